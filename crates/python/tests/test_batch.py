"""A robot over record batches of Arrow."""

import pickle

import numpy as np
import pytest

from denavit import BatchMap, Robot, UsageError, map_batch

pa = pytest.importorskip("pyarrow")

NAMES = [f"q{k}" for k in range(1, 7)]


def joints(rows, seed=0):
    return np.random.default_rng(seed).uniform(-3, 3, (rows, 6))


def batch(q, **more):
    return pa.record_batch({**{name: q[:, k] for k, name in enumerate(NAMES)}, **more})


def test_poses_are_the_robots():
    q = joints(1001)
    out = map_batch("ur5", batch(q, note=[f"row {k}" for k in range(1001)]), fk=True)
    pose = Robot("ur5").fk(q)
    assert isinstance(out, pa.RecordBatch)
    for k, name in enumerate("xyz"):
        assert np.abs(out.column(name).to_numpy() - pose[:, k, 3]).max() < 1e-13
    entries = [out.column(f"r{r}{c}").to_numpy() for r in (1, 2, 3) for c in (1, 2, 3)]
    assert np.abs(np.stack(entries, -1) - pose[:, :3, :3].reshape(-1, 9)).max() < 1e-13
    assert out.column("note").to_pylist()[7] == "row 7"
    assert out.schema.field("x").metadata == {b"unit": b"m"}
    assert out.schema.metadata[b"denavit.robot"] == b"Universal Robots UR5"


def test_parts_and_pickles_have_the_same_bits():
    mapping = BatchMap("ur5", fk=True, orientation="rotation-vector", jacobian=True, manipulability=True)
    whole = batch(joints(5000, 1))
    wanted = mapping(whole)
    again = pickle.loads(pickle.dumps(mapping))
    assert again == mapping and hash(again) == hash(mapping)
    for first, count in [(0, 1), (17, 300), (4999, 1)]:
        assert again(whole.slice(first, count)).equals(wanted.slice(first, count))
    table = pa.Table.from_batches([whole.slice(0, 123), whole.slice(123)])
    assert mapping(table).combine_chunks().equals(pa.Table.from_batches([wanted]).combine_chunks())
    reader = mapping.reader(table)
    assert reader.schema.equals(wanted.schema)
    assert reader.read_all().combine_chunks().equals(pa.Table.from_batches([wanted]).combine_chunks())


def test_rows_without_numbers_have_nulls():
    q = joints(4, 2)
    columns = {name: list(q[:, k]) for k, name in enumerate(NAMES)}
    columns["q2"][1] = None
    columns["q5"][3] = float("nan")
    out, counts = BatchMap("ur5", fk=True).counted(pa.record_batch(columns))
    assert counts == (4, 1, 1, 0, 0) and counts.nulls == 1
    assert [x is None for x in out.column("x").to_pylist()] == [False, True, False, True]
    empty = BatchMap("ur5", fk=True).counted(pa.Table.from_batches([batch(q)]).slice(0, 0))
    assert empty[0].num_rows == 0 and "x" in empty[0].column_names and empty[1].rows == 0


def test_all_solutions_and_the_nearest():
    q = joints(50, 3)
    poses = map_batch("ur5", batch(q), fk=True, orientation="quaternion")
    found = map_batch("ur5", poses, ik="all", orientation="quaternion", keep=[])
    robot = Robot("ur5")
    answers = robot.ik_batch(robot.fk(q))
    assert found.column("ik_count").to_pylist() == answers.counts.tolist()
    assert found.column("ik_status").to_pylist() == answers.status
    for k, solutions in enumerate(found.column("ik").to_pylist()):
        assert np.abs(robot.fk(np.array(solutions)) - robot.fk(q[k])).max() < 1e-9
    near = map_batch("ur5", poses, ik="nearest", orientation="quaternion", keep=[])
    own = np.stack([near.column(f"ik_{name}").to_numpy() for name in NAMES], -1)
    assert np.abs(own - q).max() < 1e-6
    slots = map_batch("ur5", poses, ik="all", slots=2, orientation="quaternion", keep=[])
    assert slots.column("ik1_q1").to_pylist() == [all_of[0][0] for all_of in found.column("ik").to_pylist()]


