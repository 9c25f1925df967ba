"""Printed formulas held against a robot."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Optional, Union

from . import _denavit
from ._errors import FileError, UsageError
from ._formulas import Derivations


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

    @property
    def correct(self) -> Any:
        """What is right instead, as text or rows of text; ``None`` where it is not known or nothing is wrong."""
        return self.data.get("correct")

    @property
    def slip(self) -> Optional[str]:
        """The slip that explains it, in words; ``None`` where none was found."""
        found = self.data.get("slip")
        return None if found is None else str(found["words"])

    def __str__(self) -> str:
        parts = [f"line {self.line}: {self.claim} ({self.about}): {self.verdict}"]
        if self.verdict in ("wrong", "carried"):
            right = self.correct
            if isinstance(right, list):
                right = "; ".join(
                    ", ".join(map(str, row)) if isinstance(row, list) else str(row) for row in right
                )
            parts += [f"right is {right}"] if right else []
            parts += [self.slip] if self.slip else []
        return "; ".join(parts)


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

    def __str__(self) -> str:
        """A line for each claim, and how many there are of each verdict."""
        tally = ", ".join(f"{count} {verdict}" for verdict, count in self.tally.items() if count)
        lines = [str(claim) for claim in self.claims]
        lines += [
            f"line {skipped['at']['line']}: not judged: {skipped['text']}"
            for skipped in self.data.get("unjudged", [])
        ]
        return "\n".join([*lines, tally or "no claims"])


def read_document(document: Union[str, os.PathLike[str]], name: str) -> tuple[str, str]:
    """Text and name of a document: a path is read; a ``str`` with a line break in it is the text itself."""
    if isinstance(document, str) and "\n" in document:
        return document, name
    if document == "":
        raise UsageError("the document is empty: a path, or a text with a line break, is needed")
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


@dataclass(frozen=True)
class Mark:
    """What an answer earns for one of the tasks of an exercise."""

    #: What the task is called.
    name: str
    #: The points that are certain.
    points: float
    #: Further points that a teacher decides on: formulas that were not judged.
    open: float
    #: The most that it earns.
    most: float
    #: How many formulas are right, and how many were judged.
    right: int
    judged: int


@dataclass(frozen=True)
class Marked:
    """An answer to an exercise, judged and marked."""

    #: The claims with their verdicts.
    checked: Checked
    #: One a task.
    marks: list[Mark]

    @property
    def points(self) -> float:
        """The points that are certain."""
        return sum(mark.points for mark in self.marks)

    @property
    def open(self) -> float:
        """Further points that a teacher decides on."""
        return sum(mark.open for mark in self.marks)

    @property
    def most(self) -> float:
        """The most that can be earned."""
        return sum(mark.most for mark in self.marks)

    def __str__(self) -> str:
        line = "{0.name}: {0.points:g} of {0.most:g}, {0.right} of {0.judged} formulas right"
        lines = [line.format(mark) for mark in self.marks]
        return "\n".join([*lines, f"{self.points:g} of {self.most:g} points"])


@dataclass(frozen=True)
class Exercise:
    """A sheet of tasks about a robot, with its solution: see `Robot.exercise`."""

    #: ``fk``, ``dh``, ``ik``, ``jacobian``, ``singularities``, ``transforms``, ``position``, ``statics``, ``torques`` or ``path``.
    kind: str
    #: Which sheet of its kind.
    seed: int
    #: How many configurations or poses it has.
    count: int
    #: ``en`` or ``fr``.
    language: str
    #: Everything, as ``denavit exercise --format json --solution`` prints it: see ``docs/json.md``.
    data: dict[str, Any] = field(repr=False)
    #: The robot that it was made of, as it was given.
    robot: Derivations

    @property
    def title(self) -> str:
        """What it is called."""
        return str(self.data["title"])

    @property
    def statement(self) -> str:
        """The tasks, as Markdown."""
        return str(self.data["statement"])

    @property
    def solution(self) -> str:
        """The solution, as Markdown: each formula is proved, and `check` finds it so."""
        return str(self.data["solution"])

    @property
    def toml(self) -> str:
        """The robot that answers are held against, as a robot file: all its lengths have names and values."""
        return str(self.data["toml"])

    def sheet(self, format: str = "markdown", *, solution: bool = False) -> str:
        """The tasks, or the solution, as ``markdown``, or as a document of its own in ``html``, ``latex`` or ``typst``."""
        return self.robot._core.exercise_sheet(self._request, format, solution)

    def check(self, answer: Union[str, os.PathLike[str]], *, name: str = "answer.md") -> Marked:
        """What an answer earns, formula by formula: ``answer`` and ``name`` are as in `denavit.check`."""
        checked, marked = self.robot._core.exercise_marked(self._request, *read_document(answer, name))
        marks = [
            Mark(m["name"], m["points"], m["open"], m["most"], m["right"], m["judged"])
            for m in json.loads(marked)["marks"]
        ]
        return Marked(checked_of(checked), marks)

    @property
    def _request(self) -> tuple[str, int, int, str]:
        return self.kind, self.seed, self.count, self.language

    def _repr_markdown_(self) -> str:
        return self.statement


def exercise_of(robot: Derivations, kind: str, seed: int, count: int, language: str) -> Exercise:
    """The exercise of these options about a robot."""
    if seed < 0 or count < 0:
        raise UsageError(f"seed {seed}, count {count}: neither is negative")
    data = json.loads(robot._core.exercise((kind, seed, count, language)))
    return Exercise(kind, seed, count, language, data, robot)
