"""Derivatives: of dynamics as they are computed, of poses by the geometric Jacobian."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ._errors import UnsupportedError

if TYPE_CHECKING:
    from ._robot import Robot

Floats = NDArray[Any]

#: A Jacobian whose least singular value is below this part of its greatest has no inverse.
SINGULAR = 1e-9


class TorqueDerivatives(NamedTuple):
    """Torques and their first derivatives; a row of a matrix is a torque's, a column a joint's."""

    #: τ, ``(..., n)``.
    torque: Floats
    #: ∂τ/∂q, ``(..., n, n)``.
    by_q: Floats
    #: ∂τ/∂q̇, ``(..., n, n)``.
    by_qd: Floats
    #: ∂τ/∂q̈ = A(q), ``(..., n, n)``.
    inertia: Floats


class AccelerationDerivatives(NamedTuple):
    """Accelerations and their first derivatives; a row of a matrix is an acceleration's, a column a joint's."""

    #: q̈, ``(..., n)``.
    acceleration: Floats
    #: ∂q̈/∂q, ``(..., n, n)``.
    by_q: Floats
    #: ∂q̈/∂q̇, ``(..., n, n)``.
    by_qd: Floats
    #: ∂q̈/∂τ = A(q)⁻¹, ``(..., n, n)``.
    by_torque: Floats


def parts(found: Floats) -> tuple[Floats, Floats, Floats, Floats]:
    """What stands side by side, ``(..., n, 3 n + 1)``: values and three matrices."""
    n = found.shape[-2]
    cut = [found[..., 1 + k * n : 1 + (k + 1) * n] for k in range(3)]
    return found[..., 0], cut[0], cut[1], cut[2]


def torque_derivatives(found: Floats) -> TorqueDerivatives:
    """Torques with their derivatives from what stands side by side."""
    return TorqueDerivatives(*parts(found))


def acceleration_derivatives(found: Floats) -> AccelerationDerivatives:
    """Accelerations with their derivatives from what stands side by side."""
    return AccelerationDerivatives(*parts(found))


def pose_slopes(pose: Floats, jacobian: Floats) -> Floats:
    """∂T/∂q of poses T ``(..., 4, 4)`` with geometric Jacobians ``(..., 6, n)`` along the base: ``(..., 4, 4, n)``."""
    v, w = jacobian[..., :3, :], jacobian[..., 3:, :]
    slopes = np.zeros((*pose.shape, jacobian.shape[-1]), dtype=jacobian.dtype)
    # Column c of ∂R/∂q_j is w_j × R[:, c].
    r = pose[..., :3, :3]
    slopes[..., :3, :3, :] = np.cross(w[..., :, None, :], r[..., :, :, None], axis=-3)
    slopes[..., :3, 3, :] = v
    return slopes


def solution_slopes(pose: Floats, jacobian: Floats) -> Floats:
    """∂q/∂T at solutions of poses T, ``(..., n, 4, 4)``: the joints that follow a change of the pose that keeps it one.

    The pseudoinverse of the Jacobian maps the twist of dT, ω = vee(dR Rᵀ), onto the joints; what of a change no pose has, or the
    arm cannot follow, is left out. Where the arm is singular there is no such derivative: NaN.
    """
    is_known = np.isfinite(jacobian).all(axis=(-2, -1), keepdims=True)
    u, s, vt = np.linalg.svd(np.where(is_known, jacobian, 0.0), full_matrices=False)
    is_regular = s[..., -1:] > SINGULAR * s[..., :1]
    with np.errstate(divide="ignore", invalid="ignore"):
        inverse = np.swapaxes(vt, -1, -2) * np.where(is_regular, 1.0 / s, np.nan)[..., None, :]
    inverse = inverse @ np.swapaxes(u, -1, -2)
    slopes = np.zeros((*inverse.shape[:-1], 4, 4), dtype=jacobian.dtype)
    slopes[..., :3, 3] = inverse[..., :3]
    # ω = ½ Σ_c R[:, c] × dR[:, c].
    r = pose[..., :3, :3]
    slopes[..., :3, :3] = 0.5 * np.cross(inverse[..., 3:, None], r[..., None, :, :], axis=-2)
    unknown: Floats = np.asarray(np.isnan(inverse).any(axis=-1))
    return np.where(unknown[..., None, None], np.nan, slopes)


def refuse_redundant(robot: Robot) -> None:
    """Raises `UnsupportedError` for an arm with more joints than the hand can use."""
    if robot.n > 6:
        raise UnsupportedError(f"{robot.name} has {robot.n} joints: solutions are no functions of the pose")


def nearest_solutions(robot: Robot, pose: Floats, near: Floats) -> Floats:
    """The solutions nearest to ``near`` ``(..., n)`` of poses ``(..., 4, 4)``; NaN where none was found."""
    poses = np.asarray(pose, dtype=np.float64).reshape(-1, 4, 4)
    starts = np.asarray(near, dtype=np.float64).reshape(-1, robot.n)
    found = np.full(starts.shape, np.nan)
    for k, (one, start) in enumerate(zip(poses, starts)):
        answer = robot.ik(one, near=start)
        if answer.nearest is not None:
            found[k] = answer.nearest
    return found.reshape(near.shape)
