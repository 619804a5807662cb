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
    heard: list[str] = []
    participant.on_warning(heard.append)
    return heard


def other(child, node="talker", what="publisher", ros_type="std_msgs/msg/String", qos="QoS()"):
    return child(CHILD.format(node=node, what=what, type=ros_type, qos=qos))


def test_a_best_effort_publisher_for_a_reliable_subscription(participant, node, child, warnings, eventually):
    participant.subscription(node, "/scan", STRING, QoS(), on_data=None)
    other(child, qos="QoS(reliable=False)")
    eventually(lambda: warnings)
    assert warnings == [
        (
            "node /talker on /scan offers best-effort, but this subscription asks for reliable: nothing will arrive. "
            "Ask for best-effort (qos_profile_sensor_data) or make the publisher reliable."
        )
    ]


def test_a_reliable_subscriber_for_a_best_effort_publisher(participant, node, child, warnings, eventually):
    participant.publisher(node, "/scan", STRING, SENSOR)
    other(child, node="listener", what="subscribe")
    eventually(lambda: warnings)
    assert warnings == [
        (
            "node /listener on /scan asks for reliable, but this publisher offers best-effort: nothing will arrive. "
            "Ask for best-effort (qos_profile_sensor_data) or make the publisher reliable."
        )
    ]


def test_a_volatile_publisher_for_a_transient_local_subscription(participant, node, child, warnings, eventually):
    participant.subscription(node, "/scan", STRING, QoS(transient_local=True), on_data=None)
    other(child)
    eventually(lambda: warnings)
    assert "/talker on /scan offers volatile, but this subscription asks for transient-local" in warnings[0]


def test_another_type_on_the_topic(participant, node, child, warnings, eventually):
    participant.subscription(node, "/scan", STRING, QoS(), on_data=None)
    other(child, ros_type="std_msgs/msg/Int32")
    eventually(lambda: warnings)
    assert warnings == [
        (
            "node /talker on /scan publishes std_msgs/msg/Int32, but this subscription expects std_msgs/msg/String: "
            "nothing will arrive. Use one message type, or another topic name."
        )
    ]


def test_two_endpoints_of_this_process_are_told_of_once(participant, node, warnings, eventually):
    participant.publisher(node, "/scan", STRING, SENSOR)
    participant.subscription(node, "/scan", STRING, QoS(), on_data=None)
    participant.subscription(node, "/done", STRING, QoS(), on_data=None)
    participant.publisher(node, "/done", INT32, QoS())
    eventually(lambda: len(warnings) == 2)
    assert warnings[0].startswith("node /tester on /scan offers best-effort")
    assert warnings[1].startswith("node /tester on /done publishes std_msgs/msg/Int32")


def test_a_peer_without_a_name(beside_rosless):
    beside_rosless("""
        warnings = []
        participant.on_warning(warnings.append)
        participant.subscription(node, "/scan", STRING, QoS())
        publisher = peer.advertise("/scan", "std_msgs/msg/String", reliability="best_effort")
        eventually(lambda: warnings)
        assert warnings[0].startswith("an unnamed node on /scan offers best-effort"), warnings
    """)


def test_without_a_callback_the_log_has_it(participant, node, caplog, eventually):
    with caplog.at_level(logging.WARNING, logger="coframe.wire"):
        participant.publisher(node, "/scan", STRING, SENSOR)
        participant.subscription(node, "/scan", STRING, QoS(), on_data=None)
        eventually(lambda: "offers best-effort" in caplog.text)


def test_another_definition_of_the_same_type(participant, node, child, warnings, eventually):
    participant.subscription(node, "/scan", STRING, QoS(), on_data=None)
    child("""
        import coframe
        from coframe.messages import find
        int32 = find("std_msgs/msg/Int32")
        class Liar:
            ROS_TYPE = "std_msgs/msg/String"
            SLOT_TYPES = int32.SLOT_TYPES
            get_fields_and_field_types = int32.get_fields_and_field_types
        with coframe.connect("liar") as ros:
            publisher = ros.publisher("/scan", Liar)
            input()
    """)
    eventually(lambda: warnings)
    assert warnings == [
        (
            "node /liar on /scan has another definition of std_msgs/msg/String than this subscription: nothing will "
            "arrive. Use the same message definitions and the same quality of service on both sides."
        )
    ]


def test_what_fits_is_not_told_of(participant, node, child, warnings, eventually):
    subscription = participant.subscription(node, "/scan", STRING, SENSOR, on_data=None)
    other(child)
    eventually(lambda: subscription.matched)
    eventually(lambda: ("/", "talker") in participant.nodes())
    assert warnings == []
