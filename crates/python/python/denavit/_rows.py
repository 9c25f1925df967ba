"""Rows of a Denavit–Hartenberg table as the text of a robot file."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from numbers import Integral, Real
from typing import Any, Optional

from ._errors import UsageError

#: The cells of a row, in the order of its elementary transforms.
LETTERS: Mapping[str, tuple[str, ...]] = {
    "standard": ("theta", "d", "a", "alpha"),
    "craig": ("alpha", "a", "theta", "d"),
    "khalil": ("alpha", "d", "theta", "r"),
}


def toml_of(
    rows: Iterable[Any],
    convention: str,
    name: str,
    parameters: Optional[Mapping[str, Any]],
    base: Any,
    tool: Any,
    gravity: Optional[Sequence[Any]],
) -> str:
    """The robot file."""
    if convention not in LETTERS:
        raise UsageError(f"no convention `{convention}`: standard, craig or khalil")
    lines = [f"name = {quoted(name)}", f"convention = {quoted(convention)}"]
    if gravity is not None:
        lines.append(f"gravity = {value(gravity)}")
    if parameters:
        lines.append("\n[parameters]")
        lines += [f"{quoted(key)} = {value('' if x is None else x)}" for key, x in parameters.items()]
    for number, row in enumerate(rows, 1):
        lines.append("\n[[joints]]")
        for key, x in cells(row, convention, number).items():
            lines.append(f"{quoted(key)} = {value(x)}")
    for key, frame in (("base", base), ("tool", tool)):
        if frame is not None:
            lines.append(f"\n[{key}]")
            lines += [f"{quoted(part)} = {value(x)}" for part, x in mounting(frame, key).items()]
    return "\n".join(lines) + "\n"


def mounting(frame: Any, what: str) -> Mapping[str, Any]:
    """A frame as a robot file has it: by its parts, or by its matrix."""
    if isinstance(frame, Mapping):
        return frame
    rows = [list(row) for row in frame] if isinstance(frame, Iterable) and not isinstance(frame, str) else []
    if [len(row) for row in rows] != [4] * 4:
        raise UsageError(f"{what}: a mapping with xyz, rpy or matrix is needed, or a 4×4 matrix")
    return {"matrix": rows}


def cells(row: Any, convention: str, number: int) -> Mapping[str, Any]:
    """The cells of a row by their letters."""
    if isinstance(row, Mapping):
        return {str(key): x for key, x in row.items() if x is not None}
    letters = LETTERS[convention]
    if isinstance(row, str) or not isinstance(row, Iterable):
        raise UsageError(f"row {number} is neither a mapping nor a sequence of {', '.join(letters)}")
    values = list(row)
    if len(values) != len(letters):
        wanted = ", ".join(letters)
        raise UsageError(f"row {number} has {len(values)} cells; {wanted} are needed")
    return dict(zip(letters, values))


def value(x: Any) -> str:
    """A value of a robot file."""
    if isinstance(x, str):
        return quoted(x)
    if isinstance(x, bool):
        raise UsageError(f"{x} is no value of a table")
    if isinstance(x, Integral):
        return str(int(x))
    if isinstance(x, Real):
        given = float(x)
        if not math.isfinite(given):
            raise UsageError(f"{given} is no value of a table")
        return repr(given)
    if isinstance(x, Iterable):
        return "[" + ", ".join(value(part) for part in x) + "]"
    raise UsageError(f"{x!r} is no value of a table")


def quoted(text: str) -> str:
    """A string of TOML."""
    import json

    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")
