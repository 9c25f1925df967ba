"""Record batches on local clusters of Ray and Spark, and in Daft and DuckDB: the same bits as one process, with a worker killed too.

``cargo xtask soak clusters`` runs it, and prints what each costs beside one process.
"""

import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

from denavit import BatchMap

if not os.environ.get("DENAVIT_CLUSTERS"):
    pytest.skip("`cargo xtask soak clusters` runs these", allow_module_level=True)

import pyarrow as pa
import pyarrow.parquet as pq

NAMES = [f"q{k}" for k in range(1, 7)]
FILES, ROWS = 16, 125_000
MAPPING = BatchMap("ur5", fk=True, orientation="quaternion")
RESULTS = BatchMap("ur5", fk=True, orientation="quaternion", keep=[])


@pytest.fixture(scope="module")
def joints(tmp_path_factory):
    """A folder of Parquet with two million rows, each with its number."""
    folder = tmp_path_factory.mktemp("joints")
    random = np.random.default_rng(7)
    for k in range(FILES):
        q = random.uniform(-3, 3, (ROWS, 6))
        columns = {name: q[:, j] for j, name in enumerate(NAMES)}
        table = pa.table({"row": np.arange(k * ROWS, (k + 1) * ROWS), **columns})
        pq.write_table(table, folder / f"part-{k:02}.parquet", row_group_size=25_000)
    return folder


@pytest.fixture(scope="module")
def alone(joints):
    """What one process computes, and how long it takes to read and to compute."""
    start = time.perf_counter()
    table = pq.read_table(joints)
    read = time.perf_counter()
    made = MAPPING(table)
    end = time.perf_counter()
    print(f"\none process: read {read - start:.2f} s, computed {end - read:.2f} s")
    return made.combine_chunks(), end - start


def same(found, alone):
    """Every row once, and its bits."""
    found = found.sort_by("row").combine_chunks()
    wanted = alone[0]
    assert found.num_rows == wanted.num_rows == FILES * ROWS
    for name in wanted.column_names:
        ours = found.column(name).combine_chunks().to_numpy(zero_copy_only=False)
        theirs = wanted.column(name).combine_chunks().to_numpy(zero_copy_only=False)
        # Bits, not numbers: a zero with another sign would be seen.
        assert ours.dtype == theirs.dtype and ours.tobytes() == theirs.tobytes(), name


def say(who, seconds, without, alone):
    print(f"{who}: {seconds:.2f} s; the same without computing {without:.2f} s; one process {alone[1]:.2f} s")


class Dying:
    """The same function, whose first worker dies while it computes."""

    def __init__(self, mark):
        self.mark = mark

    def __call__(self, batch):
        made = MAPPING(batch)
        try:
            os.close(os.open(self.mark, os.O_CREAT | os.O_EXCL))
        except FileExistsError:
            return made
        os.kill(os.getpid(), signal.SIGKILL)

    def each(self, batches):
        for batch in batches:
            yield self(batch)

    def schema(self, schema):
        return MAPPING.schema(schema)


@pytest.fixture(scope="module")
def ray_cluster():
    ray = pytest.importorskip("ray")
    os.environ.setdefault("RAY_ENABLE_UV_RUN_RUNTIME_ENV", "0")
    ray.init(num_cpus=2, include_dashboard=False, logging_level="ERROR", object_store_memory=500 << 20)
    ray.data.DataContext.get_current().enable_progress_bars = False
    yield ray
    ray.shutdown()


def ray_table(dataset):
    import ray

    return pa.concat_tables(ray.get(dataset.to_arrow_refs()))


def test_ray(ray_cluster, joints, alone, tmp_path):
    from denavit.ray import map_batches

    ray = ray_cluster
    # The first tasks start workers.
    ray_table(ray.data.read_parquet(str(joints)).limit(10))
    start = time.perf_counter()
    ray_table(ray.data.read_parquet(str(joints)).map_batches(lambda b: b, batch_format="pyarrow"))
    without = time.perf_counter() - start
    start = time.perf_counter()
    found = ray_table(map_batches(ray.data.read_parquet(str(joints)), MAPPING))
    say("Ray", time.perf_counter() - start, without, alone)
    same(found, alone)
    mark = tmp_path / "died"
    found = ray_table(map_batches(ray.data.read_parquet(str(joints)), Dying(str(mark))))
    assert mark.exists()
    same(found, alone)


