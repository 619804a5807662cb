# SPDX-License-Identifier: Apache-2.0
import struct
import threading

import pytest

from coframe import WireError
from coframe._core import Event
from coframe.messages import codec, find
from coframe.messages.native_codec import native_codec
from coframe.wire import QoS

STRING = find("std_msgs/msg/String")
TF_MESSAGE = find("tf2_msgs/msg/TFMessage")

ECHO = """
    import coframe
    from coframe.messages import find
    STRING = find("std_msgs/msg/String")
    with coframe.connect("echo") as ros:
        publisher = ros.publisher("/back", STRING)
        for message in ros.subscribe("/there", STRING):
            publisher.publish(STRING(data=message.data.upper()))
            if message.data == "end":
                break
        input()
"""


def test_messages_are_exchanged_between_processes(participant, node, child, eventually):
    arrived = Event()
    there = participant.publisher(node, "/there", STRING, QoS())
    back = participant.subscription(node, "/back", STRING, QoS(), on_data=arrived)
    other = child(ECHO)
    eventually(lambda: there.matched == 1 and back.matched == 1)
    arrived.clear()
    for text in ("hello", "grüß Gott", "end"):
        there.write(codec.serialize(STRING(data=text)))
    received = []
    while len(received) < 3:
        assert arrived.wait(10_000_000_000)
        received += back.take()
    assert [codec.deserialize(s.data, STRING).data for s in received] == ["HELLO", "GRÜSS GOTT", "END"]
    assert all(sample.source_timestamp > 1_600_000_000_000_000_000 for sample in received)
    eventually(lambda: participant.writer_node(received[0].writer) == "/echo")
    assert other.finish() == (0, "")
    eventually(lambda: back.matched == 0)
    assert participant.writer_node(received[0].writer) == "/echo", (
        "the name is kept for some time after the node has left"
    )


@pytest.mark.dds_only("only writers of DDS are native")
@pytest.mark.parametrize("of_items", [False, True])
def test_publishing_directly(participant, node, eventually, of_items):
    publisher = participant.publisher(node, "/tf", TF_MESSAGE, QoS())
    subscription = participant.subscription(node, "/tf", TF_MESSAGE, QoS(), on_data=None)
    closed = Event()
    publish = publisher.direct(native_codec(TF_MESSAGE), closed, lambda error: error, of_items=of_items)
    transforms = [find("geometry_msgs/msg/TransformStamped")(child_frame_id=name) for name in "ab"]
    message = TF_MESSAGE(transforms=transforms)
    assert publish(transforms if of_items else message) is True
    assert publish(transforms[0] if of_items else TF_MESSAGE()) is True
    for other in (message if of_items else transforms, iter(transforms), "text", None, STRING()):
        assert publish(other) is False
    taken = []
    eventually(lambda: taken.extend(subscription.take()) or len(taken) == 2)
    children = [[t.child_frame_id for t in codec.deserialize(s.data, TF_MESSAGE).transforms] for s in taken]
    assert children == [["a", "b"], ["a"] if of_items else []]
    closed.set()
    assert publish(transforms if of_items else message) is False
    closed.clear()
    publisher.close()
    assert publish(transforms if of_items else message) is False


@pytest.mark.dds_only("only writers of DDS are native")
def test_errors_of_publishing_directly(participant, node):
    """The text of DDS becomes a WireError, and the caller chooses the exception."""
    publisher = participant.publisher(node, "/tf", TF_MESSAGE, QoS())
    publish = publisher.direct(native_codec(STRING), Event(), KeyError)  # Transforms are checked before they are sent.
    # The second text is that of Fast DDS.
    with pytest.raises(KeyError, match=r"failed: could not write: (Bad Parameter|the message is not valid)") as info:
        publish(STRING(data="not transforms"))
    assert isinstance(info.value.args[0], WireError)


