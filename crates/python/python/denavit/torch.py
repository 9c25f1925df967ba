"""A robot's functions for PyTorch: tensors in, tensors out, with gradients.

Values and derivatives are those of the compiled programs, on the host in the tensors' precision. Gradients are not differentiated
again.

>>> import torch  # doctest: +SKIP
>>> from denavit import Robot
>>> from denavit.torch import TorchRobot  # doctest: +SKIP
>>> arm = TorchRobot(Robot("ur5"))  # doctest: +SKIP
>>> q = torch.zeros(6, requires_grad=True)  # doctest: +SKIP
>>> arm.fk(q)[2, 3].backward()  # doctest: +SKIP
"""

from __future__ import annotations

from typing import Any, Callable

import numpy as np
import torch  # type: ignore[import-not-found, unused-ignore]
from torch.autograd.function import once_differentiable  # type: ignore[import-not-found, unused-ignore]

from ._errors import ShapeError
from ._robot import Robot
from ._slopes import nearest_solutions, pose_slopes, refuse_redundant, solution_slopes

Tensor = Any


class TorchRobot:
    """A robot's functions over tensors of any leading shape: see `denavit.jax.JaxRobot`, of which these are the same."""

    def __init__(self, robot: Robot) -> None:
        self.robot = robot

    def fk(self, q: Tensor) -> Tensor:
        """Poses of the tool in the base, ``(..., 4, 4)`` for ``q`` of the shape ``(..., n)``."""
        (q,) = _rows(self.robot.n, q=q)
        return _Pose.apply(q, self.robot)

    def torque(self, q: Tensor, qd: Tensor, qdd: Tensor) -> Tensor:
        """Torques, ``(..., n)``: see `Robot.torque`."""
        robot = self.robot
        vectors = _rows(robot.n, q=q, qd=qd, qdd=qdd)
        return _Dynamics.apply(robot.torque, robot.torque_derivatives, *vectors)

    def acceleration(self, q: Tensor, qd: Tensor, tau: Tensor) -> Tensor:
        """Accelerations, ``(..., n)``: see `Robot.acceleration`."""
        robot = self.robot
        vectors = _rows(robot.n, q=q, qd=qd, tau=tau)
        return _Dynamics.apply(robot.acceleration, robot.acceleration_derivatives, *vectors)

    def ik(self, pose: Tensor, near: Tensor) -> Tensor:
        """The solutions nearest to ``near`` ``(..., n)`` for poses ``(..., 4, 4)``: ``(..., n)``; NaN where none was found.

        Its gradient by a pose follows changes that keep it one; it is NaN where the arm is singular, and 0 by ``near``.

        Raises `UnsupportedError` for an arm with more joints than the hand can use: its solutions are families.
        """
        refuse_redundant(self.robot)
        (near,) = _rows(self.robot.n, near=near)
        if tuple(pose.shape[-2:]) != (4, 4):
            raise ShapeError(f"pose has the shape {tuple(pose.shape)}; (..., 4, 4) is needed")
        leading = torch.broadcast_shapes(pose.shape[:-2], near.shape[:-1])
        return _Solution.apply(
            pose.expand(*leading, 4, 4), near.detach().expand(*leading, self.robot.n), self.robot
        )


def _rows(n: int, **vectors: Tensor) -> tuple[Tensor, ...]:
    """Vectors of one shape and type."""
    for name, vector in vectors.items():
        if tuple(vector.shape[-1:]) != (n,):
            raise ShapeError(f"{name} has the shape {tuple(vector.shape)}; (..., {n}) is needed")
    dtype = torch.float64 if any(v.dtype == torch.float64 for v in vectors.values()) else torch.float32
    made = torch.broadcast_tensors(*(v.to(dtype) for v in vectors.values()))
    return tuple(made)


def _host(tensor: Tensor) -> Any:
    return np.ascontiguousarray(tensor.detach().cpu().numpy())


def _like(array: Any, tensor: Tensor) -> Tensor:
    return torch.as_tensor(np.ascontiguousarray(array), dtype=tensor.dtype, device=tensor.device)


def _pose_backward(ctx: Any, back: Tensor) -> Any:
    (q,) = ctx.saved_tensors
    at = _host(q)
    slopes = pose_slopes(ctx.robot.fk(at), ctx.robot.jacobian(at))
    return _like(np.einsum("...ijn,...ij->...n", slopes, _host(back)), q), None


class _Pose(torch.autograd.Function):  # type: ignore[misc]
    @staticmethod
    def forward(ctx: Any, q: Tensor, robot: Robot) -> Tensor:
        ctx.save_for_backward(q)
        ctx.robot = robot
        return _like(robot.fk(_host(q)), q)

    backward = staticmethod(once_differentiable(_pose_backward))


def _dynamics_backward(ctx: Any, back: Tensor) -> Any:
    vectors = ctx.saved_tensors
    found = ctx.slopes(*(_host(v) for v in vectors))[1:]
    by = (np.einsum("...ij,...i->...j", matrix, _host(back)) for matrix in found)
    return (None, None, *(_like(one, back) for one in by))


class _Dynamics(torch.autograd.Function):  # type: ignore[misc]
    @staticmethod
    def forward(ctx: Any, value: Callable[..., Any], slopes: Callable[..., Any], *vectors: Tensor) -> Tensor:
        ctx.save_for_backward(*vectors)
        ctx.slopes = slopes
        return _like(value(*(_host(v) for v in vectors)), vectors[0])

    backward = staticmethod(once_differentiable(_dynamics_backward))


def _solution_backward(ctx: Any, back: Tensor) -> Any:
    (found,) = ctx.saved_tensors
    at = _host(found)
    slopes = solution_slopes(ctx.robot.fk(at), ctx.robot.jacobian(at))
    return _like(np.einsum("...nij,...n->...ij", slopes, _host(back)), back), None, None


class _Solution(torch.autograd.Function):  # type: ignore[misc]
    @staticmethod
    def forward(ctx: Any, pose: Tensor, near: Tensor, robot: Robot) -> Tensor:
        found = _like(nearest_solutions(robot, _host(pose), _host(near)), pose)
        ctx.save_for_backward(found)
        ctx.robot = robot
        return found

    backward = staticmethod(once_differentiable(_solution_backward))
