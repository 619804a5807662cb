# SPDX-License-Identifier: Apache-2.0
"""Simulated time from /clock."""

import pytest

from rclpy.clock import ClockChange, JumpThreshold, ROSClock
from rclpy.duration import Duration
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter
from rclpy.time import Time
from rclpy.time_source import TimeSource
from rosgraph_msgs.msg import Clock


@pytest.fixture
def simulation(make_node, wait_until):
    node = make_node(cli_args=["--ros-args", "-p", "use_sim_time:=true"])
    publisher = make_node("simulator").create_publisher(Clock, "/clock", 10)
    executor = SingleThreadedExecutor(context=node.context)
    executor.add_node(node)
    wait_until(lambda: publisher.get_subscription_count() == 1)

    def advance_to(seconds: float) -> None:
        message = Clock(clock=Time(seconds=seconds).to_msg())
        wait_until(
            lambda: node.get_clock().now().nanoseconds == int(seconds * 1e9),
            lambda: (publisher.publish(message), executor.spin_once(timeout_sec=0.05)),
        )

    node.advance_to = advance_to
    node.spin_once = lambda: executor.spin_once(timeout_sec=0.05)
    return node


def test_clock_uses_simulated_time(simulation):
    assert simulation.get_clock().now().nanoseconds == 0
    simulation.advance_to(100.5)
    assert simulation.get_clock().now().seconds_nanoseconds() == (100, 500_000_000)


def test_timers_use_simulated_time(simulation, wait_until):
    calls = []
    simulation.advance_to(100)
    simulation.create_timer(10.0, lambda: calls.append(simulation.get_clock().now().nanoseconds // 10**9))
    simulation.advance_to(109)
    simulation.spin_once()
    assert calls == []
    simulation.advance_to(110)
    wait_until(lambda: calls, simulation.spin_once)
    assert calls == [110]
    simulation.advance_to(5)  # The simulation was restarted.
    simulation.advance_to(16)
    wait_until(lambda: len(calls) == 2, simulation.spin_once)


def test_disabling_simulated_time_is_a_jump(simulation):
    jumps = []
    simulation.advance_to(100)
    simulation.get_clock().create_jump_callback(
        JumpThreshold(min_forward=None, min_backward=Duration(seconds=-1)), post_callback=jumps.append
    )
    simulation.advance_to(50)
    assert jumps[-1].delta == Duration(seconds=-50)
    assert simulation.set_parameters([Parameter("use_sim_time", value=False)])[0].successful
    assert jumps[-1].clock_change is ClockChange.ROS_TIME_DEACTIVATED
    assert simulation.get_clock().now().nanoseconds > 10**18


def test_time_sources_of_the_user_follow_the_parameter_of_their_node(simulation, make_node, wait_until):
    clock, late = ROSClock(), ROSClock()
    source = TimeSource(node=simulation)
    source.attach_clock(clock)
    jumps = []
    clock.create_jump_callback(JumpThreshold(min_forward=None, min_backward=None), post_callback=jumps.append)
    assert (source.ros_time_is_active, clock.ros_time_is_active) == (True, True)
    simulation.advance_to(100)
    simulation.advance_to(101)
    wait_until(lambda: clock.now() == simulation.get_clock().now(), simulation.spin_once)
    assert simulation.set_parameters([Parameter("use_sim_time", value=False)])[0].successful
    assert [jump.clock_change for jump in jumps] == [ClockChange.ROS_TIME_DEACTIVATED]
    assert not clock.ros_time_is_active
    assert simulation.set_parameters([Parameter("use_sim_time", value=True)])[0].successful
    assert clock.ros_time_is_active
    source.detach_node()
    assert (clock.ros_time_is_active, simulation.get_clock().ros_time_is_active) == (False, True)
    without_node = TimeSource()
    without_node.attach_clock(late)
    assert not late.ros_time_is_active
    without_node.attach_node(make_node("other", parameter_overrides=[Parameter("use_sim_time", value=True)]))
    assert late.ros_time_is_active