def test_pending_and_limit(participant, node, eventually):
    publisher = participant.publisher(node, "/chatter", STRING, QoS())
    subscription = participant.subscription(node, "/chatter", STRING, QoS(), on_data=None)
    assert subscription.take() == []
    assert not subscription.pending()
    for text in "abc":
        publisher.write(codec.serialize(STRING(data=text)))
    taken = []
    eventually(lambda: taken.extend(subscription.take(limit=2 - len(taken))) or len(taken) == 2)
    eventually(subscription.pending)
    assert [codec.deserialize(sample.data, STRING).data for sample in subscription.take()] == ["c"]
    assert not subscription.pending()


def test_keep_last_keeps_the_last_messages(participant, node, eventually):
    publisher = participant.publisher(node, "/chatter", STRING, QoS())
    every = participant.subscription(node, "/chatter", STRING, QoS(), on_data=None)
    subscription = participant.subscription(node, "/chatter", STRING, QoS(depth=2), on_data=None)
    for text in "abcde":
        publisher.write(codec.serialize(STRING(data=text)))
    arrived = []
    eventually(lambda: arrived.extend(every.take()) or len(arrived) == 5)
    last = []
    eventually(lambda: last.extend(subscription.take()) or len(last) == 2)
    assert [codec.deserialize(sample.data, STRING).data for sample in last] == ["d", "e"]


def test_a_large_message(participant, node, child):
    other = child("""
        import coframe
        from coframe.messages import find
        with coframe.connect("large") as ros:
            publisher = ros.publisher("/large", find("std_msgs/msg/UInt8MultiArray"))
            while not publisher.matched:
                pass
            publisher.publish(find("std_msgs/msg/UInt8MultiArray")(data=bytes(range(256)) * 20_000))
            input()
    """)
    arrived = Event()
    kind = find("std_msgs/msg/UInt8MultiArray")
    subscription = participant.subscription(node, "/large", kind, QoS(), on_data=arrived)
    samples = subscription.take()
    while not samples:
        assert arrived.wait(20_000_000_000)
        samples = subscription.take()
    assert bytes(codec.deserialize(samples[0].data, kind).data) == bytes(range(256)) * 20_000
    assert other.finish() == (0, "")


def test_bytes_without_a_header_raise_an_error(participant, node):
    publisher = participant.publisher(node, "/chatter", STRING, QoS())
    with pytest.raises(ValueError, match="4 bytes of encapsulation"):
        publisher.write(b"\0\1")


def test_bytes_that_are_not_transforms_raise_an_error(participant, node):
    publisher = participant.publisher(node, "/tf", TF_MESSAGE, QoS())
    good = codec.serialize(TF_MESSAGE(transforms=[find("geometry_msgs/msg/TransformStamped")()]))
    publisher.write(good)
    for bad in (good[:-1], good + b"four", good[:4], b"\0\1\0\0\xff\xff\xff\xff", b"\1" + good[1:]):
        with pytest.raises(WireError, match="Publishing on /tf failed") as caught:
            publisher.write(bad)
        assert "must be the CDR serialization of a tf2_msgs/msg/TFMessage" in caught.value.hint


@pytest.mark.dds_only("the other program is an RTPS program")
def test_transforms_are_received_by_programs_that_check_types(participant, node, child, eventually):
    arrived = Event()
    there = participant.publisher(node, "/there", TF_MESSAGE, QoS())
    here = participant.subscription(node, "/there", TF_MESSAGE, QoS())
    back = participant.subscription(node, "/back", STRING, QoS(), on_data=arrived)
    other = child("""
        import coframe
        from coframe.messages import find
        with coframe.connect("reader") as ros:
            publisher = ros.publisher("/back", find("std_msgs/msg/String"))
            message = next(iter(ros.subscribe("/there", find("tf2_msgs/msg/TFMessage"))))
            publisher.publish(find("std_msgs/msg/String")(data=message.transforms[0].child_frame_id))
            input()
    """)
    eventually(lambda: there.matched == 2 and back.matched == 1)
    stamped = find("geometry_msgs/msg/TransformStamped")(child_frame_id="lidar")
    data = codec.serialize(TF_MESSAGE(transforms=[stamped]))
    arrived.clear()
    there.write(data)
    assert [sample.data for sample in here.take()] == [data], "in this process"
    assert arrived.wait(10_000_000_000)
    assert [codec.deserialize(sample.data, STRING).data for sample in back.take()] == ["lidar"], "in another one"
    assert other.finish() == (0, "")


