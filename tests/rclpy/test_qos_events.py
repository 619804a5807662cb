# SPDX-License-Identifier: Apache-2.0
"""Deadlines, liveliness, lifespan and incompatible QoS: enforced, reported by callbacks and logged."""

import time

import pytest

import rclpy
import tf2_ros
from rclpy import event_handler, qos_event
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.duration import Duration
from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import DurabilityPolicy, LivelinessPolicy, QoSPolicyKind, QoSProfile, ReliabilityPolicy
from std_msgs.msg import Int32, String
from tf2_msgs.msg import TFMessage

DEADLINE = QoSProfile(depth=1, deadline=Duration(nanoseconds=100_000_000))
BEST_EFFORT = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)


@pytest.fixture
def spin(context, node, wait_until):
    """Return a function that spins the node until a condition is true."""
    executor = SingleThreadedExecutor(context=context)
    return lambda condition: wait_until(
        condition, lambda: rclpy.spin_once(node, executor=executor, timeout_sec=0.05), timeout=10
    )


@pytest.mark.dds_only("Zenoh has no deadlines")
def test_missed_deadlines_are_reported_on_both_sides(node, spin):
    offered, requested, received = [], [], []
    publisher = node.create_publisher(
        String, "chatter", DEADLINE, event_callbacks=PublisherEventCallbacks(deadline=offered.append)
    )
    node.create_subscription(
        String,
        "chatter",
        received.append,
        DEADLINE,
        event_callbacks=SubscriptionEventCallbacks(deadline=requested.append),
    )
    publisher.publish(String())
    spin(lambda: offered and requested and received)
    assert offered[0].total_count >= 1
    assert offered[0].total_count_change >= 1
    assert isinstance(requested[0], qos_event.QoSRequestedDeadlineMissedInfo)


@pytest.mark.dds_only("over Zenoh, a publisher is alive as long as its session")
def test_a_publisher_that_does_not_assert_its_liveliness_is_lost(node, spin):
    lost, changed = [], []
    qos = QoSProfile(
        depth=1,
        liveliness=LivelinessPolicy.MANUAL_BY_TOPIC,
        liveliness_lease_duration=Duration(nanoseconds=200_000_000),
    )
    publisher = node.create_publisher(
        String, "chatter", qos, event_callbacks=PublisherEventCallbacks(liveliness=lost.append)
    )
    node.create_subscription(
        String, "chatter", print, qos, event_callbacks=SubscriptionEventCallbacks(liveliness=changed.append)
    )
    publisher.assert_liveliness()
    spin(lambda: any(event.alive_count == 1 for event in changed))
    spin(lambda: lost and changed[-1].not_alive_count == 1)
    assert lost[0].total_count == 1
    publisher.publish(String())
    spin(lambda: changed[-1].alive_count == 1)


def test_matches_are_reported(node, spin):
    publisher_side, subscription_side = [], []
    callbacks = SubscriptionEventCallbacks(matched=subscription_side.append)
    node.create_subscription(String, "chatter", print, 1, event_callbacks=callbacks)
    publisher = node.create_publisher(
        String, "chatter", 1, event_callbacks=PublisherEventCallbacks(matched=publisher_side.append)
    )
    spin(lambda: publisher_side and subscription_side)
    assert (publisher_side[0].current_count, subscription_side[0].current_count) == (1, 1)
    assert node.destroy_publisher(publisher)
    spin(lambda: subscription_side[-1].current_count == 0)
    assert len(list(node.waitables)) == 1


@pytest.mark.dds_only("over Zenoh, quality of service does not prevent communication")
def test_incompatible_qos_is_reported_to_callbacks(node, spin, capfd):
    offered, requested = [], []
    node.create_subscription(
        String, "chatter", print, 1, event_callbacks=SubscriptionEventCallbacks(incompatible_qos=requested.append)
    )
    node.create_publisher(
        String, "chatter", BEST_EFFORT, event_callbacks=PublisherEventCallbacks(incompatible_qos=offered.append)
    )
    spin(lambda: offered and requested)
    assert (offered[0].total_count, offered[0].last_policy_kind) == (1, QoSPolicyKind.RELIABILITY)
    assert (requested[0].total_count, requested[0].last_policy_kind) == (1, QoSPolicyKind.RELIABILITY)
    assert "incompatible" not in capfd.readouterr().err


