"""A robot's functions in DuckDB.

A function in SQL::

    import duckdb
    from denavit import BatchMap
    from denavit.duckdb import register
    con = duckdb.connect()
    register(con, "ur5_fk", BatchMap("ur5", fk=True, keep=[]))
    con.sql("select unnest(ur5_fk(q1, q2, q3, q4, q5, q6)) from 'joints.parquet'")
"""

from __future__ import annotations

from inspect import Parameter, Signature
from typing import Any

from ._batch import BatchMap
from ._errors import UsageError


def register(connection: Any, name: str, mapping: BatchMap) -> None:
    """Makes a function of the columns that `BatchMap.inputs` names, in SQL; it gives a structure of what is computed.

    Rows with a null have nulls. DuckDB calls a function of Python's by one thread at a time: `relation` is quicker for whole tables.
    """
    import duckdb  # type: ignore[import-not-found, unused-ignore]

    results = mapping.results()
    if set(mapping.inputs) & set(results.names):
        raise UsageError("a function of columns gives what is computed alone: BatchMap(…, keep=[])")

    def function(*columns: Any) -> Any:
        return mapping.of_columns(*columns)

    # How many columns it takes is asked of it.
    each = [Parameter(name, Parameter.POSITIONAL_ONLY) for name in mapping.inputs]
    function.__signature__ = Signature(each)  # type: ignore[attr-defined]
    types = {field.name: _type(field.type) for field in results}
    made = duckdb.struct_type(types)
    connection.create_function(
        name,
        function,
        ["DOUBLE"] * len(mapping.inputs),
        made,
        type="arrow",
        null_handling="special",
    )


def relation(connection: Any, query: str, mapping: BatchMap) -> Any:
    """What a query gives with what is computed of its rows, as a ``pyarrow.RecordBatchReader``, in constant memory.

    DuckDB can read it again by the name of a variable: ``r = relation(con, …); con.sql("copy (from r) to 'poses.parquet'")``; on another
    connection than that of the query, which is still being read.
    """
    rows = connection.sql(query)
    arrow = getattr(rows, "to_arrow_reader", None) or rows.fetch_record_batch
    return mapping.reader(arrow(1 << 16))


def _type(of: Any) -> str:
    """DuckDB's name of a type of ours."""
    import pyarrow.types as types  # type: ignore[import-not-found, import-untyped, unused-ignore]

    if types.is_list(of) or types.is_large_list(of):
        return f"{_type(of.value_type)}[]"
    if types.is_float64(of):
        return "DOUBLE"
    if types.is_int32(of):
        return "INTEGER"
    if types.is_boolean(of):
        return "BOOLEAN"
    return "VARCHAR"
