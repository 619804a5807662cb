# SPDX-License-Identifier: Apache-2.0
"""Listeners and broadcasters on the graph."""

import gc
import threading
import time
from collections.abc import Callable, Iterator

import pytest

import rclpy
import tf2_ros
from rclpy.context import Context
from rclpy.duration import Duration
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.time import Time
from tf2_msgs.msg import TFMessage
from tf2_msgs.srv import FrameGraph

ENOUGH = Duration(seconds=20)


@pytest.fixture
def make_node(domain_id: int) -> Iterator[Callable[..., Node]]:
    """Return a function that creates nodes in one context, which are destroyed after the test."""
    context = Context()
    rclpy.init(context=context, domain_id=domain_id)
    nodes: list[Node] = []

    def make(name: str = "node", **arguments: object) -> Node:
        nodes.append(Node(name, context=context, **arguments))
        return nodes[-1]

    yield make
    for node in nodes:
        node.destroy_node()
    context.try_shutdown()


@pytest.fixture
def executor(make_node) -> Iterator[SingleThreadedExecutor]:
    executor = SingleThreadedExecutor(context=make_node("anchor").context)
    yield executor
    executor.shutdown()


def until(condition: Callable[[], object], seconds: float = 20.0) -> bool:
    """Wait for a condition by polling."""
    deadline = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > deadline:
            return False
        time.sleep(0.002)
    return True


def spin_until(executor: SingleThreadedExecutor, condition: Callable[[], object], seconds: float = 20.0) -> bool:
    deadline = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > deadline:
            return False
        executor.spin_once(timeout_sec=0.05)
    return True


def test_transforms_are_received_without_spinning(make_node, stamped):
    buffer, talker = tf2_ros.Buffer(), make_node("talker")
    listener = tf2_ros.TransformListener(buffer, make_node("listener"))
    broadcaster = tf2_ros.TransformBroadcaster(talker)
    assert until(lambda: listener.tf_sub.get_publisher_count() and broadcaster.pub_tf.get_subscription_count())
    broadcaster.sendTransform([stamped("a", "b", 5.0, (1.0, 0.0, 0.0)), stamped("b", "c", 5.0)])
    found = buffer.lookup_transform("a", "c", Time(seconds=5), timeout=ENOUGH)
    assert found.transform.translation.x == 1.0
    assert "broadcaster: 'default_authority'" in buffer.all_frames_as_yaml()


def test_listener_through_the_node(make_node, executor, stamped):
    """With wire="rclpy", the node's executor inserts the transforms, as in tf2_ros."""
    node = make_node("listener")
    buffer = tf2_ros.Buffer()
    tf2_ros.TransformListener(buffer, node, wire="rclpy")
    tf2_ros.StaticTransformBroadcaster(make_node("talker")).sendTransform(stamped("a", "b"))
    assert not buffer.can_transform("a", "b", Time(), Duration(seconds=0.2))
    executor.add_node(node)
    assert spin_until(executor, lambda: buffer.can_transform("a", "b", Time()))
    with pytest.raises(ValueError, match=r"wire is 'dds'\. Valid values: native, rclpy"):
        tf2_ros.TransformListener(buffer, node, wire="dds")


def test_lookup_with_timeout_inside_a_callback_of_a_single_threaded_executor(make_node, executor, stamped):
    """With upstream's listener, the transform would not be received there."""
    node = make_node("listener")
    buffer = tf2_ros.Buffer()
    tf2_ros.TransformListener(buffer, node)
    broadcaster = tf2_ros.StaticTransformBroadcaster(make_node("talker"))
    found = []

    def callback() -> None:
        broadcaster.sendTransform(stamped("a", "b", 5.0))
        found.append(buffer.lookup_transform("a", "b", Time(), timeout=ENOUGH))

    timer = node.create_timer(0.01, lambda: (timer.cancel(), callback()))
    executor.add_node(node)
    assert spin_until(executor, lambda: found)


def test_coroutine_callback_awaits_a_transform_from_the_wire(make_node, executor, stamped):
    node = make_node("listener")
    buffer = tf2_ros.Buffer()
    listener = tf2_ros.TransformListener(buffer, node)
    broadcaster = tf2_ros.TransformBroadcaster(make_node("talker"))
    found = []

    async def callback() -> None:
        timer.cancel()
        found.append(await buffer.lookup_transform_async("a", "b", Time(seconds=5)))

    timer = node.create_timer(0.01, callback)
    executor.add_node(node)
    assert spin_until(executor, timer.is_canceled)
    assert until(listener.tf_sub.get_publisher_count)
    assert until(broadcaster.pub_tf.get_subscription_count)
    broadcaster.sendTransform(stamped("a", "b", 5.0))
    assert spin_until(executor, lambda: found)
    assert found[0].child_frame_id == "b"


def test_listener_without_a_reference(make_node, stamped):
    buffer = tf2_ros.Buffer()
    tf2_ros.TransformListener(buffer, make_node("listener"))
    gc.collect()
    tf2_ros.StaticTransformBroadcaster(make_node("talker")).sendTransform(stamped("a", "b"))
    assert buffer.can_transform("a", "b", Time(), ENOUGH)


