"""The interface of LeRobot's kinematics: its arms (SO-100, SO-101, Koch) by this package, with nothing else to install.

``RobotKinematics`` stands for ``lerobot.model.kinematics.RobotKinematics``; angles are degrees there, and here::

    from denavit.lerobot import RobotKinematics      # was: from lerobot.model.kinematics import RobotKinematics

    kinematics = RobotKinematics("so101_new_calib.urdf", "gripper_frame_link")
    pose = kinematics.forward_kinematics(degrees)
    degrees = kinematics.inverse_kinematics(degrees, pose)
    kinematics.residual                              # how far off the last pose is: metres, radians

An arm with five joints reaches no arbitrary pose: what comes nearest by the weights is sought from the current joints on, which may end at
a local minimum; `RobotKinematics.residual` says how near it is.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._descent import descend
from ._errors import ShapeError, UsageError
from ._poses import matrix_of
from ._robot import Robot

Floats = NDArray[np.float64]


class RobotKinematics:
    """Forward and inverse kinematics of an arm from a URDF, in degrees.

    Parameters
    ----------
    urdf_path
        The URDF file.
    target_frame_name
        The link whose pose is meant.
    joint_names
        The joints in the order of the vectors; those of the chain to that link otherwise.

    Raises the errors of `Robot.from_file`; `UsageError` if a name is that of no joint on the chain.
    """

    def __init__(
        self,
        urdf_path: Union[str, os.PathLike[str]],
        target_frame_name: str = "gripper_frame_link",
        joint_names: Optional[Sequence[str]] = None,
    ) -> None:
        #: The arm as this package has it.
        self.robot = Robot.from_file(urdf_path, tip=target_frame_name)
        own = [joint.name or joint.variable for joint in self.robot.joints]
        #: The joints, in the order of the vectors.
        self.joint_names = list(own if joint_names is None else joint_names)
        unknown = [name for name in own if name not in self.joint_names]
        if unknown:
            raise UsageError(
                f"joint_names lacks {', '.join(unknown)}, which the chain to {target_frame_name} has"
            )
        self._order = [self.joint_names.index(name) for name in own]
        limits = [joint.limits or (-np.inf, np.inf) for joint in self.robot.joints]
        self._lower, self._upper = np.array(limits, dtype=np.float64).reshape(-1, 2).T
        #: How far the pose that was found last is from the one that was asked for: metres, radians.
        self.residual = (0.0, 0.0)

    def forward_kinematics(self, joint_pos_deg: ArrayLike) -> Floats:
        """The pose of the link in the base, 4×4; joints behind those of `joint_names` (a gripper) do not count."""
        pose: Floats = self.robot.fk(self._radians(joint_pos_deg))
        return pose

    def inverse_kinematics(
        self,
        current_joint_pos: ArrayLike,
        desired_ee_pose: Any,
        position_weight: float = 1.0,
        orientation_weight: float = 0.01,
    ) -> Floats:
        """Joints in degrees for a pose, near to the current ones; what stands behind `joint_names` comes back as it is.

        The pose itself where the arm has it, in the solution next to the current joints within the limits; else a local minimum of the
        sum of squares of the distance (m) times ``position_weight`` and the angle (rad) times ``orientation_weight``, by steps from
        the current joints on. A weight of 0 leaves that part free.
        """
        given = np.asarray(current_joint_pos, dtype=np.float64)
        start = self._radians(given)
        target = np.asarray(matrix_of(desired_ee_pose), dtype=np.float64)
        if target.shape != (4, 4):
            raise ShapeError(f"desired_ee_pose has the shape {target.shape}; (4, 4) is needed")
        found: Optional[Floats] = None
        if position_weight > 0.0 and orientation_weight > 0.0:
            found = self.robot.ik(target, near=start, limits=True).nearest
        if found is None:
            found = self._descend(start, target, position_weight, orientation_weight)
        off = self._off(found, target)
        self.residual = (float(np.linalg.norm(off[:3])), float(np.linalg.norm(off[3:])))
        result = given.copy()
        result[self._order] = np.degrees(found)
        return result

    def _radians(self, degrees: ArrayLike) -> Floats:
        given = np.asarray(degrees, dtype=np.float64)
        if given.ndim != 1 or len(given) < len(self.joint_names):
            raise ShapeError(f"the joints have the shape {given.shape}; ({len(self.joint_names)},) is needed")
        return np.radians(given[self._order])

    def _off(self, q: Floats, target: Floats) -> Floats:
        """What moves the hand onto the target: a way, and a turn as a vector, in the base."""
        pose = self.robot.fk(q)
        turn = target[:3, :3] @ pose[:3, :3].T
        vector = 0.5 * np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]])
        sine, cosine = np.linalg.norm(vector), 0.5 * (np.trace(turn) - 1.0)
        angle = np.arctan2(sine, cosine)
        if sine > 1e-9:
            vector *= angle / sine
        elif cosine < 0.0:
            # Half a turn, 2 a aᵀ − 1: its axis is along the longest column with 1 added on the diagonal.
            columns = turn + np.eye(3)
            axis = columns[:, np.argmax(np.diag(turn))]
            vector = np.pi * axis / np.linalg.norm(axis)
        return np.concatenate([target[:3, 3] - pose[:3, 3], vector])

    def _descend(self, q: Floats, target: Floats, position: float, orientation: float) -> Floats:
        """A local minimum within the limits."""
        weights = np.repeat([np.sqrt(position), np.sqrt(orientation)], 3)

        def off(q: Floats) -> Floats:
            missing: Floats = weights * self._off(q, target)
            return missing

        def slopes(q: Floats) -> Floats:
            by: Floats = weights[:, None] * self.robot.jacobian(q)
            return by

        return descend(q, self._lower, self._upper, off, slopes)
