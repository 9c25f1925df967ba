"""A robot's functions over data frames of Daft.

A function of expressions, and columns by it::

    import daft
    from denavit import BatchMap
    from denavit.daft import with_columns
    poses = with_columns(daft.read_parquet("joints/"), BatchMap("ur5", fk=True, keep=[]))
"""

from __future__ import annotations

from importlib import import_module
from typing import Any

from ._batch import BatchMap


def function(mapping: BatchMap, **options: Any) -> Any:
    """A function of expressions, as ``daft.func.batch`` makes it, of the columns that `BatchMap.inputs` names; it gives a structure.

    ``options`` are those of ``daft.func.batch``: ``use_process``, ``batch_size``, ``max_retries`` and others.
    """
    daft: Any = import_module("daft")
    names = [field.name for field in mapping.results()]
    fields = {field.name: daft.DataType.from_arrow_type(field.type) for field in mapping.results()}
    kept = set(mapping.inputs) & set(names)
    if kept:
        from ._errors import UsageError

        raise UsageError("a function of expressions gives what is computed alone: BatchMap(…, keep=[])")

    @daft.func.batch(return_dtype=daft.DataType.struct(fields), **options)  # type: ignore[untyped-decorator, unused-ignore]
    def denavit(*columns: Any) -> Any:
        return daft.Series.from_arrow(mapping.of_columns(*(column.to_arrow() for column in columns)))

    return denavit


def with_columns(frame: Any, mapping: BatchMap, **options: Any) -> Any:
    """A ``daft.DataFrame`` with what is computed of its rows; ``options`` are those of ``daft.func.batch``."""
    daft: Any = import_module("daft")
    made = function(mapping, **options)(*(daft.col(name) for name in mapping.inputs))
    names = [field.name for field in mapping.results()]
    whole = frame.with_column("_denavit", made)
    columns = {name: daft.col("_denavit").get(name) for name in names}
    return whole.with_columns(columns).exclude("_denavit")
