"""The same question to many recordings: one dataset, and none of them stops the others."""

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import recordings
from deadly import DeadlyQuestion
from typer.testing import CliRunner

import coframe
from coframe.bags import Answer, Question, answer, answer_all, batch
from coframe.cli.app import app

arrow_dataset = pytest.importorskip("pyarrow.dataset")
WALK = Question("odom", "lidar", rate=10)


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


def assert_complete(bags, answers, folder):
    """What is written is what each recording says by itself."""
    assert [answer.bag for answer in answers] == [str(bag) for bag in bags]
    good = [one for one in answers if not one.error]
    assert {one.bag for one in good} == {str(bags[i]) for i in (0, 2, 3)}
    table = arrow_dataset.dataset(folder).to_table()
    bag_of_row = np.array(table["bag"].to_pylist())
    assert table.num_rows == sum(one.poses for one in good) > 60
    for one in good:
        with coframe.open_bag(one.bag) as recording:
            poses, _ = WALK.ask(recording)
        rows = bag_of_row == one.bag
        assert table["stamp_ns"].to_numpy()[rows].tolist() == poses.stamps.tolist()
        found = np.stack([table[name].to_numpy()[rows] for name in ("x", "y", "z", "qx", "qy", "qz", "qw")], axis=1)
        assert (found == np.concatenate([poses.translation, poses.quaternion], axis=1)).all()


def test_processes_of_this_machine(bags, tmp_path):
    """One dies, two cannot be read, one is cut off."""
    deadly = recordings.write_mcap(bags[0].with_name("deadly.mcap"))
    question = DeadlyQuestion("odom", "lidar", rate=10)
    told = []
    *answers, dead = answer_all([*bags, deadly], question, tmp_path / "out", workers=2, progress=told.append)
    assert_complete(bags, answers, tmp_path / "out")
    assert "its process died" in dead.error
    assert sorted(told) == sorted([*answers, dead])
    assert "cannot be read: No such file" in answers[4].error
    assert answers[2].problems


@pytest.fixture
def in_this_process(monkeypatch):
    monkeypatch.setitem(batch.ENGINES, "processes", lambda jobs, _workers: (answer(*job) for job in jobs))


@pytest.mark.usefixtures("in_this_process")
def test_a_second_run_does_what_is_left(bags, tmp_path):
    assert_complete(bags, answer_all(bags, WALK, tmp_path / "out"), tmp_path / "out")
    bags[3].joinpath("metadata.yaml").touch()
    again = answer_all(bags, WALK, tmp_path / "out")
    assert_complete(bags, again, tmp_path / "out")
    assert [one.kept for one in again] == [True, False, True, False, False]


def test_an_answer_to_another_question_is_not_kept(bags, tmp_path):
    first = answer(str(bags[0]), WALK, str(tmp_path))
    assert not first.error
    assert answer(str(bags[0]), WALK, str(tmp_path)) == first._replace(kept=True, problems=())
    other = answer(str(bags[0]), Question("odom", "base", start="1s"), str(tmp_path))
    assert (other.kept, other.error) == (False, "")
    (part,) = tmp_path.glob("*.parquet")
    part.write_bytes(part.read_bytes()[:-20])
    assert not answer(str(bags[0]), Question("odom", "base", start="1s"), str(tmp_path)).kept
    assert "there is nothing between" in answer(str(bags[0]), Question("odom", "base", start="1h"), str(tmp_path)).error
    assert "is no point in time" in answer(str(bags[0]), Question("odom", "base", start="soon"), str(tmp_path)).error


@pytest.mark.filterwarnings("ignore")  # of another library, which has its own
def test_a_cluster_of_dask(bags, tmp_path):
    distributed = pytest.importorskip("distributed")
    dask = pytest.importorskip("dask")
    with (
        distributed.LocalCluster(n_workers=1, processes=False, dashboard_address=None) as cluster,
        dask.config.set({"scheduler-address": cluster.scheduler_address}),
    ):
        answers = answer_all(bags, WALK, tmp_path / "out", on="dask")
    assert_complete(bags, answers, tmp_path / "out")


RAY = """
import json, sys
from coframe.bags import answer_all
from deadly import DeadlyQuestion

folder, *bags = sys.argv[1:]
answers = answer_all(bags, DeadlyQuestion("odom", "lidar", rate=10), folder, on="ray", workers=2)
print(json.dumps(answers))
"""


@pytest.mark.slow
def test_a_cluster_of_ray(bags, tmp_path, network):
    """One that Ray makes for itself, on a network of its own; one of the recordings ends its worker's process."""
    pytest.importorskip("ray", reason="Ray is not installed (pip install ray)")
    deadly = recordings.write_mcap(bags[0].with_name("deadly.mcap"))
    command = network.command(sys.executable, "-c", RAY, tmp_path / "out", *bags, deadly)
    environment = {**os.environ, "PYTHONPATH": str(Path(__file__).parent), "RAY_USAGE_STATS_ENABLED": "0"}
    ended = subprocess.run(command, capture_output=True, text=True, env=environment, check=False)
    assert ended.returncode == 0, ended.stderr
    *answers, dead = (Answer(*values) for values in json.loads(ended.stdout.splitlines()[-1]))  # Ray talks, too
    assert_complete(bags, answers, tmp_path / "out")
    assert dead.error.startswith("Ray says: ")


@pytest.mark.usefixtures("in_this_process")
def test_the_command_lists_the_bad_ones_in_the_end(bags, tmp_path):
    command = ["batch", "odom", "lidar", *map(str, bags), "--rate", "10", "-o", str(tmp_path / "out")]
    ended = CliRunner().invoke(app, command)
    assert ended.exit_code == 1
    assert "poses from 3 recordings" in ended.stdout
    assert f"coframe: {bags[1]} is no recording: nothing.mcap: it is neither" in ended.stderr
    assert ended.stderr.count(str(bags[1])) == 1
    assert ended.stderr.rstrip().endswith("2 of 5 recordings failed, for the reasons above")
    assert CliRunner().invoke(app, [*command, "--on", "abacus"]).exit_code == 2


def test_what_is_not_installed_is_said_before_any_work(bags, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "ray", None)
    with pytest.raises(coframe.RecordingError, match="Ray needs the package ray") as caught:
        answer_all(bags, WALK, tmp_path / "out", on="ray")
    assert caught.value.hint == "pip install ray"
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    with pytest.raises(coframe.RecordingError, match="Parquet needs the package pyarrow"):
        answer_all(bags, WALK, tmp_path / "out")
