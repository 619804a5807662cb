# SPDX-License-Identifier: Apache-2.0
"""A node that receives its own transforms, tested through upstream's names only, like upstream's tests.

Upstream needs one `spin_once` for each message, and so do these; none of them has a timeout, and all must return.
"""

import gc
import os
import threading
import time
import weakref

import pytest

import rclpy
import tf2_ros
from rclpy.clock import ClockType
from rclpy.context import Context
from rclpy.duration import Duration
from rclpy.exceptions import InvalidHandle, RCLError
from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.publisher import Publisher
from rclpy.service import Service
from rclpy.subscription import Subscription
from rclpy.time import Time
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

ENOUGH = Duration(seconds=20)


@pytest.fixture
def node(domain_id):
    rclpy.init(domain_id=domain_id)
    node = rclpy.create_node("test_listener_and_broadcaster")
    yield node
    node.destroy_node()
    rclpy.shutdown()


@pytest.fixture
def buffer():
    return tf2_ros.Buffer()


@pytest.fixture
def listener(buffer, node):
    return tf2_ros.TransformListener(buffer=buffer, node=node, spin_thread=False)


@pytest.fixture
def broadcaster(node):
    return tf2_ros.TransformBroadcaster(node)


@pytest.fixture
def static_broadcaster(node):
    return tf2_ros.StaticTransformBroadcaster(node)


@pytest.mark.usefixtures("listener")
def test_spin_once_receives_one_transform(buffer, node, broadcaster, stamped):
    sent = stamped("foo", "bar", 0.3, (1.0, 2.0, 3.0))
    broadcaster.sendTransform(sent)
    rclpy.spin_once(node)
    assert buffer.lookup_transform("foo", "bar", Time(seconds=0.3)) == sent


def test_spin_once_returns_for_each_message(node, listener, broadcaster, static_broadcaster, stamped):
    for seconds in (1.0, 2.0, 3.0):
        broadcaster.sendTransform(stamped("foo", "bar", seconds))
    static_broadcaster.sendTransform(stamped("bar", "sensor"))
    for _ in range(4):
        rclpy.spin_once(node)
    assert listener.buffer.can_transform("foo", "sensor", Time(seconds=2))


@pytest.mark.usefixtures("listener")
@pytest.mark.parametrize("kind", [SingleThreadedExecutor, MultiThreadedExecutor])
def test_spin_once_waits_for_a_transform(buffer, node, broadcaster, stamped, kind):
    executor = kind()
    executor.add_node(node)
    sender = threading.Timer(0.05, lambda: broadcaster.sendTransform(stamped("foo", "bar", 1.0)))
    sender.start()
    executor.spin_once()
    assert buffer.can_transform("foo", "bar", Time())
    sender.join()
    executor.shutdown()


@pytest.mark.usefixtures("listener")
def test_other_callbacks_take_precedence(node, broadcaster, stamped):
    """Many transforms do not starve timers."""
    ticks = []
    node.create_timer(0.001, lambda: ticks.append(1))
    for number in range(50):
        broadcaster.sendTransform(stamped("foo", "bar", 1.0 + number))
        rclpy.spin_once(node)
        rclpy.spin_once(node)
    assert len(ticks) > 10


def test_spin_once_delivers_a_message_of_the_same_process(node):
    received = []
    node.create_subscription(String, "chatter", received.append, 10)
    publisher = node.create_publisher(String, "chatter", 10)
    for text in ("one", "two"):
        publisher.publish(String(data=text))
        rclpy.spin_once(node)
        assert received[-1].data == text


def test_replacing_the_buffer(node, listener, broadcaster, static_broadcaster, stamped):
    """Upstream's test setup replaces the buffer of an existing listener."""
    for number in range(3):
        listener.buffer = tf2_ros.Buffer()
        broadcaster.sendTransform(stamped("foo", f"bar{number}", 1.0))
        rclpy.spin_once(node)
        assert listener.buffer.can_transform("foo", f"bar{number}", Time(seconds=1))
        assert not listener.buffer.can_transform("foo", f"bar{number - 1}", Time())
    static_broadcaster.sendTransform(stamped("foo", "bar", 0.0, (1.0, 0.0, 0.0)))
    rclpy.spin_once(node)
    assert listener.buffer.lookup_transform("foo", "bar", Time()).transform.translation.x == 1.0


def test_previous_buffer_receives_no_transforms(buffer, listener, broadcaster, stamped):
    listener.buffer = tf2_ros.Buffer()
    broadcaster.sendTransform(stamped("foo", "bar", 1.0))
    assert listener.buffer.can_transform("foo", "bar", Time(), ENOUGH)
    assert not buffer.can_transform("foo", "bar", Time())


