"""What goes wrong, with what was found in texts."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Optional, Union


@dataclass(frozen=True)
class Finding:
    """Something that was found in a text: an error, a warning, or a note on how it was understood."""

    #: ``error``, ``warning`` or ``note``.
    severity: str
    #: What.
    message: str
    #: What would help.
    hint: Optional[str]
    #: The text: a file, or what stands for one.
    file: str
    #: The line, from 1; 0 if it has no place.
    line: int
    #: The column, from 1, in characters; 0 if it has no place.
    column: int
    #: All of it as the command line prints it, with the line and the place in it.
    rendered: str

    def __str__(self) -> str:
        return self.rendered


Row = tuple[str, str, Optional[str], str, int, int, str]


def findings_of(rows: Iterable[Union[Finding, Row]]) -> tuple[Finding, ...]:
    return tuple(row if isinstance(row, Finding) else Finding(*row) for row in rows)


class DenavitError(Exception):
    """What the package raises. ``findings`` holds what was found in a text, with places and hints."""

    findings: tuple[Finding, ...]

    def __init__(self, message: str = "", findings: Iterable[Union[Finding, Row]] = ()) -> None:
        super().__init__(message)
        self.findings = findings_of(findings)

    def __reduce__(self) -> tuple[Any, ...]:
        return (type(self), (str(self), self.findings))


class DescriptionWarning(UserWarning):
    """Something about a description that is worth a look; `Robot.findings` holds it with its place."""


class UnknownRobotError(DenavitError, LookupError):
    """There is no robot of this name in the catalogue."""


class DescriptionError(DenavitError, ValueError):
    """A description has errors; ``findings`` holds all of them."""


class ChainError(DenavitError, ValueError):
    """There is no such chain of joints in the robot, or several to choose from."""


class FileError(DenavitError, OSError):
    """A file cannot be read or written."""


class MissingValueError(DenavitError, ValueError):
    """A parameter has no value where a number is needed."""


class MotionError(DenavitError, ValueError):
    """There is no such motion: its start is out of reach, a way-point outside of the limits, or it is asked to be too fast."""


class NoMassesError(DenavitError, ValueError):
    """Dynamics of a robot that says nothing of masses."""


class ShapeError(DenavitError, ValueError):
    """An array has the wrong shape; the message says which shape is needed."""


class PoseError(DenavitError, ValueError):
    """A matrix is no pose: not finite, not orthonormal, or a reflection."""


class UsageError(DenavitError, ValueError):
    """What is asked for does not fit the robot: no such frame, joint, format or language."""


class UnsupportedError(DenavitError):
    """There is no closed form, no code, or no solution method for this."""
