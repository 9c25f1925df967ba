"""Robots."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._denavit import Core
from ._denavit import catalogue as _catalogue
from ._errors import DescriptionWarning, Finding, findings_of
from ._formulas import Derivations, PathLike
from ._motion import Motions
from ._numbers import Numbers
from ._rows import toml_of, value

Floats = NDArray[Any]


def catalogue() -> list[str]:
    """The names of all arms of the catalogue.

    >>> import denavit
    >>> "ur5" in denavit.catalogue()
    True
    """
    return _catalogue()[0]


@dataclass(frozen=True)
class Joint:
    """A joint of a robot."""

    #: Its variable: ``q1``.
    variable: str
    #: What its file calls it.
    name: Optional[str]
    #: ``revolute`` or ``prismatic``.
    kind: str
    #: The least and the greatest value of its variable, radians or metres.
    limits: Optional[tuple[float, float]]
    #: Its largest speed, rad/s or m/s.
    velocity: Optional[float]


class Robot(Numbers, Derivations, Motions):
    """A robot arm: one chain of joints, from its table.

    ``Robot(name)`` takes one of the catalogue (see `catalogue`); `from_file`, `from_dh` and `from_toml` read others. A robot
    never changes; it can be pickled, and used by several threads at once.

    >>> from denavit import Robot
    >>> robot = Robot("staubli-rx90")
    >>> robot
    <Robot: Stäubli RX-90, 6 joints (RRRRRR), khalil convention>
    >>> robot.joints[0]
    Joint(variable='q1', name=None, kind='revolute', limits=None, velocity=None)

    ``base`` and ``tip`` name the ends of the chain where the name is that of a tree.

    Raises `UnknownRobotError` if there is no such robot; it says what may have been meant.
    """

    __slots__ = ("_core",)
    _core: Core

    def __init__(
        self,
        name: str,
        *,
        base: Optional[str] = None,
        tip: Optional[str] = None,
        convention: Optional[str] = None,
    ) -> None:
        self._core = _warned(Core.catalogue(name, base, tip, convention))

    @classmethod
    def _of(cls, core: Core) -> Robot:
        robot = cls.__new__(cls)
        robot._core = core
        return robot

    @classmethod
    def from_file(
        cls,
        path: PathLike,
        *,
        base: Optional[str] = None,
        tip: Optional[str] = None,
        convention: Optional[str] = None,
        arguments: Optional[Mapping[str, Any]] = None,
        packages: Optional[Mapping[str, PathLike]] = None,
        as_written: bool = False,
        angles: Optional[str] = None,
        lengths: Optional[str] = None,
        table: Optional[int] = None,
        columns: Optional[str] = None,
    ) -> Robot:
        """A robot from a file: a robot file (``.toml``, ``.par``), a URDF, xacro or MJCF, a table in Markdown, CSV or LaTeX, or a
        program (``.py``, ``.m``), which is read and not run.

        Parameters
        ----------
        base, tip
            Where the chain begins and ends: links of a URDF or MJCF, frames of a tree of rows; from the root to the leaf
            with the most joints otherwise.
        convention
            ``standard``, ``craig`` or ``khalil``: of a table that does not say it, or of the table that is made of bodies.
        arguments, packages
            Values of a xacro file's arguments; folders of packages by name, where they do not lie beside the file.
        as_written
            Whether 1.5708 in a URDF or MJCF stays what it is, and is not a quarter turn.
        angles, lengths
            ``deg`` or ``rad``, ``mm`` or ``m``: units of numbers without unit in a table.
        table, columns
            Which table of a document, from 1; what its columns mean, as in ``"theta alpha a d"``.

        Raises `DescriptionError` with all findings if the file has errors, `ChainError` if there is no such chain or several
        to choose from, `FileError` if it cannot be read. What is worth saying besides is in `findings`; warnings are raised as
        `DescriptionWarning`, too, by Python's ``warnings``.
        """
        given = [(str(k), str(v)) for k, v in (arguments or {}).items()]
        folders = [(str(k), os.fspath(v)) for k, v in (packages or {}).items()]
        name = os.fspath(path)
        core = Core.file(
            name, base, tip, convention, given, folders, as_written, angles, lengths, table, columns
        )
        return cls._of(_warned(core))

    @classmethod
    def from_dh(
        cls,
        rows: Iterable[Union[Mapping[str, Any], Sequence[Any]]],
        *,
        convention: str,
        name: str = "robot",
        parameters: Optional[Mapping[str, Any]] = None,
        base: Union[Mapping[str, Any], ArrayLike, None] = None,
        tool: Union[Mapping[str, Any], ArrayLike, None] = None,
        gravity: Optional[Sequence[Any]] = None,
    ) -> Robot:
        """A robot from the rows of its table.

        A row is a mapping by the letters of the convention, or a sequence in the order of its transforms: theta, d, a, alpha
        (``standard``); alpha, a, theta, d (``craig``); alpha, d, theta, r (``khalil``). A cell is a number (metres, radians)
        or a text: ``"q1"``, ``"q2 - 90 deg"``, ``"450 mm"``, ``"L1"``; the cell with the joint's variable makes the row
        revolute or prismatic, a row without one does not move. A mapping also holds ``limits``, ``velocity``,
        ``acceleration``, ``name``, ``mass``, ``com``, ``inertia``, ``rotor``, ``viscous`` and ``coulomb``, as robot files do (``com`` in the row's
        frame; ``inertia`` about it: xx, xy, xz, yy, yz, zz).
        As there, a float that is the nearest double to a multiple of π/12 is that angle exactly, so that ``math.pi / 2`` is a
        quarter turn; `findings` says so.

        >>> import math
        >>> from denavit import Robot
        >>> arm = Robot.from_dh(
        ...     [("q1", "h", 0, math.pi / 2), ("q2", 0, "L", 0)],
        ...     convention="standard", parameters={"h": 0.4, "L": "300 mm"},
        ... )
        >>> arm.fk([0.0, math.pi / 2]).round(12)[:3, 3].tolist()
        [0.0, 0.0, 0.7]

        Parameters
        ----------
        parameters
            Symbols of the table with their values; ``None`` for one without value, which formulas carry.
        base, tool
            Frame 0 in the base and the tool in the last frame: ``{"xyz": …, "rpy": …}``, ``{"matrix": …}``, or a 4×4 matrix.
        gravity
            The acceleration of gravity in the base, m/s²; 9.81 along −z otherwise.

        Raises `DescriptionError` with all findings if a row has errors.
        """
        text = toml_of(rows, convention, name, parameters, base, tool, gravity)
        return cls._of(_warned(Core.text(text, name)))

    @classmethod
    def from_toml(cls, text: str, *, name: str = "robot") -> Robot:
        """A robot from the text of a robot file; ``name`` is what findings call the text.

        Raises `DescriptionError` with all findings if it has errors.
        """
        return cls._of(_warned(Core.text(text, name)))

    def chain(self, base: Optional[str] = None, tip: Optional[str] = None) -> Robot:
        """Another chain of the tree that this one was taken from; its file is read again.

        Raises `ChainError` if there is no such chain, or the robot is one chain.
        """
        return Robot._of(_warned(self._core.chain(base, tip)))

    def set(self, **values: Union[str, float, int]) -> Robot:
        """The robot with values for its parameters: ``robot.set(D3=0.45)``, ``robot.set(D3="450 mm")``.

        Raises `UsageError` if there is no such parameter, or it is no value.
        """
        texts = [(k, v if isinstance(v, str) else value(v)) for k, v in values.items()]
        return Robot._of(self._core.set(texts))

    def converted(self, convention: str) -> Robot:
        """The robot in another convention, proved to be the same chain; where that is not decided `findings` has a warning.

        >>> from denavit import Robot
        >>> Robot("ur5").converted("craig").convention
        'craig'
        """
        return Robot._of(_warned(self._core.converted(convention), known=len(self._core.findings)))

    @property
    def name(self) -> str:
        """What people call it."""
        return self._core.name

    @property
    def source(self) -> Optional[str]:
        """Where the numbers come from."""
        return self._core.source

    @property
    def convention(self) -> str:
        """``standard``, ``craig`` or ``khalil``."""
        return self._core.convention

    @property
    def joints(self) -> list[Joint]:
        """Its joints, in order."""
        return [Joint(*joint) for joint in self._core.joints]

    @property
    def n(self) -> int:
        """How many joints it has."""
        return len(self._core.joints)

    @property
    def parameters(self) -> dict[str, Optional[float]]:
        """Its symbols with their values, metres and radians; ``None`` for one without value."""
        return dict(self._core.parameters)

    @property
    def poses(self) -> dict[str, Floats]:
        """Configurations that have names, ``(n,)`` each."""
        return {name: np.array(q) for name, q in self._core.poses}

    @property
    def has_masses(self) -> bool:
        """Whether it says something of masses."""
        return self._core.has_masses

    @property
    def findings(self) -> tuple[Finding, ...]:
        """Warnings, and notes on how its text was understood."""
        return findings_of(self._core.findings)

    @property
    def toml(self) -> str:
        """The robot as the text of a robot file."""
        return self._core.toml

    def __repr__(self) -> str:
        kinds = "".join("R" if joint.kind == "revolute" else "P" for joint in self.joints)
        joints = f"{len(kinds)} joint{'' if len(kinds) == 1 else 's'} ({kinds})"
        return f"<Robot: {self.name}, {joints}, {self.convention} convention>"

    def __str__(self) -> str:
        head, rows = self._core.table
        widths = [max(map(len, column)) for column in zip(head, *rows)]
        lines = ["  ".join(c.ljust(w) for c, w in zip(row, widths)).rstrip() for row in [head, *rows]]
        return "\n".join([repr(self)[len("<Robot: ") : -1], "", *("  " + line for line in lines)])

    def _repr_html_(self) -> str:
        """The table, a picture and the pose as a formula, for notebooks."""
        import html

        head, rows = self._core.table
        cells = "".join(f"<th>{html.escape(h)}</th>" for h in head)
        body = "".join("<tr>" + "".join(f"<td>{html.escape(c)}</td>" for c in row) + "</tr>" for row in rows)
        title = html.escape(repr(self)[len("<Robot: ") : -1])
        return (
            f"<div><p><strong>{title}</strong></p><table><thead><tr>{cells}</tr></thead>"
            f"<tbody>{body}</tbody></table>{self.figure()}{self._pose_in_html()}</div>"
        )

    def _pose_in_html(self) -> str:
        """The pose of the tool in MathML; nothing of arms with more joints than a reader would follow."""
        if self.n > 7:
            return ""
        parts = self._core.derive_text("html", "base", "tool", "all").split("<h2 ")
        found = (part for part in parts if ">Forward model" in part.split("</h2>")[0])
        return "".join(f"<h4>{part.split('>', 1)[1].replace('</h2>', '</h4>')}" for part in found)

    def __eq__(self, other: object) -> bool:
        """Whether the robot files are the same."""
        return self.toml == other.toml if isinstance(other, Robot) else NotImplemented

    def __hash__(self) -> int:
        return hash(self.toml)

    def __reduce__(self) -> tuple[Any, ...]:
        return (_unpickled, (self.toml,))


def _warned(core: Core, known: int = 0) -> Core:
    """The same, its warnings but those that are known raised where the package was called."""
    found = [finding for finding in findings_of(core.findings)[known:] if finding.severity == "warning"]
    if found:
        import sys
        import warnings
        from types import FrameType

        level = 1
        frame: FrameType | None = sys._getframe()
        while frame is not None and frame.f_globals.get("__name__", "").startswith("denavit."):
            level, frame = level + 1, frame.f_back
        for finding in found:
            warnings.warn(finding.rendered, DescriptionWarning, stacklevel=level)
    return core


def _unpickled(text: str) -> Robot:
    return Robot._of(Core.text(text, "robot"))


def _compiled(text: str, names: list[str], goal: str) -> Any:
    robot = _unpickled(text)
    return robot.compile("ik", goal=goal) if names == ["ik"] else robot.compile(names)