@pytest.mark.usefixtures("listener")
def test_extrapolation(buffer, node, broadcaster, stamped):
    for seconds in (0.3, 0.2):
        broadcaster.sendTransform(stamped("foo", "bar", seconds))
        rclpy.spin_once(node)
    with pytest.raises(tf2_ros.ExtrapolationException, match="extrapolation into the past"):
        buffer.lookup_transform("foo", "bar", Time(seconds=0.1))
    with pytest.raises(tf2_ros.ExtrapolationException, match="extrapolation into the future"):
        buffer.lookup_transform("foo", "bar", Time(seconds=0.4))


def test_listener_without_a_reference(buffer, node, broadcaster, stamped):
    listener = weakref.ref(tf2_ros.TransformListener(buffer, node))
    gc.collect()
    broadcaster.sendTransform(stamped("foo", "bar", 1.0))
    rclpy.spin_once(node)
    assert buffer.can_transform("foo", "bar", Time())
    assert listener() is not None, "upstream, the node's subscriptions hold it"


def test_buffer_subclass_that_overrides_set_transform(node, broadcaster, static_broadcaster, stamped):
    class Renaming(tf2_ros.Buffer):
        def set_transform(self, transform, authority):
            assert authority == "default_authority"
            transform.header.frame_id = f"robot1/{transform.header.frame_id}"
            super().set_transform(transform, authority)

    buffer = Renaming()
    tf2_ros.TransformListener(buffer, node)
    broadcaster.sendTransform(stamped("foo", "bar", 1.0))
    rclpy.spin_once(node)
    assert buffer.can_transform("robot1/foo", "bar", Time())
    static_broadcaster.sendTransform(stamped("bar", "sensor"))
    rclpy.spin_once(node)
    assert buffer.can_transform("robot1/foo", "sensor", Time())


def test_buffer_with_a_replaced_method(node, broadcaster, stamped, monkeypatch):
    buffer, seen = tf2_ros.Buffer(), []
    monkeypatch.setattr(buffer, "set_transform", lambda *arguments: seen.append(arguments))
    tf2_ros.TransformListener(buffer, node)
    broadcaster.sendTransform(stamped("foo", "bar", 1.0))
    rclpy.spin_once(node)
    assert seen == [(stamped("foo", "bar", 1.0), "default_authority")]


def test_listener_subclass_that_overrides_callback(buffer, node, broadcaster, stamped):
    class Counting(tf2_ros.TransformListener):
        count = 0

        def callback(self, data):
            self.count += len(data.transforms)
            super().callback(data)

    listener = Counting(buffer, node)
    broadcaster.sendTransform([stamped("foo", "bar", 1.0), stamped("bar", "baz", 1.0)])
    rclpy.spin_once(node)
    assert listener.count == 2
    assert buffer.can_transform("foo", "baz", Time())


def test_attributes_of_listeners(buffer, node, listener):
    assert listener.buffer is buffer
    assert listener.node is node
    for subscription, topic in ((listener.tf_sub, "/tf"), (listener.tf_static_sub, "/tf_static")):
        assert isinstance(subscription, Subscription)
        assert (subscription.topic_name, subscription.msg_type) == (topic, TFMessage)
        assert subscription.callback_group is listener.group
        assert subscription.qos_profile.depth == 100
        assert subscription in list(node.subscriptions)
    assert not hasattr(listener, "executor")
    assert not hasattr(listener, "dedicated_listener_thread")
    listener.unregister()
    assert list(node.subscriptions) == []
    listener.unregister()


def test_attributes_of_buffers(node):
    buffer = tf2_ros.Buffer(node=node)
    assert isinstance(buffer.srv, Service)
    assert buffer.srv.service_name == "/tf2_frames"
    assert buffer.clock is node.get_clock()
    alone = tf2_ros.Buffer()
    assert not hasattr(alone, "srv")
    assert alone.clock.clock_type == ClockType.SYSTEM_TIME


def test_subscription_of_a_listener_can_be_destroyed(buffer, node, listener, broadcaster, static_broadcaster, stamped):
    assert node.destroy_subscription(listener.tf_sub)
    broadcaster.sendTransform(stamped("foo", "bar", 1.0))
    static_broadcaster.sendTransform(stamped("bar", "sensor"))
    assert buffer.can_transform("bar", "sensor", Time(), ENOUGH)
    assert not buffer.can_transform("foo", "bar", Time())


def test_dedicated_thread(buffer, node):
    listener = tf2_ros.TransformListener(buffer, node, spin_thread=True)
    assert isinstance(listener.executor, SingleThreadedExecutor)
    ticked = threading.Event()
    node.create_timer(0.01, ticked.set)
    assert ticked.wait(20.0)
    assert listener.dedicated_listener_thread.is_alive()
    listener.unregister()
    listener.dedicated_listener_thread.join(20.0)
    assert not listener.dedicated_listener_thread.is_alive()


