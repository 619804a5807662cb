# SPDX-License-Identifier: Apache-2.0
"""How contexts, executors and nodes end, and start again."""

import signal

import pytest

import rclpy
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.exceptions import InvalidHandle
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.task import Future


@pytest.fixture
def _default_context(domain_id):
    yield domain_id
    rclpy.try_shutdown()


@pytest.mark.usefixtures("_default_context")
def test_the_default_context_starts_again_after_each_kind_of_end():
    for end in (rclpy.shutdown, rclpy.try_shutdown, _interrupt_and_shut_down, _interrupt_and_try_to_shut_down):
        rclpy.init(args=[])
        node = rclpy.create_node("again")
        rclpy.spin_once(node, timeout_sec=0.0)
        end()
        assert not rclpy.ok()
        node.destroy_node()
    rclpy.init(args=[])
    assert rclpy.ok()


def _interrupt_and_shut_down():
    with pytest.raises(KeyboardInterrupt):
        signal.raise_signal(signal.SIGINT)
    rclpy.shutdown()


def _interrupt_and_try_to_shut_down():
    with pytest.raises(KeyboardInterrupt):
        signal.raise_signal(signal.SIGINT)
    rclpy.try_shutdown()


@pytest.mark.parametrize("error", [SystemExit(3), KeyboardInterrupt(), GeneratorExit(), ValueError("wrong")])
@pytest.mark.parametrize("kind", [SingleThreadedExecutor, MultiThreadedExecutor])
def test_any_exception_of_a_callback_ends_the_spinning(context, node, error, kind):
    def fail():
        raise error

    executor = kind(context=context)
    executor.add_node(node)
    node.create_timer(0.001, fail)
    with pytest.raises(type(error)) as caught:
        executor.spin()
    assert caught.value is error
    executor.shutdown()


def test_spinning_inside_a_callback_gives_the_node_back(context, node, wait_until):
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    inner, calls = SingleThreadedExecutor(context=context), []

    def spin_inside():
        calls.append(node.executor)
        if len(calls) == 1:
            future = Future()
            group = ReentrantCallbackGroup()  # The default group waits for the end of this callback.
            timer = node.create_timer(0.001, lambda: future.done() or future.set_result(None), group)
            rclpy.spin_until_future_complete(node, future, inner, timeout_sec=10)
            assert future.done()
            node.destroy_timer(timer)

    node.create_timer(0.001, spin_inside)
    wait_until(lambda: len(calls) > 2, lambda: executor.spin_once(timeout_sec=0.1))
    assert set(calls) == {executor}
    assert inner.get_nodes() == []


def test_a_node_in_no_executor_is_in_none_afterwards(context, node):
    executor = SingleThreadedExecutor(context=context)
    rclpy.spin_once(node, executor=executor, timeout_sec=0.0)
    assert node.executor is None


def test_the_names_of_a_destroyed_node_raise(make_node):
    node = make_node("gone", namespace="/a")
    node.destroy_node()
    for name in (node.get_name, node.get_namespace, node.get_fully_qualified_name):
        with pytest.raises(InvalidHandle) as caught:
            name()
        assert caught.value.hint == "The node /a/gone was destroyed before."
    assert repr(node) == "<Node /a/gone>"
    node.get_logger().debug("still there")
