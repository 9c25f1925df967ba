"""What a robot computes: arrays of any leading shape in and out."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Literal, Optional, Union, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._answers import Answer, Answers, answer_of, answers_of
from ._denavit import Compiled, CompiledIk, Core
from ._errors import ShapeError
from ._poses import goal_of
from ._slopes import (
    AccelerationDerivatives,
    TorqueDerivatives,
    acceleration_derivatives,
    torque_derivatives,
)

Floats = NDArray[Any]


class Numbers:
    """The methods of `Robot` that compute."""

    __slots__ = ()
    _core: Core

    def fk(self, q: ArrayLike, *, out: Optional[Floats] = None, threads: Optional[int] = None) -> Floats:
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
            A 4×4 matrix; ``(p, xyzw)``, ``(p, R)`` or ``(p, Rotation)`` with SciPy's rotations; a spatialmath ``SE3``. With the goal
            ``position`` a point ``(3,)`` will do.
        near
            A configuration ``(n,)``: `Answer.nearest` is the solution next to it, of those within the limits if there are some.
        limits
            Whether solutions that the joints' limits exclude are left out; those that stay are given within the limits, whole turns
            from where they would be otherwise.
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
        >>> nearest = robot.ik(robot.fk(q), near=q).nearest
        >>> nearest is not None and nearest.round(9).tolist()
        [0.3, -1.2, 1.5, 0.4, 0.9, -0.6]
        """
        return answer_of(
            self._core.ik(goal_of(pose, goal), vector(near, "near"), limits, one, values_of(given), goal)
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
        """All configurations for many poses ``(..., 4, 4)``, or points ``(..., 3)`` with the goal ``position``, on all cores; the rest
        as in `ik`.
        """
        return answers_of(self._core.ik_batch(goal_of(poses, goal), limits, values_of(given), goal, threads))

    def torque(self, q: ArrayLike, qd: ArrayLike, qdd: ArrayLike, *, threads: Optional[int] = None) -> Floats:
        """Torques τ (N·m; N for slides) that make the accelerations ``qdd`` in the state ``(q, qd)``: ``(..., n)``.

        Friction and rotors are in them where the robot says so. The arrays ``(..., n)`` are broadcast against each other. The
        first call derives the formulas, which takes a second or two for six joints; later ones only compute.

        Raises `NoMassesError` if the robot says nothing of masses.

        >>> from denavit import Robot
        >>> pendulum = Robot.from_dh(
        ...     [{"theta": "q1", "a": "1 m", "mass": "2 kg"}],
        ...     convention="standard", gravity=[0, -9.81, 0],
        ... )
        >>> pendulum.torque([0.0], [0.0], [0.0])
        array([19.62])
        """
        return self._core.dynamics("torque", (q, qd, qdd), threads)

    def inertia(self, q: ArrayLike, *, threads: Optional[int] = None) -> Floats:
        """Inertia matrices A(q), ``(..., n, n)``; the rest as in `torque`."""
        return self._core.dynamics("inertia", (q,), threads)

    def bias(self, q: ArrayLike, qd: ArrayLike, *, threads: Optional[int] = None) -> Floats:
        """The torques without accelerations, ``(..., n)``: Coriolis, centrifugal, gravity, friction; the rest as in `torque`."""
        return self._core.dynamics("bias", (q, qd), threads)

    def gravity(self, q: ArrayLike, *, threads: Optional[int] = None) -> Floats:
        """Torques that hold the arm, ``(..., n)``; the rest as in `torque`."""
        return self._core.dynamics("gravity", (q,), threads)

    def acceleration(
        self, q: ArrayLike, qd: ArrayLike, tau: ArrayLike, *, threads: Optional[int] = None
    ) -> Floats:
        """Accelerations that the torques ``tau`` make in the state ``(q, qd)``, ``(..., n)``; the rest as in `torque`."""
        return self._core.dynamics("acceleration", (q, qd, tau), threads)

    def energy(self, q: ArrayLike, qd: ArrayLike, *, threads: Optional[int] = None) -> Floats:
        """Kinetic and potential energy, joules, ``(..., 2)``; the rest as in `torque`."""
        return self._core.dynamics("energy", (q, qd), threads)

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
        return torque_derivatives(self._core.dynamics("torque_derivatives", (q, qd, qdd), threads))

    def acceleration_derivatives(
        self, q: ArrayLike, qd: ArrayLike, tau: ArrayLike, *, threads: Optional[int] = None
    ) -> AccelerationDerivatives:
        """Accelerations with their derivatives by ``q``, ``qd`` and ``tau``, in one pass; the rest as in `torque_derivatives`."""
        return acceleration_derivatives(
            self._core.dynamics("acceleration_derivatives", (q, qd, tau), threads)
        )

    @overload
    def compile(  # type: ignore[overload-overlap]
        self, functions: Literal["ik"], *, goal: str = "pose"
    ) -> CompiledIk: ...
    @overload
    def compile(self, functions: Union[str, Sequence[str]] = "fk") -> Compiled: ...
    def compile(
        self, functions: Union[str, Sequence[str]] = "fk", *, goal: str = "pose"
    ) -> Union[Compiled, CompiledIk]:
        """Functions of this robot as one compiled program, to be called again and again.

        ``functions`` are names: ``fk``, ``frames``, ``jacobian``, ``torque``, ``inertia``, ``bias``, ``gravity``,
        ``acceleration``, ``energy``, ``torque_derivatives``, ``acceleration_derivatives``; of several, what they have in
        common is computed once. They compute what the methods of these names do by default, one state in machine code
        made for this processor, many in blocks: see `Compiled`. ``ik``, which stands alone, is the closed form by itself,
        of a ``pose`` or a ``position`` by ``goal``: see `CompiledIk`.

        >>> from denavit import Robot
        >>> both = Robot("ur5").compile(["fk", "jacobian"])
        >>> pose, jacobian = both([0.3, -1.2, 1.5, 0.4, 0.9, -0.6])
        >>> pose.shape, jacobian.shape
        ((4, 4), (6, 6))
        >>> ik = Robot("ur5").compile("ik")
        >>> found = ik(pose)
        >>> int(found.counts), found.solutions.shape, bool(found.regular)
        (8, (8, 6), True)

        Raises `UsageError` if there is no such function, `NoMassesError` or `UnsupportedError` if the robot has it not.
        """
        names = functions.split(",") if isinstance(functions, str) else functions
        names = [str(name).strip() for name in names]
        if names == ["ik"]:
            return self._core.compile_ik(goal)
        return self._core.compile(names)


def values_of(given: Optional[Mapping[Union[str, int], float]]) -> list[tuple[str, float]]:
    """Joints with their values."""
    return [(str(joint), float(x)) for joint, x in (given or {}).items()]


def vector(q: Optional[ArrayLike], what: str) -> Optional[list[float]]:
    """A vector as a list of finite numbers."""
    if q is None:
        return None
    vector = np.asarray(q, dtype=np.float64)
    if vector.ndim != 1:
        raise ShapeError(f"{what} has the shape {vector.shape}; (n,) is needed")
    if not np.all(np.isfinite(vector)):
        raise ShapeError(f"{what} holds a value that is not finite")
    result: list[float] = vector.tolist()
    return result
