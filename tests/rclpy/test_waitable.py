# SPDX-License-Identifier: Apache-2.0
"""Waitables of users."""

import pytest

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.guard_condition import GuardCondition
from rclpy.timer import Timer
from rclpy.waitable import NumberOfEntities, Waitable


class Bell(Waitable):
    """A waitable of a guard condition or a timer, as libraries write it."""

    def __init__(self, node, period_ns=None):
        super().__init__(ReentrantCallbackGroup())
        self.guard = GuardCondition(None, self.callback_group, context=node.context)
        self.timer = (
            None
            if period_ns is None
            else Timer(None, self.callback_group, period_ns, node.get_clock(), context=node.context)
        )
        self.rung = 0
        self.is_rung = False

    def is_ready(self, wait_set):
        kind = "guard_condition" if self.timer is None else "timer"
        self.is_rung = wait_set.is_ready(kind, self.index)
        return self.is_rung

    def take_data(self):
        return "ring" if self.is_rung else None

    async def execute(self, taken_data):
        assert taken_data == "ring"
        self.rung += 1

    def get_num_entities(self):
        return NumberOfEntities(num_gcs=1) if self.timer is None else NumberOfEntities(num_timers=1)

    def add_to_wait_set(self, wait_set):
        if self.timer is None:
            self.index = wait_set.add_guard_condition(self.guard)
        else:
            self.index = wait_set.add_timer(self.timer)


@pytest.mark.parametrize("executor_type", [SingleThreadedExecutor, MultiThreadedExecutor])
def test_a_waitable_runs_once_for_each_trigger(context, node, wait_until, executor_type):
    bell, executor = Bell(node), executor_type(context=context)
    node.add_waitable(bell)
    assert list(node.waitables) == [bell]
    executor.add_node(node)
    executor.spin_once(timeout_sec=0)
    assert bell.rung == 0
    bell.guard.trigger()
    wait_until(lambda: bell.rung == 1, lambda: executor.spin_once(timeout_sec=0.1))
    executor.spin_once(timeout_sec=0)
    assert bell.rung == 1
    node.remove_waitable(bell)
    bell.guard.trigger()
    executor.spin_once(timeout_sec=0)
    assert bell.rung == 1
    with pytest.raises(ValueError, match="not in list"):
        node.remove_waitable(bell)
    executor.shutdown()


def test_a_waitable_with_a_timer_ends_the_wait(context, node):
    bell = Bell(node, period_ns=20_000_000)
    node.add_waitable(bell)
    executor = SingleThreadedExecutor(context=context)
    for _ in range(3):
        rclpy.spin_once(node, executor=executor, timeout_sec=5)
    assert bell.rung == 3


def test_numbers_of_entities_add_up():
    total = NumberOfEntities(1, 2, 3, 4, 5, 6) + NumberOfEntities(num_timers=1)
    assert repr(total) == "NumberOfEntities(1, 2, 4, 4, 5, 6)"
    total += NumberOfEntities(num_subs=1)
    assert total.num_subscriptions == 2