@pytest.fixture(scope="module")
def spark_cluster():
    pytest.importorskip("pyspark")
    from pyspark.sql import SparkSession

    # Workers are of this environment.
    os.environ["PYSPARK_PYTHON"] = os.environ["PYSPARK_DRIVER_PYTHON"] = sys.executable
    built = (
        SparkSession.builder.master("local[2,4]")
        .config("spark.ui.enabled", "false")
        .config("spark.driver.memory", "2g")
        .config("spark.sql.execution.arrow.maxRecordsPerBatch", "65536")
        .getOrCreate()
    )
    built.sparkContext.setLogLevel("OFF")
    yield built
    built.stop()


def test_spark(spark_cluster, joints, alone, tmp_path):
    from denavit.spark import map_in_arrow

    spark = spark_cluster

    def written(frame, name):
        start = time.perf_counter()
        frame.write.parquet(str(tmp_path / name))
        return time.perf_counter() - start

    frame = spark.read.parquet(str(joints))
    written(frame.limit(10), "first")
    without = written(frame.mapInArrow(lambda batches: batches, frame.schema), "without")
    seconds = written(map_in_arrow(frame, MAPPING), "poses")
    say("Spark (written as Parquet)", seconds, without, alone)
    same(pq.read_table(tmp_path / "poses").select(alone[0].column_names), alone)
    mark = tmp_path / "died"
    written(map_in_arrow(frame, Dying(str(mark))), "again")
    assert mark.exists()
    same(pq.read_table(tmp_path / "again").select(alone[0].column_names), alone)


def test_daft(joints, alone):
    daft = pytest.importorskip("daft")
    from denavit.daft import with_columns

    start = time.perf_counter()
    daft.read_parquet(str(joints)).to_arrow()
    without = time.perf_counter() - start
    for processes in (False, True):
        frame = with_columns(daft.read_parquet(str(joints)), RESULTS, use_process=processes)
        start = time.perf_counter()
        found = frame.to_arrow()
        how = "in processes" if processes else "in threads"
        say(f"Daft, {how}", time.perf_counter() - start, without, alone)
        same(found.select(alone[0].column_names), alone)


#: Daft on Ray, where what is lost is computed again: its own processes are not started again. A process has one runner.
ON_RAY = """
import os, signal, sys
import daft, ray
from denavit import BatchMap
from denavit.daft import with_columns

folder, mark, out = sys.argv[1:]


class Dying:
    def __init__(self):
        self.mapping = BatchMap("ur5", fk=True, orientation="quaternion", keep=[])
        self.inputs = self.mapping.inputs

    def results(self):
        return self.mapping.results()

    def of_columns(self, *columns):
        made = self.mapping.of_columns(*columns)
        try:
            os.close(os.open(mark, os.O_CREAT | os.O_EXCL))
        except FileExistsError:
            return made
        os.kill(os.getpid(), signal.SIGKILL)


ray.init(num_cpus=2, include_dashboard=False, logging_level="ERROR", object_store_memory=500 << 20)
daft.set_runner_ray()
with_columns(daft.read_parquet(folder), Dying()).write_parquet(out)
ray.shutdown()
"""


def test_daft_on_ray(joints, alone, tmp_path):
    pytest.importorskip("daft")
    pytest.importorskip("ray")
    mark, out = tmp_path / "died", tmp_path / "out"
    words = [sys.executable, "-c", ON_RAY, str(joints), str(mark), str(out)]
    done = subprocess.run(words, capture_output=True, text=True, timeout=300, check=False)
    assert done.returncode == 0, done.stderr[-2000:]
    assert mark.exists()
    same(pq.read_table(out).select(alone[0].column_names), alone)


def test_duckdb(joints, alone):
    duckdb = pytest.importorskip("duckdb")
    from denavit.duckdb import register, relation

    con = duckdb.connect()
    con.sql("set threads = 2")
    files = f"'{joints}/*.parquet'"
    arrow = lambda made: (getattr(made, "to_arrow_table", None) or made.fetch_arrow_table)()  # noqa: E731
    start = time.perf_counter()
    arrow(con.sql(f"select * from {files}"))
    without = time.perf_counter() - start
    register(con, "ur5_fk", RESULTS)
    start = time.perf_counter()
    found = arrow(con.sql(f"select *, unnest(ur5_fk({', '.join(NAMES)})) from {files}"))
    say("DuckDB, a function", time.perf_counter() - start, without, alone)
    same(found, alone)
    start = time.perf_counter()
    found = relation(con, f"select * from {files}", MAPPING).read_all()
    say("DuckDB, a relation", time.perf_counter() - start, without, alone)
    same(found, alone)
