# SPDX-License-Identifier: Apache-2.0
"""Constant differences that look like errors, such as another frame or clock, and options that remove them."""

import csv
import json
import re
import shlex

import numpy as np
import pytest
from click.testing import CliRunner

import coframe
from coframe import quaternion
from coframe.cli.app import app
from coframe.trajectories import TrajectoryError, compare_trajectories, write_trajectory

SECOND = 1_000_000_000
START = 1_700_000_000 * SECOND
WORLD = coframe.Transform.from_rpy([3.0, -2.0, 1.0], [0.2, -0.4, 2.0])
# A camera, whose optical axis is z, on a robot, whose x axis points ahead.
CAMERA = coframe.Transform.from_rpy([0.2, -0.1, 0.3], [-np.pi / 2, 0.1, -np.pi / 2])


def drive(seed=None, count=600, late=0):
    """Return a robot that turns about all axes; with a seed, with noise of 2 cm and a degree."""
    t = np.arange(count) / 20
    positions = np.stack([5 * np.sin(t / 3), 4 * np.cos(t / 5), 0.5 * np.sin(t)], axis=1)
    angles = np.stack([0.3 * np.sin(t), 0.2 * np.cos(t / 2), t / 3 + 0.4 * np.sin(2 * t)], axis=1)
    if seed is not None:
        rng = np.random.default_rng(seed)
        positions = positions + rng.normal(scale=0.02, size=positions.shape)
        angles = angles + rng.normal(scale=0.02, size=angles.shape)
    stamps = START + np.rint(t * SECOND).astype(np.int64) + late
    return coframe.Transform(positions, quaternion.from_rpy(angles), stamp=stamps)


@pytest.mark.parametrize("align", ["none", "se3", "sim3"])
@pytest.mark.parametrize("seed", [0, 1, pytest.param(2, marks=pytest.mark.slow)])
def test_a_body_offset_is_found_and_removed(align, seed):
    rng = np.random.default_rng(seed)
    offset = coframe.Transform.exp(np.concatenate([rng.normal(scale=0.3, size=3), rng.normal(scale=1.5, size=3)]))
    estimate = drive(seed) @ offset.inverse()
    estimate = estimate if align == "none" else WORLD @ estimate
    if align == "sim3":
        estimate = coframe.Transform(0.5 * estimate.translation, estimate.quaternion, stamp=estimate.stamps)
        offset = coframe.Transform(0.5 * offset.translation, offset.quaternion)
    found = compare_trajectories(drive(), estimate, align=align).body_offset
    distance, angle = found.transform.distance(offset)
    assert distance < 0.01
    assert angle < 0.01
    removed = compare_trajectories(drive(), estimate, align=align, body_offset=found.transform)
    assert removed.ape.rotation_statistics.rmse < 0.045
    assert removed.ape.translation_statistics.rmse < 0.045
    assert removed.body_offset is None


@pytest.mark.parametrize("late", [0.012, 0.123, -0.35, 1.2, -1.9])
@pytest.mark.parametrize("align", ["none", "se3"])
def test_a_time_shift_is_found_and_removed(align, late):
    estimate = drive(1, late=round(late * SECOND))
    estimate = estimate if align == "none" else WORLD @ estimate
    found = compare_trajectories(drive(), estimate, align=align, max_difference="30ms").time_shift
    if abs(late) < 0.02:  # less than half of the error
        return
    assert found.offset == pytest.approx(-late * SECOND, abs=2e6)
    removed = compare_trajectories(drive(), estimate, align=align, max_difference="30ms", t_offset=found.offset)
    assert removed.ape.translation_statistics.rmse < 0.06
    assert removed.time_shift is None


@pytest.mark.parametrize("seed", range(2))
def test_both_at_once(seed):
    estimate = WORLD @ drive(seed, late=-300_000_000) @ CAMERA.inverse()
    found = compare_trajectories(drive(), estimate, align="se3")
    assert found.time_shift.offset == pytest.approx(300_000_000, abs=6e6)
    distance, angle = found.body_offset.transform.distance(CAMERA)
    assert (distance < 0.02, angle < 0.02) == (True, True)


