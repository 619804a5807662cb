# SPDX-License-Identifier: Apache-2.0
"""Publishers and subscriptions."""

import threading
from array import array

import numpy as np
import pytest

import rclpy.serialization
from rcl_interfaces.msg import Log
from rclpy.context import Context
from rclpy.exceptions import InvalidHandle
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import DurabilityPolicy, QoSProfile, qos_profile_sensor_data
from rclpy.wait_for_message import wait_for_message
from sensor_msgs.msg import JointState, PointCloud2
from std_msgs.msg import ByteMultiArray, Int32, String


@pytest.fixture
def spin(node, wait_until):
    executor = SingleThreadedExecutor(context=node.context)
    executor.add_node(node)
    return lambda condition: wait_until(condition, lambda: executor.spin_once(timeout_sec=0.1))


def test_messages_arrive_in_order(node, spin):
    got = []
    node.create_subscription(Int32, "numbers", lambda message: got.append(message.data), 100)
    publisher = node.create_publisher(Int32, "numbers", 100)
    spin(lambda: publisher.get_subscription_count() == 1)
    for number in range(50):
        publisher.publish(Int32(data=number))
    spin(lambda: len(got) == 50)
    assert got == list(range(50))
    assert publisher.topic_name == "/numbers"


def test_queue_keeps_the_latest_messages(node, spin):
    got = []
    node.create_subscription(Int32, "numbers", lambda message: got.append(message.data), 3)
    publisher = node.create_publisher(Int32, "numbers", 3)
    spin(lambda: publisher.get_subscription_count() == 1)
    for number in range(10):
        publisher.publish(Int32(data=number))
    spin(lambda: got[-1:] == [9])
    assert got == [7, 8, 9]


def test_late_joining_subscriptions_receive_kept_messages(node, spin):
    qos = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    node.create_publisher(String, "map", qos).publish(String(data="here"))
    got = []
    node.create_subscription(String, "map", lambda message: got.append(message.data), qos)
    spin(lambda: got)
    assert got == ["here"]


def test_coroutine_callbacks_message_info_and_bytes(node, spin):
    got, infos, raw = [], [], []

    async def keep(message):
        got.append(message.data)

    node.create_subscription(String, "a", keep, 10)
    node.create_subscription(String, "a", lambda message, info: infos.append((message.data, info)), 10)
    node.create_subscription(String, "a", raw.append, qos_profile_sensor_data, raw=True)
    publisher = node.create_publisher(String, "a", 10)
    spin(lambda: publisher.get_subscription_count() == 3)
    publisher.publish(String(data="x"))
    spin(lambda: got and infos and raw)
    assert got == ["x"]
    assert infos[0][0] == "x"
    assert 0 < infos[0][1]["source_timestamp"] <= infos[0][1]["received_timestamp"]
    assert rclpy.serialization.deserialize_message(raw[0], String) == String(data="x")
    publisher.publish(raw[0])
    spin(lambda: len(got) == 2)


def test_large_arrays_and_fields_that_only_python_code_serializes(node, spin):
    cloud = PointCloud2(
        data=array("B", np.arange(1_000_003, dtype=np.uint32).astype(np.uint8).tobytes()), is_dense=True
    )
    octets = ByteMultiArray(data=[b"\1", b"\xff"])
    unusual = JointState(name=["elbow"])
    unusual._velocity = array("f", [1.0, 2.5])  # an array of another type, assigned past the checks
    got = []
    for topic, message in (("cloud", cloud), ("octets", octets), ("unusual", unusual)):
        node.create_subscription(type(message), topic, got.append, 10)
        publisher = node.create_publisher(type(message), topic, 10)
        spin(lambda publisher=publisher: publisher.get_subscription_count() == 1)
        publisher.publish(message)
        spin(lambda topic=topic: len(got) == ["cloud", "octets", "unusual"].index(topic) + 1)
    assert got == [cloud, octets, JointState(name=["elbow"], velocity=[1.0, 2.5])]
    cloud.data.append(7)  # Publishing has released the memory of the array.


@pytest.mark.parametrize("published", [0, 1, 2])
def test_wrong_types_are_rejected(node, published):
    publisher = node.create_publisher(String, "a", 10)
    for _ in range(published):
        publisher.publish(String())
    with pytest.raises(TypeError, match="Expected"):
        publisher.publish(Int32())
    with pytest.raises(RuntimeError, match="callable with one argument"):
        node.create_subscription(String, "a", lambda: None, 10)


