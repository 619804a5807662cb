# SPDX-License-Identifier: Apache-2.0
"""Awaiting rclpy's futures in asyncio programs, with results from any thread."""

import asyncio
import gc
import subprocess
import sys
import threading
import time
import types
import weakref

import pytest

import tf2_ros
from geometry_msgs.msg import TransformStamped
from rclpy.duration import Duration
from rclpy.executors import SingleThreadedExecutor
from rclpy.executors import TimeoutException as NothingReadyException
from rclpy.task import Future, Task
from rclpy.time import Time
from std_srvs.srv import SetBool

LONG = 20.0


def stamped(child: str, seconds: float) -> TransformStamped:
    message = TransformStamped(child_frame_id=child)
    message.header.frame_id = "odom"
    message.header.stamp = Time(seconds=seconds).to_msg()
    message.transform.translation.x = float(seconds)
    return message


@pytest.fixture
def buffer():
    return tf2_ros.Buffer()


@pytest.fixture
def in_thread():
    """Return a function that runs a function in another thread, which is joined after the test."""
    threads = []

    def start(function):
        threads.append(threading.Thread(target=function))
        threads[-1].start()

    yield start
    for thread in threads:
        thread.join(LONG)
        assert not thread.is_alive()


@pytest.fixture
def spinning(make_node):
    """Return a node that is spun in another thread."""
    node = make_node("server")
    executor = SingleThreadedExecutor(context=node.context)
    executor.add_node(node)
    thread = threading.Thread(target=executor.spin)
    thread.start()
    yield node
    executor.shutdown(timeout_sec=LONG)
    thread.join(LONG)
    assert not thread.is_alive()


def run(coroutine):
    """Run a coroutine like asyncio.run, and fail if it hangs or a callback of the loop fails."""
    failures = []

    async def main():
        asyncio.get_running_loop().set_exception_handler(lambda _, context: failures.append(context))
        return await asyncio.wait_for(coroutine, LONG)

    result = asyncio.run(main())
    gc.collect()
    assert failures == []
    return result


def test_result_from_another_thread(in_thread):
    future = Future()

    async def main():
        in_thread(lambda: future.set_result(7))
        return await future

    assert run(main()) == 7


def test_available_result_needs_no_loop_iteration():
    future = Future()
    future.set_result("there")
    with pytest.raises(StopIteration) as stop:
        future.__await__().send(None)
    assert stop.value.value == "there"

    async def main():
        return await future

    assert run(main()) == "there"


def test_exception_from_another_thread(in_thread):
    future = Future()

    async def main():
        in_thread(lambda: future.set_exception(KeyError("lost")))
        await future

    with pytest.raises(KeyError, match="lost"):
        run(main())


def test_awaiting_a_thousand_transforms(in_thread):
    buffer = tf2_ros.Buffer(Duration(seconds=1000))

    async def main():
        lookups = [buffer.lookup_transform_async("odom", "base", Time(seconds=n * 0.1)) for n in range(1, 501)]
        waits = [buffer.wait_for_transform_async("odom", "base", Time(seconds=n * 0.1)) for n in range(501, 1001)]
        awaited = asyncio.gather(*lookups, *waits)
        await asyncio.sleep(0)  # All tasks start to wait.

        def broadcast():
            for seconds in range(0, 101, 10):
                buffer.set_transform(stamped("base", seconds), "other thread")

        in_thread(broadcast)
        return await awaited

    found = run(main())
    assert [transform.transform.translation.x for transform in found] == pytest.approx(
        [n * 0.1 for n in range(1, 1001)]
    )


def test_transforms_from_the_wire(make_node):
    node = make_node("listener")
    buffer = tf2_ros.Buffer()
    tf2_ros.TransformListener(buffer, node)
    broadcaster = tf2_ros.StaticTransformBroadcaster(make_node("talker"))

    async def main():
        waiting = asyncio.ensure_future(buffer.wait_for_transform_async("odom", "base", Time()))
        await asyncio.sleep(0)
        broadcaster.sendTransform(stamped("base", 3.0))
        return await waiting

    assert run(main()).transform.translation.x == 3.0


def test_service_calls(spinning):
    def switch(request, response):
        response.success = request.data
        return response

    spinning.create_service(SetBool, "switch", switch)
    client = spinning.create_client(SetBool, "switch")
    assert client.wait_for_service(timeout_sec=LONG)

    async def main():
        single = await client.call_async(SetBool.Request(data=True))
        both = await asyncio.gather(*(client.call_async(SetBool.Request(data=value)) for value in (False, True)))
        return single.success, [response.success for response in both]

    assert run(main()) == (True, [False, True])


def test_waiting_costs_no_processor_time(make_node, buffer):
    tf2_ros.TransformListener(buffer, make_node())

    async def main():
        waits = [asyncio.ensure_future(buffer.lookup_transform_async("odom", "base", Time())) for _ in range(10)]
        before = time.process_time()
        await asyncio.wait(waits, timeout=0.5)
        spent = time.process_time() - before
        buffer.set_transform(stamped("base", 1.0), "me")
        await asyncio.gather(*waits)
        return spent

    assert run(main()) < 0.2


def test_asyncio_timeout_cancels_the_future():
    future = Future()

    async def main():
        with pytest.raises(asyncio.TimeoutError):
            await asyncio.wait_for(future, 0.01)

    run(main())
    assert future.cancelled()
    assert future._Coframe__waiters == []