@pytest.mark.parametrize("align", ["none", "se3", "sim3", "scale"])
@pytest.mark.parametrize("seed", range(2))
def test_noise_and_another_world_are_not_reported(align, seed):
    estimate = WORLD @ drive(seed) if align in {"se3", "sim3"} else drive(seed)
    result = compare_trajectories(drive(), estimate, align=align)
    assert (result.body_offset, result.time_shift) == (None, None)
    turned = compare_trajectories(drive(), WORLD @ drive(seed))
    assert (turned.body_offset, turned.time_shift) == (None, None)


@pytest.mark.parametrize("degrees", [3, 10, 40, 170])
def test_a_turned_world_of_a_robot_on_a_plane_is_not_a_body_offset(degrees):
    t = np.arange(400) / 20
    angles = np.stack([0 * t, 0 * t, t / 3], axis=1)
    positions = np.stack([4 * np.sin(t / 3), 4 - 4 * np.cos(t / 3), 0 * t], axis=1)
    truth = coframe.Transform(positions, quaternion.from_rpy(angles), stamp=START + (t * SECOND).astype(np.int64))
    world = coframe.Transform.from_rpy([0, 0, 0], yaw=np.radians(degrees))
    assert compare_trajectories(truth, world @ truth).body_offset is None
    mount = coframe.Transform.from_rpy([0.3, 0, 0], yaw=np.radians(degrees))
    found = compare_trajectories(truth, truth @ mount).body_offset
    assert found.transform.distance(mount.inverse())[1] < 1e-6


def test_a_drift_is_not_a_body_offset():
    truth = drive()
    angles = np.zeros((len(truth), 3))
    angles[:, 2] = np.linspace(0, 1, len(truth))
    drifting = coframe.Transform(
        truth.translation, quaternion.multiply(truth.quaternion, quaternion.from_rpy(angles)), stamp=truth.stamps
    )
    found = compare_trajectories(truth, drifting).body_offset
    assert found is None or found.rotation_rmse[1] > 0.25  # half of a drift of a radian is its mean


def test_options_that_are_not_valid():
    for options, text in (
        ({"align": "so3"}, "No alignment named 'so3'"),
        ({"align": "se3", "align_origin": True}, "mutually exclusive"),
        ({"project": "zx"}, "No plane named 'zx'"),
        ({"n_to_align": 0}, "n_to_align must be at least 1"),
        ({"t_offset": "soon"}, "soon"),
        ({"align": "hand-eye", "body_offset": CAMERA}, "give one of them"),
    ):
        with pytest.raises(ValueError, match=text):
            compare_trajectories(drive(), drive(1), **options)
    with pytest.raises(TrajectoryError, match=r"No stamps .* are within 10 ms") as caught:
        compare_trajectories(drive(), drive(late=3600 * SECOND))
    assert "-3600.000000000 s" in caught.value.hint
    with pytest.raises(TrajectoryError, match=r"No stamps .* are within 10 ms") as caught:
        compare_trajectories(drive(), drive(1, late=-280_000_000))
    found = re.search(r"add (\S+) ms to the stamps of the estimate", caught.value.hint)
    assert float(found[1]) == pytest.approx(280, abs=2)


@pytest.mark.parametrize("late", [0.0, 0.1, -0.237])
@pytest.mark.parametrize("seed", [0, pytest.param(1, marks=pytest.mark.slow)])
def test_the_offset_and_the_body_frame_can_be_estimated_at_once(late, seed):
    estimate = WORLD @ drive(seed, late=round(late * SECOND)) @ CAMERA.inverse()
    result = compare_trajectories(drive(), estimate, align="hand-eye", t_offset="auto")
    assert result.t_offset == pytest.approx(-late * SECOND, abs=6e6)
    distance, angle = result.applied_body_offset.distance(CAMERA)
    assert (distance < 0.02, angle < 0.01) == (True, True)
    assert result.ape.translation_statistics.rmse < 0.04
    assert result.ape.rotation_statistics.rmse < 0.04
    assert (result.body_offset, result.time_shift) == (None, None)
    assert len(result.reference) > 580


def test_a_shifted_estimate_is_not_interpolated_over_gaps():
    estimate = drive(late=33_000_000)
    estimate = estimate[np.r_[0:200, 400:600]]
    result = compare_trajectories(drive(), estimate, t_offset="auto")
    assert result.t_offset == pytest.approx(-33e6, abs=1e6)
    assert 390 <= len(result.reference) <= 401
    assert result.ape.translation_statistics.max < 0.02


