# SPDX-License-Identifier: Apache-2.0
"""`AsyncNode`, whose callbacks run in an asyncio event loop."""

import asyncio
import sys
import time

import pytest

import rclpy
from example_interfaces.action import Fibonacci
from rclpy.action import CancelResponse
from rclpy.exceptions import InvalidHandle
from rclpy.executors import SingleThreadedExecutor
from rclpy.experimental import AsyncNode
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.subscription_content_filter_options import ContentFilterOptions
from rosgraph_msgs.msg import Clock
from std_msgs.msg import Int32, String
from std_srvs.srv import SetBool

pytestmark = pytest.mark.skipif(sys.version_info < (3, 11), reason="asyncio.TaskGroup")


@pytest.fixture
def run(context):
    """Return a function that runs a coroutine function with a node, for at most 20 s."""

    def run(main, *, name="tester", **options):
        async def inside():
            async with asyncio.timeout(20):
                node = AsyncNode(name, context=context, **options)
                async with node:
                    await main(node)

        asyncio.run(inside())

    return run


async def until(condition):
    while not condition():  # noqa: ASYNC110 - conditions of the test wake no event
        await asyncio.sleep(0.005)


def test_messages_in_order_to_functions_and_coroutine_functions(run):
    received, awaited = [], []

    async def on_message(message):
        await asyncio.sleep(0)
        awaited.append(message.data)

    async def main(node):
        assert isinstance(node, Node)
        publisher = node.create_publisher(Int32, "numbers", 100)
        node.create_subscription(Int32, "numbers", lambda message: received.append(message.data), 100)
        node.create_subscription(Int32, "numbers", on_message, 100)
        await until(lambda: publisher.get_subscription_count() == 2)
        for number in range(50):
            publisher.publish(Int32(data=number))
        await until(lambda: len(received) == len(awaited) == 50)
        assert received == awaited == list(range(50))

    run(main)


@pytest.mark.parametrize("concurrent", [False, True])
def test_only_concurrent_subscriptions_overlap(run, concurrent):
    active, most = 0, 0

    async def on_message(_):
        nonlocal active, most
        active += 1
        most = max(most, active)
        await asyncio.sleep(0.05)
        active -= 1

    async def main(node):
        publisher = node.create_publisher(String, "chatter", 10)
        node.create_subscription(String, "chatter", on_message, 10, concurrent=concurrent)
        await until(lambda: publisher.get_subscription_count() == 1)
        for _ in range(3):
            publisher.publish(String())
        await until(lambda: most and not active)
        await asyncio.sleep(0.3)

    run(main)
    assert most == (3 if concurrent else 1)


def test_services_answer_and_calls_are_awaited(run):
    async def answer(request, response):
        await asyncio.sleep(0.01)
        response.success = request.data
        return response

    async def main(node):
        node.create_service(SetBool, "switch", answer, concurrent=True)
        client = node.create_client(SetBool, "switch")
        assert await client.wait_for_service(10)
        answers = await asyncio.gather(*(client.call(SetBool.Request(data=bool(i % 2))) for i in range(6)))
        assert [answer.success for answer in answers] == [False, True] * 3
        silent = node.create_client(SetBool, "silent")
        assert not await silent.wait_for_service(0.05)
        with pytest.raises(TimeoutError):
            async with asyncio.timeout(0.05):
                await silent.call(SetBool.Request())

    run(main)


def test_actions_with_feedback_and_cancellation(run):
    async def execute(goal):
        for _ in range(goal.request.order):
            if goal.is_cancel_requested:
                goal.canceled()
                return Fibonacci.Result(sequence=[-1])
            goal.publish_feedback(Fibonacci.Feedback(sequence=[1]))
            await asyncio.sleep(0.01)
        goal.succeed()
        return Fibonacci.Result(sequence=[goal.request.order])

    async def main(node):
        node.create_action_server(Fibonacci, "fibonacci", execute, cancel_callback=lambda _: CancelResponse.ACCEPT)
        client = node.create_action_client(Fibonacci, "fibonacci")
        assert await client.wait_for_server(10)
        feedback = []
        results = await asyncio.gather(
            client.send_goal(Fibonacci.Goal(order=3), feedback_callback=feedback.append),
            client.send_goal(Fibonacci.Goal(order=4)),
        )
        assert [list(result.result.sequence) for result in results] == [[3], [4]]
        await until(lambda: len(feedback) == 3)
        handle = await client.send_goal_async(Fibonacci.Goal(order=1000))
        await handle.cancel_goal_async()
        assert list((await handle.get_result_async()).result.sequence) == [-1]

    run(main)


def test_timers_start_stop_and_skip(run):
    calls = []

    async def slow():
        calls.append(time.monotonic())
        await asyncio.sleep(0.1)

    async def main(node):
        late = node.create_timer(0.01, lambda: calls.append("late"), autostart=False)
        node.create_timer(0.01, slow)
        await asyncio.sleep(0.35)
        assert 1 <= len(calls) <= 5
        assert "late" not in calls
        late.reset()
        await until(lambda: "late" in calls)

    run(main)


