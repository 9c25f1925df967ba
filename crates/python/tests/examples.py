"""The examples of the documentation as modules for type checkers: `python tests/examples.py FOLDER` writes them there.

A program of a page is a module, and so is every docstring with examples.
"""

import ast
import doctest
import importlib.util
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
PACKAGE = ROOT / "crates" / "python" / "python" / "denavit"
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md")), ROOT / "docs" / "site" / "index.md"]
#: What an example may need that is large: without it, it is left out.
LARGE = "torch"


def programs(page):
    """The programs of a page, each by itself."""
    return re.findall(r"^```python\n(.*?)^```", page.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE)


def docstrings(file):
    """The examples of each docstring of a file, as programs."""
    kinds = (ast.Module, ast.ClassDef, ast.FunctionDef)
    nodes = (
        node for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))) if isinstance(node, kinds)
    )
    for text in filter(None, map(ast.get_docstring, nodes)):
        examples = doctest.DocTestParser().get_examples(text)
        if examples:
            yield "".join(example.source for example in examples)


def modules():
    """Names of modules with their texts."""
    for page in PAGES:
        for k, text in enumerate(programs(page)):
            yield f"{page.stem.lower()}_{k}", text
    for file in sorted(PACKAGE.glob("*.py")):
        for k, text in enumerate(docstrings(file)):
            yield f"docstring_{file.stem.strip('_')}_{k}", text


def main(folder):
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.glob("*.py"):
        old.unlink()
    is_there = importlib.util.find_spec(LARGE) is not None
    count = 0
    for name, text in modules():
        if is_there or f"import {LARGE}" not in text:
            (folder / f"{name.replace('-', '_')}.py").write_text(text, encoding="utf-8")
            count += 1
    print(f"{count} examples")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