# The command.


@pytest.fixture
def files(tmp_path):
    write_trajectory(drive(), tmp_path / "truth.tum")
    write_trajectory(WORLD @ drive(1, late=-300_000_000) @ CAMERA.inverse(), tmp_path / "camera.tum")
    write_trajectory(WORLD @ drive(2), tmp_path / "good.tum")
    return tmp_path


def run(*arguments):
    result = CliRunner().invoke(app, ["compare", *map(str, arguments)])
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result.exit_code, result.stdout, result.stderr


def test_the_options_that_are_printed_remove_the_differences(files):
    code, out, error = run(files / "truth.tum", files / "camera.tum", "--align", "se3")
    assert code == 0
    assert re.search(r"a time offset of (29\d|30\d) ms explains most of the error", error)
    assert re.search(r"differ by a constant pose of 1\d\d(\.\d)? deg and 0\.\d+ m", error)
    options = [shlex.split(line.partition("To remove it: ")[2]) for line in error.splitlines()]
    assert [each[0] for each in options] == ["--t-offset", "--body-offset"]
    code, out, error = run(files / "truth.tum", files / "camera.tum", "--align", "se3", *options[0], *options[1])
    assert (code, error) == (0, "")
    rotation = float(next(line for line in out.splitlines() if line.startswith("APE rotation")).split()[3])
    assert rotation < 2.5


def test_several_estimates_are_rows_and_curves(files):
    outputs = [word for kind in ("csv", "json", "html") for word in ("-o", files / f"a.{kind}")]
    code, out, error = run(
        files / "truth.tum", files / "good.tum", files / "camera.tum", files / "good.tum", "--align", "se3", *outputs
    )
    assert code == 0
    rows = [line.split() for line in out.splitlines()[-3:]]
    assert [row[0] for row in rows[:2]] == [str(files / "good.tum"), str(files / "camera.tum")]
    assert rows[2][:2] == [str(files / "good.tum"), "(2)"]
    single = json.loads(run(files / "truth.tum", files / "good.tum", "--align", "se3", "--json")[1])
    assert float(rows[0][3]) == pytest.approx(single["ape"]["translation"]["rmse"], rel=1e-3)
    data = json.loads((files / "a.json").read_text())["estimates"]
    assert [each["name"] for each in data][:2] == [str(files / "good.tum"), str(files / "camera.tum")]
    assert {key: data[0][key] for key in single} == single
    assert data[1]["time_shift"]["offset_ns"] == pytest.approx(300_000_000, abs=3e6)
    table = list(csv.DictReader((files / "a.csv").read_text().splitlines()))
    assert len(table) == sum(each["pairs"] for each in data)
    page = (files / "a.html").read_text()
    assert page.count("APE, translation of") == 3
    assert error.startswith(f"coframe: {files / 'camera.tum'}: a time offset of")


@pytest.mark.parametrize(
    ("words", "text"),
    [
        (["--align", "se3", "--align-origin"], "mutually exclusive"),
        (["--project", "zx"], "'zx' is not one of 'xy', 'xz', 'yz'"),
        (["--n-to-align", "0"], "0 is not in the range"),
        (["--body-offset", "0", "0", "0", "0", "0", "nan"], "not finite"),
        (["--t-offset", "soon"], "is not a duration"),
    ],
)
def test_wrong_options_of_the_command(files, words, text):
    code, _, error = run(files / "truth.tum", files / "good.tum", *words)
    assert (code, text in error) == (2, True), error


def test_planes_origins_and_offsets(files):
    errors = {}
    for name, words in {
        "none": [],
        "origin": ["--align-origin"],
        "plane": ["--align-origin", "--project", "xy"],
        "few": ["--align", "se3", "--n-to-align", "50"],
        "late": ["--align", "se3", "--t-offset", "-40ms", "--t-max-diff", "15ms"],
    }.items():
        code, out, _ = run(files / "truth.tum", files / "good.tum", "--json", *words)
        assert code == 0
        errors[name] = json.loads(out)["ape"]["translation"]
    assert errors["origin"]["min"] < 1e-9
    assert errors["plane"]["rmse"] < errors["origin"]["rmse"] < errors["none"]["rmse"]
    assert errors["few"]["rmse"] > 0.03
    assert errors["late"]["rmse"] > 0.03