def test_the_clock_sleeps_in_simulated_time(run):
    async def main(node):
        publisher = node.create_publisher(Clock, "/clock", 10)
        await until(lambda: publisher.get_subscription_count() >= 1)
        woken = []

        async def sleep():
            await node.get_clock().sleep(5.0)
            woken.append(node.get_clock().now().nanoseconds)

        def tick(seconds):
            message = Clock()
            message.clock.sec = seconds
            publisher.publish(message)

        tick(10)
        await until(lambda: node.get_clock().now().nanoseconds == 10 * 10**9)
        async with asyncio.TaskGroup() as group:
            group.create_task(sleep())
            await asyncio.sleep(0.05)
            tick(14)
            await until(lambda: node.get_clock().now().nanoseconds == 14 * 10**9)
            assert woken == []
            tick(15)
        assert woken == [15 * 10**9]

    run(main, parameter_overrides=[Parameter("use_sim_time", value=True)])


def test_real_time_sleep_and_the_wait_for_a_node(run, make_node):
    async def main(node):
        start = time.monotonic()
        await node.get_clock().sleep(0.05)
        assert time.monotonic() - start >= 0.05
        make_node("other", namespace="/a")
        await node.wait_for_node("/a/other", check_interval=0.01)
        with pytest.raises(TimeoutError):
            async with asyncio.timeout(0.05):
                await node.wait_for_node("missing")

    run(main)


def test_raw_messages_and_content_filters(run):
    raw, filtered = [], []

    async def main(node):
        publisher = node.create_publisher(Int32, "numbers", 10)
        node.create_subscription(Int32, "numbers", raw.append, 10, raw=True)
        options = ContentFilterOptions("data > 1", [])
        node.create_subscription(
            Int32, "numbers", lambda m: filtered.append(m.data), 10, content_filter_options=options
        )
        await until(lambda: publisher.get_subscription_count() == 2)
        for number in range(4):
            publisher.publish(Int32(data=number))
        await until(lambda: len(raw) == 4)
        await until(lambda: filtered == [2, 3])
        assert isinstance(raw[0], bytes)

    run(main)


def test_an_exception_of_a_callback_ends_the_block(run):
    async def fail(_):
        raise KeyError("from the callback")

    async def main(node):
        publisher = node.create_publisher(String, "chatter", 10)
        node.create_subscription(String, "chatter", fail, 10)
        await until(lambda: publisher.get_subscription_count() == 1)
        publisher.publish(String())
        await asyncio.sleep(20)

    with pytest.raises(ExceptionGroup) as caught:  # noqa: F821 - Python 3.11
        run(main)
    assert caught.group_contains(KeyError, match="from the callback")


def test_leaving_the_block_cancels_callbacks_and_destroys_the_node(run):
    ends = []

    async def forever(_):
        try:
            await asyncio.sleep(60)
        finally:
            ends.append("cancelled")

    async def main(node):
        nodes.append(node)
        publisher = node.create_publisher(String, "chatter", 10)
        node.create_subscription(String, "chatter", forever, 10)
        await until(lambda: publisher.get_subscription_count() == 1)
        publisher.publish(String())
        await until(lambda: node._AsyncNode__running)

    nodes = []
    run(main)
    assert ends == ["cancelled"]
    with pytest.raises(InvalidHandle, match="Cannot create publisher on a destroyed node"):
        nodes[0].create_publisher(String, "chatter", 1)

    async def again():
        async with nodes[0]:
            pass

    with pytest.raises(RuntimeError, match="Node has been destroyed and cannot be reentered"):
        asyncio.run(again())


def test_run_ends_with_the_context_and_only_once(context):
    async def main():
        node = AsyncNode("runner", context=context)
        running = asyncio.create_task(node.run())
        await asyncio.sleep(0.05)
        with pytest.raises(RuntimeError, match="Node is already running"):
            await node.run()
        context.try_shutdown()
        await asyncio.wait_for(running, 10)

    asyncio.run(main())


def test_an_executor_refuses_the_node(context):
    async def main():
        node = AsyncNode("runner", context=context)
        with pytest.raises(RuntimeError, match="runs in an event loop, not in an executor"):
            SingleThreadedExecutor(context=context).add_node(node)
        node.destroy_node()

    asyncio.run(main())


def test_a_message_of_another_process_arrives_at_an_idle_node(run, make_node):
    received = []
    other = make_node("other")
    publisher = other.create_publisher(String, "chatter", 10)

    async def main(node):
        node.create_subscription(String, "chatter", received.append, 10)
        await until(lambda: publisher.get_subscription_count() == 1)
        await asyncio.sleep(0.3)
        await asyncio.to_thread(publisher.publish, String(data="hello"))
        await until(lambda: received)

    run(main)
    assert rclpy.get_rmw_implementation_identifier()
