# SPDX-License-Identifier: Apache-2.0
"""A contract derived from a good recording is kept by it, and each fault in another recording breaks it by name."""

import dataclasses
import math

import pytest
from runs import MS, SECOND, START, Run, rpy, stamp_message

from coframe.contract import (
    AvailabilityRequirement,
    check_recording,
    contract_yaml,
    derive_contract,
    measure_recording,
    parse_contract,
)
from coframe.doctor import Severity
from coframe.messages import find

TWIST = "geometry_msgs/msg/Twist"


@pytest.fixture(scope="module")
def good(tmp_path_factory):
    return Run.healthy(seconds=4).write(tmp_path_factory.mktemp("good"))


@pytest.fixture(scope="module")
def contract(good):
    return derive_contract(measure_recording(good))


def problems(contract, run, folder):
    verdict = check_recording(contract, run.write(folder))
    assert not verdict.unreadable
    return {(each.kind, each.subject): " ".join(each.problems) for each in verdict.broken}


def test_the_good_recording_keeps_its_contract(contract, good):
    verdict = check_recording(contract, good)
    assert verdict.is_kept
    assert {each.kind for each in verdict.results} == {"transform", "topic", "availability", "clock", "finding"}
    assert verdict.text() == f"{good}: 6 of 6 requirements are met"


def test_what_is_derived(contract):
    moving, static = sorted(contract.transforms, key=lambda each: each.static)
    assert (moving.parent, moving.child, moving.min_rate, moving.max_gap) == ("odom", "base_link", 40.0, 60 * MS)
    assert (static.parent, static.child, static.xyz, static.rpy) == (
        "base_link",
        "lidar",
        (0.1, 0.0, 0.3),
        (0.0, 0.0, 0.0),
    )
    (topic,) = contract.topics
    assert (topic.name, topic.type, topic.frame, topic.min_rate) == ("/scan", "sensor_msgs/msg/LaserScan", "lidar", 8.0)
    (available,) = contract.availability
    assert (available.target, available.source, available.at) == ("odom", "lidar", "/scan")
    assert contract.clock == "wall"
    assert contract.ignore == ()


def test_another_good_recording_keeps_the_contract(contract, tmp_path):
    assert problems(contract, Run.healthy(seconds=7, latency=3 * MS), tmp_path) == {}


def test_a_missing_static_transform(contract, tmp_path):
    found = problems(contract, Run.healthy(seconds=4, skip={"static"}), tmp_path)
    assert found["transform", "base_link -> lidar"] == "the frame 'lidar' was not published"
    assert "'lidar' was not published" in found["availability", "odom <- lidar at /scan"]
    assert ("finding", "TF014") in found


def test_a_misspelt_frame_is_suggested(contract, tmp_path):
    run = Run.healthy(seconds=4, skip={"static"})
    run.tf("base_link", "lidra", START, (0.1, 0.0, 0.3), static=True)
    found = problems(contract, run, tmp_path)
    assert found["transform", "base_link -> lidar"] == ("the frame 'lidar' was not published. Did you mean 'lidra'?")


@pytest.mark.parametrize(
    ("place", "turn", "text"),
    [
        ((0.1, 0.005, 0.3), rpy(0, 0, 0), "the position is off by 5 mm; the tolerance is 1 mm"),
        ((100.0, 0.0, 300.0), rpy(0, 0, 0), "the position is off by 316 m; the tolerance is 1 mm"),
        (
            (0.1, 0.0, 0.3),
            rpy(0, 0, math.radians(0.5)),
            "the rotation is off by 0.5 degrees; the tolerance is 0.1 degrees",
        ),
        ((0.1, 0.0, 0.3), rpy(math.pi, 0, 0), "the rotation is off by 180 degrees"),
    ],
)
def test_a_mount_that_has_moved(contract, tmp_path, place, turn, text):
    run = Run.healthy(seconds=4, skip={"static"})
    run.tf("base_link", "lidar", START, place, turn, static=True)
    assert text in problems(contract, run, tmp_path)["transform", "base_link -> lidar"]


