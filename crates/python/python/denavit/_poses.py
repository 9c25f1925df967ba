"""Poses as people have them, as 4×4 matrices."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._errors import PoseError, ShapeError

Floats = NDArray[np.float64]


def matrix_of(pose: Any) -> Floats:
    """A pose, or an array of poses, as an array ``(..., 4, 4)``.

    Taken are 4×4 matrices, pairs ``(p, rotation)`` of a position and a quaternion x, y, z, w, a 3×3 matrix or SciPy's
    ``Rotation``, and what has its matrix as ``A`` (spatialmath's ``SE3``) or gives it by ``as_matrix()`` (SciPy's
    ``RigidTransform``).
    """
    if isinstance(pose, np.ndarray) and pose.dtype != object:
        return pose
    if isinstance(pose, tuple) and len(pose) == 2:
        return _of_pair(*pose)
    given: Any = pose
    if hasattr(given, "as_matrix"):
        return np.asarray(given.as_matrix(), dtype=np.float64)
    if hasattr(given, "A"):
        matrix = given.A
        return np.stack(matrix) if isinstance(matrix, list) else np.asarray(matrix, dtype=np.float64)
    try:
        return np.asarray(pose, dtype=np.float64)
    except (TypeError, ValueError) as why:
        raise ShapeError(f"pose is no array: {why}") from None


def goal_of(given: Any, goal: str) -> Floats:
    """What is to be reached: poses as in `matrix_of`; points ``(..., 3)``, too, where the orientation does not matter."""
    found = matrix_of(given)
    if goal != "position" or found.shape[-1:] != (3,) or found.dtype.kind not in "fiu":
        return found
    return _of_pair(found, np.eye(3))


def _of_pair(position: Any, rotation: Any) -> Floats:
    p = np.asarray(position, dtype=np.float64)
    if p.shape[-1:] != (3,):
        raise ShapeError(f"the position has the shape {p.shape}; (..., 3) is needed")
    if hasattr(rotation, "as_matrix"):
        r = np.asarray(rotation.as_matrix(), dtype=np.float64)
    else:
        r = np.asarray(rotation, dtype=np.float64)
        if r.shape[-2:] != (3, 3):
            r = _of_quaternion(r)
    leading = np.broadcast_shapes(p.shape[:-1], r.shape[:-2])
    matrix = np.zeros((*leading, 4, 4))
    matrix[..., :3, :3] = r
    matrix[..., :3, 3] = p
    matrix[..., 3, 3] = 1.0
    return matrix


def _of_quaternion(xyzw: Floats) -> Floats:
    if xyzw.shape[-1:] != (4,):
        raise ShapeError(
            f"the rotation has the shape {xyzw.shape}; a quaternion (..., 4) or a matrix (..., 3, 3) is needed"
        )
    length = np.sqrt(np.sum(xyzw * xyzw, axis=-1, keepdims=True))
    if not np.all(np.isfinite(length)) or np.any(length == 0.0):
        raise PoseError("a quaternion is not finite, or has length 0")
    x, y, z, w = np.moveaxis(xyzw / length, -1, 0)
    rows = (
        (1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)),
        (2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)),
        (2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)),
    )
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)
