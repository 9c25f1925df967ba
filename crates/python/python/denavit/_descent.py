"""Joints that bring something near to what is wanted, step by step: for goals that no closed form has."""

from __future__ import annotations

from typing import Callable

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

#: Steps at most, and the step below which it has arrived, radians.
_STEPS = 60
_ARRIVED = 1e-10


def descend(
    q: Floats,
    lower: Floats,
    upper: Floats,
    off: Callable[[Floats], Floats],
    slopes: Callable[[Floats], Floats],
) -> Floats:
    """Levenberg and Marquardt's steps within limits from ``q`` ``(n,)`` on, to a local minimum of ``|off(q)|²``.

    ``off`` is what is missing ``(m,)``, and ``slopes`` ``(m, n)`` by how much the joints make up for it.
    """
    q = np.clip(q, lower, upper)
    missing = off(q)
    damping = 1e-6
    for _ in range(_STEPS):
        by = slopes(q)
        # A joint at its limit that would be pushed beyond does not move.
        pull = by.T @ missing
        free = ~(((q <= lower) & (pull < 0.0)) | ((q >= upper) & (pull > 0.0)))
        normal = by.T @ by
        moves = np.zeros_like(q)
        while damping < 1e12:
            part = normal[np.ix_(free, free)] + damping * np.eye(int(free.sum()))
            moves[free] = np.linalg.solve(part, pull[free])
            there = np.clip(q + moves, lower, upper)
            still = off(there)
            if still @ still <= missing @ missing:
                break
            damping *= 8.0
        else:
            break
        arrived = bool(np.max(np.abs(there - q), initial=0.0) < _ARRIVED)
        q, missing, damping = there, still, max(damping / 8.0, 1e-12)
        if arrived:
            break
    return q
