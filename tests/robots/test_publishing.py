"""What robot_state_publisher would send: which joints, when, and again when."""

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


def test_fixed_joints_are_told_apart(robot):
    (fixed,) = StatePublisher(robot).fixed()
    assert (fixed.target, fixed.source) == ("c", "d")


def test_joints_of_the_state_and_their_followers_are_told(robot):
    told = StatePublisher(robot).moving(SECOND, ["turn", "unknown", "stay", "free"], [0.5, 1, 2, 3])
    assert {transform.source: transform.rpy[0] for transform in told} == pytest.approx({"a": 0.5, "b": 1.0, "c": 1.0})
    assert StatePublisher(robot).moving(SECOND, ["unknown"], [1.0]) == []
    (alone,) = StatePublisher(robot).moving(SECOND, ["far"], [0.25])
    assert (alone.target, alone.source) == ("a", "b")


def test_joints_are_not_told_of_too_often(robot):
    publisher = StatePublisher(robot, 20.0)
    told = [bool(publisher.moving(SECOND + i * 10_000_000, ["turn"], [0.1])) for i in range(11)]
    assert told == [i % 5 == 0 for i in range(11)]
    assert publisher.moving(SECOND + 101_000_000, ["turn", "far"], [0.1, 0.2])  # one of them was not told of yet
    publisher.ignore_stamps = True
    assert publisher.moving(SECOND + 101_000_001, ["turn"], [0.1])


def test_joints_of_another_robot_count_for_nothing(robot):
    publisher = StatePublisher(robot, 20.0)
    told = [bool(publisher.moving(SECOND + i * 10_000_000, ["turn", f"other{i}"], [0.1, 0.1])) for i in range(11)]
    assert told == [i % 5 == 0 for i in range(11)]


def test_a_clock_that_was_set_back_begins_anew(robot):
    publisher = StatePublisher(robot)
    assert not publisher.turned_back(5 * SECOND)
    assert publisher.moving(5 * SECOND, ["turn"], [0.1])
    assert not publisher.moving(SECOND, ["turn"], [0.1])
    assert publisher.turned_back(SECOND)
    assert publisher.moving(SECOND, ["turn"], [0.1])


def test_a_frequency_of_zero_tells_once(robot):
    publisher = StatePublisher(robot, 0.0)
    assert [bool(publisher.moving(i * SECOND, ["turn"], [0.1])) for i in (1, 100)] == [True, False]


def test_positions_that_are_no_numbers_are_refused(robot):
    with pytest.raises(ValueError, match="not finite"):
        StatePublisher(robot).moving(SECOND, ["turn"], [float("nan")])