def test_unregister(make_node, stamped):
    buffer, other = tf2_ros.Buffer(), tf2_ros.Buffer()
    node = make_node("listener")
    listener = tf2_ros.TransformListener(buffer, node)
    tf2_ros.TransformListener(other, node)
    listener.unregister()
    listener.unregister()
    tf2_ros.StaticTransformBroadcaster(make_node("talker")).sendTransform(stamped("a", "b"))
    assert other.can_transform("a", "b", Time(), ENOUGH)
    assert not buffer.can_transform("a", "b", Time())


def test_destroying_the_node_stops_its_listeners(make_node, stamped):
    buffer, other = tf2_ros.Buffer(), tf2_ros.Buffer()
    node = make_node("listener")
    tf2_ros.TransformListener(buffer, node)
    tf2_ros.TransformListener(other, make_node("other"))
    node.destroy_node()
    tf2_ros.StaticTransformBroadcaster(make_node("talker")).sendTransform(stamped("a", "b"))
    assert other.can_transform("a", "b", Time(), ENOUGH)
    assert not buffer.can_transform("a", "b", Time())


def test_replacing_the_buffer(make_node, stamped):
    listener = tf2_ros.TransformListener(tf2_ros.Buffer(), make_node("listener"))
    listener.buffer = tf2_ros.Buffer()
    tf2_ros.StaticTransformBroadcaster(make_node("talker")).sendTransform(stamped("a", "b"))
    assert listener.buffer.can_transform("a", "b", Time(), ENOUGH)


def test_callbacks_can_be_called_directly(make_node, stamped):
    listener = tf2_ros.TransformListener(tf2_ros.Buffer(), make_node("listener"))
    listener.callback(TFMessage(transforms=[stamped("a", "b", 5.0)]))
    listener.static_callback(TFMessage(transforms=[stamped("b", "c")]))
    assert listener.buffer.can_transform("a", "c", Time(seconds=5))


def test_overridden_callback_receives_every_message(make_node, executor, stamped):
    class Mine(tf2_ros.TransformListener):
        seen = 0

        def static_callback(self, data: TFMessage) -> None:
            self.seen += len(data.transforms)
            super().static_callback(data)

    node = make_node("listener")
    listener = Mine(tf2_ros.Buffer(), node)
    tf2_ros.StaticTransformBroadcaster(make_node("talker")).sendTransform(stamped("a", "b"))
    executor.add_node(node)
    assert spin_until(executor, lambda: listener.seen == 1)
    assert listener.buffer.can_transform("a", "b", Time())
    listener.unregister()


def test_overridden_set_transform_receives_every_transform(make_node, executor, stamped):
    class Mine(tf2_ros.Buffer):
        def set_transform_static(self, transform, authority: str) -> None:
            transform.child_frame_id = "renamed"
            super().set_transform_static(transform, authority)

    node = make_node("listener")
    buffer = Mine()
    tf2_ros.TransformListener(buffer, node)
    tf2_ros.StaticTransformBroadcaster(make_node("talker")).sendTransform(stamped("a", "b"))
    executor.add_node(node)
    assert spin_until(executor, lambda: buffer.can_transform("a", "renamed", Time()))


def test_remapped_tf_topics(make_node, stamped):
    remaps = ["--ros-args", "-r", "/tf:=tf", "-r", "/tf_static:=tf_static"]
    talker = make_node("talker", namespace="robot1", cli_args=remaps)
    buffer, elsewhere = tf2_ros.Buffer(), tf2_ros.Buffer()
    listener = tf2_ros.TransformListener(buffer, make_node("listener", namespace="robot1", cli_args=remaps))
    tf2_ros.TransformListener(elsewhere, make_node("elsewhere"))
    assert listener.tf_sub.topic_name == "/robot1/tf"
    assert tf2_ros.TransformBroadcaster(talker).pub_tf.topic_name == "/robot1/tf"
    tf2_ros.StaticTransformBroadcaster(talker).sendTransform(stamped("a", "b"))
    assert buffer.can_transform("a", "b", Time(), ENOUGH)
    assert not elsewhere.can_transform("a", "b", Time())


def test_tf_topics_as_arguments(make_node, stamped):
    node, talker = make_node("listener"), make_node("talker")
    buffers = {}
    for robot in ("avatar", "operator"):
        buffers[robot] = tf2_ros.Buffer()
        tf2_ros.TransformListener(buffers[robot], node, tf_topic=f"/{robot}/tf", tf_static_topic=f"/{robot}/tf_static")
        broadcaster = tf2_ros.StaticTransformBroadcaster(talker, tf_static_topic=f"/{robot}/tf_static")
        broadcaster.sendTransform(stamped("a", robot))
    for robot, buffer in buffers.items():
        assert buffer.can_transform("a", robot, Time(), ENOUGH)
        assert len(buffer._getFrameStrings()) == 2
    assert tf2_ros.TransformBroadcaster(talker, tf_topic="/avatar/tf").pub_tf.topic_name == "/avatar/tf"