def test_attributes_of_broadcasters(node, broadcaster, static_broadcaster, stamped):
    assert isinstance(broadcaster.pub_tf, Publisher)
    assert (broadcaster.pub_tf.topic_name, broadcaster.pub_tf.qos_profile.depth) == ("/tf", 100)
    assert isinstance(static_broadcaster.pub_tf, Publisher)
    assert (static_broadcaster.pub_tf.topic_name, static_broadcaster.pub_tf.qos_profile.depth) == ("/tf_static", 1)
    assert {broadcaster.pub_tf, static_broadcaster.pub_tf} <= set(node.publishers)
    static_broadcaster.sendTransform([stamped("foo", "bar"), stamped("foo", "baz")])
    assert [transform.child_frame_id for transform in static_broadcaster.net_message.transforms] == ["bar", "baz"]
    assert static_broadcaster._child_frame_ids == {"bar", "baz"}
    with pytest.raises(TypeError, match="Expected"):
        static_broadcaster.pub_tf.publish(String())
    assert node.destroy_publisher(static_broadcaster.pub_tf)


@pytest.mark.usefixtures("listener")
def test_send_one_or_several_transforms(buffer, node, broadcaster, stamped):
    for transforms in (
        stamped("foo", "one", 1.0),
        [stamped("foo", "two", 1.0)],
        (stamped("foo", "three", 1.0), stamped("foo", "four", 1.0)),
        (stamped("foo", child, 1.0) for child in ("five", "six")),
    ):
        broadcaster.sendTransform(transforms)
        rclpy.spin_once(node)
    assert {"one", "two", "three", "four", "five", "six"} <= set(buffer._getFrameStrings())


@pytest.mark.parametrize("owner", ["instance", "class"])
def test_a_replacement_of_publish_receives_messages(broadcaster, stamped, monkeypatch, owner):
    broadcaster.sendTransform(stamped("foo", "before"))
    got = []
    if owner == "instance":
        monkeypatch.setattr(broadcaster.pub_tf, "publish", got.append)
    else:
        monkeypatch.setattr(Publisher, "publish", lambda _, message: got.append(message))
    broadcaster.sendTransform(stamped("foo", "one"))
    broadcaster.sendTransform([stamped("foo", "two"), stamped("foo", "three")])
    assert [type(message) for message in got] == [TFMessage, TFMessage]
    assert [[t.child_frame_id for t in message.transforms] for message in got] == [["one"], ["two", "three"]]


def test_errors_of_send_transform(node, broadcaster, stamped):
    broadcaster.sendTransform(stamped("foo", "bar"))
    for wrong in (String(), [String()], None):
        with pytest.raises(AssertionError, match="transforms"):
            broadcaster.sendTransform(wrong)
    node.destroy_publisher(broadcaster.pub_tf)
    with pytest.raises(InvalidHandle, match="destruction was requested"):
        broadcaster.sendTransform(stamped("foo", "bar"))


def test_send_transform_after_the_shutdown(stamped):
    with Context() as context:
        node = rclpy.create_node("tester", context=context)
        broadcaster = tf2_ros.TransformBroadcaster(node)
        broadcaster.sendTransform(stamped("foo", "bar"))
        context.shutdown()
        with pytest.raises(RCLError, match="publisher's context is invalid"):
            broadcaster.sendTransform(stamped("foo", "bar"))
        node.destroy_node()


def frames_of_a_late_listener(node):
    buffer = tf2_ros.Buffer()
    tf2_ros.TransformListener(buffer, node)
    while not buffer._getFrameStrings():
        rclpy.spin_once(node)  # can also return for a message to one of the earlier listeners
    return set(buffer._getFrameStrings())


def assert_late_listeners_have(node, frames):
    """Assert what a late listener receives. Shared transforms are those that the process has received until then."""
    deadline = time.monotonic() + (20 if os.environ.get("COFRAME_SHARED") == "1" else 0)
    while (received := frames_of_a_late_listener(node)) != frames:
        assert time.monotonic() < deadline, received


def test_static_transform_is_withdrawn_through_net_message(node, static_broadcaster, stamped):
    other = tf2_ros.StaticTransformBroadcaster(node)
    other.sendTransform(stamped("foo", "others"))
    static_broadcaster.sendTransform([stamped("foo", "bar"), stamped("foo", "baz")])
    assert frames_of_a_late_listener(node) == {"foo", "others", "bar", "baz"}
    static_broadcaster.net_message.transforms = static_broadcaster.net_message.transforms[1:]
    static_broadcaster.pub_tf.publish(static_broadcaster.net_message)
    assert_late_listeners_have(node, {"foo", "others", "baz"})
    static_broadcaster.sendTransform(stamped("foo", "new"))
    assert_late_listeners_have(node, {"foo", "others", "baz", "new"})


