"""Exact kinematics of robot manipulators: formulas that are proved, numbers that are fast.

>>> import numpy as np
>>> from denavit import Robot
>>> robot = Robot("ur5")
>>> pose = robot.fk([0.3, -1.2, 1.5, 0.4, 0.9, -0.6])
>>> answer = robot.ik(pose)
>>> answer.solutions.shape, answer.complete
((8, 6), True)
>>> bool(np.allclose(robot.fk(answer.solutions), pose))
True

Angles are radians, lengths metres; poses are 4×4 matrices of the tool in the base.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ._answers import Answer, Answers, Branches, Family, Obstacle
from ._denavit import Batch, Compiled, CompiledIk, __version__
from ._errors import (
    ChainError,
    DenavitError,
    DescriptionError,
    DescriptionWarning,
    FileError,
    Finding,
    MissingValueError,
    MotionError,
    NoMassesError,
    PoseError,
    ShapeError,
    UnknownRobotError,
    UnsupportedError,
    UsageError,
)
from ._robot import Joint, Robot, catalogue
from ._slopes import AccelerationDerivatives, TorqueDerivatives

if TYPE_CHECKING:
    from ._batch import BatchMap, Counts, map_batch
    from ._derivations import (
        Derivation,
        DynamicFormulas,
        ForwardFormulas,
        InverseFormulas,
        JacobianFormulas,
        Step,
    )
    from ._documents import Checked, Claim, Exercise, Mark, Marked, check
    from ._paths import Clearance, Deviation, Event, Held, Motion, Start, State

__all__ = [
    "AccelerationDerivatives",
    "Answer",
    "Answers",
    "Batch",
    "BatchMap",
    "Branches",
    "ChainError",
    "Checked",
    "Claim",
    "Clearance",
    "Compiled",
    "CompiledIk",
    "Counts",
    "DenavitError",
    "Derivation",
    "DescriptionError",
    "DescriptionWarning",
    "Deviation",
    "DynamicFormulas",
    "Event",
    "Exercise",
    "Family",
    "FileError",
    "Finding",
    "ForwardFormulas",
    "Held",
    "InverseFormulas",
    "JacobianFormulas",
    "Joint",
    "Mark",
    "Marked",
    "MissingValueError",
    "Motion",
    "MotionError",
    "NoMassesError",
    "Obstacle",
    "PoseError",
    "Robot",
    "ShapeError",
    "Start",
    "State",
    "Step",
    "TorqueDerivatives",
    "UnknownRobotError",
    "UnsupportedError",
    "UsageError",
    "__version__",
    "catalogue",
    "check",
    "map_batch",
]

#: What is read when it is first needed, and where it is.
_LATE = {
    "_batch": ["BatchMap", "Counts", "map_batch"],
    "_derivations": [
        "Derivation",
        "DynamicFormulas",
        "ForwardFormulas",
        "InverseFormulas",
        "JacobianFormulas",
        "Step",
    ],
    "_documents": ["Checked", "Claim", "Exercise", "Mark", "Marked", "check"],
    "_paths": ["Clearance", "Deviation", "Event", "Held", "Motion", "Start", "State"],
}


def __getattr__(name: str) -> Any:
    from importlib import import_module

    for module, names in _LATE.items():
        if name in names:
            return getattr(import_module(f"{__name__}.{module}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
