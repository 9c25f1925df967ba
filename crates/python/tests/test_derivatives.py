"""Derivatives against differences and the figures of Pinocchio, and the functions for JAX and PyTorch against them."""

import numpy as np
import pytest

from conftest import peers
from denavit import Robot, ShapeError, UnsupportedError
from denavit._slopes import pose_slopes, solution_slopes
from test_numbers import close, with_bodies

Q = np.array([0.3, -1.2, 1.5, 0.4, 0.9, -0.6])


def differences(function, q, step=1e-6):
    """∂f/∂q by central differences, the last axis that of q."""
    moves = step * np.eye(q.shape[-1])
    return np.stack([(function(q + m) - function(q - m)) / (2 * step) for m in moves], axis=-1)


def heavy(name="articulated-3r"):
    one = next(o for o in peers("dynamics.json")["catalogue"] if o["name"] == name)
    return with_bodies(one), {
        k: np.array([s[k] for s in one["samples"]]) for k in ("q", "qd", "qdd", "pulled")
    }


@pytest.mark.parametrize("name", ["planar-2r", "scara", "articulated-3r", "cylindrical-rpp"])
def test_derivatives_of_dynamics_are_differences(name):
    robot, of = heavy(name)
    q, qd, qdd, tau = of["q"], of["qd"], of["qdd"], of["pulled"]
    found = robot.torque_derivatives(q, qd, qdd)
    assert close(found.torque, robot.torque(q, qd, qdd), 1e-12)
    assert close(found.inertia, robot.inertia(q), 1e-12)
    assert close(found.by_q, differences(lambda x: robot.torque(x, qd, qdd), q), 1e-7)
    assert close(found.by_qd, differences(lambda x: robot.torque(q, x, qdd), qd), 1e-7)
    pulled = robot.acceleration_derivatives(q, qd, tau)
    assert close(pulled.acceleration, robot.acceleration(q, qd, tau), 1e-9)
    assert close(
        pulled.by_torque @ robot.inertia(q), np.broadcast_to(np.eye(robot.n), found.inertia.shape), 1e-9
    )
    assert close(pulled.by_q, differences(lambda x: robot.acceleration(x, qd, tau), q), 1e-5)
    assert close(pulled.by_qd, differences(lambda x: robot.acceleration(q, x, tau), qd), 1e-5)


def test_derivatives_of_poses_and_solutions():
    for robot, q in [(Robot("ur5"), Q), (Robot("scara"), np.array([0.3, 0.8, 0.1, -0.4]))]:
        slopes = pose_slopes(robot.fk(q), robot.jacobian(q))
        assert close(slopes, differences(robot.fk, q), 1e-8)
        back = np.einsum("nij,ijm->nm", solution_slopes(robot.fk(q), robot.jacobian(q)), slopes)
        assert close(back, np.eye(robot.n), 1e-10)
    arm = Robot("ur5")
    stretched = np.array([0.3, -1.2, 0.0, 0.4, 0.9, -0.6])
    assert np.isnan(solution_slopes(arm.fk(stretched), arm.jacobian(stretched))).all()


@pytest.fixture
def jax():
    jax = pytest.importorskip("jax", minversion="0.4.34")
    jax.config.update("jax_enable_x64", True)
    return jax


def test_jax_has_the_derivatives_of_the_robot(jax):
    from denavit.jax import JaxRobot

    robot = Robot("ur5")
    arm = JaxRobot(robot)
    slopes = pose_slopes(robot.fk(Q), robot.jacobian(Q))
    assert close(jax.jacfwd(arm.fk)(Q), slopes, 1e-12)
    assert close(jax.jacrev(arm.fk)(Q), slopes, 1e-12)
    rows = np.stack([Q, 0.5 * Q, Q - 0.1])
    assert close(jax.jit(jax.vmap(arm.fk))(rows), robot.fk(rows), 0.0)
    assert close(
        jax.jit(jax.vmap(jax.jacfwd(arm.fk)))(rows)[1],
        pose_slopes(robot.fk(rows[1]), robot.jacobian(rows[1])),
        1e-12,
    )
    assert np.asarray(arm.fk(Q.astype(np.float32))).dtype == np.float32
    with pytest.raises(ShapeError, match="q has the shape"):
        arm.fk(Q[:5])


def test_jax_differentiates_solutions_by_the_pose(jax):
    from denavit.jax import JaxRobot

    robot = Robot("ur5")
    arm = JaxRobot(robot)
    pose = robot.fk(Q)
    assert close(arm.ik(pose, Q), Q, 1e-9)
    assert close(jax.jacrev(arm.ik)(pose, Q), solution_slopes(pose, robot.jacobian(Q)), 1e-9)
    # There and back is the identity.
    assert close(jax.jacfwd(lambda q: arm.ik(arm.fk(q), Q))(Q), np.eye(6), 1e-9)
    far = pose.copy()
    far[0, 3] += 10.0
    assert np.isnan(np.asarray(arm.ik(far, Q))).all()
    with pytest.raises(UnsupportedError, match="7 joints"):
        JaxRobot(Robot("franka-panda")).ik(np.eye(4), np.zeros(7))


def test_jax_has_dynamics(jax):
    from denavit.jax import JaxRobot

    robot, of = heavy()
    arm = JaxRobot(robot)
    q, qd, qdd, tau = (of[k][0] for k in ("q", "qd", "qdd", "pulled"))
    found = robot.torque_derivatives(q, qd, qdd)
    for k, wanted in enumerate(found[1:]):
        assert close(jax.jacrev(arm.torque, argnums=k)(q, qd, qdd), wanted, 1e-12)
    pulled = robot.acceleration_derivatives(q, qd, tau)
    for k, wanted in enumerate(pulled[1:]):
        assert close(jax.jacfwd(arm.acceleration, argnums=k)(q, qd, tau), wanted, 1e-12)


def test_torch_has_the_derivatives_of_the_robot():
    torch = pytest.importorskip("torch")
    from denavit.torch import TorchRobot

    robot = Robot("ur5")
    arm = TorchRobot(robot)
    rows = torch.tensor(np.stack([Q, 0.5 * Q]), requires_grad=True)
    found = torch.autograd.functional.jacobian(arm.fk, rows[0].detach())
    assert close(found.numpy(), pose_slopes(robot.fk(Q), robot.jacobian(Q)), 1e-12)
    assert torch.autograd.gradcheck(arm.fk, rows)
    pose = torch.tensor(robot.fk(Q))
    back = torch.autograd.functional.jacobian(lambda p: arm.ik(p, torch.tensor(Q)), pose)
    assert close(back.numpy(), solution_slopes(robot.fk(Q), robot.jacobian(Q)), 1e-9)
    with pytest.raises(ShapeError, match="q has the shape"):
        arm.fk(rows[:, :5])
    heavy_robot, of = heavy()
    state = [torch.tensor(of[k][:2], requires_grad=True) for k in ("q", "qd", "qdd")]
    assert torch.autograd.gradcheck(TorchRobot(heavy_robot).torque, state)
    pulled = [*state[:2], torch.tensor(of["pulled"][:2], requires_grad=True)]
    assert torch.autograd.gradcheck(TorchRobot(heavy_robot).acceleration, pulled, rtol=1e-2)
