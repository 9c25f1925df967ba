"""What motions are: samples, and what a path of the hand meets."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, NamedTuple, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._denavit import Moving
from ._motion import Motions

Floats = NDArray[np.float64]
#: What a motion was made of: a robot, ``path`` or ``follow``, and what the module takes.
Made = tuple[Motions, str, tuple[Any, ...]]


class State(NamedTuple):
    """Joints at times, ``(..., n)`` each: rad or m, per second, per second squared."""

    q: Floats
    qd: Floats
    qdd: Floats


@dataclass(frozen=True, eq=False)
class Event:
    """Something that a path of the hand meets."""

    #: Where: the part of the way, from 0 to 1.
    s: float
    #: ``singular``, ``limit``, ``within_limits`` or ``end``.
    kind: str
    #: In words.
    words: str
    #: The joints there, ``(n,)``.
    q: Floats
    #: The joint that leaves its limits or enters them again, from 1.
    joint: Optional[int]
    #: The limit.
    limit: Optional[float]
    #: The factor of the Jacobian's determinant that is 0, where it is one that is known.
    factor: Optional[str]
    #: How the axes lie, where that is known.
    why: Optional[str]
    #: Whether the factor changes its sign.
    crossed: Optional[bool]
    #: Whether the hand could go on in another branch, where the path ends.
    reachable: Optional[bool]


class Clearance(NamedTuple):
    """How near a path comes to a singular configuration."""

    #: Where it is nearest, from 0 to 1.
    s: float
    #: The joints there, ``(n,)``.
    q: Floats
    #: The smallest singular value of the Jacobian there, lengths by the reach.
    smallest: float


class Deviation(NamedTuple):
    """How far the hand leaves its path at most."""

    #: Metres.
    distance: float
    #: Radians.
    angle: float


class Held(NamedTuple):
    """The greatest parts of their limits that a motion takes, 1 at the limit; None of what is not limited."""

    #: At so many instants it was looked at, from the start to the end, evenly.
    instants: int
    velocity: float
    acceleration: Optional[float]
    jerk: Optional[float]
    torque: Optional[float]


class Start(NamedTuple):
    """A configuration in which a path can start, and what comes of it."""

    #: The joints, ``(n,)``.
    q: Floats
    #: Its branch: ``shoulder+ elbow−``.
    branch: str
    #: The part of the path that it follows, 1 if all.
    reached: float
    #: How many singular configurations are on the way.
    singular: int
    #: Whether it stays within the limits.
    within_limits: bool


@dataclass(frozen=True, eq=False)
class Motion:
    """A motion of all joints, in samples; `at` gives it at other times."""

    #: Seconds, ``(k,)``.
    t: Floats
    #: Joints, ``(k, n)``, radians and metres.
    q: Floats
    #: Their velocities, ``(k, n)``.
    qd: Floats
    #: Their accelerations, ``(k, n)``.
    qdd: Floats
    #: Poses of the tool, ``(k, 4, 4)``.
    poses: Floats
    #: √det(J Jᵀ), lengths by the arm's size, ``(k,)``.
    manipulability: Floats
    #: Seconds.
    duration: float
    #: What path it is, in words.
    course: str
    #: How it was timed, in words.
    timing: str
    #: What it takes of its limits, where jerks or torques are limited along a path.
    held: Optional[Held]
    #: Whether it goes to the end of the path, within the limits.
    ok: bool
    #: The same in words.
    verdict: str
    #: The part of the path that could be followed, 1 if all.
    reached: float
    #: How far the hand leaves its path between samples, where it has one.
    deviation: Optional[Deviation]
    #: Whether all singular configurations on the way are among `events`, where the hand has a path.
    certified: Optional[bool]
    #: How near the path comes to a singular configuration, where no factors tell.
    clearance: Optional[Clearance]
    #: What a path of the hand meets, in order.
    events: list[Event]
    #: Configurations in which a path of the hand can start, where that was asked for or matters.
    starts: list[Start]
    _moving: Moving = field(repr=False)
    _made: Made = field(repr=False)

    def at(self, t: ArrayLike) -> State:
        """The state at times ``t``, seconds, of any shape ``(...)``: ``(..., n)`` each; at rest before and behind the motion."""
        times = np.asarray(t, dtype=np.float64)
        found = self._moving.at(times.ravel().tolist())
        return State(*(one.reshape(*times.shape, self.q.shape[1]) for one in found))

    def __len__(self) -> int:
        return len(self.t)

    def __reduce__(self) -> tuple[Any, Made]:
        """A copy is planned again: the same request gives the same motion."""
        return motion_of, self._made

    def __repr__(self) -> str:
        return f"<Motion: {self.course}, {self.duration:.4g} s, {len(self)} samples; {self.verdict}>"


def motion_of(robot: Motions, manner: str, arguments: tuple[Any, ...]) -> Motion:
    """The motion that a robot plans: ``path`` or ``follow`` with what the module takes."""
    found: dict[str, Any] = getattr(robot._core, manner)(*arguments)
    found["poses"] = found["poses"].reshape(-1, 4, 4)
    found["events"] = [Event(**event) for event in found["events"]]
    found["starts"] = [Start(*start) for start in found["starts"]]
    found["deviation"] = None if found["deviation"] is None else Deviation(*found["deviation"])
    found["held"] = None if found["held"] is None else Held(*found["held"])
    found["clearance"] = None if found["clearance"] is None else Clearance(*found["clearance"])
    return Motion(_moving=found.pop("moving"), _made=(robot, manner, arguments), **found)
