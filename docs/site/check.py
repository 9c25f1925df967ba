"""Looks at the site as it was built: `python check.py FOLDER`, with the package on the path.

Fails on a link within it that leads nowhere, on what would be fetched from elsewhere, on pictures without words, and on public names
of the package that it does not describe.
"""

import importlib
import inspect
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

from sphinx.util.inventory import InventoryFile

import denavit

#: What is fetched with a page, and by which attribute.
FETCHED = {"img": "src", "script": "src", "iframe": "src", "link": "href", "source": "src"}
#: Modules beside the package itself whose names are public.
MODULES = ["denavit.eaik", "denavit.ikpy", "denavit.lerobot"]
ROOT = Path(sys.argv[1])
#: The page of `denavit view`, which has tests of its own.
APP = ROOT / "view"


class Page(HTMLParser):
    """Links, names of places, and findings of a page."""

    def __init__(self, file):
        super().__init__()
        self.links, self.places, self.findings = [], set(), []
        self.feed(file.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        of = dict(attributes)
        self.places.update(of[key] for key in ("id", "name") if of.get(key))
        if tag == "img" and not of.get("alt"):
            self.findings.append(f"a picture without words: {of.get('src')}")
        fetched = of.get(FETCHED.get(tag, ""))
        if fetched and urlsplit(fetched).scheme not in ("", "data"):
            self.findings.append(f"fetched from elsewhere: {fetched}")
        link = fetched or (of.get("href") if tag == "a" else None)
        if link:
            self.links.append(link)


def broken(file, page, pages):
    """The links of a page that lead nowhere."""
    for link in page.links:
        parts = urlsplit(link)
        if parts.scheme or parts.netloc:
            continue
        to = (file.parent / unquote(parts.path)).resolve() if parts.path else file
        if to.is_dir():
            to = to / "index.html"
        if not to.is_file():
            yield f"{link} leads nowhere"
        elif parts.fragment and to in pages and unquote(parts.fragment) not in pages[to].places:
            yield f"{link} leads to no place of the page"


def public():
    """Public names: what the package exports, and the members of its classes."""
    exported = {f"denavit.{name}": getattr(denavit, name) for name in denavit.__all__}
    exported.pop("denavit.__version__")
    for name in MODULES:
        module = importlib.import_module(name)
        own = {n: x for n, x in vars(module).items() if getattr(x, "__module__", None) == name}
        exported.update({f"{name}.{n}": x for n, x in own.items() if not n.startswith("_")})
    for name, found in exported.items():
        yield name
        if inspect.isclass(found):
            # What another public class hands on is described there.
            bases = [base for base in found.__mro__ if base.__module__.startswith("denavit")]
            own = [base for base in bases if base is found or base not in exported.values()]
            members = {member for base in own for member in vars(base) if not member.startswith("_")}
            yield from (f"{name}.{member}" for member in members)


def main():
    files = sorted(f for f in ROOT.rglob("*.html") if APP not in f.parents)
    pages = {file.resolve(): Page(file) for file in files}
    findings = [f"{file}: {text}" for file, page in pages.items() for text in page.findings]
    findings += [f"{file}: {text}" for file, page in pages.items() for text in broken(file, page, pages)]
    inventory = InventoryFile.loads((ROOT / "objects.inv").read_bytes(), uri="").data
    described = {name for kind in inventory if kind.startswith("py:") for name in inventory[kind]}
    findings += [f"{name} is not described" for name in sorted(set(public()) - described)]
    links = sum(len(page.links) for page in pages.values())
    print(
        "\n".join(
            [
                *findings,
                f"{len(pages)} pages, {links} links, {len(described)} names: {len(findings)} findings",
            ]
        )
    )
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
