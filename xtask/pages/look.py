"""Compiles Typst documents: `python look.py FOLDER`. Fails on warnings, on ink in the margins of a page, and on slides that run over
theirs: these say in their first lines how many pages they are."""

import io
import pathlib
import re
import sys

import typst
from PIL import Image

MARGIN_CM = 1.5  # The text leaves 2.2 cm.
PPI = 40


def main(folder):
    findings = []
    documents = sorted(pathlib.Path(folder).glob("*.typ"))
    for path in documents:
        pages, warnings = typst.compile_with_warnings(str(path), format="png", ppi=PPI)
        findings += [f"{path.name}: {warning}" for warning in warnings]
        pages = [pages] if isinstance(pages, bytes) else pages
        said = re.search(r"^// (\d+) pages$", path.read_text(encoding="utf-8"), re.M)
        if said and int(said[1]) != len(pages):
            findings.append(f"{path.name}: {len(pages)} pages, where its steps are {said[1]}")
        for number, png in enumerate(pages, 1):
            page = Image.open(io.BytesIO(png)).convert("L")
            wide = int(MARGIN_CM / 2.54 * PPI)
            sides = [(0, 0, wide, page.height), (page.width - wide, 0, page.width, page.height)]
            if any(page.crop(side).getextrema()[0] < 200 for side in sides):
                findings.append(f"{path.name}: page {number} has ink in its margins")
    for finding in findings:
        print(finding, file=sys.stderr)
    print(f"{len(documents)} documents by Typst: {len(findings)} findings")
    return 1 if findings else 0


sys.exit(main(sys.argv[1]))