@pytest.mark.dds_only("over Zenoh, quality of service does not prevent communication")
@pytest.mark.parametrize(
    ("offered", "requested", "policy"),
    [
        ({"reliability": ReliabilityPolicy.BEST_EFFORT}, {}, "RELIABILITY"),
        ({}, {"durability": DurabilityPolicy.TRANSIENT_LOCAL}, "DURABILITY"),
        ({"deadline": Duration(seconds=5)}, {"deadline": Duration(seconds=1)}, "DEADLINE"),
        ({"liveliness": LivelinessPolicy.AUTOMATIC}, {"liveliness": LivelinessPolicy.MANUAL_BY_TOPIC}, "LIVELINESS"),
    ],
)
def test_incompatible_qos_is_logged_once_on_each_side(make_node, wait_until, printed, offered, requested, policy):
    node = make_node("talker")
    publisher = node.create_publisher(String, "chatter", QoSProfile(depth=1, **offered))
    node.create_subscription(String, "chatter", print, QoSProfile(depth=1, **requested))
    wait_until(lambda: printed().count("Last incompatible policy") == 2)
    warnings = [line for line in printed().splitlines() if line.startswith("[WARN]")]
    assert [line.split("]: ")[1] for line in sorted(warnings, key=lambda line: line.split("]: ")[1])] == [
        (
            f"New publisher discovered on topic 'chatter', offering incompatible QoS. "
            f"No messages will be received from it. Last incompatible policy: {policy}"
        ),
        (
            f"New subscription discovered on topic 'chatter', requesting incompatible QoS. "
            f"No messages will be sent to it. Last incompatible policy: {policy}"
        ),
    ]
    assert all("[talker]: " in line for line in warnings)
    assert publisher.get_subscription_count() == 0


@pytest.mark.cyclone_only("Fast DDS refuses a second type of a topic in one process")
def test_another_type_is_reported(node, spin):
    found = []
    callbacks = SubscriptionEventCallbacks(incompatible_type=found.append)
    node.create_subscription(String, "chatter", print, 1, event_callbacks=callbacks)
    node.create_publisher(Int32, "chatter", 1, event_callbacks=PublisherEventCallbacks(use_default_callbacks=False))
    spin(lambda: found)
    assert found == [event_handler.IncompatibleTypeInfo(1, 1)]


@pytest.mark.dds_only("Zenoh has no lifespan of messages")
def test_expired_messages_are_not_delivered_to_late_subscriptions(node, spin):
    """As on /rosout, whose messages live for 10 s."""
    short = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL, lifespan=Duration(nanoseconds=50_000_000))
    publisher = node.create_publisher(String, "chatter", short)
    publisher.publish(String(data="old"))
    time.sleep(0.1)
    received = []
    late = QoSProfile(depth=10, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    node.create_subscription(String, "chatter", received.append, late)
    publisher.publish(String(data="new"))
    spin(lambda: received)
    assert received == [String(data="new")]
    [info] = node.get_publishers_info_by_topic("/rosout")
    assert info.qos_profile.lifespan == Duration(seconds=10)
    [info] = node.get_publishers_info_by_topic("chatter")
    assert info.qos_profile.lifespan == Duration(nanoseconds=50_000_000)
    assert publisher.wait_for_all_acked(Duration(seconds=5))


def test_a_handler_is_a_waitable(node):
    callbacks = PublisherEventCallbacks(deadline=print)
    publisher = node.create_publisher(String, "chatter", 1, event_callbacks=callbacks)
    [handler] = publisher.event_handlers
    assert isinstance(handler, qos_event.QoSEventHandler)
    assert handler.get_num_entities().num_events == 1
    assert handler.take_data() is None
    assert isinstance(handler.callback_group, MutuallyExclusiveCallbackGroup)
    assert not handler.is_ready(None)


@pytest.mark.dds_only("over Zenoh, quality of service does not prevent communication")
def test_a_listener_with_another_qos_is_logged_by_its_node(make_node, wait_until, printed):
    node = make_node("looker")
    broadcaster = node.create_publisher(TFMessage, "/tf", BEST_EFFORT)
    listener = tf2_ros.TransformListener(tf2_ros.Buffer(), node)
    wait_until(lambda: printed().count("Last incompatible policy: RELIABILITY") == 2)
    assert "[looker]: New publisher discovered on topic '/tf', offering incompatible QoS." in printed()
    assert broadcaster.get_subscription_count() == listener.tf_sub.get_publisher_count() == 0
