"""A robot's functions over data frames of Spark.

Batches are computed by its executors::

    from denavit import BatchMap
    from denavit.spark import map_in_arrow
    poses = map_in_arrow(spark.read.parquet("joints/"), BatchMap("ur5", fk=True))
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from ._batch import BatchMap


def map_in_arrow(frame: Any, mapping: BatchMap) -> Any:
    """A ``pyspark.sql.DataFrame`` with what is computed of its rows, batch by batch in the workers.

    A task that is lost with its worker is computed again, and has the same bits.
    """
    from pyspark.sql.pandas.types import (  # type: ignore[import-not-found, unused-ignore]
        from_arrow_schema,
        to_arrow_schema,
    )

    schema = from_arrow_schema(mapping.schema(to_arrow_schema(frame.schema)))

    def each(batches: Iterator[Any]) -> Iterator[Any]:
        return mapping.each(batches)

    return frame.mapInArrow(each, schema)
