# SPDX-License-Identifier: Apache-2.0
"""Clocks, time jumps and sleeping."""

import threading
import time

import pytest

from rclpy.clock import Clock, ClockChange, ClockType, JumpThreshold, ROSClock
from rclpy.context import Context
from rclpy.duration import Duration
from rclpy.exceptions import NotInitializedException
from rclpy.time import Time

ANY_JUMP = JumpThreshold(min_forward=Duration(seconds=1), min_backward=Duration(seconds=-1))


@pytest.fixture
def plain_context():
    context = Context()
    context.init([])
    yield context
    context.try_shutdown()


def test_clock_types():
    assert Clock().clock_type is ClockType.SYSTEM_TIME
    assert isinstance(Clock(clock_type=ClockType.ROS_TIME), ROSClock)
    assert repr(Clock(clock_type=ClockType.STEADY_TIME)) == "Clock(clock_type=STEADY_TIME)"
    with pytest.raises(TypeError, match="Clock type must be a ClockType enum"):
        Clock(clock_type="wall")


def test_now_returns_the_time_of_the_clock_type():
    assert abs(Clock().now().nanoseconds - time.time_ns()) < 10**9
    steady = Clock(clock_type=ClockType.STEADY_TIME)
    first = steady.now()
    assert first.clock_type is ClockType.STEADY_TIME
    assert steady.now() >= first


def test_ros_time_is_system_time_until_it_is_simulated():
    clock = ROSClock()
    assert abs(clock.now().nanoseconds - time.time_ns()) < 10**9
    clock.set_ros_time_override(Time(seconds=42, clock_type=ClockType.ROS_TIME))
    assert not clock.ros_time_is_active
    clock._set_ros_time_is_active(True)
    assert clock.now() == Time(seconds=42, clock_type=ClockType.ROS_TIME)


def test_jump_callbacks_respect_their_thresholds():
    clock = ROSClock()
    calls = []
    handle = clock.create_jump_callback(
        ANY_JUMP, pre_callback=lambda: calls.append("before"), post_callback=calls.append
    )
    clock._set_ros_time_is_active(True)
    assert calls.pop().clock_change is ClockChange.ROS_TIME_ACTIVATED
    for seconds in (10, 10.5, 9, 8.5):
        clock.set_ros_time_override(Time(seconds=seconds, clock_type=ClockType.ROS_TIME))
    assert [jump.delta for jump in calls if jump != "before"] == [Duration(seconds=10), Duration(seconds=-1.5)]
    calls.clear()
    handle.unregister()
    handle.unregister()
    clock.set_ros_time_override(Time(seconds=100, clock_type=ClockType.ROS_TIME))
    assert calls == []


def test_invalid_thresholds():
    with pytest.raises(ValueError, match="min_forward must be a positive non-zero duration"):
        JumpThreshold(min_forward=Duration(seconds=-1), min_backward=None)
    with pytest.raises(ValueError, match="min_backward must be a negative non-zero duration"):
        JumpThreshold(min_forward=None, min_backward=Duration(seconds=1))
    with pytest.raises(ValueError, match="At least one jump threshold must be enabled"):
        JumpThreshold(min_forward=None, min_backward=None, on_clock_change=False)
    with pytest.raises(ValueError, match="One of pre_callback or post_callback must be callable"):
        Clock().create_jump_callback(ANY_JUMP)


def test_sleep_duration(plain_context):
    start = time.monotonic()
    assert Clock().sleep_for(Duration(seconds=0.05), context=plain_context)
    assert time.monotonic() - start >= 0.05


def test_sleep_requires_a_valid_context_and_a_matching_clock_type(plain_context):
    with pytest.raises(ValueError, match="until's clock type does not match this clock's type"):
        Clock().sleep_until(Time(clock_type=ClockType.STEADY_TIME), context=plain_context)
    plain_context.shutdown()
    with pytest.raises(NotInitializedException):
        Clock().sleep_for(Duration(seconds=1), context=plain_context)


def test_shutdown_ends_a_sleep(plain_context):
    results = []
    thread = threading.Thread(
        target=lambda: results.append(Clock().sleep_for(Duration(seconds=60), context=plain_context))
    )
    thread.start()
    plain_context.shutdown()
    thread.join(10)
    assert results == [False]


def test_simulated_sleep_follows_the_simulation(plain_context, wait_until):
    clock = ROSClock()
    clock._set_ros_time_is_active(True)
    results = []
    thread = threading.Thread(
        target=lambda: results.append(clock.sleep_for(Duration(seconds=3600), context=plain_context))
    )
    thread.start()
    seconds = iter(range(0, 100_000, 600))
    wait_until(
        lambda: results,
        lambda: (
            clock.set_ros_time_override(Time(seconds=next(seconds), clock_type=ClockType.ROS_TIME)),
            thread.join(0.01),
        ),
    )
    assert results == [True]


def test_change_of_the_time_source_ends_a_sleep(plain_context, wait_until):
    clock = ROSClock()
    results = []
    thread = threading.Thread(
        target=lambda: results.append(clock.sleep_for(Duration(seconds=60), context=plain_context))
    )
    thread.start()
    wait_until(lambda: clock._Coframe__jump_handles)
    clock._set_ros_time_is_active(True)
    thread.join(10)
    assert results == [False]
