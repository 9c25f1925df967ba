"""A robot's functions over record batches of Arrow."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Any, NamedTuple, Optional, Union

from ._errors import UsageError
from ._robot import Robot

#: What was compiled, by robot and wish: a worker that gets the same function again and again compiles it once.
_KNOWN: dict[Any, Any] = {}
#: How many are kept.
_MOST = 64


class Counts(NamedTuple):
    """How many rows were computed, and in how many something was the matter."""

    #: All rows.
    rows: int
    #: Rows with a null among their inputs.
    nulls: int
    #: Rows with what is no finite number.
    not_finite: int
    #: Rows whose pose is none.
    no_pose: int
    #: Rows with more solutions than places for them.
    more_solutions: int

    @property
    def faults(self) -> int:
        """Rows with nulls in what is computed of them."""
        return self.nulls + self.not_finite + self.no_pose


class BatchMap:
    """A robot's functions as one function of record batches: without state, and picklable, so that it runs on any worker.

    It takes what lends itself through Arrow's C data interface, a batch of pyarrow's, nanoarrow's or any other package's, or a table of
    pyarrow's or Polars', and gives a batch or a table of pyarrow's with the columns that were there and those that were computed;
    without pyarrow a `Batch`, which others can take. A row's results depend on nothing but its inputs, to the bit; a row with a null,
    or what is no finite number, has nulls.

    >>> from denavit import BatchMap
    >>> mapping = BatchMap("ur5", fk=True, orientation="quaternion", keep=[])
    >>> mapping.inputs
    ['q1', 'q2', 'q3', 'q4', 'q5', 'q6']

    Parameters
    ----------
    robot
        A `Robot`, or the name of one of the catalogue.
    fk
        Poses of the tool, or of ``frames``: ``x``, ``y``, ``z`` and the orientation.
    jacobian
        Its Jacobian along the axes of the base, ``vx_q1`` … ``wz_qn``.
    manipulability
        The tool's manipulability and condition, lengths by the arm's size.
    torque
        Torques ``tau_q1`` … for velocities and accelerations.
    ik
        Joints for poses: ``"all"`` in one list a row, ``ik``, or in ``slots`` places of their own; ``"nearest"`` to those of ``near``.
    limits
        Only what the joint limits allow.
    slots
        How many places for solutions.
    frames
        A frame by number or name, or several.
    orientation
        How orientations are written and read: ``matrix``, ``quaternion``, ``rotation-vector``, ``axis-angle``, ``rpy``, an Euler set.
    units
        Of columns that do not say theirs, and of those that are written: ``rad,m``, ``deg,mm``.
    joints, velocities, accelerations, position, rotation, near
        Columns: names with commas, ``first..last``, or one column of lists; by their usual names otherwise.
    keep
        Columns that go through; all otherwise.
    prefix
        What stands in front of the names of columns that are computed.

    Raises `UsageError` if a function cannot be had, and, when it is called, if its inputs are not there.
    """

    __slots__ = ("_columns", "_robot", "_wish")

    def __init__(
        self,
        robot: Union[Robot, str],
        *,
        fk: bool = False,
        jacobian: bool = False,
        manipulability: bool = False,
        torque: bool = False,
        ik: Optional[str] = None,
        limits: bool = False,
        slots: Optional[int] = None,
        frames: Union[str, int, Sequence[Union[str, int]]] = "tool",
        orientation: str = "matrix",
        units: str = "rad,m",
        joints: Optional[str] = None,
        velocities: Optional[str] = None,
        accelerations: Optional[str] = None,
        position: Optional[str] = None,
        rotation: Optional[str] = None,
        near: Optional[str] = None,
        keep: Optional[Sequence[str]] = None,
        prefix: str = "",
    ) -> None:
        self._robot = Robot(robot) if isinstance(robot, str) else robot
        all_frames = [frames] if isinstance(frames, (str, int)) else frames
        self._wish = {
            "fk": fk,
            "jacobian": jacobian,
            "manipulability": manipulability,
            "torque": torque,
            "ik": ik,
            "limits": limits,
            "slots": slots,
            "frames": [str(frame) for frame in all_frames],
            "orientation": orientation,
            "units": units,
            "joints": joints,
            "velocities": velocities,
            "accelerations": accelerations,
            "position": position,
            "rotation": rotation,
            "near": near,
            "keep": None if keep is None else list(keep),
            "prefix": prefix,
        }
        key = (self.robot.toml, repr(self._wish))
        columns = _KNOWN.get(key)
        if columns is None:
            columns = self.robot._core.columns(self._wish)
            while len(_KNOWN) >= _MOST:
                _KNOWN.pop(next(iter(_KNOWN)), None)
            _KNOWN[key] = columns
        self._columns = columns

    @property
    def robot(self) -> Robot:
        """The robot."""
        return self._robot

    @property
    def inputs(self) -> list[str]:
        """The columns that are read where nothing else is said, a column each."""
        return list(self._columns.inputs)

    def __call__(self, batch: Any) -> Any:
        """A batch, or a table, with what is computed of its rows."""
        return self.counted(batch)[0]

    def counted(self, batch: Any) -> tuple[Any, Counts]:
        """The same, and how many rows something is the matter with."""
        if hasattr(batch, "__arrow_c_array__"):
            made, counts = self._columns.run(batch)
            return _dressed(made), Counts(*counts)
        if hasattr(batch, "__arrow_c_stream__"):
            pyarrow = _pyarrow()
            table = pyarrow.table(batch)
            found = [self.counted(part) for part in table.to_batches()]
            whole = pyarrow.Table.from_batches([part for part, _ in found], schema=self.schema(table.schema))
            return whole, Counts(*(sum(part) for part in zip(*(c for _, c in found)))) if found else Counts(
                0, 0, 0, 0, 0
            )
        raise UsageError(f"{type(batch).__name__} lends no record batch: it has no __arrow_c_array__")

    def schema(self, schema: Any) -> Any:
        """The schema of what comes of batches of a schema."""
        declared = self._columns.schema(schema)
        return _pyarrow().schema(declared)

    def reader(self, batches: Any) -> Any:
        """A ``pyarrow.RecordBatchReader`` that computes as it is read, of such a reader or of anything that lends one."""
        pyarrow = _pyarrow()
        given = pyarrow.RecordBatchReader.from_stream(batches)
        return pyarrow.RecordBatchReader.from_batches(self.schema(given.schema), self.each(given))

    def each(self, batches: Iterable[Any]) -> Iterator[Any]:
        """What comes of each batch."""
        for batch in batches:
            yield self(batch)

    def of_columns(self, *columns: Any) -> Any:
        """What is computed of the columns that `inputs` names, as one array of structures: for functions of expressions."""
        pyarrow = _pyarrow()
        arrays = [
            column.combine_chunks() if isinstance(column, pyarrow.ChunkedArray) else column
            for column in columns
        ]
        if len(arrays) != len(self.inputs):
            raise UsageError(f"{len(arrays)} columns are given; {', '.join(self.inputs)} are needed")
        made = self(pyarrow.record_batch(arrays, names=self.inputs))
        return made.to_struct_array()

    def results(self) -> Any:
        """The fields of `of_columns`, as a ``pyarrow.Schema``."""
        pyarrow = _pyarrow()
        return self.schema(pyarrow.schema([(name, pyarrow.float64()) for name in self.inputs]))

    def __reduce__(self) -> tuple[Any, ...]:
        return (_again, (self.robot, self._wish))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, BatchMap) and (self.robot, self._wish) == (other.robot, other._wish)

    def __hash__(self) -> int:
        return hash((self.robot.toml, repr(self._wish)))

    def __repr__(self) -> str:
        asked = [name for name in ("fk", "jacobian", "manipulability", "torque", "ik") if self._wish[name]]
        return f"<BatchMap: {', '.join(asked)} of {self.robot.name}>"


def map_batch(robot: Union[Robot, str], batch: Any, **wish: Any) -> Any:
    """A record batch with what is computed of its rows; ``wish`` is what `BatchMap` takes.

    For example::

        joints = pyarrow.record_batch({f"q{k}": numpy.zeros(3) for k in range(1, 7)})
        map_batch("ur5", joints, fk=True, keep=[]).column("z")
    """
    return BatchMap(robot, **wish)(batch)


def _again(robot: Robot, wish: dict[str, Any]) -> BatchMap:
    return BatchMap(robot, **wish)


def _pyarrow() -> Any:
    try:
        import pyarrow  # type: ignore[import-not-found, import-untyped, unused-ignore]
    except ImportError:
        raise UsageError("tables and schemas need pyarrow: pip install pyarrow") from None
    return pyarrow


def _dressed(made: Any) -> Any:
    """A batch of pyarrow's, where it is installed."""
    try:
        import pyarrow  # type: ignore[import-not-found, import-untyped, unused-ignore]
    except ImportError:
        return made
    return pyarrow.record_batch(made)
