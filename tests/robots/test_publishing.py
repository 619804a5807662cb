# SPDX-License-Identifier: Apache-2.0
"""The transforms that robot_state_publisher would publish, and their rate."""

import pytest

from coframe.robots import parse_urdf
from coframe.robots.publishing import StatePublisher

SECOND = 1_000_000_000
LINKS = ["base", "a", "b", "c", "d", "e"]


def joint(name, kind, parent, child, inside=""):
    return f"<joint name='{name}' type='{kind}'><parent link='{parent}'/><child link='{child}'/>{inside}</joint>"


@pytest.fixture
def robot():
    joints = [
        joint("turn", "continuous", "base", "a"),
        joint("far", "continuous", "a", "b", "<mimic joint='near'/>"),
        joint("near", "continuous", "b", "c", "<mimic joint='turn' multiplier='2'/>"),
        joint("stay", "fixed", "c", "d"),
        joint("free", "floating", "base", "e"),
    ]
    return parse_urdf(f"<robot name='r'>{''.join(f'<link name={name!r}/>' for name in LINKS)}{''.join(joints)}</robot>")


def test_fixed_joints_are_separate(robot):
    (fixed,) = StatePublisher(robot).fixed()
    assert (fixed.target, fixed.source) == ("c", "d")


def test_planar_joints_are_published_as_fixed_ones_and_floating_joints_are_not_published():
    joints = joint("slide", "planar", "a", "b", "<origin xyz='1 2 3'/>") + joint("fly", "floating", "b", "c")
    robot = parse_urdf(f"<robot name='r'><link name='a'/><link name='b'/><link name='c'/>{joints}</robot>")
    publisher = StatePublisher(robot)
    (fixed,) = publisher.fixed()
    assert (fixed.target, fixed.source, fixed.translation.tolist()) == ("a", "b", [1, 2, 3])
    assert publisher.moving(SECOND, ["slide", "fly"], [0.5, 0.5]) == []


def test_joints_of_the_state_and_their_mimic_joints_are_published(robot):
    published = StatePublisher(robot).moving(SECOND, ["turn", "unknown", "stay", "free"], [0.5, 1, 2, 3])
    assert {transform.source: transform.rpy[0] for transform in published} == pytest.approx(
        {"a": 0.5, "b": 1.0, "c": 1.0}
    )
    assert StatePublisher(robot).moving(SECOND, ["unknown"], [1.0]) == []
    (alone,) = StatePublisher(robot).moving(SECOND, ["far"], [0.25])
    assert (alone.target, alone.source) == ("a", "b")


def test_the_frequency_limits_the_rate_of_a_joint(robot):
    publisher = StatePublisher(robot, 20.0)
    published = [bool(publisher.moving(SECOND + i * 10_000_000, ["turn"], [0.1])) for i in range(11)]
    assert published == [i % 5 == 0 for i in range(11)]
    assert publisher.moving(SECOND + 101_000_000, ["turn", "far"], [0.1, 0.2])  # one of them was not published of yet
    publisher.ignore_stamps = True
    assert publisher.moving(SECOND + 101_000_001, ["turn"], [0.1])


def test_unknown_joints_do_not_affect_the_rate(robot):
    publisher = StatePublisher(robot, 20.0)
    published = [bool(publisher.moving(SECOND + i * 10_000_000, ["turn", f"other{i}"], [0.1, 0.1])) for i in range(11)]
    assert published == [i % 5 == 0 for i in range(11)]


def test_a_clock_that_jumps_back_resets_the_rate_limit(robot):
    publisher = StatePublisher(robot)
    assert not publisher.has_jumped_back(5 * SECOND)
    assert publisher.moving(5 * SECOND, ["turn"], [0.1])
    assert not publisher.moving(SECOND, ["turn"], [0.1])
    assert publisher.has_jumped_back(SECOND)
    assert publisher.moving(SECOND, ["turn"], [0.1])


def test_a_frequency_of_zero_publishes_once(robot):
    publisher = StatePublisher(robot, 0.0)
    assert [bool(publisher.moving(i * SECOND, ["turn"], [0.1])) for i in (1, 100)] == [True, False]


def test_positions_that_are_not_finite_raise_an_error(robot):
    with pytest.raises(ValueError, match="not finite"):
        StatePublisher(robot).moving(SECOND, ["turn"], [float("nan")])
