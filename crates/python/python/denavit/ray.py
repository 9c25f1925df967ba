"""A robot's functions over data sets of Ray.

Batches are computed by its tasks::

    import ray
    from denavit import BatchMap
    from denavit.ray import map_batches
    poses = map_batches(ray.data.read_parquet("joints/"), BatchMap("ur5", fk=True))
"""

from __future__ import annotations

from typing import Any

from ._batch import BatchMap


def map_batches(dataset: Any, mapping: BatchMap, **options: Any) -> Any:
    """A ``ray.data.Dataset`` with what is computed of its rows; ``options`` are those of ``Dataset.map_batches``.

    Batches are computed by Ray's tasks. One that is lost with its worker is computed again, and has the same bits.
    """

    def denavit(batch: Any) -> Any:
        return mapping(batch)

    return dataset.map_batches(denavit, batch_format="pyarrow", zero_copy_batch=True, **options)
