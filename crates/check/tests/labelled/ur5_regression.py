"""Regression tests for the UR5 model.
Expected numbers partly from the pendant, partly typed off an old spreadsheet (sorry).
Units m / rad.  Classic DH."""
import unittest
import numpy as np
from math import pi
from kin import Link, Arm

# Link(d, a, alpha), theta is the variable
ur5 = Arm([
    Link(d=0.089159, a=0,        alpha=pi/2),
    Link(d=0,        a=-0.425,   alpha=0),
    Link(d=0,        a=-0.39225, alpha=0),
    Link(d=0.10915,  a=0,        alpha=pi/2),
    Link(d=0.09465,  a=0,        alpha=-pi/2),
    Link(d=0.0823,   a=0,        alpha=0),
])


class TestForward(unittest.TestCase):

    def test_zero(self):
        q = [0, 0, 0, 0, 0, 0]
        T = ur5.fkine(q)
        expected = np.array([[1, 0,  0, -0.8173],
                             [0, 0, -1, -0.1915],
                             [0, 1,  0,  0.0055],
                             [0, 0,  0,  1]])
        np.testing.assert_allclose(T, expected, atol=2e-4)

    def test_upright(self):
        q = [0, -pi/2, 0, -pi/2, 0, 0]
        T = ur5.fkine(q)
        expected = np.array([[-1,  0,  0,  0],
                             [ 0,  0, -1, -0.1914],
                             [ 0, -1,  0,  1.0011],
                             [ 0,  0,  0,  1]])
        np.testing.assert_allclose(T, expected, atol=2e-4)

    def test_somewhere(self):
        q = [0.3, -1.2, 1.5, -0.4, 0.7, 0.2]
        T = ur5.fkine(q)
        self.assertAlmostEqual(T[0, 3], -0.5137, places=3)
        self.assertAlmostEqual(T[1, 3], -0.3390, places=3)
        self.assertAlmostEqual(T[2, 3], 0.2805, places=3)
        # approach vector
        np.testing.assert_allclose(T[:3, 2], [-0.3863, -0.9201, 0.0643], atol=1e-3)
        np.testing.assert_allclose(T[:3, 0], [0.9181, 0.3769, 0.1228], atol=1e-3)


class TestJacobian(unittest.TestCase):

    def test_pick_pose(self):
        # pick pose, tool straight down
        q = np.deg2rad([40, -70, 100, -120, -90, 15])
        T = ur5.fkine(q)
        np.testing.assert_allclose(T[:3, 3], [-0.3739, -0.4562, 0.2101], atol=1e-3)
        J = ur5.jacob0(q)
        J_expected = np.array([
            [ 0.4562, -0.0926,  0.2133,  0.0630,  0.0529, 0],
            [-0.3739, -0.0777,  0.1790,  0.0529, -0.0630, 0],
            [ 0,      -0.4343, -0.5797, -0.0946,  0,      0],
            [ 0,       0.6428,  0.6428,  0.6428, -0.7660, 0],
            [ 0,      -0.7660, -0.7660, -0.7660, -0.6428, 0],
            [ 1,       0,       0,       0,       0,     -1]])
        np.testing.assert_allclose(J, J_expected, atol=1e-3)

    def test_zero_is_singular(self):
        J = ur5.jacob0([0, 0, 0, 0, 0, 0])
        self.assertAlmostEqual(np.linalg.det(J), 0.0)


if __name__ == '__main__':
    unittest.main()
