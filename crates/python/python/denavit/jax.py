"""A robot's functions for JAX: they go through ``jit``, ``vmap``, ``jvp``, ``grad`` and ``jacobian``.

Values and derivatives are those of the compiled programs, called back on the host; nothing is traced through formulas. What is a
derivative once is not differentiated again. Double precision needs ``jax.config.update("jax_enable_x64", True)``.

>>> import jax, jax.numpy as jnp
>>> from denavit import Robot
>>> from denavit.jax import JaxRobot
>>> arm = JaxRobot(Robot("ur5"))
>>> jax.grad(lambda q: arm.fk(q)[2, 3])(jnp.zeros(6)).shape
(6,)
"""

from __future__ import annotations

from typing import Any, Callable

import jax  # type: ignore[import-not-found, unused-ignore]
import jax.numpy as jnp  # type: ignore[import-not-found, unused-ignore]
import numpy as np

from ._errors import ShapeError
from ._robot import Robot
from ._slopes import nearest_solutions, pose_slopes, refuse_redundant, solution_slopes

Array = Any


class JaxRobot:
    """A robot's functions over JAX arrays of any leading shape.

    ``fk``, ``torque`` and ``acceleration`` are those of `Robot`, with derivatives by all arguments; ``ik`` is the solution
    nearest to a configuration, with the derivative by the pose that the implicit function theorem gives.
    """

    def __init__(self, robot: Robot) -> None:
        self.robot = robot
        n = robot.n

        def fk(q: Any) -> Any:
            return robot.fk(q)

        def fk_slopes(q: Any) -> Any:
            return pose_slopes(robot.fk(q), robot.jacobian(q))

        def torque_slopes(q: Any, qd: Any, qdd: Any) -> Any:
            return np.concatenate(robot.torque_derivatives(q, qd, qdd)[1:], axis=-1)

        def acceleration_slopes(q: Any, qd: Any, tau: Any) -> Any:
            return np.concatenate(robot.acceleration_derivatives(q, qd, tau)[1:], axis=-1)

        def ik(pose: Any, near: Any) -> Any:
            return nearest_solutions(robot, pose, near)

        def ik_slopes(q: Any) -> Any:
            return solution_slopes(robot.fk(q), robot.jacobian(q)).reshape(*q.shape[:-1], n, 16)

        self._fk = _with_slopes(fk, (4, 4), fk_slopes, (4, 4, n), "...ijn,...n->...ij")
        self._torque = _with_slopes(robot.torque, (n,), torque_slopes, (n, 3 * n), "...ij,...j->...i")
        self._acceleration = _with_slopes(
            robot.acceleration, (n,), acceleration_slopes, (n, 3 * n), "...ij,...j->...i"
        )
        self._ik = _implicit(ik, ik_slopes, n)

    def fk(self, q: Array) -> Array:
        """Poses of the tool in the base, ``(..., 4, 4)`` for ``q`` of the shape ``(..., n)``."""
        return self._fk(*_rows(self.robot.n, q=q))

    def torque(self, q: Array, qd: Array, qdd: Array) -> Array:
        """Torques, ``(..., n)``: see `Robot.torque`."""
        return self._torque(*_rows(self.robot.n, q=q, qd=qd, qdd=qdd))

    def acceleration(self, q: Array, qd: Array, tau: Array) -> Array:
        """Accelerations, ``(..., n)``: see `Robot.acceleration`."""
        return self._acceleration(*_rows(self.robot.n, q=q, qd=qd, tau=tau))

    def ik(self, pose: Array, near: Array) -> Array:
        """The solutions nearest to ``near`` ``(..., n)`` for poses ``(..., 4, 4)``: ``(..., n)``; NaN where none was found.

        Its derivative by a pose follows changes that keep it one; it is NaN where the arm is singular, and 0 by ``near``.

        Raises `UnsupportedError` for an arm with more joints than the hand can use: its solutions are families.
        """
        refuse_redundant(self.robot)
        pose, (near,) = jnp.asarray(pose), _rows(self.robot.n, near=near)
        if pose.shape[-2:] != (4, 4):
            raise ShapeError(f"pose has the shape {pose.shape}; (..., 4, 4) is needed")
        leading = jnp.broadcast_shapes(pose.shape[:-2], near.shape[:-1])
        dtype = jnp.result_type(pose, near)
        return self._ik(
            jnp.broadcast_to(pose, (*leading, 4, 4)).astype(dtype),
            jnp.broadcast_to(near, (*leading, self.robot.n)).astype(dtype),
        )


def _rows(n: int, **vectors: Array) -> list[Array]:
    """Vectors of one shape and type."""
    arrays = {name: jnp.asarray(given) for name, given in vectors.items()}
    for name, vector in arrays.items():
        if vector.shape[-1:] != (n,):
            raise ShapeError(f"{name} has the shape {vector.shape}; (..., {n}) is needed")
    dtype = jnp.result_type(*arrays.values(), jnp.float32)
    return [vector.astype(dtype) for vector in jnp.broadcast_arrays(*arrays.values())]


def _call(function: Callable[..., Any], tail: tuple[int, ...], rows: int, *arguments: Array) -> Array:
    """A function of the host; ``rows`` is how many axes of the first argument are no leading ones."""
    first = arguments[0]
    struct: Any = jax.ShapeDtypeStruct
    shape = struct((*first.shape[: first.ndim - rows], *tail), first.dtype)

    def host(*given: Any) -> Any:
        return np.asarray(function(*(np.asarray(x) for x in given)), dtype=first.dtype)

    return jax.pure_callback(host, shape, *arguments, vmap_method="broadcast_all")


def _with_slopes(
    value: Callable[..., Any],
    tail: tuple[int, ...],
    slopes: Callable[..., Any],
    wide: tuple[int, ...],
    sum: str,
) -> Callable[..., Array]:
    """A function of vectors with its derivative by them side by side."""

    def plain(*vectors: Array) -> Array:
        return _call(value, tail, 1, *vectors)

    def derivative(vectors: Any, tangents: Any) -> Any:
        by = _call(slopes, wide, 1, *vectors)
        return plain(*vectors), jnp.einsum(sum, by, jnp.concatenate(tangents, axis=-1))

    return _differentiable(plain, derivative)


def _implicit(value: Callable[..., Any], slopes: Callable[..., Any], n: int) -> Callable[..., Array]:
    """A function of a pose and what is near, with its derivative by the pose at what it gives."""

    def plain(pose: Array, near: Array) -> Array:
        return _call(value, (n,), 2, pose, near)

    def derivative(given: Any, tangents: Any) -> Any:
        found = plain(*given)
        by = _call(slopes, (n, 16), 1, found)
        change = tangents[0].reshape(*tangents[0].shape[:-2], 16)
        return found, jnp.einsum("...ij,...j->...i", by, change)

    return _differentiable(plain, derivative)


def _differentiable(value: Callable[..., Any], derivative: Callable[..., Any]) -> Callable[..., Array]:
    function: Any = jax.custom_jvp(value)
    function.defjvp(derivative)

    def called(*arguments: Array) -> Array:
        return function(*arguments)

    return called
