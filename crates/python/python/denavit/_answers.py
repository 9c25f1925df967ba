"""What inverse kinematics answers."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple, Optional, Union, overload

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Family:
    """Configurations that have the pose and hang together: the arm moves there with its hand still."""

    #: One of them, ``(n,)``.
    q: Floats
    #: Its branch: ``shoulder+ elbow−``.
    branch: str
    #: Its distance from the pose.
    residual: float
    #: Whether the limits allow it.
    within_limits: bool
    #: How many parameters the family has.
    dimension: int
    #: The unknowns that are free: ``q4``, ``q2 + q3 + q4``.
    free: list[str]
    #: How the joints move at ``q``, a unit vector ``(n,)``.
    direction: Floats
    #: Whether they move in these proportions everywhere.
    affine: bool
    #: The values of one free unknown for which there is a solution.
    interval: Optional[tuple[float, float]]
    #: The stretches of what is free within the limits, for redundant arms.
    feasible: list[tuple[float, float]]
    #: Members along it, ``(m, n)``, where it was followed.
    curve: Floats


@dataclass(frozen=True, eq=False)
class Obstacle:
    """Why there is no solution, and the configuration that comes nearest."""

    #: In words.
    why: str
    #: The nearest configuration, ``(n,)``.
    q: Floats
    #: By how much its orientation is off, radians.
    angle: float
    #: By how much its position is off, metres.
    distance: float


@dataclass(frozen=True, eq=False)
class Answer:
    """All configurations that bring the tool to a pose.

    >>> from denavit import Robot
    >>> robot = Robot("staubli-rx90")
    >>> answer = robot.ik(robot.fk([0.1, 0.2, 0.3, 0.4, 0.5, 0.6]))
    >>> answer
    <Answer: solved, 8 solutions, complete, closed form>
    >>> answer.branches[0]
    'shoulder+ elbow+ wrist+'
    """

    #: The isolated solutions ``(N, n)``, radians and metres, angles in (−π, π].
    solutions: Floats
    #: Distances of the solutions from the pose ``(N,)``: rotation, and position by the arm's size.
    residuals: Floats
    #: The branch of each solution.
    branches: list[str]
    #: How many branches coincide in each solution ``(N,)``.
    multiplicities: NDArray[np.int64]
    #: Whether the limits allow each solution, or a copy of it whole turns away ``(N,)``.
    within_limits: NDArray[np.bool_]
    #: Where the arm can move with its hand still.
    families: list[Family]
    #: Whether these are all solutions, with those that were left out.
    complete: bool
    #: ``solved``; ``unreachable`` where it is certain that there is no solution; ``outside the limits`` where there are some, and
    #: all were left out; ``not found``.
    status: str
    #: ``closed form``, ``elimination``, ``self-motion`` or ``descent``.
    method: str
    #: Why there may be more.
    doubt: Optional[str] = None
    #: How many solutions and families the limits exclude, where these were asked for.
    left_out: int = 0
    #: The solution nearest to ``near``, of those within the limits if there are some; whole turns away where that is nearer and
    #: the limits allow it.
    nearest: Optional[Floats] = None
    #: Why there is none.
    obstacle: Optional[Obstacle] = None
    #: Joints whose values went with the pose.
    given: tuple[tuple[str, float], ...] = ()

    def __len__(self) -> int:
        return len(self.solutions)

    def __iter__(self) -> Iterator[Floats]:
        return iter(self.solutions)

    def __bool__(self) -> bool:
        """Whether there is a solution or a family of them."""
        return len(self.solutions) > 0 or len(self.families) > 0

    def __repr__(self) -> str:
        parts = [self.status, _plural(len(self.solutions), "solution", "solutions")]
        if self.families:
            parts.append(_plural(len(self.families), "family", "families"))
        parts += ["complete" if self.complete else "may not be complete", self.method]
        return f"<Answer: {', '.join(parts)}>"


def _plural(count: int, one: str, many: str) -> str:
    return f"{count} {one if count == 1 else many}"


@dataclass(frozen=True, eq=False)
class Answers:
    """The answers of many poses; the solutions stand one behind the other in arrays.

    >>> from denavit import Robot
    >>> robot = Robot("ur5")
    >>> answers = robot.ik_batch(robot.fk([[0.1, -1.0, 1.2, 0.3, 0.8, 0.2], [0.3, -1.2, 1.5, 0.4, 0.9, -0.6]]))
    >>> answers.counts, answers.solutions.shape
    (array([8, 8]), (16, 6))
    >>> answers[1]
    <Answer: solved, 8 solutions, complete, closed form>
    """

    #: The solutions of all poses ``(total, n)``: those of pose ``i`` are ``solutions[offsets[i]:offsets[i + 1]]``.
    solutions: Floats
    #: Their distances from the poses ``(total,)``.
    residuals: Floats
    #: Their branches.
    branches: list[str]
    #: How many branches coincide in each ``(total,)``.
    multiplicities: NDArray[np.int64]
    #: Whether the limits allow each ``(total,)``.
    within_limits: NDArray[np.bool_]
    #: How many solutions each pose has, in the leading shape of the poses.
    counts: NDArray[np.int64]
    #: Where the solutions of each pose begin, ``(N + 1,)``.
    offsets: NDArray[np.int64]
    #: Whether all solutions of a pose are here, in the leading shape of the poses.
    complete: NDArray[np.bool_]
    #: ``solved``, ``unreachable``, ``outside the limits`` or ``not found``, one a pose.
    status: list[str]
    #: How many solutions and families of each pose the limits exclude, where these were asked for.
    left_out: list[int]
    #: The families of each pose.
    families: list[list[Family]]
    #: ``closed form``, ``elimination``, ``self-motion`` or ``descent``.
    method: str

    def __len__(self) -> int:
        return len(self.status)

    @overload
    def __getitem__(self, i: Union[int, tuple[int, ...]]) -> Answer: ...
    @overload
    def __getitem__(self, i: slice) -> list[Answer]: ...
    def __getitem__(self, i: Union[int, tuple[int, ...], slice]) -> Union[Answer, list[Answer]]:
        """The answer of one pose, counted along the flattened leading shape, or by an index for each of its axes."""
        if isinstance(i, slice):
            return [self[k] for k in range(*i.indices(len(self)))]
        if isinstance(i, tuple):
            if len(i) != self.counts.ndim:
                raise IndexError(
                    f"answer {i} of poses {self.counts.shape}: {self.counts.ndim} indices are needed"
                )
            numbers = np.arange(len(self)).reshape(self.counts.shape)
            return self[int(numbers[i])]
        k = i + len(self) if i < 0 else i
        if not 0 <= k < len(self):
            raise IndexError(f"answer {i} of {len(self)}")
        part = slice(int(self.offsets[k]), int(self.offsets[k + 1]))
        return Answer(
            solutions=self.solutions[part],
            residuals=self.residuals[part],
            branches=self.branches[part],
            multiplicities=self.multiplicities[part],
            within_limits=self.within_limits[part],
            families=self.families[k],
            complete=bool(self.complete.flat[k]),
            status=self.status[k],
            left_out=self.left_out[k],
            method=self.method,
        )

    def __iter__(self) -> Iterator[Answer]:
        return (self[k] for k in range(len(self)))

    def __repr__(self) -> str:
        solved = self.status.count("solved")
        return f"<Answers: {len(self)} poses, {solved} solved, {len(self.solutions)} solutions>"


class Branches(NamedTuple):
    """The branches of a closed form as they are computed: what `CompiledIk` gives.

    Poses that are not ``regular`` are worth a look by `Robot.ik`: families, coinciding solutions, and what rounding hides.
    """

    #: Configurations ``(..., most, n)``, NaN behind the last one of a pose.
    solutions: Floats
    #: How many each pose has ``(...)``.
    counts: NDArray[np.int64]
    #: Whether all branches of a pose are plain: none undetermined, double, or almost a solution ``(...)``.
    regular: NDArray[np.bool_]


def answer_of(found: dict[str, Any]) -> Answer:
    found["families"] = [Family(**family) for family in found["families"]]
    found["given"] = tuple(found["given"])
    if found["obstacle"] is not None:
        found["obstacle"] = Obstacle(*found["obstacle"])
    return Answer(**found)


def answers_of(found: dict[str, Any]) -> Answers:
    shape = tuple(found.pop("shape"))
    counts = found.pop("counts")
    families: list[list[Family]] = [[] for _ in range(len(counts))]
    for number, each in found["families"].items():
        families[number] = [Family(**family) for family in each]
    found["families"] = families
    found["offsets"] = np.concatenate([[0], np.cumsum(counts)]).astype(np.int64)
    found["complete"] = found["complete"].reshape(shape)
    return Answers(counts=counts.reshape(shape), **found)
