"""Robots."""

from __future__ import annotations

import html
import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._answers import Answer, Answers, answer_of, answers_of
from ._denavit import Core
from ._denavit import catalogue as _catalogue
from ._documents import Checked, checked_of, read_document
from ._errors import Finding, ShapeError, findings_of
from ._files import write
from ._poses import matrix_of
from ._rows import toml_of, value
from ._slopes import AccelerationDerivatives, TorqueDerivatives, parts

Floats = NDArray[Any]
PathLike = Union[str, os.PathLike[str]]


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


class Robot:
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
        self._core = Core.catalogue(name, base, tip, convention)

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
        to choose from, `FileError` if it cannot be read. What is worth saying besides is in `findings`.
        """
        given = [(str(k), str(v)) for k, v in (arguments or {}).items()]
        folders = [(str(k), os.fspath(v)) for k, v in (packages or {}).items()]
        name = os.fspath(path)
        return cls._of(
            Core.file(
                name, base, tip, convention, given, folders, as_written, angles, lengths, table, columns
            )
        )

    @classmethod
    def from_dh(
        cls,
        rows: Iterable[Union[Mapping[str, Any], Sequence[Any]]],
        *,
        convention: str,
        name: str = "robot",
        parameters: Optional[Mapping[str, Any]] = None,
        base: Optional[Mapping[str, Any]] = None,
        tool: Optional[Mapping[str, Any]] = None,
        gravity: Optional[Sequence[Any]] = None,
    ) -> Robot:
        """A robot from the rows of its table.

        A row is a mapping by the letters of the convention, or a sequence in the order of its transforms: theta, d, a, alpha
        (``standard``); alpha, a, theta, d (``craig``); alpha, d, theta, r (``khalil``). A cell is a number (metres, radians)
        or a text: ``"q1"``, ``"q2 - 90 deg"``, ``"450 mm"``, ``"L1"``; the cell with the joint's variable makes the row
        revolute or prismatic, a row without one does not move. A mapping also holds ``limits``, ``velocity``,
        ``acceleration``, ``name``, ``mass``, ``com``, ``inertia``, ``rotor``, ``viscous`` and ``coulomb``, as robot files do.
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
            Frame 0 in the base and the tool in the last frame: ``{"xyz": …, "rpy": …}`` or ``{"matrix": …}``.
        gravity
            The acceleration of gravity in the base, m/s²; 9.81 along −z otherwise.

        Raises `DescriptionError` with all findings if a row has errors.
        """
        text = toml_of(rows, convention, name, parameters, base, tool, gravity)
        return cls._of(Core.text(text, name))

    @classmethod
    def from_toml(cls, text: str, *, name: str = "robot") -> Robot:
        """A robot from the text of a robot file; ``name`` is what findings call the text.

        Raises `DescriptionError` with all findings if it has errors.
        """
        return cls._of(Core.text(text, name))

    def chain(self, base: Optional[str] = None, tip: Optional[str] = None) -> Robot:
        """Another chain of the tree that this one was taken from; its file is read again.

        Raises `ChainError` if there is no such chain, or the robot is one chain.
        """
        return Robot._of(self._core.chain(base, tip))

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
        return Robot._of(self._core.converted(convention))

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
        """The table and a picture, for notebooks."""
        head, rows = self._core.table
        cells = "".join(f"<th>{html.escape(h)}</th>" for h in head)
        body = "".join(
            "<tr>" + "".join(f"<td>{html.escape(c)}</td>" for c in row) + "</tr>" for row in rows
        )
        title = html.escape(repr(self)[len("<Robot: ") : -1])
        return (
            f"<div><p><strong>{title}</strong></p><table><thead><tr>{cells}</tr></thead>"
            f"<tbody>{body}</tbody></table>{self.figure()}</div>"
        )

    def __eq__(self, other: object) -> bool:
        """Whether the robot files are the same."""
        return self.toml == other.toml if isinstance(other, Robot) else NotImplemented

    def __hash__(self) -> int:
        return hash(self.toml)

    def __reduce__(self) -> tuple[Any, ...]:
        return (_unpickled, (self.toml,))

    def fk(
        self, q: ArrayLike, *, out: Optional[Floats] = None, threads: Optional[int] = None
    ) -> Floats:
        """Poses of the tool in the base.

        ``q`` has the shape ``(..., n)``, radians and metres; the poses have ``(..., 4, 4)``. Arrays of float32 are computed
        in single precision, others in double. ``out`` takes the result; ``threads`` is how many threads compute, as many as
        pay otherwise.

        >>> from denavit import Robot
        >>> Robot("ur5").fk([[0.0] * 6] * 3).shape
        (3, 4, 4)

        Raises `ShapeError` if the shape is another one, `MissingValueError` if a parameter has no value.
        """
        return self._core.fk(q, out, threads)

    def frames(
        self,
        q: ArrayLike,
        of: Optional[Sequence[Union[str, int]]] = None,
        *,
        out: Optional[Floats] = None,
        threads: Optional[int] = None,
    ) -> Floats:
        """Poses of frames in the base, ``(..., m, 4, 4)`` for ``q`` of the shape ``(..., n)``.

        ``of`` names ``m`` frames: numbers from 0, names of rows, ``"base"`` or ``"tool"``; frames 0 … of all rows and then
        the tool otherwise.

        >>> from denavit import Robot
        >>> Robot("ur5").frames([0.0] * 6).shape, Robot("ur5").frames([0.0] * 6, of=[3, "tool"]).shape
        ((8, 4, 4), (2, 4, 4))
        """
        words = None if of is None else [str(frame) for frame in of]
        return self._core.frames(q, words, out, threads)

    def jacobian(
        self,
        q: ArrayLike,
        *,
        of: Union[str, int] = "tool",
        frame: Union[str, int] = "base",
        at: Union[str, int, None] = None,
        out: Optional[Floats] = None,
        threads: Optional[int] = None,
    ) -> Floats:
        """Geometric Jacobians, ``(..., 6, n)`` for ``q`` of the shape ``(..., n)``; rows vx, vy, vz, wx, wy, wz.

        It is that of the body ``of``, a frame or the tool, at its origin or at that of the frame ``at``, along the axes of
        ``frame``.

        >>> from denavit import Robot
        >>> Robot("ur5").jacobian([0.0] * 6).shape
        (6, 6)
        """
        where = None if at is None else str(at)
        return self._core.jacobian(q, str(of), str(frame), where, out, threads)

    def ik(
        self,
        pose: Any,
        *,
        near: Optional[ArrayLike] = None,
        limits: bool = False,
        one: bool = False,
        given: Optional[Mapping[Union[str, int], float]] = None,
        goal: str = "pose",
    ) -> Answer:
        """All configurations that bring the tool to a pose in the base.

        Parameters
        ----------
        pose
            A 4×4 matrix; ``(p, xyzw)``, ``(p, R)`` or ``(p, Rotation)`` with SciPy's rotations; a spatialmath ``SE3``.
        near
            A configuration ``(n,)``: `Answer.nearest` is the solution next to it.
        limits
            Whether solutions that the joints' limits exclude are left out.
        one
            Whether one solution will do: within the limits if one is, and near to ``near``.
        given
            Values of joints, by number from 1 or by name, for arms with more joints than the hand can use; without it they
            are answered with their self-motion.
        goal
            ``pose``, or ``position`` where the orientation does not matter.

        Raises `ShapeError` or `PoseError` if it is no pose. A pose out of reach is no error: `Answer.status` says so.

        >>> from denavit import Robot
        >>> robot = Robot("ur5")
        >>> q = [0.3, -1.2, 1.5, 0.4, 0.9, -0.6]
        >>> robot.ik(robot.fk(q), near=q).nearest.round(9).tolist()
        [0.3, -1.2, 1.5, 0.4, 0.9, -0.6]
        """
        return answer_of(
            self._core.ik(matrix_of(pose), _vector(near, "near"), limits, one, _given(given), goal)
        )

    def ik_batch(
        self,
        poses: Any,
        *,
        limits: bool = False,
        given: Optional[Mapping[Union[str, int], float]] = None,
        goal: str = "pose",
        threads: Optional[int] = None,
    ) -> Answers:
        """All configurations for many poses ``(..., 4, 4)``, on all cores; the rest as in `ik`."""
        return answers_of(self._core.ik_batch(matrix_of(poses), limits, _given(given), goal, threads))

    def torque(
        self, q: ArrayLike, qd: ArrayLike, qdd: ArrayLike, *, threads: Optional[int] = None
    ) -> Floats:
        """Torques τ (N·m; N for slides) that make the accelerations ``qdd`` in the state ``(q, qd)``: ``(..., n)``.

        Friction and rotors are in them where the robot says so. The arrays ``(..., n)`` are broadcast against each other.

        Raises `NoMassesError` if the robot says nothing of masses.

        >>> from denavit import Robot
        >>> pendulum = Robot.from_dh(
        ...     [{"theta": "q1", "a": "1 m", "mass": "2 kg"}],
        ...     convention="standard", gravity=[0, -9.81, 0],
        ... )
        >>> pendulum.torque([0.0], [0.0], [0.0])
        array([19.62])
        """
        return self._core.dynamics("torque", self._state(q=q, qd=qd, qdd=qdd), threads)

    def inertia(self, q: ArrayLike, *, threads: Optional[int] = None) -> Floats:
        """Inertia matrices A(q), ``(..., n, n)``; the rest as in `torque`."""
        return self._core.dynamics("inertia", self._state(q=q), threads)

    def bias(self, q: ArrayLike, qd: ArrayLike, *, threads: Optional[int] = None) -> Floats:
        """The torques without accelerations, ``(..., n)``: Coriolis, centrifugal, gravity, friction; the rest as in `torque`."""
        return self._core.dynamics("bias", self._state(q=q, qd=qd), threads)

    def gravity(self, q: ArrayLike, *, threads: Optional[int] = None) -> Floats:
        """Torques that hold the arm, ``(..., n)``; the rest as in `torque`."""
        return self._core.dynamics("gravity", self._state(q=q), threads)

    def acceleration(
        self, q: ArrayLike, qd: ArrayLike, tau: ArrayLike, *, threads: Optional[int] = None
    ) -> Floats:
        """Accelerations that the torques ``tau`` make in the state ``(q, qd)``, ``(..., n)``; the rest as in `torque`."""
        return self._core.dynamics("acceleration", self._state(q=q, qd=qd, tau=tau), threads)

    def energy(self, q: ArrayLike, qd: ArrayLike, *, threads: Optional[int] = None) -> Floats:
        """Kinetic and potential energy, joules, ``(..., 2)``; the rest as in `torque`."""
        return self._core.dynamics("energy", self._state(q=q, qd=qd), threads)

    def torque_derivatives(
        self, q: ArrayLike, qd: ArrayLike, qdd: ArrayLike, *, threads: Optional[int] = None
    ) -> TorqueDerivatives:
        """Torques with their derivatives by ``q``, ``qd`` and ``qdd``, in one pass; the rest as in `torque`.

        Coulomb friction counts as constant.

        >>> from denavit import Robot
        >>> pendulum = Robot.from_dh(
        ...     [{"theta": "q1", "a": "1 m", "mass": "2 kg"}],
        ...     convention="standard", gravity=[0, -9.81, 0],
        ... )
        >>> found = pendulum.torque_derivatives([0.0], [0.0], [1.0])
        >>> found.torque, found.inertia
        (array([21.62]), array([[2.]]))
        """
        state = self._state(q=q, qd=qd, qdd=qdd)
        return TorqueDerivatives(*parts(self._core.dynamics("torque with derivatives", state, threads)))

    def acceleration_derivatives(
        self, q: ArrayLike, qd: ArrayLike, tau: ArrayLike, *, threads: Optional[int] = None
    ) -> AccelerationDerivatives:
        """Accelerations with their derivatives by ``q``, ``qd`` and ``tau``, in one pass; the rest as in `torque_derivatives`."""
        state = self._state(q=q, qd=qd, tau=tau)
        return AccelerationDerivatives(
            *parts(self._core.dynamics("acceleration with derivatives", state, threads))
        )

    def _state(self, **vectors: ArrayLike) -> Floats:
        """Vectors side by side, ``(..., k·n)``."""
        arrays = []
        for name, given in vectors.items():
            vector = np.asarray(given)
            if vector.shape[-1:] != (self.n,):
                raise ShapeError(f"{name} has the shape {vector.shape}; (..., {self.n}) is needed")
            arrays.append(vector)
        try:
            together = np.broadcast_arrays(*arrays)
        except ValueError:
            shapes = ", ".join(f"{k} {a.shape}" for k, a in zip(vectors, arrays))
            raise ShapeError(f"the shapes do not go together: {shapes}") from None
        return np.concatenate(together, axis=-1)

    def derive(
        self,
        format: str = "text",
        *,
        frame: Union[str, int] = "base",
        of: Union[str, int] = "tool",
        only: str = "all",
    ) -> str:
        """Link transforms, the simplified pose of ``of`` in ``frame``, and the shortest algorithm for it, proved.

        ``format`` is ``text``, ``latex``, ``typst``, ``markdown``, ``html`` or ``json``; ``only`` what the algorithm
        computes: ``all``, or a list of ``position``, ``orientation``, ``x``, ``y``, ``z``.

        >>> from denavit import Robot
        >>> "t14 = " in Robot("ur5").derive()
        True
        """
        return self._core.derive_text(format, str(frame), str(of), only)

    def ik_explain(
        self,
        format: str = "text",
        *,
        given: Optional[Sequence[Union[str, int]]] = None,
        goal: str = "pose",
    ) -> str:
        """How the closed form of the inverse kinematics is derived, step by step, each step proved.

        Formats as in `derive`. Raises `UnsupportedError` with the reason if there is no closed form.
        """
        words = None if given is None else [str(joint) for joint in given]
        return self._core.ik_explain(format, words, goal)

    def jacobian_explain(self, format: str = "text", *, of: Union[str, int] = "tool") -> str:
        """The Jacobian in the frame where it is shortest, its determinant in factors, and why the arm is singular where one
        is zero. Formats as in `derive`.
        """
        return self._core.jacobian_explain(format, str(of))

    def dynamics_explain(self, format: str = "text") -> str:
        """Base parameters and torques as formulas, step by step; symbols of Khalil and Dombre's names where the robot says
        nothing of masses. Formats as in `derive`.
        """
        return self._core.dynamics_explain(format)

    def check(self, document: PathLike, *, name: str = "document.md") -> Checked:
        """The claims of a document about this robot, each with its verdict: see `denavit.check`."""
        return checked_of(self._core.check(*read_document(document, name)))

    def generate(
        self,
        language: str,
        functions: Sequence[str] = ("fk", "jacobian", "ik"),
        *,
        folder: Optional[PathLike] = None,
        name: Optional[str] = None,
        goal: str = "pose",
        overwrite: bool = False,
    ) -> dict[str, str]:
        """Source code that builds and tests itself: texts by the path of their file.

        Written to ``folder`` where one is given; files that are there already with other contents stay, all of them, unless
        ``overwrite`` says otherwise.

        >>> from denavit import Robot
        >>> sorted(Robot("ur5").generate("c", ["fk"], name="ur5"))[:2]
        ['Makefile', 'test_ur5.c']

        Raises `UsageError` if there is no such language or function, `UnsupportedError` if there is no such code, `FileError`
        if a file stands in the way or cannot be written.
        """
        if isinstance(functions, str):
            functions = [part.strip() for part in functions.split(",")]
        files = dict(self._core.generate(language, list(functions), name, goal)[0])
        if folder is not None:
            write(Path(folder), files, overwrite)
        return files

    def report(self, format: str = "html", *, language: str = "en") -> str:
        """What a lab report would contain, as one page of ``html``, or as ``latex`` or ``typst``; in ``en`` or ``fr``."""
        return self._core.report(format, language)

    def figure(self, q: Optional[ArrayLike] = None, *, scheme: bool = False) -> str:
        """The arm with its frames and lengths as SVG, at ``q`` or where it shows well; ``scheme`` draws the line diagram."""
        return self._core.figure(_vector(q, "q"), scheme)


def _unpickled(text: str) -> Robot:
    return Robot.from_toml(text)


def _given(given: Optional[Mapping[Union[str, int], float]]) -> list[tuple[str, float]]:
    return [(str(joint), float(x)) for joint, x in (given or {}).items()]


def _vector(q: Optional[ArrayLike], what: str) -> Optional[list[float]]:
    if q is None:
        return None
    vector = np.asarray(q, dtype=np.float64)
    if vector.ndim != 1:
        raise ShapeError(f"{what} has the shape {vector.shape}; (n,) is needed")
    if not np.all(np.isfinite(vector)):
        raise ShapeError(f"{what} holds a value that is not finite")
    result: list[float] = vector.tolist()
    return result