def test_a_publisher_of_transforms_can_be_closed_while_another_thread_writes(participant, node):
    data = codec.serialize(TF_MESSAGE(transforms=[find("geometry_msgs/msg/TransformStamped")()]))
    for _ in range(20):
        publisher = participant.publisher(node, "/tf", TF_MESSAGE, QoS())
        begun, errors = threading.Event(), []

        def write(publisher=publisher, begun=begun, errors=errors):
            try:
                while True:
                    publisher.write(data)
                    begun.set()
            except WireError as error:
                errors.append(str(error))

        writer = threading.Thread(target=write)
        writer.start()
        assert begun.wait(10)
        publisher.close()
        writer.join(10)
        assert errors == ["The publisher on /tf is closed."]


@pytest.mark.cyclone_only("the other program is found by multicast, which Fast DDS does not use on one machine")
def test_an_independent_program_publishes_receives_and_lists(beside_rosless):
    beside_rosless("""
        publisher = participant.publisher(node, "/ours", STRING, QoS())
        subscription = participant.subscription(node, "/theirs", STRING, QoS())
        theirs = peer.advertise("/theirs", "std_msgs/msg/String")
        from_coframe = peer.subscribe("/ours", "std_msgs/msg/String", reliability="reliable")
        eventually(lambda: publisher.matched and subscription.matched and theirs.subscriber_count)
        publisher.write(codec.serialize(STRING(data="from coframe")))
        assert from_coframe.read(10).data == "from coframe"
        theirs.send({"data": "from rosless"})
        eventually(lambda: [codec.deserialize(s.data, STRING).data for s in subscription.take()] == ["from rosless"])
        listed = {topic.name: topic.type_name for topic in peer.graph().topics}
        assert listed["/ours"] == listed["/theirs"] == "std_msgs/msg/String"
    """)


@pytest.mark.cyclone_only("the header of requests is that of rmw_cyclonedds")
def test_service_messages_contain_the_header_of_rmw(participant, node):
    request = find("std_srvs/srv/SetBool_Request")
    arrived = Event()
    client = participant.publisher(node, "/light", request, QoS(), kind="request")
    server = participant.subscription(node, "/light", request, QoS(), on_data=arrived, kind="request")
    cdr = codec.serialize(request(data=True))
    client.write(cdr[:4] + struct.pack("<Qq", 77, 1) + cdr[4:])
    assert arrived.wait(10_000_000_000)
    (sample,) = server.take()
    assert struct.unpack_from("<Qq?", sample.data, 4) == (77, 1, True)
    assert participant.services() == {"/light": ["std_srvs/srv/SetBool_Request"]}
    assert participant.publishers("/light", kind="request")[0].ros_type == "std_srvs/srv/SetBool_Request"


@pytest.mark.parametrize(
    "name",
    [
        "sensor_msgs/msg/PointCloud2",
        "sensor_msgs/msg/Imu",
        "nav_msgs/msg/Odometry",
        "rcl_interfaces/msg/ParameterEvent",
        "rcl_interfaces/srv/GetParameters_Request",
        "visualization_msgs/msg/MarkerArray",
        "std_msgs/msg/Empty",
        "std_msgs/msg/Byte",
        "std_msgs/msg/Char",
        "tf2_msgs/action/LookupTransform_Feedback",
        "action_msgs/msg/GoalStatusArray",
        "example_interfaces/msg/WString",
    ],
)
def test_messages_of_many_types_are_exchanged(name, participant, node, eventually):
    kind = find(name)
    publisher = participant.publisher(node, "/any", kind, QoS())
    subscription = participant.subscription(node, "/any", kind, QoS(), on_data=None)
    publisher.write(codec.serialize(kind()))
    eventually(subscription.pending)
    (sample,) = subscription.take()
    assert codec.deserialize(sample.data, kind) == kind()
