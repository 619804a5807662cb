# SPDX-License-Identifier: Apache-2.0
"""`bag merge --offset`: two computers with different clocks, given as a number or measured from what both recorded."""

import numpy as np
import pytest
from click.testing import CliRunner
from recordings import START
from runs import MS, SECOND, Run, stamp_message
from scipy.spatial.transform import Rotation, Slerp

import coframe
from coframe.cli.app import app
from coframe.messages import find

OFFSET = 3_600_120_000_000  # nanoseconds by which the second clock is behind
FIX, HEADER, COUNTER = "sensor_msgs/msg/NavSatFix", "std_msgs/msg/Header", "std_msgs/msg/UInt32"
SECONDS = 25


def motion(seed, seconds):
    """Return a smooth random rotation as a function of time."""
    rng = np.random.default_rng(seed)
    times = np.arange(-2.0, seconds + 2.0, 0.1)
    kernel = np.exp(-0.5 * (np.arange(-30, 31) / 6.0) ** 2)
    rates = (
        np.stack(
            [
                np.convolve(column, kernel / np.sqrt((kernel**2).sum()), "same")
                for column in rng.normal(size=(3, len(times)))
            ],
            axis=1,
        )
        * 0.5
    )
    turns = [Rotation.identity()]
    for rate in rates[:-1]:
        turns.append(turns[-1] * Rotation.from_rotvec(rate * 0.1))
    return Slerp(times, Rotation.concatenate(turns))


def record(folder, *, clock=0, frames=("map", "base"), mount=None, turn=True, shared=True, seed=1, stamp_clock=None):
    """Write what one computer records of a body that turns; the receive times and stamps are on its own clock."""
    rng = np.random.default_rng(seed + bool(clock))
    run, body = Run(), motion(1, SECONDS)
    mount = mount or Rotation.identity()
    for time in np.sort(rng.uniform(0, SECONDS, 25 * SECONDS)):
        rotation = (body(time) if turn else Rotation.identity()) * Rotation.from_rotvec(rng.normal(size=3) * 0.002)
        at = START + round(time * SECOND) - clock
        stamp = at if stamp_clock is None else stamp_clock + round(time * SECOND)
        run.tf(*frames, stamp, (0.0, 0.0, 0.0), tuple((rotation * mount).as_quat()), arrived=at + MS)
    for number in range(100 if shared else 0):  # from a third computer: both receive the same bytes
        at = START + number * SECOND // 5 - clock
        sent = find(FIX)(header=find(HEADER)(stamp=stamp_message(START + number * SECOND // 5), frame_id="sky"))
        run.message("/beacon", FIX, sent, at + round(abs(rng.normal()) * MS / 2))
    folder.mkdir()
    return run.write(folder)


def merge(folder, *words):
    ended = CliRunner().invoke(app, ["bag", "merge", *map(str, words), "-o", str(folder)])
    return ended.exit_code, ended.stderr


def stamps(path, child):
    with coframe.open_bag(path) as bag:
        messages = [one.message for one in bag.messages("/tf")]
    found = [each.header.stamp for one in messages for each in one.transforms if each.child_frame_id == child]
    return np.array([stamp.sec * SECOND + stamp.nanosec for stamp in found])


def test_a_given_offset_shifts_receive_times_and_stamps(tmp_path):
    bags = record(tmp_path / "a"), record(tmp_path / "b", frames=("map", "other"), clock=OFFSET)
    assert merge(tmp_path / "both", *bags, "--offset", "-1h")[0] == 0
    assert (stamps(tmp_path / "both", "other") == stamps(bags[1], "other") - 3600 * SECOND).all()
    assert (stamps(tmp_path / "both", "base") == stamps(bags[0], "base")).all()
    with coframe.open_bag(bags[1]) as before, coframe.open_bag(tmp_path / "both") as after:
        shifted = [one.received for one in after.messages("/tf") if one.message.transforms[0].child_frame_id == "other"]
        assert (np.array(shifted) == before.received("/tf") - 3600 * SECOND).all()


@pytest.mark.parametrize("method", ["topic:/beacon", "auto", "motion:map:base=world:camera"])
def test_a_measured_offset_is_right_within_its_deviation(tmp_path, method):
    mount = Rotation.from_euler("xyz", [10, 70, -30], degrees=True)
    bags = record(tmp_path / "a"), record(tmp_path / "b", clock=OFFSET, frames=("world", "camera"), mount=mount)
    code, said = merge(tmp_path / "both", *bags, "--offset", method)
    assert code == 0, said
    moved = stamps(tmp_path / "both", "camera") - stamps(bags[1], "camera")
    assert abs(moved - OFFSET).max() < 2 * MS
    assert "+3600.1" in said
    assert " +-" in said


def test_equal_frames_that_turn_are_found_without_a_common_topic(tmp_path):
    bags = record(tmp_path / "a", shared=False), record(tmp_path / "b", clock=OFFSET, shared=False)
    code, said = merge(tmp_path / "both", *bags, "--offset", "auto", "--join")
    assert code == 0, said
    assert "from the rotation of map:base" in said


def test_equal_counters_of_two_robots_are_no_evidence(tmp_path):
    """Both count from 0, one of them 7 s later: equal messages, but not the same ones."""
    bags = []
    for name, later in (("a", 0), ("b", 7 * SECOND)):
        run = Run()
        run.tf("map", f"robot_{name}", START, static=True)
        for number in range(50):
            run.message("/count", COUNTER, find(COUNTER)(data=number), START + number * SECOND // 10 + later)
        (tmp_path / name).mkdir()
        bags.append(run.write(tmp_path / name))
    code, said = merge(tmp_path / "both", *bags, "--offset", "auto")
    assert (code, "no common evidence of a time offset" in said) == (1, True)


def test_simulated_stamps_are_not_shifted(tmp_path):
    bags = record(tmp_path / "a"), record(tmp_path / "b", frames=("map", "other"), clock=OFFSET, stamp_clock=SECOND)
    assert merge(tmp_path / "both", *bags, "--offset", "-1h")[0] == 0
    assert (stamps(tmp_path / "both", "other") == stamps(bags[1], "other")).all()


@pytest.mark.parametrize(
    ("change", "method", "reason"),
    [
        ({"turn": False}, "motion:map:base", "the rotations do not agree at any time offset"),
        ({"shared": False}, "topic:/beacon", "has no topic /beacon"),
        ({"shared": False, "turn": False}, "auto", "no common evidence of a time offset"),
        ({}, "motion:map:bas", "no time offset from the motion map:bas"),
        ({}, "motion:map", "is not two frames such as map:base_link"),
        ({}, "magic", "'magic' is not an offset"),
        ({}, "5 parsecs", "is not a duration"),
    ],
)
def test_thin_evidence_is_refused(tmp_path, change, method, reason):
    bags = record(tmp_path / "a", **change), record(tmp_path / "b", clock=OFFSET, **change)
    code, said = merge(tmp_path / "both", *bags, "--offset", method)
    assert code == 1
    assert reason in said
    assert not (tmp_path / "both").exists()


def test_one_offset_is_given_for_each_recording_after_the_first(tmp_path):
    bag = record(tmp_path / "a")
    code, said = merge(tmp_path / "both", bag, bag, "--offset", "0s", "--offset", "1s")
    assert (code, "--offset: give 1, one for each recording after the first" in said) == (2, True)