def test_static_listener_does_not_subscribe_to_tf(make_node, stamped):
    buffer, talker = tf2_ros.Buffer(), make_node("talker")
    listener = tf2_ros.StaticTransformListener(buffer, make_node("listener"))
    tf2_ros.StaticTransformBroadcaster(talker).sendTransform(stamped("a", "b"))
    assert buffer.can_transform("a", "b", Time(), ENOUGH)
    assert listener.tf_sub is None
    assert talker.count_subscribers("/tf") == 0


def test_late_listeners_receive_all_static_transforms_of_a_process(make_node, stamped):
    first, second = make_node("first"), make_node("second")
    broadcasters = [tf2_ros.StaticTransformBroadcaster(node) for node in (first, first, second)]
    for number, broadcaster in enumerate(broadcasters):
        message = stamped("a", "reused")
        for part in ("x", "y"):
            message.child_frame_id = f"{part}{number}"
            broadcaster.sendTransform(message)
    broadcasters[0].sendTransform(stamped("a", "x0", translation=(9.0, 0.0, 0.0)))
    buffer = tf2_ros.Buffer()
    tf2_ros.TransformListener(
        buffer, make_node("late"), static_qos=QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    )
    for number in range(3):
        for part in ("x", "y"):
            assert buffer.can_transform("a", f"{part}{number}", Time(), ENOUGH)
    assert buffer.lookup_transform("a", "x0", Time()).transform.translation.x == 9.0
    children = [transform.child_frame_id for transform in broadcasters[0].net_message.transforms]
    assert children == ["x0", "y0"]


def test_static_broadcaster_with_a_qos_profile(make_node, stamped):
    qos = QoSProfile(depth=5, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    broadcaster = tf2_ros.StaticTransformBroadcaster(make_node("talker"), qos)
    broadcaster.sendTransform(stamped("a", "b"))
    broadcaster.sendTransform(stamped("a", "c"))
    buffer = tf2_ros.Buffer()
    tf2_ros.TransformListener(buffer, make_node("late"))
    assert buffer.can_transform("b", "c", Time(), ENOUGH)


def test_several_transforms_are_sent_in_one_message(make_node, executor, stamped):
    node = make_node("listener")
    sizes = []
    node.create_subscription(TFMessage, "/tf", lambda message: sizes.append(len(message.transforms)), 10)
    broadcaster = tf2_ros.TransformBroadcaster(make_node("talker"))
    executor.add_node(node)
    assert until(broadcaster.pub_tf.get_subscription_count)
    broadcaster.sendTransform(stamped("a", "b") for _ in range(3))
    broadcaster.sendTransform(stamped("a", "b"))
    assert spin_until(executor, lambda: len(sizes) == 2)
    assert sizes == [3, 1]


def test_dedicated_thread_spins_the_node(make_node):
    node = make_node("listener")
    listener = tf2_ros.TransformListener(tf2_ros.Buffer(), node, spin_thread=True)
    ticked = threading.Event()
    node.create_timer(0.01, ticked.set)
    assert ticked.wait(20.0)
    listener.unregister()
    listener.dedicated_listener_thread.join(20.0)
    assert not listener.dedicated_listener_thread.is_alive()


def test_frames_service(make_node, executor, stamped):
    node, asking = make_node("listener", namespace="robot1"), make_node("asking")
    buffer = tf2_ros.Buffer(node=node)
    buffer.set_transform_static(stamped("a", "b"), "me")
    client = asking.create_client(FrameGraph, "/robot1/tf2_frames")
    executor.add_node(node)
    executor.add_node(asking)
    assert spin_until(executor, client.service_is_ready)
    answer = client.call_async(FrameGraph.Request())
    assert spin_until(executor, answer.done)
    assert answer.result().frame_yaml == buffer.all_frames_as_yaml()


def test_change_to_simulated_time_clears_the_buffer(make_node, stamped):
    buffer, node = tf2_ros.Buffer(), make_node("listener")
    tf2_ros.TransformListener(buffer, node)
    buffer.set_transform(stamped("a", "b", 5.0), "me")
    node.set_parameters([Parameter("use_sim_time", value=True)])
    assert until(lambda: not buffer.can_transform("a", "b", Time()))


def test_listener_creates_a_node_if_none_is_given(domain_id, stamped):
    del domain_id
    rclpy.init()
    try:
        buffer = tf2_ros.Buffer()
        listener = tf2_ros.TransformListener(buffer)
        assert listener.node.get_name().startswith("transform_listener_impl_")
        talker = rclpy.create_node("talker")
        tf2_ros.StaticTransformBroadcaster(talker).sendTransform(stamped("a", "b"))
        assert buffer.can_transform("a", "b", Time(), ENOUGH)
        talker.destroy_node()
        listener.node.destroy_node()
    finally:
        rclpy.shutdown()