@pytest.mark.parametrize("published", [0, 1, 2])
def test_publishing_after_the_shutdown_raises(node, published):
    publisher = node.create_publisher(String, "a", 10)
    for _ in range(published):
        publisher.publish(String())
    node.context.shutdown()
    with pytest.raises(RuntimeError, match="publisher's context is invalid"):
        publisher.publish(String())


@pytest.mark.parametrize("published", [0, 1, 2])
def test_publishing_after_destruction_raises(node, published):
    publisher = node.create_publisher(String, "a", 10)
    for _ in range(published):
        publisher.publish(String())
    node.destroy_publisher(publisher)
    with pytest.raises(InvalidHandle, match="destruction was requested"):
        publisher.publish(String())


def test_first_and_later_messages_of_all_forms_arrive(node, spin):
    class Derived(String):
        pass

    got = []
    node.create_subscription(String, "a", lambda message: got.append(message.data), 10)
    publisher = node.create_publisher(String, "a", 10)
    spin(lambda: publisher.get_subscription_count() == 1)
    for _ in range(2):
        publisher.publish(String(data="message"))
        publisher.publish(Derived(data="derived"))
        publisher.publish(rclpy.serialization.serialize_message(String(data="bytes")))
    spin(lambda: len(got) == 6)
    assert got == ["message", "derived", "bytes"] * 2


def test_remapped_topics_match(make_node, wait_until):
    talker = make_node("talker", cli_args=["--ros-args", "-r", "chatter:=/elsewhere"])
    publisher = talker.create_publisher(String, "chatter", 10)
    listener = make_node("listener")
    listener.create_subscription(String, "/elsewhere", lambda _: None, 10)
    wait_until(lambda: publisher.get_subscription_count() == 1)


def test_destroyed_subscriptions_are_removed_from_the_graph(node, wait_until):
    subscription = node.create_subscription(String, "a", lambda _: None, 10)
    publisher = node.create_publisher(String, "a", 10)
    wait_until(lambda: subscription.get_publisher_count() == 1)
    node.destroy_subscription(subscription)
    wait_until(lambda: publisher.get_subscription_count() == 0)
    assert subscription.get_publisher_count() == 0


def test_waiting_for_one_message(node, wait_until):
    publisher = node.create_publisher(String, "a", 10)
    results = []
    thread = threading.Thread(target=lambda: results.append(wait_for_message(String, node, "a", time_to_wait=10)))
    thread.start()
    wait_until(lambda: publisher.get_subscription_count() == 1)
    publisher.publish(String(data="x"))
    thread.join(10)
    assert results == [(True, String(data="x"))]
    assert wait_for_message(String, node, "a", time_to_wait=0.01) == (False, None)


def test_log_messages_are_published_on_rosout(node, spin):
    got = []
    node.create_subscription(Log, "/rosout", got.append, 10)
    node.get_logger().get_child("hand").warn("careful")
    spin(lambda: got)
    assert (got[0].level, got[0].name, got[0].msg) == (30, "tester.hand", "careful")
    assert got[0].function == "test_log_messages_are_published_on_rosout"


def test_rosout_can_be_disabled(domain_id, make_node):
    assert make_node("loud").count_publishers("/rosout") == 1
    context = Context()
    context.init(["--ros-args", "--disable-rosout-logs"], domain_id=domain_id)
    quiet = rclpy.create_node("quiet", context=context)
    assert "quiet" not in [info.node_name for info in quiet.get_publishers_info_by_topic("/rosout")]
    quiet.destroy_node()
    context.shutdown()


def test_a_damaged_message_is_dropped_with_a_warning(context, node, wait_until, capfd):
    received = []
    executor = SingleThreadedExecutor(context=context)
    node.create_subscription(String, "chatter", received.append, 10)
    publisher = node.create_publisher(String, "chatter", 10)
    publisher.publish(b"\0\1\0\0\xff\xff\xff\xff")
    publisher.publish(String(data="whole"))
    wait_until(lambda: received, lambda: rclpy.spin_once(node, executor=executor, timeout_sec=0.1))
    assert received == [String(data="whole")]
    assert "Dropped a message on /chatter: std_msgs/msg/String: at byte" in capfd.readouterr().err
