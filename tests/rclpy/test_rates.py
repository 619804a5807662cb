# SPDX-License-Identifier: Apache-2.0
"""What ends `Rate.sleep()`: the end of the period, a destruction, a shutdown, and jumps of simulated time."""

import itertools
import threading

import pytest

from rclpy.exceptions import ROSInterruptException
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter
from rclpy.time import Time
from rosgraph_msgs.msg import Clock

ONCE_A_YEAR = 1e-7  # Hz


class Sleeper:
    """A thread in `rate.sleep()`."""

    def __init__(self, rate):
        self.rate = rate
        self.outcome = None
        self.thread = threading.Thread(target=self._run, daemon=True)
        self.thread.start()

    def _run(self):
        try:
            self.rate.sleep()
            self.outcome = "returned"
        except (RuntimeError, ROSInterruptException) as error:
            self.outcome = type(error).__name__

    def wait(self):
        self.thread.join(10)
        assert not self.thread.is_alive(), "the thread still sleeps"
        return self.outcome


@pytest.fixture
def sleep_in_thread(wait_until):
    def start(node, frequency=ONCE_A_YEAR):
        waiting = len(node.get_clock()._Coframe__jump_handles)
        sleeper = Sleeper(node.create_rate(frequency))
        wait_until(lambda: len(node.get_clock()._Coframe__jump_handles) == waiting + 1)
        return sleeper

    return start


@pytest.fixture
def simulated(make_node):
    node = make_node("simulated", cli_args=["--ros-args", "-p", "use_sim_time:=true"])
    assert node.get_clock().ros_time_is_active
    return node


@pytest.fixture(params=["system time", "paused simulation"])
def any_node(request):
    return request.getfixturevalue("node" if request.param == "system time" else "simulated")


def test_destroy_rate_wakes_all_its_threads(any_node, sleep_in_thread, wait_until):
    first = sleep_in_thread(any_node)
    second = Sleeper(first.rate)
    wait_until(lambda: len(any_node.get_clock()._Coframe__jump_handles) == 2)
    other = sleep_in_thread(any_node)
    assert any_node.destroy_rate(first.rate)
    assert (first.wait(), second.wait()) == ("returned", "returned")
    assert other.thread.is_alive()
    with pytest.raises(RuntimeError, match="Rate cannot sleep because it has been destroyed"):
        first.rate.sleep()
    assert any_node.destroy_rate(other.rate)
    assert other.wait() == "returned"


def test_destroy_rate_in_a_callback(any_node, sleep_in_thread, context):
    sleeper = sleep_in_thread(any_node)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(any_node)
    guard = any_node.create_guard_condition(lambda: any_node.destroy_rate(sleeper.rate))
    guard.trigger()
    while sleeper.thread.is_alive():
        executor.spin_once(timeout_sec=0.1)
    assert sleeper.wait() == "returned"


def test_the_end_of_the_timer_or_of_the_node_interrupts_the_sleep(any_node, sleep_in_thread):
    sleeper, other = sleep_in_thread(any_node), sleep_in_thread(any_node)
    first, _ = any_node.timers
    assert any_node.destroy_timer(first)
    assert sleeper.wait() == "ROSInterruptException"
    any_node.destroy_node()
    assert other.wait() == "ROSInterruptException"


@pytest.mark.parametrize("spins", [True, False])
def test_shutdown_interrupts_the_sleep(any_node, sleep_in_thread, context, spins):
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(any_node)
    sleeper = sleep_in_thread(any_node)
    spinning = threading.Thread(target=executor.spin if spins else lambda: None)
    spinning.start()
    executor.shutdown()  # The rate does not need the executor.
    assert sleeper.thread.is_alive()
    context.shutdown()
    assert sleeper.wait() == "ROSInterruptException"
    spinning.join()


def test_jumps_of_simulated_time(simulated, sleep_in_thread, wait_until):
    """The clock is set as /clock does it, without an executor that could end the period."""
    clock = simulated.get_clock()

    def set_clock(seconds):
        clock.set_ros_time_override(Time(seconds=seconds))

    set_clock(1000)
    forward = sleep_in_thread(simulated, 0.1)
    set_clock(1009)
    assert forward.thread.is_alive()
    set_clock(5000)
    assert forward.wait() == "returned"
    # After a jump back, a period starts again, so that a restarted simulation does not stop the loop.
    back = sleep_in_thread(simulated, 0.1)
    seconds = itertools.count(5)
    wait_until(lambda: not back.thread.is_alive(), lambda: set_clock(next(seconds)))
    assert next(seconds) > 15
    assert back.wait() == "returned"


def test_the_end_of_simulated_time_restarts_the_period(simulated, sleep_in_thread):
    sleeper = sleep_in_thread(simulated, 20)
    assert simulated.set_parameters([Parameter("use_sim_time", value=False)])[0].successful
    assert sleeper.wait() == "returned"


def test_a_rate_follows_the_clock_topic_after_a_restart_of_the_simulation(
    simulated, make_node, sleep_in_thread, wait_until, context
):
    publisher = make_node("simulator").create_publisher(Clock, "/clock", 10)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(simulated)
    wait_until(lambda: publisher.get_subscription_count() == 1)
    time = iter(range(1, 10_000))

    def simulate():
        publisher.publish(Clock(clock=Time(seconds=next(time)).to_msg()))
        executor.spin_once(timeout_sec=0.01)

    wait_until(lambda: simulated.get_clock().now().nanoseconds > 0, simulate)
    simulated.get_clock().set_ros_time_override(Time(seconds=10**6))
    sleeper = sleep_in_thread(simulated, 0.2)
    wait_until(lambda: not sleeper.thread.is_alive(), simulate)
    assert sleeper.wait() == "returned"
