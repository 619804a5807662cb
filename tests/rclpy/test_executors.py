# SPDX-License-Identifier: Apache-2.0
"""Executors: timers, guard conditions, coroutines, callback groups and threads."""

import contextlib
import threading
import time

import numpy as np
import pytest

import rclpy
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.context import Context
from rclpy.executors import (
    Executor,
    ExternalShutdownException,
    MultiThreadedExecutor,
    ShutdownException,
    SingleThreadedExecutor,
    TimeoutException,
)
from rclpy.experimental import EventsExecutor
from rclpy.task import Future
from std_msgs.msg import String


@pytest.fixture
def executor(node):
    executor = SingleThreadedExecutor(context=node.context)
    executor.add_node(node)
    yield executor
    executor.shutdown()


@pytest.fixture
def pool(node):
    executor = MultiThreadedExecutor(3, context=node.context)
    executor.add_node(node)
    yield executor
    executor.shutdown(timeout_sec=10)


@pytest.fixture
def spinning(pool):
    thread = threading.Thread(target=pool.spin)
    thread.start()
    yield pool
    pool.shutdown(timeout_sec=10)
    thread.join(10)
    assert not thread.is_alive()


def test_timer_keeps_its_period(node, executor):
    stamps = []
    node.create_timer(0.02, lambda: stamps.append(time.monotonic()))
    while len(stamps) < 11:
        executor.spin_once(timeout_sec=1)
    assert 0.19 < stamps[-1] - stamps[0] < 0.4


def test_timer_can_be_stopped_and_started(node, executor):
    calls = []
    timer = node.create_timer(0.01, lambda: calls.append(1))
    timer.cancel()
    assert timer.is_canceled()
    assert timer.time_until_next_call() is None
    executor.spin_once(timeout_sec=0.05)
    assert calls == []
    timer.reset()
    executor.spin_once(timeout_sec=1)
    assert calls == [1]
    assert timer.time_since_last_call() < 10**9
    timer.timer_period_ns = 50_000_000
    assert timer.timer_period_ns == 50_000_000
    assert node.destroy_timer(timer)


def test_missed_periods_are_skipped(node, executor):
    timer = node.create_timer(0.01, lambda: None)
    time.sleep(0.1)
    executor.spin_once(timeout_sec=1)
    assert 0 < timer.time_until_next_call() <= 10_000_000


def test_spin_once_times_out(executor):
    start = time.monotonic()
    executor.spin_once(timeout_sec=0.05)
    assert 0.05 <= time.monotonic() - start < 2
    executor.spin_once(timeout_sec=0)


def test_wait_for_ready_callbacks(executor, node):
    with pytest.raises(TimeoutException):
        executor.wait_for_ready_callbacks(timeout_sec=0)
    guard = node.create_guard_condition(lambda: None)
    guard.trigger()
    task, entity, owner = executor.wait_for_ready_callbacks(timeout_sec=1)
    assert (entity, owner) == (guard, node)
    task()


def test_guard_conditions_wake_from_other_threads(node, executor):
    calls = []
    guard = node.create_guard_condition(lambda: calls.append(1))
    thread = threading.Thread(target=guard.trigger)
    thread.start()
    executor.spin_once(timeout_sec=10)
    thread.join()
    assert calls == [1]
    executor.spin_once(timeout_sec=0)
    assert calls == [1]


def test_all_ready_callbacks_run(node, executor):
    calls = []
    node.create_timer(0.0, lambda: calls.append("timer"))
    guard = node.create_guard_condition(lambda: calls.append("guard"))
    guard.trigger()
    for _ in range(4):
        executor.spin_once(timeout_sec=1)
    assert "guard" in calls


