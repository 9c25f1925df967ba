"""The interface of EAIK's Python package: programs written for it run with another import.

>>> import numpy as np
>>> from denavit.eaik import DhRobot       # was: from eaik.IK_DH import DhRobot
>>> half = np.pi / 2
>>> robot = DhRobot(
...     np.array([half, 0, 0, half, -half, 0]), np.array([0, -0.425, -0.39225, 0, 0, 0]),
...     np.array([0.089159, 0, 0, 0.10915, 0.09465, 0.0823]),
... )
>>> found = robot.IK(robot.fwdKin(np.array([0.3, -1.2, 1.5, 0.4, 0.9, -0.6])))
>>> found.num_solutions(), any(found.is_LS)
(8, False)

What differs: solutions are all of them where `Solutions.complete` says so; a pose out of reach has the one configuration that comes
nearest, with ``is_LS`` true, and families of solutions (at singular poses) one member each. Interface of EAIK 1.2.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._answers import Answer
from ._errors import ShapeError, UnsupportedError
from ._robot import Robot

Floats = NDArray[np.float64]
Fixed = Optional[Sequence[tuple[int, float]]]


@dataclass(frozen=True, eq=False)
class Solutions:
    """What `IKRobot.IK` gives."""

    #: Configurations of all joints, ``(n,)`` each.
    Q: list[Floats]
    #: Whether each only comes nearest to the pose.
    is_LS: list[bool]
    #: Whether these are all solutions.
    complete: bool = field(default=True)

    def num_solutions(self) -> int:
        """How many there are."""
        return len(self.Q)


class IKRobot:
    """A robot with the methods of ``eaik.IK_Robot.IKRobot``."""

    def __init__(self, robot: Robot, fixed_axes: Fixed = None) -> None:
        #: The robot as this package has it.
        self.robot = robot
        self._given: dict[Union[str, int], float] = {i + 1: float(q) for i, q in fixed_axes or ()}

    def fwdKin(self, q: ArrayLike) -> Floats:
        """The pose of the tool, 4×4, at all joints ``(n,)``."""
        pose: Floats = self.robot.fk(np.asarray(q, dtype=np.float64))
        return pose

    def IK(self, pose: Any) -> Solutions:
        """All configurations for a 4×4 pose."""
        return self._solutions(self.robot.ik(pose, given=self._given))

    def IK_batched(self, pose_batch: Any, num_worker_threads: Optional[int] = None) -> list[Solutions]:
        """The same for poses ``(N, 4, 4)`` or a list of them."""
        poses = np.asarray(pose_batch, dtype=np.float64)
        if poses.ndim != 3 or poses.shape[1:] != (4, 4):
            raise ShapeError(f"pose_batch has the shape {poses.shape}; (N, 4, 4) is needed")
        answers = self.robot.ik_batch(poses, given=self._given, threads=num_worker_threads)
        # What comes nearest where nothing is found is asked for pose by pose.
        return [self._solutions(answer) if answer else self.IK(pose) for pose, answer in zip(poses, answers)]

    def hasKnownDecomposition(self) -> bool:
        """Whether there is a closed form."""
        try:
            self.robot.ik_explain(given=list(self._given) or None)
        except UnsupportedError:
            return False
        return True

    def _solutions(self, answer: Answer) -> Solutions:
        found = [*answer.solutions, *(family.q for family in answer.families)]
        if not found and answer.obstacle is not None:
            return Solutions([answer.obstacle.q], [True], answer.complete)
        return Solutions(found, [False] * len(found), answer.complete)


class DhRobot(IKRobot):
    """A robot of revolute joints from the columns of its standard table: as ``eaik.IK_DH.DhRobot``."""

    def __init__(
        self, dh_alpha: ArrayLike, dh_a: ArrayLike, dh_d: ArrayLike, fixed_axes: Fixed = None
    ) -> None:
        columns = [np.atleast_1d(np.asarray(c, dtype=np.float64)) for c in (dh_d, dh_a, dh_alpha)]
        if len({c.shape for c in columns}) != 1 or columns[0].ndim != 1:
            raise ShapeError(f"the columns have the shapes {', '.join(str(c.shape) for c in columns)}")
        rows = [(f"q{k + 1}", *map(float, row)) for k, row in enumerate(zip(*columns))]
        super().__init__(Robot.from_dh(rows, convention="standard"), fixed_axes)


class HPRobot(IKRobot):
    """A robot of revolute joints from directions ``H`` ``(n, 3)`` and offsets ``P`` ``(n + 1, 3)``: as ``eaik.IK_HP.HPRobot``."""

    def __init__(self, H: ArrayLike, P: ArrayLike, fixed_axes: Fixed = None) -> None:
        directions, offsets = (np.asarray(x, dtype=np.float64) for x in (H, P))
        n = len(directions)
        if directions.shape != (n, 3) or offsets.shape != (n + 1, 3):
            raise ShapeError(
                f"H and P have the shapes {directions.shape} and {offsets.shape}; (n, 3) and (n + 1, 3) are needed"
            )
        points = np.cumsum(offsets, axis=0)
        axes = [
            f"[[axes]]\npoint = {list(map(float, point))}\ndirection = {list(map(float, direction))}\n"
            for point, direction in zip(points, directions)
        ]
        tip = f"[tip]\nxyz = {list(map(float, points[-1]))}\n"
        super().__init__(Robot.from_toml("\n".join(['name = "robot"\n', *axes, tip])), fixed_axes)


class UrdfRobot(IKRobot):
    """A robot from a URDF file: as ``eaik.IK_URDF.UrdfRobot``, with the tool where ``tip`` is, the last link otherwise."""

    def __init__(
        self,
        file_path: Union[str, os.PathLike[str]],
        fixed_axes: Fixed = None,
        *,
        base: Optional[str] = None,
        tip: Optional[str] = None,
    ) -> None:
        super().__init__(Robot.from_file(file_path, base=base, tip=tip), fixed_axes)
