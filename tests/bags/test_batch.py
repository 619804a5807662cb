# SPDX-License-Identifier: Apache-2.0
"""The same query over many recordings: one dataset, and a bad recording does not stop the others."""

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import recordings
from click.testing import CliRunner
from deadly import DeadlyQuery
from file_server import FileServer

import coframe
from coframe.bags import QueryResult, TableQuery, TrajectoryQuery, batch, query_recording, query_recordings
from coframe.cli.app import app

arrow_dataset = pytest.importorskip("pyarrow.dataset")
WALK = TrajectoryQuery("odom", "lidar", rate=10)


@pytest.fixture
def bags(tmp_path):
    folder = tmp_path / "bags"
    folder.mkdir()
    good = recordings.write_mcap(folder / "a.mcap")
    (folder / "nothing.mcap").write_bytes(b"no recording")
    cut = folder / "cut.mcap"
    cut.write_bytes(good.read_bytes()[:-1500])
    other = recordings.write_rosbag2(folder / "rosbag2")
    return [good, folder / "nothing.mcap", cut, other, folder / "missing.mcap"]


def assert_complete(bags, results, folder):
    """The dataset contains what a query of each recording by itself returns."""
    assert [result.bag for result in results] == [str(bag) for bag in bags]
    good = [result for result in results if not result.error]
    assert {result.bag for result in good} == {str(bags[i]) for i in (0, 2, 3)}
    table = arrow_dataset.dataset(folder).to_table()
    bag_of_row = np.array(table["bag"].to_pylist())
    assert table.num_rows == sum(result.poses for result in good) > 60
    for result in good:
        with coframe.open_bag(result.bag) as recording:
            poses, _ = WALK.run(recording)
        rows = bag_of_row == result.bag
        assert table["stamp_ns"].to_numpy()[rows].tolist() == poses.stamps.tolist()
        found = np.stack([table[name].to_numpy()[rows] for name in ("x", "y", "z", "qx", "qy", "qz", "qw")], axis=1)
        assert (found == np.concatenate([poses.translation, poses.quaternion], axis=1)).all()


def test_processes_of_this_machine(bags, tmp_path):
    """One recording kills its process, two cannot be read, one is truncated."""
    deadly = recordings.write_mcap(bags[0].with_name("deadly.mcap"))
    query = DeadlyQuery("odom", "lidar", rate=10)
    reported = []
    *results, dead = query_recordings([*bags, deadly], query, tmp_path / "out", workers=2, progress=reported.append)
    assert_complete(bags, results, tmp_path / "out")
    assert "The process died" in dead.error
    assert sorted(reported) == sorted([*results, dead])
    assert "cannot be read: No such file" in results[4].error
    assert results[2].problems


@pytest.fixture
def in_this_process(monkeypatch):
    monkeypatch.setitem(batch.ENGINES, "processes", lambda run, jobs, _workers: ((job, run(*job)) for job in jobs))


@pytest.mark.usefixtures("in_this_process")
def test_a_second_run_queries_only_new_and_changed_recordings(bags, tmp_path):
    first = query_recordings(bags, WALK, tmp_path / "out")
    assert_complete(bags, first, tmp_path / "out")
    bags[3].joinpath("metadata.yaml").touch()
    again = query_recordings(bags, WALK, tmp_path / "out")
    assert_complete(bags, again, tmp_path / "out")
    assert [result.kept for result in again] == [True, False, True, False, False]
    assert again[2].problems == first[2].problems != ()


def test_the_file_of_another_query_is_not_kept(bags, tmp_path):
    first = query_recording(str(bags[0]), WALK, str(tmp_path))
    assert not first.error
    assert query_recording(str(bags[0]), WALK, str(tmp_path)) == first._replace(kept=True)
    later = TrajectoryQuery("odom", "base", start="1s")
    other = query_recording(str(bags[0]), later, str(tmp_path))
    assert (other.kept, other.error) == (False, "")
    (part,) = tmp_path.glob("*.parquet")
    part.write_bytes(part.read_bytes()[:-20])
    assert not query_recording(str(bags[0]), later, str(tmp_path)).kept


