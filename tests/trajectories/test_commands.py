# SPDX-License-Identifier: Apache-2.0
"""The commands ``coframe compare`` and ``coframe trajectory``."""

import csv
import json

import numpy as np
import pytest
import recordings
from click.testing import CliRunner

import coframe
from coframe.cli.app import app
from coframe.trajectories import read_trajectory


@pytest.fixture(scope="module")
def bag(tmp_path_factory):
    return recordings.write_mcap(tmp_path_factory.mktemp("compare") / "walk.mcap")


@pytest.fixture
def truth(bag, tmp_path):
    run("trajectory", bag, "odom", "base", "-o", tmp_path / "truth.tum")
    return tmp_path / "truth.tum"


def run(*arguments):
    result = CliRunner().invoke(app, [str(argument) for argument in arguments])
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result.exit_code, result.stdout, result.stderr


@pytest.mark.parametrize("kind", ["tum", "kitti", "euroc", "csv", "npz"])
def test_trajectories_are_written_in_every_format(bag, tmp_path, kind):
    path = tmp_path / f"a.{kind}"
    code, out, _ = run("trajectory", bag, "odom", "base", "-o", path)
    assert (code, f"{path}: 60 poses from 1700000000.000000000 to " in out) == (0, True)
    expected = recordings.expected().trajectory("odom", "base")
    np.testing.assert_allclose(read_trajectory(path).matrix, expected.matrix, atol=1e-14)


def test_a_trajectory_of_several_batches(bag, tmp_path, monkeypatch):
    run("trajectory", bag, "odom", "base", "-o", tmp_path / "one.csv", "--rate", "100")
    monkeypatch.setattr("coframe.bags._trajectory_query.BATCH", 7)
    code, _, _ = run("trajectory", bag, "odom", "base", "-o", tmp_path / "many.csv", "--rate", "100")
    assert code == 0
    assert (tmp_path / "one.csv").read_text() == (tmp_path / "many.csv").read_text()


def test_a_recording_compared_with_its_own_trajectory(bag, truth):
    code, out, error = run("compare", truth, f"{bag}:odom:base", "--align", "se3")
    assert (code, error) == (0, "")
    assert out.startswith("60 pairs of poses, aligned\nestimate scaled by 1.000000, rotated by [")
    assert [line.partition("  ")[0] for line in out.splitlines()[-4:]] == [
        "APE translation [m]",
        "APE rotation [deg]",
        "RPE translation [m]",
        "RPE rotation [deg]",
    ]
    assert all(len(line) <= 120 for line in out.splitlines())


def test_figures_in_json(bag, truth, tmp_path):
    code, out, _ = run("compare", truth, f"{bag}:odom:lidar", "--json", "--delta", "1s", "-o", tmp_path / "a.json")
    data = json.loads(out)
    assert code == 0
    assert data == json.loads((tmp_path / "a.json").read_text())
    mount = coframe.Transform.from_rpy([0.1, 0, 0.3], [0, 0, 1])
    assert data["ape"]["translation"]["mean"] == pytest.approx(np.linalg.norm(mount.translation))
    assert data["ape"]["rotation"]["mean"] == pytest.approx(1.0)
    assert data["rpe"]["delta_unit"] == "seconds"
    assert data["alignment"] is None


def test_errors_in_csv(bag, truth, tmp_path):
    code, _, _ = run("compare", truth, f"{bag}:odom:lidar", "--delta", "10", "-o", tmp_path / "a.csv")
    assert code == 0
    rows = list(csv.DictReader((tmp_path / "a.csv").read_text().splitlines()))
    assert len(rows) == 60
    assert rows[0]["stamp_ns"] == "1700000000000000000"
    assert float(rows[5]["ape_rotation"]) == pytest.approx(1.0)
    assert [i for i, row in enumerate(rows) if row["rpe_translation"]] == [10, 20, 30, 40, 50]


@pytest.mark.parametrize("kind", ["html", "svg", "png"])
def test_errors_as_a_plot(bag, truth, tmp_path, kind):
    if kind != "html":
        pytest.importorskip("matplotlib", reason="the extra `plot` is not installed")
    code, _, error = run("compare", truth, f"{bag}:odom:lidar", "-o", tmp_path / f"a.{kind}")
    # The lidar is mounted 0.1 m ahead, 0.3 m up, and turned by a radian.
    assert (code, "constant pose of 57.3 deg and 0.3162 m" in error) == (0, True)
    content = (tmp_path / f"a.{kind}").read_bytes()
    assert kind == "png" or b"RPE over 1 frame, translation" in content


def test_trajectories_without_stamps_are_plotted_by_number(bag, tmp_path):
    run("trajectory", bag, "odom", "base", "-o", tmp_path / "a.kitti")
    code, _, _ = run("compare", tmp_path / "a.kitti", tmp_path / "a.kitti", "-o", tmp_path / "a.html")
    assert (code, '"x": "pose"' in (tmp_path / "a.html").read_text()) == (0, True)


@pytest.mark.parametrize(
    ("estimate", "code", "reason", "hint"),
    [
        ("{bag}", 2, "is a recording: give a topic with poses, or two of its frames", "walk.mcap:map:base_link"),
        ("{bag}:odom", 2, "has one frame; a trajectory needs two", "BAG:TARGET:SOURCE"),
        ("{bag}:odom:bsae", 1, "does not exist", "Did you mean 'base'?"),
        ("missing.tum", 1, "missing.tum cannot be read: No such file or directory", ""),
        ("missing.mcap:a:b", 1, "missing.mcap cannot be read", ""),
    ],
)
def test_arguments_that_are_not_trajectories(bag, truth, estimate, code, reason, hint):
    found, out, error = run("compare", truth, estimate.format(bag=bag))
    assert (found, out) == (code, "")
    assert reason in error
    assert hint in error


def test_wrong_options(truth, tmp_path):
    for words in (["--delta", "1 parsec"], ["--max-difference", "soon"], ["--align", "sim4"], ["-o", "a.pdf"]):
        assert run("compare", truth, truth, *words)[0] == 2, words
    code, _, error = run("compare", truth, truth, "-o", tmp_path / "missing" / "a.csv")
    assert (code, "cannot be written: No such file" in error) == (1, True)
