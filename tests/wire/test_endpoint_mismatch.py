# SPDX-License-Identifier: Apache-2.0
import logging

import pytest

from coframe.messages import find
from coframe.wire import QoS
from coframe.wire.qos import SENSOR

STRING = find("std_msgs/msg/String")
INT32 = find("std_msgs/msg/Int32")

CHILD = """
    import coframe
    from coframe.messages import find
    from coframe.wire import QoS
    with coframe.connect("{node}") as ros:
        kind = find("{type}")
        endpoint = ros.{what}("/scan", kind, qos={qos})
        input()
"""


@pytest.fixture
def warnings(participant):
    received: list[str] = []
    participant.on_warning(received.append)
    return received


def other(child, node="talker", what="publisher", ros_type="std_msgs/msg/String", qos="QoS()"):
    return child(CHILD.format(node=node, what=what, type=ros_type, qos=qos))


@pytest.mark.dds_only("over Zenoh, quality of service does not prevent communication")
def test_a_best_effort_publisher_for_a_reliable_subscription(participant, node, child, warnings, eventually):
    participant.subscription(node, "/scan", STRING, QoS(), on_data=None)
    other(child, qos="QoS(reliable=False)")
    eventually(lambda: warnings)
    assert warnings == [
        (
            "Node /talker offers best-effort on /scan, but this subscription requests reliable: no messages will "
            "arrive. Request best-effort (qos_profile_sensor_data), or make the publisher reliable."
        )
    ]


@pytest.mark.dds_only("over Zenoh, quality of service does not prevent communication")
def test_a_reliable_subscriber_for_a_best_effort_publisher(participant, node, child, warnings, eventually):
    participant.publisher(node, "/scan", STRING, SENSOR)
    other(child, node="listener", what="subscribe")
    eventually(lambda: warnings)
    assert warnings == [
        (
            "Node /listener requests reliable on /scan, but this publisher offers best-effort: no messages will "
            "arrive. Request best-effort (qos_profile_sensor_data), or make the publisher reliable."
        )
    ]


@pytest.mark.dds_only("over Zenoh, quality of service does not prevent communication")
def test_a_volatile_publisher_for_a_transient_local_subscription(participant, node, child, warnings, eventually):
    participant.subscription(node, "/scan", STRING, QoS(transient_local=True), on_data=None)
    other(child)
    eventually(lambda: warnings)
    assert "/talker offers volatile on /scan, but this subscription requests transient-local" in warnings[0]


def test_a_different_type_on_the_topic(participant, node, child, warnings, eventually):
    participant.subscription(node, "/scan", STRING, QoS(), on_data=None)
    other(child, ros_type="std_msgs/msg/Int32")
    eventually(lambda: warnings)
    assert warnings == [
        (
            "Node /talker publishes std_msgs/msg/Int32 on /scan, but this subscription expects std_msgs/msg/String: "
            "no messages will arrive. Use the same message type, or another topic name."
        )
    ]


@pytest.mark.dds_only("over Zenoh, quality of service does not prevent communication")
def test_a_mismatch_within_this_process_is_reported_once(participant, node, warnings, eventually):
    participant.publisher(node, "/scan", STRING, SENSOR)
    participant.subscription(node, "/scan", STRING, QoS(), on_data=None)
    eventually(lambda: len(warnings) == 1)
    assert warnings[0].startswith("Node /tester offers best-effort on /scan")


@pytest.mark.cyclone_only("Fast DDS refuses a second type of a topic in one process")
def test_a_second_type_within_this_process_is_reported_once(participant, node, warnings, eventually):
    participant.subscription(node, "/done", STRING, QoS(), on_data=None)
    participant.publisher(node, "/done", INT32, QoS())
    eventually(lambda: len(warnings) == 1)
    assert warnings[0].startswith("Node /tester publishes std_msgs/msg/Int32 on /done")


@pytest.mark.dds_only("the other program is an RTPS program")
def test_a_mismatch_with_an_endpoint_that_has_no_node(beside_rosless):
    beside_rosless("""
        warnings = []
        participant.on_warning(warnings.append)
        participant.subscription(node, "/scan", STRING, QoS())
        publisher = peer.advertise("/scan", "std_msgs/msg/String", reliability="best_effort")
        eventually(lambda: warnings)
        assert warnings[0].startswith("An unnamed node offers best-effort on /scan"), warnings
    """)


@pytest.mark.dds_only("over Zenoh, quality of service does not prevent communication")
def test_warnings_are_logged_if_there_is_no_callback(participant, node, caplog, eventually):
    with caplog.at_level(logging.WARNING, logger="coframe.wire"):
        participant.publisher(node, "/scan", STRING, SENSOR)
        participant.subscription(node, "/scan", STRING, QoS(), on_data=None)
        eventually(lambda: "offers best-effort" in caplog.text)


def test_matching_endpoints_cause_no_warning(participant, node, child, warnings, eventually):
    subscription = participant.subscription(node, "/scan", STRING, SENSOR, on_data=None)
    other(child)
    eventually(lambda: subscription.matched)
    eventually(lambda: ("/", "talker") in participant.nodes())
    assert warnings == []