def test_subclass_of_the_static_broadcaster(node, stamped):
    """Programs subclass the broadcaster of Jazzy to update transforms."""

    class Updating(tf2_ros.StaticTransformBroadcaster):
        def sendTransform(self, transform):  # noqa: N802 - upstream's name
            if transform.child_frame_id in self._child_frame_ids:
                self.net_message.transforms = [
                    transform if known.child_frame_id == transform.child_frame_id else known
                    for known in self.net_message.transforms
                ]
                self.pub_tf.publish(self.net_message)
            else:
                super().sendTransform(transform)

    broadcaster = Updating(node)
    for x in (1.0, 2.0):
        broadcaster.sendTransform(stamped("foo", "bar", translation=(x, 0.0, 0.0)))
    buffer = tf2_ros.Buffer()
    tf2_ros.TransformListener(buffer, node)
    rclpy.spin_once(node)
    assert buffer.lookup_transform("foo", "bar", Time()).transform.translation.x == 2.0


def test_typical_node(domain_id, stamped):
    """A node with a listener, a broadcaster and a timer, whose callback shuts down."""

    class Robot(Node):
        def __init__(self):
            super().__init__("robot")
            self.tf_buffer = tf2_ros.Buffer()
            self.tf_listener = tf2_ros.TransformListener(self.tf_buffer, self)
            self.tf_broadcaster = tf2_ros.TransformBroadcaster(self)
            self.found = None
            self.create_timer(0.01, self.on_timer)

        def on_timer(self):
            try:
                self.found = self.tf_buffer.lookup_transform("foo", "bar", Time())
            except tf2_ros.TransformException as error:
                self.get_logger().debug(f"Could not transform: {error}")
                self.tf_broadcaster.sendTransform(stamped("foo", "bar", 1.0))
            else:
                rclpy.shutdown()

    rclpy.init(domain_id=domain_id)
    robot = Robot()
    rclpy.spin(robot)
    assert robot.found.child_frame_id == "bar"
    robot.destroy_node()


REMAPS = ["--ros-args", "-r", "__ns:=/robot1", "-r", "/tf:=/robot1/tf", "-r", "/tf_static:=tf_static"]


@pytest.mark.usefixtures("node")
def test_remapped_topics_of_a_robot(stamped):
    """As in Nav2, each robot runs the same program with different remappings."""
    robot = rclpy.create_node("driver", cli_args=REMAPS)
    buffers = {name: tf2_ros.Buffer() for name in ("same node", "plain")}
    tf2_ros.TransformListener(buffers["same node"], robot)
    plain = rclpy.create_node("plain")
    tf2_ros.TransformListener(buffers["plain"], plain)
    moving, fixed = tf2_ros.TransformBroadcaster(robot), tf2_ros.StaticTransformBroadcaster(robot)
    assert robot.get_fully_qualified_name() == "/robot1/driver"
    assert (moving.pub_tf.topic_name, fixed.pub_tf.topic_name) == ("/robot1/tf", "/robot1/tf_static")
    moving.sendTransform(stamped("odom", "base_link", 1.0))
    fixed.sendTransform(stamped("base_link", "lidar", 1.0))
    assert buffers["same node"].can_transform("odom", "lidar", Time(), ENOUGH)
    assert not buffers["plain"].can_transform("odom", "lidar", Time())
    names = dict(robot.get_topic_names_and_types())
    assert {"/robot1/tf", "/robot1/tf_static"} <= names.keys()
    for created in (robot, plain):
        created.destroy_node()


def test_prefixes_of_listeners_and_broadcasters(node, stamped):
    """A native listener, a subclass, and both broadcasters, which do not modify the given messages."""

    class Watched(tf2_ros.TransformListener):
        def callback(self, data):
            super().callback(data)

    buffers = [tf2_ros.Buffer(), tf2_ros.Buffer()]
    tf2_ros.TransformListener(buffers[0], node, prefix="fleet/", keep=["map"])
    Watched(buffers[1], node, prefix="fleet/", keep=["map"])
    moving = tf2_ros.TransformBroadcaster(node, prefix="robot1/", keep=["map"])
    fixed = tf2_ros.StaticTransformBroadcaster(node, prefix="robot1/", keep=["map"])
    odom, lidar = stamped("map", "odom", 1.0), stamped("odom", "lidar", 1.0)
    moving.sendTransform(odom)
    fixed.sendTransform([lidar])
    for buffer in buffers:
        while not buffer.can_transform("map", "fleet/robot1/lidar", Time()):
            rclpy.spin_once(node)
    assert (odom.header.frame_id, odom.child_frame_id, lidar.child_frame_id) == ("map", "odom", "lidar")
