"""Motions: paths of the joints and of the hand, followed and timed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Optional, Union, cast

import numpy as np
from numpy.typing import ArrayLike

from ._denavit import Core
from ._errors import ShapeError, UsageError
from ._numbers import vector
from ._poses import matrix_of

if TYPE_CHECKING:
    from ._paths import Motion

Limits = Optional[Union[float, ArrayLike]]


class Motions:
    """The methods of `Robot` that move it."""

    __slots__ = ()
    _core: Core

    def path(
        self,
        points: ArrayLike,
        *,
        velocity: Limits = None,
        acceleration: Limits = None,
        jerk: Limits = None,
        torque: Limits = None,
        duration: Optional[float] = None,
        dt: Optional[float] = None,
        law: Optional[str] = None,
        blend: Optional[float] = None,
    ) -> Motion:
        """A path of the joints through configurations ``(m, n)``, timed as fast as the limits allow.

        Parameters
        ----------
        points
            Two configurations for a move, more for a smooth curve through them.
        velocity, acceleration, jerk
            The largest of each joint: one number for all or one each, ``(n,)``, rad/s or m/s and so on; velocities and
            accelerations of the robot's own file where they are not given. Without accelerations the law is a quintic.
        torque
            The largest torque of each drive, N·m (N for slides), of a robot with masses; needs velocities, and goes with
            accelerations and jerks.
        duration
            Seconds for the whole path, no less than the limits allow.
        dt
            Seconds between samples; two hundred samples at most otherwise.
        law
            Of a move between two configurations: ``cubic``, ``quintic``, ``trapezoidal`` or ``jerk-limited``.
        blend
            Go straight between configurations and round each corner at this distance, radians and metres.

        Raises `MotionError` if there is no such motion, `UsageError` if the options do not go together, `NoMassesError` if
        torques are limited of a robot that says nothing of masses.

        >>> from denavit import Robot
        >>> motion = Robot("ur5").path([[0.0] * 6, [1.0] * 6], velocity=2.0, acceleration=4.0, law="trapezoidal")
        >>> motion.duration
        1.0
        >>> motion.at(0.5).qd.round(9).tolist()
        [2.0, 2.0, 2.0, 2.0, 2.0, 2.0]
        """
        through = np.asarray(points, dtype=np.float64)
        n = self._joints()
        if through.ndim != 2 or through.shape[1] != n or len(through) < 2:
            raise ShapeError(f"points has the shape {through.shape}; (m, {n}) with two or more is needed")
        if not np.all(np.isfinite(through)):
            raise ShapeError("points holds a value that is not finite")
        manner = self._manner(velocity, acceleration, jerk, torque, duration, dt)
        from ._paths import motion_of

        return motion_of(self, "path", (through.tolist(), {**manner, "law": law, "blend": blend}))

    def follow(
        self,
        poses: Any,
        *,
        start: Optional[ArrayLike] = None,
        along: Union[str, ArrayLike, Sequence[Union[str, ArrayLike]]] = "line",
        max_deviation: Optional[float] = None,
        speed: float = 0.25,
        alternatives: bool = False,
        velocity: Limits = None,
        acceleration: Limits = None,
        jerk: Limits = None,
        torque: Limits = None,
        duration: Optional[float] = None,
        dt: Optional[float] = None,
    ) -> Motion:
        """A path of the hand through poses ``(m, 4, 4)``, followed by the joints and timed.

        Parameters
        ----------
        poses
            Poses as in `ik_batch`.
        start
            The configuration ``(n,)`` at the start; where its hand is elsewhere the path begins there. Otherwise every branch of
            the first pose is tried, and the one that goes furthest is taken.
        along
            What is between poses: ``line``, ``screw`` (about and along one axis in space), or a point ``(3,)`` in the base that an
            arc goes through; one for all or one for each piece. ``spline`` is a smooth curve through all poses.
        max_deviation
            How far the hand may leave its path between samples of the joints, metres; a hundredth of a millimetre otherwise.
        speed
            The hand's speed on the average where no accelerations are known, m/s.
        alternatives
            Whether `Motion.starts` says what comes of every configuration in which the path can start.
        velocity, acceleration, jerk, torque, duration, dt
            As in `path`.

        Where the path cannot be followed to its end `Motion.reached` is below 1, and the last of `Motion.events` says why.

        Raises `MotionError` if the start is out of reach or there is no such timing; the rest as in `path` and `ik_batch`.

        >>> from denavit import Robot
        >>> robot = Robot("ur5")
        >>> pose = robot.fk([0.3, -1.2, 1.5, 0.4, 0.9, -0.6])
        >>> there = pose.copy()
        >>> there[2, 3] += 0.1
        >>> motion = robot.follow([pose, there], duration=2.0)
        >>> motion.ok, motion.deviation is not None and float(motion.deviation.distance) < 1e-5
        (True, True)
        >>> bool(abs(motion.poses[-1] - there).max() < 1e-5)
        True
        """
        pieces: list[Any] = (
            [along] if isinstance(along, str) or _is_point(along) else list(cast(Sequence[Any], along))
        )
        entries = [p if isinstance(p, str) else _point(p) for p in pieces]
        manner = self._manner(velocity, acceleration, jerk, torque, duration, dt)
        manner.update(max_deviation=max_deviation, speed=speed, alternatives=alternatives)
        from ._paths import motion_of

        pieces_between = None if entries == ["spline"] else entries
        return motion_of(
            self, "follow", (matrix_of(poses).copy(), pieces_between, vector(start, "start"), manner)
        )

    def _joints(self) -> int:
        return len(self._core.joints)

    def _manner(
        self,
        velocity: Limits,
        acceleration: Limits,
        jerk: Limits,
        torque: Limits,
        duration: Optional[float],
        dt: Optional[float],
    ) -> dict[str, Any]:
        n = self._joints()
        return {
            "velocity": _limits(velocity, "velocity", n),
            "acceleration": _limits(acceleration, "acceleration", n),
            "jerk": _limits(jerk, "jerk", n),
            "torque": _limits(torque, "torque", n),
            "duration": duration,
            "dt": dt,
            "law": None,
            "blend": None,
            "speed": None,
            "max_deviation": None,
            "alternatives": False,
        }


def _limits(given: Limits, what: str, n: int) -> Optional[list[float]]:
    if given is None:
        return None
    values = np.asarray(given, dtype=np.float64)
    if values.shape not in ((), (n,)):
        raise ShapeError(f"{what} has the shape {values.shape}; one number or ({n},) is needed")
    if not np.all(values > 0.0):
        raise UsageError(f"{what} holds {values[~(values > 0.0)].item(0)}: positive numbers are needed")
    each: list[float] = np.broadcast_to(values, (n,)).tolist()
    return each


def _is_point(given: Any) -> bool:
    """Whether it is three numbers, and not a list of pieces."""
    entries = list(given)
    return len(entries) == 3 and all(np.ndim(x) == 0 and not isinstance(x, str) for x in entries)


def _point(given: ArrayLike) -> list[float]:
    point = np.asarray(given, dtype=np.float64)
    if point.shape != (3,):
        raise ShapeError(f"a point of an arc has the shape {point.shape}; (3,) is needed")
    place: list[float] = point.tolist()
    return place