def test_spin_raises_exceptions_of_callbacks(node, executor):
    node.create_timer(0.0, lambda: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        executor.spin_once(timeout_sec=1)


def test_tasks(executor):
    task = executor.create_task(lambda a, b: a + b, 1, b=2)
    executor.spin_until_future_complete(task, timeout_sec=10)
    assert task.result() == 3


def test_done_callbacks_run_in_the_executor(executor):
    future, threads = Future(executor=executor), []
    future.add_done_callback(lambda _: threads.append(threading.current_thread()))
    thread = threading.Thread(target=lambda: future.set_result(1))
    thread.start()
    thread.join()
    assert threads == []
    executor.spin_once(timeout_sec=10)
    assert threads == [threading.current_thread()]


def test_awaiting_coroutines_use_no_processor_time(node, executor):
    future, results = Future(), []

    async def wait():
        results.append(await future)

    node.create_timer(0.01, lambda: None)
    task = executor.create_task(wait)
    start = time.process_time()
    end = time.monotonic() + 0.3
    while time.monotonic() < end:
        executor.spin_once(timeout_sec=0.1)
    assert time.process_time() - start < 0.2
    assert results == []
    future.set_result("there")
    executor.spin_until_future_complete(task, timeout_sec=10)
    assert results == ["there"]


def test_polling_coroutines_do_not_starve_others(node, executor):
    class YieldOnce:
        def __await__(self):
            yield

    calls = []

    async def poll():
        while not calls:
            await YieldOnce()

    task = executor.create_task(poll)
    node.create_timer(0.02, lambda: calls.append(1))
    executor.spin_until_future_complete(task, timeout_sec=10)
    assert task.done()


def test_shutdown_during_a_callback_ends_the_spin(node, executor):
    publisher = node.create_publisher(String, "a", 10)

    def work():
        node.context.shutdown()
        publisher.publish(String())

    node.create_guard_condition(work).trigger()
    executor.spin()
    assert not node.context.ok()


def test_timers_continue_after_a_ready_entity_is_destroyed(node, executor):
    calls = []
    gone = node.create_guard_condition(lambda: None)
    first = node.create_guard_condition(lambda: node.destroy_guard_condition(gone))
    node.destroy_guard_condition(gone)
    gone = node.create_guard_condition(lambda: None)
    first.trigger()
    gone.trigger()
    node.create_timer(0.05, lambda: calls.append(1))
    while not calls:
        executor.spin_once(timeout_sec=10)
    assert calls == [1]


def test_suspended_coroutine_callbacks_reserve_their_group(node, executor, wait_until):
    future, calls = Future(), []

    async def slow():
        calls.append("begin")
        await future
        calls.append("end")

    first = node.create_guard_condition(slow)
    second = node.create_guard_condition(lambda: calls.append("second"))
    first.trigger()
    executor.spin_once(timeout_sec=1)
    second.trigger()
    executor.spin_once(timeout_sec=0)
    assert calls == ["begin"]
    future.set_result(None)
    wait_until(lambda: len(calls) == 3, lambda: executor.spin_once(timeout_sec=0.1))
    assert calls == ["begin", "end", "second"]


def test_spin_until_future_complete_times_out(executor):
    future = Future()
    executor.spin_until_future_complete(future, timeout_sec=0.01)
    assert not future.done()


def test_future_set_in_another_thread_wakes_the_executor(executor):
    future = Future()
    timer = threading.Timer(0.05, lambda: future.set_result(1))
    timer.start()
    executor.spin_until_future_complete(future, timeout_sec=10)
    assert future.done()
    timer.join()


def test_node_belongs_to_one_executor(node, executor):
    other = SingleThreadedExecutor(context=node.context)
    assert node.executor is executor
    assert not executor.add_node(node)
    assert other.add_node(node)
    assert node.executor is other
    assert executor.get_nodes() == []
    other.remove_node(node)
    assert node.executor is None
    node.executor = executor
    assert executor.get_nodes() == [node]


def test_node_of_another_context_is_rejected(node):
    with Context() as other, pytest.raises(RuntimeError, match="different contexts"):
        SingleThreadedExecutor(context=other).add_node(node)


def test_shutdown_of_the_context_ends_spins(node, executor):
    threads = [threading.Thread(target=executor.spin), threading.Thread(target=node.context.shutdown)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(10)
        assert not thread.is_alive()
    with pytest.raises(ExternalShutdownException):
        executor.spin_once()
    executor.spin()


def test_shutdown_of_the_executor(node):
    executor = SingleThreadedExecutor(context=node.context)
    executor.add_node(node)
    thread = threading.Thread(target=executor.spin)
    thread.start()
    assert executor.shutdown(timeout_sec=10)
    thread.join(10)
    assert not thread.is_alive()
    with pytest.raises(ShutdownException):
        executor.wait_for_ready_callbacks()


def test_many_executors_of_one_context(make_node, wait_until):
    nodes = [make_node(f"n{i}") for i in range(3)]
    counts = [0, 0, 0]
    threads = []
    for index, node in enumerate(nodes):
        executor = SingleThreadedExecutor(context=node.context)
        executor.add_node(node)

        def count(index=index):
            counts[index] += 1

        node.create_timer(0.01, count)
        threads.append(threading.Thread(target=executor.spin))
        threads[-1].start()
    wait_until(lambda: min(counts) >= 10)
    nodes[0].context.shutdown()
    for thread in threads:
        thread.join(10)
        assert not thread.is_alive()


@pytest.mark.usefixtures("spinning")
def test_groups_run_in_parallel(node):
    barrier = threading.Barrier(2, timeout=10)
    passed = threading.Semaphore(0)

    def meet():
        barrier.wait()
        passed.release()

    for _ in range(2):
        node.create_guard_condition(meet, MutuallyExclusiveCallbackGroup()).trigger()
    assert passed.acquire(timeout=10)
    assert passed.acquire(timeout=10)


@pytest.mark.usefixtures("spinning")
def test_reentrant_callbacks_overlap(node):
    barrier = threading.Barrier(2, timeout=10)
    passed = threading.Semaphore(0)

    def meet():
        with contextlib.suppress(threading.BrokenBarrierError):
            barrier.wait()
            passed.release()

    node.create_timer(0.01, meet, ReentrantCallbackGroup())
    assert passed.acquire(timeout=10)
    barrier.abort()


@pytest.mark.usefixtures("spinning")
def test_mutually_exclusive_callbacks_do_not_overlap(node, wait_until):
    active, overlaps, calls = [], [], []

    def work():
        active.append(1)
        overlaps.append(len(active) > 1)
        time.sleep(0.005)
        active.pop()
        calls.append(1)

    for _ in range(3):
        node.create_timer(0.001, work)
    wait_until(lambda: len(calls) > 20)
    assert not any(overlaps)


@pytest.mark.usefixtures("spinning")
def test_entity_that_is_always_ready_does_not_starve_its_group(node, wait_until):
    calls = []
    node.create_timer(0.0, lambda: time.sleep(0.001))
    guard = node.create_guard_condition(lambda: calls.append(1))
    for count in (1, 2, 3):
        guard.trigger()
        wait_until(lambda count=count: len(calls) == count)


def test_spin_raises_exceptions_of_pool_threads(node, pool):
    node.create_timer(0.0, lambda: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        pool.spin()


def test_shutdown_waits_for_running_callbacks(node, pool):
    started, ended = threading.Event(), []

    def work():
        started.set()
        time.sleep(0.1)
        ended.append(1)

    node.create_guard_condition(work).trigger()
    thread = threading.Thread(target=pool.spin)
    thread.start()
    assert started.wait(10)
    assert pool.shutdown(timeout_sec=10)
    assert ended == [1]
    thread.join(10)


@pytest.mark.parametrize("timeout", [np.int32(3), np.float32(3), np.int8(3)])
def test_timeouts_of_numpy_types(context, node, timeout):
    """The product of a small type and 1e9 is negative or an error, so that spin_once would not wait."""
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    calls = []
    node.create_timer(0.2, lambda: calls.append(1))
    executor.spin_once(timeout_sec=timeout)
    assert calls == [1]


def test_rate_keeps_the_frequency(node):
    start = time.monotonic()  # the periods begin when the rate is created
    rate = node.create_rate(50)
    for _ in range(5):
        rate.sleep()
    assert 0.09 < time.monotonic() - start < 0.5
    assert node.destroy_rate(rate)


def test_groups_contain_their_entities(node):
    group = ReentrantCallbackGroup()
    timer = node.create_timer(1.0, lambda: None, group)
    assert group.has_entity(timer)
    assert not node.default_callback_group.has_entity(timer)


def test_rate_in_a_loop_with_spin_once(context, node):
    """The loop of the official URDF tutorial: the rate's timer ends `spin_once`, and `sleep` does not wait again."""
    executor = SingleThreadedExecutor(context=context)
    start = time.monotonic()
    rate = node.create_rate(50)
    for _ in range(5):
        rclpy.spin_once(node, executor=executor)
        rate.sleep()
    assert 0.08 < time.monotonic() - start < 1
    assert len(list(node.timers)) == 1
    assert node.destroy_rate(rate)
    assert list(node.timers) == []
    with pytest.raises(RuntimeError, match="Rate cannot sleep because it has been destroyed"):
        rate.sleep()


def test_rate_beside_a_spinning_thread(context, node):
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    thread = threading.Thread(target=executor.spin)
    thread.start()
    start = time.monotonic()  # the periods begin when the rate is created
    rate = node.create_rate(50)
    for _ in range(5):
        rate.sleep()
    assert 0.07 < time.monotonic() - start < 1
    executor.shutdown()
    thread.join()


class Priority(Executor):
    """An executor of a user, written like that of ROS 2's examples."""

    def __init__(self, **options):
        super().__init__(**options)
        self.ran = []

    def spin_once(self, timeout_sec=None):
        try:
            handler, entity, node = self.wait_for_ready_callbacks(timeout_sec=timeout_sec)
        except (ShutdownException, TimeoutException):
            return
        self.ran.append((type(entity).__name__, node.get_name()))
        handler()
        if handler.exception() is not None:
            raise handler.exception()

    def spin_once_until_future_complete(self, _, timeout_sec=None):
        self.spin_once(timeout_sec)


def test_an_executor_of_the_user(context, node):
    executor, done = Priority(context=context), Future()
    executor.add_node(node)
    timer = node.create_timer(0.01, lambda: done.set_result("fired"))
    executor.spin_until_future_complete(done, timeout_sec=5)
    assert done.result() == "fired"
    assert executor.ran == [("Timer", "tester")]
    timer.cancel()
    node.create_guard_condition(lambda: 1 / 0).trigger()
    with pytest.raises(ZeroDivisionError):
        executor.spin_once(timeout_sec=5)
    bare = Executor(context=context)
    bare.create_task(print)
    with pytest.raises(NotImplementedError):
        bare.spin_once(timeout_sec=1)


def test_callbacks_that_are_ready_together_are_yielded_together(context, node):
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    guards = [node.create_guard_condition(lambda: None, ReentrantCallbackGroup()) for _ in range(3)]
    for guard in guards:
        guard.trigger()
    ready = list(executor._wait_for_ready_callbacks(timeout_sec=5))
    assert [entity for _, entity, _ in ready] == guards
    for handler, _, _ in ready:
        handler()


def test_sizes_of_the_pool_and_the_events_executor(context, node):
    with pytest.raises(ValueError, match="max_workers must be greater than 0"):
        MultiThreadedExecutor(num_threads=0, context=context)
    executor, fired = EventsExecutor(context=context), []
    executor.add_node(node)
    node.create_timer(0.01, lambda: fired.append(True))
    executor.spin_once(timeout_sec=5)
    assert fired == [True]