def test_a_damaged_file_is_written_again(bags, tmp_path):
    """One flipped bit anywhere in the file is enough, and the poses are those of the recording afterwards."""
    folder = tmp_path / "out"
    folder.mkdir()
    first = query_recording(str(bags[0]), WALK, str(folder))
    (part,) = folder.glob("*.parquet")
    (checksum,) = folder.glob("_*.sha256")
    whole, digest = part.read_bytes(), checksum.read_bytes()
    for position in range(0, len(whole), len(whole) // 20):
        part.write_bytes(whole[:position] + bytes([whole[position] ^ 4]) + whole[position + 1 :])
        assert query_recording(str(bags[0]), WALK, str(folder)) == first
        assert part.read_bytes() == whole
    for content in (b"", digest[:30], b"\xff" * 80, None):
        checksum.unlink() if content is None else checksum.write_bytes(content)
        assert not query_recording(str(bags[0]), WALK, str(folder)).kept
    assert (part.read_bytes(), checksum.read_bytes()) == (whole, digest)
    assert query_recording(str(bags[0]), WALK, str(folder)).kept
    assert arrow_dataset.dataset(folder).to_table().num_rows == first.poses


@pytest.mark.parametrize(("start", "error"), [("1h", "No stamps between"), ("soon", "is not a point in time")])
def test_a_query_without_a_result_has_an_error(bags, tmp_path, start, error):
    query = TrajectoryQuery("odom", "base", start=start)
    assert error in query_recording(str(bags[0]), query, str(tmp_path)).error


@pytest.mark.filterwarnings("ignore")  # Dask has its own warnings
def test_a_cluster_of_dask(bags, tmp_path):
    distributed = pytest.importorskip("distributed")
    dask = pytest.importorskip("dask")
    with (
        distributed.LocalCluster(n_workers=1, processes=False, dashboard_address=None) as cluster,
        dask.config.set({"scheduler-address": cluster.scheduler_address}),
    ):
        results = query_recordings(bags, WALK, tmp_path / "out", on="dask")
    assert_complete(bags, results, tmp_path / "out")


RAY = """
import json, sys
from coframe.bags import query_recordings
from deadly import DeadlyQuery
from file_server import FileServer

folder, *bags = sys.argv[1:]
results = query_recordings(bags, DeadlyQuery("odom", "lidar", rate=10), folder, on="ray", workers=2)
print(json.dumps(results))
"""


@pytest.mark.slow
def test_a_cluster_of_ray(bags, tmp_path, network):
    """Ray starts a cluster on a separate network; one of the recordings kills its worker."""
    pytest.importorskip("ray", reason="Ray is not installed (pip install ray)")
    deadly = recordings.write_mcap(bags[0].with_name("deadly.mcap"))
    command = network.command(sys.executable, "-c", RAY, tmp_path / "out", *bags, deadly)
    environment = {**os.environ, "PYTHONPATH": str(Path(__file__).parent), "RAY_USAGE_STATS_ENABLED": "0"}
    ended = subprocess.run(command, capture_output=True, text=True, env=environment, check=False)
    assert ended.returncode == 0, ended.stderr
    *results, dead = (
        QueryResult(*values) for values in json.loads(ended.stdout.splitlines()[-1])
    )  # Ray prints its own lines
    assert_complete(bags, results, tmp_path / "out")
    assert dead.error.startswith("Ray reports: ")


@pytest.mark.usefixtures("in_this_process")
def test_the_command_lists_failed_recordings_at_the_end(bags, tmp_path):
    command = ["batch", "odom", "lidar", *map(str, bags), "--rate", "10", "-o", str(tmp_path / "out")]
    ended = CliRunner().invoke(app, command)
    assert ended.exit_code == 1
    assert "poses from 3 recordings" in ended.stdout
    assert f"coframe: {bags[1]} is not a recording: nothing.mcap: the file is in none" in ended.stderr
    assert ended.stderr.count(f"coframe: {bags[1]}") == 1
    assert ended.stderr.rstrip().endswith("2 of 5 recordings failed; see the reasons above")
    assert CliRunner().invoke(app, [*command, "--on", "abacus"]).exit_code == 2


def test_missing_packages_are_reported_before_any_work(bags, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "ray", None)
    with pytest.raises(coframe.RecordingError, match="Ray needs the package ray") as caught:
        query_recordings(bags, WALK, tmp_path / "out", on="ray")
    assert caught.value.hint == "pip install ray"
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    with pytest.raises(coframe.RecordingError, match="Parquet needs the package pyarrow"):
        query_recordings(bags, WALK, tmp_path / "out")


TABLE = TableQuery(["odom:lidar", "/tf@previous"], at="/tf", max_gap="200ms")


def manifest(folder):
    content = json.loads((folder / "_manifest.json").read_text())
    return {entry["bag"]: entry for entry in content["recordings"]}


def test_tables_of_many_recordings(bags, tmp_path):
    results = query_recordings(bags, TABLE, tmp_path / "out", workers=2)
    table = arrow_dataset.dataset(tmp_path / "out").to_table().to_pandas()
    for result in (result for result in results if not result.error):
        with coframe.open_bag(result.bag) as recording:
            expected = TABLE.run(recording)
        rows = table[table["bag"] == result.bag]
        assert rows["stamp_ns"].tolist() == expected.stamps.tolist()
        assert rows["odom:lidar.x"].tolist() == expected["odom:lidar.x"].tolist()
        assert result.poses == len(expected) == manifest(tmp_path / "out")[result.bag]["rows"]
    assert [result.reason for result in results] == ["", "unreadable", "", "", "unreadable"]
    again = query_recordings(bags, TABLE, tmp_path / "out", workers=2)
    assert [result.kept for result in again] == [True, False, True, True, False]
    assert [result._replace(kept=False) for result in again] == results


@pytest.mark.usefixtures("in_this_process")
@pytest.mark.parametrize("on_gap", ["nan", "omit"])
def test_the_manifest_lists_what_is_missing(tmp_path, on_gap):
    rows = [row for number, row in enumerate(recordings.messages()) if not 20 <= number < 40]
    rows += [("/tick", at - 1000, b"\0\1\0\0\1\0\0\0\0") for _, at, _ in recordings.messages()[1:]]
    types = {"/tick": ("std_msgs/msg/String", "ros2msg", b"string data\n", "cdr")}
    bag = recordings.write_mcap(tmp_path / "gap.mcap", rows=sorted(rows, key=lambda row: row[1]), types=types)
    query = TableQuery(["odom:base"], at="/tick", max_gap="200ms", on_gap=on_gap)
    (result,) = query_recordings([bag], query, tmp_path / "out")
    (omission,) = result.omitted
    assert (omission.column, omission.reason) == ("odom:base", "no samples around it within the limits")
    assert omission.rows == 20
    assert (omission.stop - omission.start) // recordings.SECOND == 0
    written = arrow_dataset.dataset(tmp_path / "out").to_table()
    assert (written.num_rows, result.missing) == ((60, 0) if on_gap == "nan" else (40, 20))
    (entry,) = manifest(tmp_path / "out").values()
    assert entry["omitted"] == [omission._asdict()]
    assert (entry["rows"], entry["missing"], entry["file"]) == (written.num_rows, result.missing, result.file)


@pytest.mark.usefixtures("in_this_process")
@pytest.mark.parametrize(
    ("query", "reason"),
    [
        (TableQuery("/nothing.x", at="/tf"), "no topic"),
        (TableQuery("odom:lidar", at="/nothing"), "no topic"),
        (TrajectoryQuery("odom", "lidar", stamps_of="/nothing"), "no topic"),
        (TrajectoryQuery("odom", "moon"), "no transform"),
        (TableQuery("odom:moon", at="/tf"), "no transform"),
        (TableQuery("/tf.no_field"), "failed"),
    ],
)
def test_the_reason_of_a_failure(bags, tmp_path, query, reason):
    (result,) = query_recordings(bags[:1], query, tmp_path / "out")
    assert result.reason == reason
    entry = manifest(tmp_path / "out")[str(bags[0])]
    assert (entry["reason"], entry["error"], entry["file"]) == (reason, result.error, "")


@pytest.mark.usefixtures("in_this_process")
def test_a_recording_that_fails_later_leaves_no_rows_of_another_query(bags, tmp_path):
    query_recordings(bags[:1], WALK, tmp_path / "out")
    content = bags[0].read_bytes()
    bags[0].write_bytes(b"damaged")
    (again,) = query_recordings(bags[:1], WALK, tmp_path / "out")
    assert again.reason == "unreadable"
    assert (tmp_path / "out" / again.file).exists(), "the poses of an earlier run are not lost"
    (other,) = query_recordings(bags[:1], TABLE, tmp_path / "out")
    assert other.file == ""
    assert not list((tmp_path / "out").glob("*.parquet"))
    bags[0].write_bytes(content)
    assert query_recordings(bags[:1], TABLE, tmp_path / "out")[0].poses == 60


def test_an_interrupted_batch_keeps_what_is_done(bags, tmp_path, monkeypatch):
    def interrupted(run, jobs, _workers):
        yield jobs[0], run(*jobs[0])
        raise KeyboardInterrupt

    with monkeypatch.context() as patch:
        patch.setitem(batch.ENGINES, "processes", interrupted)
        with pytest.raises(KeyboardInterrupt):
            query_recordings(bags, TABLE, tmp_path / "out")
    entries = manifest(tmp_path / "out")
    assert entries[str(bags[0])]["rows"] == 60
    assert entries[str(bags[2])]["reason"] == "interrupted"
    assert query_recordings(bags[:1], TABLE, tmp_path / "out", workers=1)[0].kept


def test_recordings_on_a_server(bags, tmp_path):
    with FileServer({"/a/run.mcap": bags[0].read_bytes(), "/b/run.mcap": bags[2].read_bytes()}) as server:
        urls = [server.url(path, "me:secret@") for path in ("/a/run.mcap", "/b/run.mcap", "/c/run.mcap")]
        urls[0] += "?X-Amz-Signature=secret1"
        first = query_recordings(urls, TABLE, tmp_path / "out", workers=2)
        assert [result.reason for result in first] == ["", "", "unreadable"]
        urls[0] = urls[0].replace("secret1", "secret2")
        again = query_recordings(urls, TABLE, tmp_path / "out", workers=2)
        assert [result.kept for result in again] == [True, True, False]
        server.etag = '"changed"'
        assert not query_recordings(urls[:1], TABLE, tmp_path / "out", workers=1)[0].kept
    for file in (tmp_path / "out").iterdir():
        assert b"secret" not in file.read_bytes()


@pytest.mark.parametrize(
    ("arguments", "code", "text"),
    [
        (["-c", "odom:lidar", "--at", "/tf", "BAG"], 0, "60 rows from 1 recording"),
        (["-c", "odom:lidar", "-c", "/tf@previous", "--rate", "10", "BAG"], 0, "30 rows from 1 recording"),
        (["odom", "lidar", "--rate", "10", "BAG"], 0, "30 poses from 1 recording"),
        (["-c", "odom:lidar", "BAG"], 1, "the rows of the table have no times"),
        (["-c", "odom:lidar"], 2, "Missing argument"),
        (["odom", "lidar"], 2, "missing argument BAG"),
        (["odom", "lidar", "--at", "/tf", "BAG"], 2, "--at is for tables"),
        (["-c", "odom:", "BAG"], 2, "odom:"),
        (["-c", "odom:lidar", "ftp://x/y"], 2, "not supported"),
    ],
)
def test_the_command_writes_tables(bags, tmp_path, arguments, code, text):
    arguments = [str(bags[0]) if each == "BAG" else each for each in arguments]
    result = CliRunner().invoke(app, ["batch", *arguments, "-o", str(tmp_path / "out"), "-j", "1"])
    assert result.exit_code == code, result.output
    assert text in result.output