@pytest.mark.skipif(sys.version_info < (3, 11), reason="asyncio.timeout came with Python 3.11")
def test_asyncio_timeout_blocks(buffer):
    async def main():
        with pytest.raises(TimeoutError):
            async with asyncio.timeout(0.01):
                await buffer.lookup_transform_async("odom", "base", Time())
        buffer.set_transform(stamped("base", 1.0), "me")
        async with asyncio.timeout(LONG):
            return await buffer.lookup_transform_async("odom", "base", Time())

    assert run(main()).child_frame_id == "base"


def test_cancelling_the_task_cancels_the_future():
    future = Future()
    over = []
    future.add_done_callback(over.append)

    async def main():
        task = asyncio.ensure_future(future)
        await asyncio.sleep(0)
        task.cancel()
        with pytest.raises(asyncio.CancelledError):
            await task

    run(main())
    assert future.cancelled()
    assert not future.done()
    assert over == [future]


def test_shielded_future_is_not_cancelled():
    future = Future()

    async def main():
        shielded = asyncio.shield(future)
        await asyncio.sleep(0)
        with pytest.raises(asyncio.TimeoutError):
            await asyncio.wait_for(shielded, 0.01)
        assert not future.cancelled()
        future.set_result(1)

    run(main())


def test_future_cancelled_from_outside():
    """A coroutine of an executor gets None. An asyncio task gets CancelledError, as from asyncio's futures."""

    async def main():
        future = Future()
        first = asyncio.ensure_future(future)
        await asyncio.sleep(0)
        future.cancel()
        with pytest.raises(asyncio.CancelledError):
            await first
        with pytest.raises(asyncio.CancelledError):
            await future

    run(main())


def test_several_tasks_await_one_future(in_thread):
    future = Future()

    async def main():
        awaited = asyncio.gather(future, asyncio.wait_for(future, LONG), future)
        await asyncio.sleep(0)
        in_thread(lambda: future.set_result("all"))
        return await awaited

    assert run(main()) == ["all"] * 3
    assert future._Coframe__waiters == []


def test_cancelled_request_is_removed(node):
    client = node.create_client(SetBool, "nowhere")

    async def main():
        with pytest.raises(asyncio.TimeoutError):
            await asyncio.wait_for(client.call_async(SetBool.Request()), 0.01)

    run(main())
    assert client._Client__pending == {}


def test_result_after_the_loop_is_closed(recwarn):
    future = Future()
    loop = asyncio.new_event_loop()

    async def wait():
        await future

    task = loop.create_task(wait())
    loop.run_until_complete(asyncio.sleep(0))
    assert len(future._Coframe__waiters) == 1
    loop.close()
    future.set_result(1)  # The loop of the awaiting task is closed.
    task._log_destroy_pending = False
    gone = weakref.ref(task)
    del task
    gc.collect()
    assert gone() is None
    assert not recwarn.list


def test_coroutines_run_by_send_inside_a_task():
    future = Future()

    async def wait():
        return await future

    async def main():
        coroutine = wait()
        coroutine.send(None)
        future.set_result("there")
        with pytest.raises(StopIteration) as stop:
            coroutine.send(None)
        return stop.value.value

    assert run(main()) == "there"


def test_executor_that_spins_inside_a_task(node):
    executor = SingleThreadedExecutor(context=node.context)
    future = Future()

    async def callback():
        return await future

    async def main():
        task = executor.create_task(callback)
        executor.spin_once(timeout_sec=LONG)
        with pytest.raises(NothingReadyException):  # The executor sleeps instead of polling.
            executor.wait_for_ready_callbacks(timeout_sec=0)
        future.set_result("rclpy")
        executor.spin_until_future_complete(task, timeout_sec=LONG)
        return task.result()

    assert run(main()) == "rclpy"


def test_asyncio_program_inside_a_callback(node, in_thread):
    executor = SingleThreadedExecutor(context=node.context)

    async def callback():
        future = Future()
        in_thread(lambda: future.set_result("asyncio"))
        return asyncio.run(asyncio.wait_for(future, LONG))

    task = executor.create_task(callback)
    executor.spin_until_future_complete(task, timeout_sec=LONG)
    assert task.result() == "asyncio"


def test_awaiting_a_task_of_an_executor(spinning):
    async def double(number):
        return 2 * number

    async def main():
        return await spinning.executor.create_task(double, 21)

    assert run(main()) == 42


def test_cancelled_running_task_is_closed_after_its_step(in_thread):
    begun, go_on, closed = threading.Event(), threading.Event(), threading.Event()

    async def work():
        try:
            begun.set()
            go_on.wait(LONG)
            await Future()
        finally:
            closed.set()

    task = Task(work)
    in_thread(task)
    assert begun.wait(LONG)
    task.cancel()
    assert not closed.is_set()
    go_on.set()
    assert closed.wait(LONG)
    assert task.cancelled()


def test_buffer_timeout_describes_what_is_missing(buffer):
    async def main():
        await buffer.lookup_transform_async("odom", "base", Time(), timeout=Duration(seconds=0.01))

    with pytest.raises(tf2_ros.LookupException, match='"odom" passed to lookupTransform argument target_frame'):
        run(main())


def test_asyncio_is_not_imported_without_need():
    """Programs that do not use asyncio start faster."""
    code = "import sys, rclpy, tf2_ros; sys.exit('asyncio' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_callbacks_run_while_another_thread_imports_asyncio(monkeypatch):
    monkeypatch.setitem(sys.modules, "asyncio", types.ModuleType("asyncio"))
    task = Task(lambda: 5)
    task()
    assert task.result() == 5

    async def handler():
        return 6

    task = Task(handler)
    task()
    assert task.result() == 6
