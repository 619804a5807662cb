# SPDX-License-Identifier: Apache-2.0
"""Time and Duration: values, arithmetic and comparisons."""

import enum
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest

import builtin_interfaces.msg
from rclpy.clock import ClockType
from rclpy.duration import Duration, Infinite
from rclpy.time import Time


def test_seconds_and_nanoseconds_are_added():
    assert Time(seconds=1.5, nanoseconds=7).nanoseconds == 1_500_000_007
    assert Time(seconds=3, nanoseconds=4).seconds_nanoseconds() == (3, 4)
    assert Duration(seconds=-1, nanoseconds=1).nanoseconds == -999_999_999


class Seconds(enum.IntEnum):
    THREE = 3


SMALL = [Seconds.THREE, np.int8(3), np.uint8(3), np.int32(3), np.float16(3), np.float32(3)]


@pytest.mark.parametrize("three", [*SMALL, np.uint64(3), np.array(3), Decimal(3), Fraction(3)])
def test_numbers_of_any_type(three):
    """The product of an int32 and 1e9 would not fit into 32 bits."""
    assert Duration(seconds=three, nanoseconds=three).nanoseconds == 3_000_000_003
    assert Time(seconds=three, nanoseconds=three).nanoseconds == 3_000_000_003


@pytest.mark.parametrize("value", ["5", b"5", [5], (5,), bytearray(1), np.str_("5"), np.datetime64("2026-01-01")])
@pytest.mark.parametrize("kind", [Time, Duration])
def test_values_that_are_not_numbers(kind, value):
    """A list would otherwise be repeated a billion times."""
    for argument in ("seconds", "nanoseconds"):
        with pytest.raises(TypeError, match="Expected a number, got"):
            kind(**{argument: value})


def test_default_clock_type_is_system_time():
    assert Time().clock_type is ClockType.SYSTEM_TIME
    assert repr(Time(seconds=1)) == "Time(nanoseconds=1000000000, clock_type=SYSTEM_TIME)"


@pytest.mark.parametrize(
    ("arguments", "error", "text"),
    [
        ({"seconds": -1}, ValueError, "Seconds value must not be negative"),
        ({"nanoseconds": -1}, ValueError, "Nanoseconds value must not be negative"),
        ({"clock_type": "steady"}, TypeError, "Clock type must be a ClockType enum"),
        ({"nanoseconds": 2**63}, OverflowError, "Total nanoseconds value is too large to store in C time point."),
    ],
)
def test_invalid_times_are_rejected(arguments, error, text):
    with pytest.raises(error, match=text):
        Time(**arguments)


def test_too_long_durations_are_rejected():
    with pytest.raises(OverflowError, match="too large to store in C duration"):
        Duration(nanoseconds=2**63)
    assert str(Infinite) == "Infinite"
    assert str(Duration(nanoseconds=5)) == "5 nanoseconds"


def test_arithmetic_of_time_and_duration():
    later = Time(seconds=5, clock_type=ClockType.STEADY_TIME) + Duration(seconds=1)
    assert later == Time(seconds=6, clock_type=ClockType.STEADY_TIME)
    assert Duration(seconds=1) + Time(seconds=1) == Time(seconds=2)
    assert Time(seconds=3) - Time(seconds=5) == Duration(seconds=-2)
    assert Time(seconds=3) - Duration(seconds=1) == Time(seconds=2)


def test_arithmetic_errors():
    with pytest.raises(ValueError, match="Subtraction leads to negative time"):
        Time(seconds=1) - Duration(seconds=2)
    with pytest.raises(OverflowError, match="Addition leads to overflow in C storage"):
        Time(nanoseconds=2**63 - 1) + Duration(nanoseconds=1)
    with pytest.raises(TypeError, match="Can't subtract times with different clock types"):
        Time(seconds=1) - Time(clock_type=ClockType.ROS_TIME)
    with pytest.raises(TypeError):
        Time() + 5
    with pytest.raises(TypeError):
        Time() - 5


def test_comparison_with_other_types():
    with pytest.raises(TypeError, match="Can't compare times with different clock types"):
        assert Time() == Time(clock_type=ClockType.ROS_TIME)
    with pytest.raises(TypeError, match="Can't compare times with different clock types"):
        assert Time() < Time(clock_type=ClockType.ROS_TIME)
    assert Time() != 5
    assert Duration() != 0.1
    assert Time() != None  # noqa: E711 - programs compare with == None
    with pytest.raises(TypeError):
        assert Duration() < 1


def test_order():
    assert Time(seconds=1) < Time(seconds=2) <= Time(seconds=2)
    assert Time(seconds=2) > Time(seconds=1) >= Time(seconds=1)
    assert Duration(seconds=1) < Duration(seconds=2) <= Duration(seconds=2)
    assert Duration(seconds=2) > Duration(seconds=1) >= Duration(seconds=1)


def test_conversion_to_and_from_messages():
    message = Time(nanoseconds=1_700_000_000_123_456_789).to_msg()
    assert (message.sec, message.nanosec) == (1_700_000_000, 123_456_789)
    assert Time.from_msg(message) == Time(nanoseconds=1_700_000_000_123_456_789, clock_type=ClockType.ROS_TIME)
    for nanoseconds in (0, -1, 1_500_000_000, -1_500_000_000):
        assert Duration.from_msg(Duration(nanoseconds=nanoseconds).to_msg()) == Duration(nanoseconds=nanoseconds)


def test_conversion_rejects_other_messages():
    with pytest.raises(TypeError, match=r"Must pass a builtin_interfaces.msg.Time object"):
        Time.from_msg(builtin_interfaces.msg.Duration())
    with pytest.raises(TypeError, match=r"Must pass a builtin_interfaces.msg.Duration object"):
        Duration.from_msg(builtin_interfaces.msg.Time())


def test_comparison_with_other_types_raises_up_to_humble(monkeypatch):
    monkeypatch.setattr("rclpy.time.since", lambda _: False)
    monkeypatch.setattr("rclpy.duration.since", lambda _: False)
    with pytest.raises(TypeError, match="Can't compare time with object of type"):
        assert Time() != 5
    with pytest.raises(TypeError, match="Can't compare duration with object of type"):
        assert Duration() == 0.1


def test_durations_are_added_subtracted_and_multiplied():
    second = Duration(seconds=1)
    assert second + Duration(nanoseconds=5) == Duration(seconds=1, nanoseconds=5)
    assert Duration(nanoseconds=5) - second == Duration(nanoseconds=5 - 10**9)
    assert (second * 3, second * 0.5) == (Duration(seconds=3), Duration(seconds=0.5))
    assert str(second * float("inf")) == "Infinite"
    with pytest.raises(ValueError, match="Can't multiply duration with nan"):
        second * float("nan")
    with pytest.raises(TypeError):
        second + 1
    with pytest.raises(OverflowError):
        Duration(nanoseconds=2**62) * 2