def test_other_packages_batches():
    """Whatever has the interface; without pyarrow what comes of it has it, too."""
    own = batch(joints(10, 4))

    class Lent:
        def __arrow_c_array__(self, requested_schema=None):
            return own.__arrow_c_array__(requested_schema)

    mapping = BatchMap("ur5", fk=True)
    assert mapping(Lent()).equals(mapping(own))
    made, counts = mapping._columns.run(own)
    assert len(made) == 10 and counts[0] == 10 and made.column_names[-1] == "r33"
    # It can be taken more than once.
    assert pa.record_batch(made).equals(pa.record_batch(made))
    assert pa.schema(made).equals(mapping(own).schema)
    # A slice begins in the middle of its buffers.
    assert mapping(own.slice(3, 4)).equals(mapping(own).slice(3, 4))
    polars = pytest.importorskip("polars")
    frame = polars.DataFrame({name: own.column(name).to_numpy() for name in NAMES})
    assert mapping(frame).column("x").to_pylist() == mapping(own).column("x").to_pylist()


@pytest.mark.parametrize(
    ("wish", "columns", "what"),
    [
        ({}, NAMES, "nothing is to be computed"),
        ({"fk": True}, ["a", "b"], "joint variables are in no columns that are known"),
        ({"fk": True}, [*NAMES, "x"], "two columns `x`"),
        ({"fk": True, "frames": "elbow9"}, NAMES, "elbow9"),
        ({"fk": True, "orientation": "up"}, NAMES, "no orientation is called"),
        ({"ik": "some"}, NAMES, "`all` or `nearest`"),
        ({"torque": True}, NAMES, "nothing of masses"),
        ({"fk": True, "units": "inch"}, NAMES, "no unit `inch`"),
    ],
)
def test_what_does_not_fit_is_refused(wish, columns, what):
    with pytest.raises(UsageError, match=what):
        map_batch("ur5", pa.record_batch({name: [0.0] for name in columns}), **wish)


def test_what_is_no_batch_is_refused():
    mapping = BatchMap("ur5", fk=True)
    with pytest.raises(UsageError, match="lends no record batch"):
        mapping([1, 2, 3])

    class Wrong:
        def __arrow_c_array__(self, requested_schema=None):
            return (1, 2)

    with pytest.raises(UsageError, match="gives no capsules"):
        mapping(Wrong())
    own = batch(joints(2))
    schema, array = own.__arrow_c_array__()

    class Twice:
        def __arrow_c_array__(self, requested_schema=None):
            return schema, array

    mapping(Twice())
    with pytest.raises(UsageError, match="given away"):
        mapping(Twice())


def test_the_command_line_writes_the_same_bits(cli, tmp_path):
    pq = pytest.importorskip("pyarrow.parquet")
    source = tmp_path / "in.parquet"
    own = batch(joints(3000, 5))
    pq.write_table(pa.Table.from_batches([own]), source, row_group_size=1000)
    out = tmp_path / "out.parquet"
    cli("map", "ur5", str(source), "-o", str(out), "--fk", "--orientation", "quaternion")
    read = pq.read_table(out)
    made = BatchMap("ur5", fk=True, orientation="quaternion")(own)
    assert read.column_names == made.schema.names
    for name in read.column_names:
        assert read.column(name).combine_chunks().equals(made.column(name)), name
    assert read.schema.field("x").metadata[b"unit"] == b"m"


def test_a_function_in_duckdb():
    duckdb = pytest.importorskip("duckdb")
    from denavit.duckdb import register, relation

    own = batch(joints(5000, 6))
    wanted = BatchMap("ur5", fk=True)(own)
    con = duckdb.connect()
    con.register("rows", own)
    register(con, "ur5_fk", BatchMap("ur5", fk=True, keep=[]))
    query = "select *, unnest(ur5_fk(q1, q2, q3, q4, q5, q6)) from rows"
    found = con.sql(query)
    found = (getattr(found, "to_arrow_table", None) or found.fetch_arrow_table)()
    for name in wanted.schema.names:
        assert found.column(name).combine_chunks().equals(wanted.column(name)), name
    streamed = relation(con, "select * from rows", BatchMap("ur5", fk=True)).read_all()
    for name in wanted.schema.names:
        assert streamed.column(name).combine_chunks().equals(wanted.column(name)), name
    with pytest.raises(UsageError, match="keep"):
        register(con, "other", BatchMap("ur5", fk=True))
