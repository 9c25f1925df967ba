"""Printed formulas held against a robot."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Union

from . import _denavit
from ._errors import FileError


@dataclass(frozen=True)
class Claim:
    """An equation that a document prints, with its verdict."""

    #: What it is about, in words.
    about: str
    #: Its left side as printed.
    claim: str
    #: ``equal``, ``wrong``, ``carried``, ``conditional``, ``undecided`` or ``unreadable``.
    verdict: str
    #: The line, from 1.
    line: int
    #: Everything that is known of it: see ``docs/json.md``.
    data: dict[str, Any] = field(repr=False)


@dataclass(frozen=True)
class Checked:
    """A document with its verdicts.

    >>> from denavit import check
    >>> found = check('''| j | alpha | a | theta | d |
    ... |---|---|---|---|---|
    ... | 1 | 0 | 0 | q1 | 0 |
    ... | 2 | 0 | L1 | q2 | 0 |
    ... | 3 | 0 | L2 | 0 | 0 |
    ...
    ... Craig's convention. The position is
    ...
    ... $p_x = L_1 \\\\cos\\\\theta_1 + L_2 \\\\cos(\\\\theta_1 + \\\\theta_2)$
    ...
    ... $p_y = L_1 \\\\sin\\\\theta_1 - L_2 \\\\sin(\\\\theta_1 + \\\\theta_2)$
    ... ''', name="homework.md")
    >>> [(claim.claim, claim.verdict) for claim in found.claims]
    [('p_x', 'equal'), ('p_y', 'wrong')]
    """

    #: What it claims, in its order.
    claims: list[Claim]
    #: How many claims there are of each verdict.
    tally: dict[str, int]
    #: Everything that is known, as ``denavit check --json`` prints it: see ``docs/json.md``.
    data: dict[str, Any] = field(repr=False)

    @property
    def ok(self) -> bool:
        """Whether nothing is wrong, undecided or unreadable."""
        bad = ("wrong", "carried", "conditional", "undecided", "unreadable")
        return not any(self.tally[verdict] for verdict in bad)


def read_document(document: Union[str, os.PathLike[str]], name: str) -> tuple[str, str]:
    """Text and name of a document: a path is read; a ``str`` with a line break in it is the text itself."""
    if isinstance(document, str) and "\n" in document:
        return document, name
    path = Path(document)
    try:
        return path.read_text(encoding="utf-8", errors="replace"), str(path)
    except OSError as why:
        raise FileError(f"{path}: {why.strerror}") from None


def checked_of(text: str) -> Checked:
    data = json.loads(text)
    claims = [Claim(c["about"], c["claim"], c["verdict"], c["at"]["line"], c) for c in data["claims"]]
    return Checked(claims, data["tally"], data)


def check(document: Union[str, os.PathLike[str]], *, name: str = "document.md") -> Checked:
    """The claims of a document about the robot whose table stands in it, each with its verdict.

    ``document`` is the path of a file, or a text: a ``str`` with a line break in it. ``name`` says by its ending what a text
    is: ``.md``, ``.tex``, ``.txt``, a program in ``.py`` or ``.m``. `Robot.check` holds a document against a robot that you have.

    Raises `DescriptionError` if the document has no table that can be read, `FileError` if it cannot be opened.
    """
    return checked_of(_denavit.check(*read_document(document, name)))