def test_a_mount_within_the_tolerance_keeps_the_contract(contract, tmp_path):
    run = Run.healthy(seconds=4, skip={"static"})
    turn = tuple(-each for each in rpy(0, 0, math.radians(0.05)))  # -q is the same rotation
    run.tf("base_link", "lidar", START, (0.1005, 0.0, 0.3), turn, static=True)
    assert problems(contract, run, tmp_path) == {}


def test_a_frame_with_another_parent(contract, tmp_path):
    run = Run.healthy(seconds=4, skip={"static"})
    run.tf("base_link", "mast", START, (0.0, 0.0, 0.0), static=True)
    run.tf("mast", "lidar", START, (0.1, 0.0, 0.3), static=True)
    found = problems(contract, run, tmp_path)
    assert found == {("transform", "base_link -> lidar"): "the parent of 'lidar' is 'mast', not 'base_link'"}


def test_a_gap_in_the_middle_and_one_at_the_end(contract, tmp_path):
    for name, missing in (("middle", range(50, 100)), ("end", range(150, 200))):
        run = Run.healthy(seconds=4, skip={"odom"})
        for i in set(range(200)) - set(missing):
            run.drive(START + i * SECOND // 50)
        (tmp_path / name).mkdir()
        found = problems(contract, run, tmp_path / name)
        longest = {"middle": "1.02 s", "end": "920 ms"}[name]
        assert f"the longest gap is {longest}" in found["transform", "odom -> base_link"]


def test_a_topic_that_is_missing_or_slow_or_of_another_type(contract, tmp_path):
    found = problems(contract, Run.healthy(seconds=4, skip={"scan"}), tmp_path)
    assert found["topic", "/scan"] == "there is no such topic"
    assert found["availability", "odom <- lidar at /scan"] == "no message on /scan has a stamp"
    slow = Run.healthy(seconds=4, skip={"scan"})
    for i in range(8):
        slow.scan(START + i * SECOND // 2, arrived=START + i * SECOND // 2 + 6 * MS)
    (tmp_path / "slow").mkdir()
    assert "the rate is 2 Hz; the minimum is 8 Hz" in problems(contract, slow, tmp_path / "slow")["topic", "/scan"]
    other = Run.healthy(seconds=4, skip={"scan"})
    for i in range(40):
        other.message("/scan", TWIST, find(TWIST)(), START + i * SECOND // 10)
    (tmp_path / "other").mkdir()
    found = problems(contract, other, tmp_path / "other")["topic", "/scan"]
    assert f"its type is {TWIST}, not sensor_msgs/msg/LaserScan" in found
    assert "its messages are in no frame, not in lidar" in found


def test_what_cannot_be_checked_is_said(contract, tmp_path):
    """The recordings of these tests contain no QoS, and damaged bytes are not examined."""
    strict = parse_contract("topics: [{name: /scan, reliable: true}]")
    verdict = check_recording(strict, Run.healthy(seconds=2).write(tmp_path))
    assert verdict.is_kept
    assert verdict.unchecked == ("topic /scan: reliable: the QoS of its publishers is unknown",)
    assert "  not checked: topic /scan: reliable: the QoS of its publishers is unknown" in verdict.text()
    path = Run.healthy(seconds=4).write(tmp_path)
    path.write_bytes(path.read_bytes()[:-2000])  # a recorder that was killed
    verdict = check_recording(contract, path)
    assert verdict.unchecked
    assert "not checked: " in verdict.text()


def test_the_frame_of_joint_states(tmp_path):
    """Their header has a frame, although the doctor does not examine them as sensor data."""
    run = Run.healthy(seconds=2)
    states = find("sensor_msgs/msg/JointState")(name=["arm"], position=[0.0])
    states.header.frame_id = "base_link"
    for i in range(20):
        run.message("/joint_states", "sensor_msgs/msg/JointState", states, START + i * SECOND // 10)
    path = run.write(tmp_path)
    for frame, expected in (("base_link", ()), ("arm", ("its messages are in base_link, not in arm",))):
        required = parse_contract(f"topics: [{{name: /joint_states, frame: {frame}}}]")
        assert check_recording(required, path).results[0].problems == expected


def test_scans_whose_transform_comes_late(contract, tmp_path):
    run = Run.healthy(seconds=4, skip={"odom"})
    for i in range(200):
        at = START + i * SECOND // 50
        run.drive(at, arrived=at + 300 * MS)
    found = problems(contract, run, tmp_path)
    assert (
        "it was available within 20 ms for 0 % of the messages; the minimum is 95 %"
        in (found["availability", "odom <- lidar at /scan"])
    )


def test_simulated_time_instead_of_system_time(contract, tmp_path):
    run = Run()
    clock = find("rosgraph_msgs/msg/Clock")
    run.tf("base_link", "lidar", 0, (0.1, 0.0, 0.3), static=True, arrived=START)
    for i in range(200):
        at = START + i * SECOND // 50
        run.message("/clock", "rosgraph_msgs/msg/Clock", clock(clock=stamp_message(at - START + SECOND)), at)
        run.drive(at, stamp=at - START + SECOND)
    found = problems(contract, run, tmp_path)
    assert found["clock", "stamps of /"] == "the stamps are simulated time, not system time"


def test_frames_that_the_contract_does_not_name(contract, tmp_path):
    run = Run.healthy(seconds=4)
    run.tf("base_link", "camera", START, (0.2, 0.0, 0.1), static=True)
    strict = dataclasses.replace(contract, other_frames=False)
    assert problems(strict, run, tmp_path) == {
        ("frames", "other frames of /"): "the contract does not name 1 frame: camera"
    }
    assert problems(contract, run, tmp_path) == {}


def test_findings_break_the_contract_from_a_severity(contract, tmp_path):
    run = Run.healthy(seconds=4)
    run.tf("dock", "charger", START, static=True)
    assert "2 separate trees" in problems(contract, run, tmp_path)["finding", "TF001"]
    for fail_on in (Severity.ERROR, None):
        assert problems(dataclasses.replace(contract, fail_on=fail_on), run, tmp_path) == {}
    accepted = parse_contract(
        contract_yaml(contract).replace("ignore: []", 'ignore: [{code: tf001, reason: "the dock is not connected"}]')
    )
    assert problems(accepted, run, tmp_path) == {}


def test_findings_of_the_good_recording_are_accepted_with_their_text(tmp_path):
    run = Run.healthy(seconds=4)
    run.tf("dock", "charger", START, static=True)
    path = run.write(tmp_path)
    derived = derive_contract(measure_recording(path))
    assert derived.ignore[0].code == "TF001"
    assert derived.ignore[0].reason.startswith("in the good recording: 2 separate trees")
    assert check_recording(derived, path).is_kept


def test_a_share_that_is_just_below_the_minimum_does_not_look_equal_to_it(contract, tmp_path):
    run = Run.healthy(seconds=4)
    required = AvailabilityRequirement("odom", "lidar", "/scan", share=1.0, within=1)
    (problem,) = problems(dataclasses.replace(contract, availability=(required,)), run, tmp_path).values()
    assert "100 % of the messages" not in problem


def test_real_recordings_keep_their_own_contract(shared):
    paths = [path for path in sorted((shared / "recordings").iterdir()) if path.name not in {"broken", "MANIFEST.md"}]
    assert len(paths) >= 5
    for path in paths:
        derived = derive_contract(measure_recording(path))
        verdict = check_recording(parse_contract(contract_yaml(derived)), path)
        assert verdict.is_kept, verdict.text()
