# SPDX-License-Identifier: Apache-2.0
"""coframe and a program that follows rmw_zenoh_cpp's conventions by itself (`ros_peer.py`) communicate."""

import struct

import pytest

import coframe
from coframe import _core
from coframe.messages import codec, find
from coframe.wire import QoS, request_header
from coframe.wire.qos import TF_STATIC_WRITER
from coframe.wire.request_header import RequestHeader
from coframe.wire.zenoh import _services as services

STRING = find("std_msgs/msg/String")
TF_MESSAGE = find("tf2_msgs/msg/TFMessage")
TRANSFORM = find("geometry_msgs/msg/TransformStamped")
SET_BOOL = find("std_srvs/srv/SetBool")

STRING_KEY = "std_msgs::msg::dds_::String_/RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18"
SERVICE_QOS = QoS(depth=10)


def transforms(parent, child, *, x, stamp=1):
    transform = TRANSFORM(child_frame_id=child)
    transform.header.frame_id = parent
    transform.header.stamp.sec = stamp
    transform.transform.translation.x = x
    transform.transform.rotation.w = 1.0
    return codec.serialize(TF_MESSAGE(transforms=[transform]))


def knows_subscription(ros_peer, topic):
    """Return whether the peer knows a subscription, so that its messages are sent to it."""
    return any("/MS/" in token and f"/{topic.replace('/', '%')}/" in token for token in ros_peer("tokens"))


def numbers(attachment):
    sequence, _, size = struct.unpack_from("<qqB", bytes.fromhex(attachment))
    assert size == 16
    return sequence, attachment[34:]


def test_its_messages_arrive_with_the_name_of_its_node(participant, node, ros_peer, eventually):
    subscription = participant.subscription(node, "/chatter", STRING, QoS())
    eventually(lambda: knows_subscription(ros_peer, "/chatter"))
    ros_peer("publish", "/chatter", "std_msgs/msg/String", "::,10:,:,:,,", codec.serialize(STRING(data="hello")).hex())
    eventually(subscription.pending)
    (sample,) = subscription.take()
    assert codec.deserialize(sample.data, STRING).data == "hello"
    eventually(lambda: participant.writer_node(sample.writer) == "/talker")
    assert subscription.matched == 1
    (publisher,) = participant.publishers("/chatter")
    assert (publisher.node, publisher.ros_type, publisher.qos) == ("talker", "std_msgs/msg/String", QoS(depth=10))
    assert publisher.type_hash.startswith("RIHS01_df668c74")


def test_it_receives_our_messages(participant, node, ros_peer, eventually):
    ros_peer("subscribe", "/robot1/chatter", "std_msgs/msg/String", "::,10:,:,:,,")
    publisher = participant.publisher(node, "/robot1/chatter", STRING, QoS())
    eventually(lambda: publisher.matched == 1)
    messages = [codec.serialize(STRING(data=text)) for text in ("one", "two")]
    for message in messages:
        publisher.write(message)
    received = []
    eventually(lambda: received.extend(ros_peer("received")) or len(received) == 2)
    assert [entry[0] for entry in received] == [f"{participant.domain_id}/robot1/chatter/{STRING_KEY}"] * 2
    assert [bytes.fromhex(entry[1]) for entry in received] == messages
    assert [numbers(entry[2]) for entry in received] == [(1, publisher.guid.hex()), (2, publisher.guid.hex())]


def test_it_sees_our_nodes_and_endpoints(participant, node, ros_peer, eventually):
    participant.publisher(node, "/chatter", STRING, QoS(depth=7))
    own = [token for token in ros_peer("tokens") if "/tester" in token]
    eventually(lambda: own.extend(t for t in ros_peer("tokens") if "/tester" in t and t not in own) or len(own) == 2)
    publisher, described = sorted(own, key=lambda token: "/NN/" in token)
    _, domain, zid, number, same, kind, enclave, namespace, name = described.split("/")
    assert (domain, kind, enclave, namespace, name) == (str(participant.domain_id), "NN", "%", "%robot1", "tester")
    assert number == same
    assert zid != ros_peer.zid
    chunks = publisher.split("/")
    assert chunks[2:4] == [zid, number]
    assert chunks[4] != number
    assert publisher.endswith(f"/MP/%/%robot1/tester/%chatter/{STRING_KEY}/::,7:,:,:,,")
    node.close()
    eventually(lambda: not [token for token in ros_peer("tokens") if "/tester" in token])


def test_its_transforms_reach_a_buffer(participant, node, ros_peer, eventually):
    buffer = coframe.Buffer()
    reader = participant.tf_reader(node, "/tf", buffer, static=False, authority=None)
    kind, qos = "tf2_msgs/msg/TFMessage", "::,100:,:,:,,"
    eventually(lambda: knows_subscription(ros_peer, "/tf"))
    ros_peer("publish", "/tf", kind, qos, transforms("odom", "base_link", x=2.5).hex())
    eventually(lambda: buffer.can_transform("odom", "base_link"))
    assert buffer.lookup("odom", "base_link").translation[0] == 2.5
    (statistics,) = reader.writer_statistics()
    assert statistics.messages == 1
    eventually(lambda: participant.writer_node(statistics.writer) == "/talker")
    ros_peer("publish", "/tf", kind, qos, "00010000ffffff")  # damaged
    eventually(lambda: buffer.statistics["malformed"] == 1)


def test_static_transforms_reach_late_subscribers_in_both_directions(participant, node, ros_peer, eventually):
    kind, qos = "tf2_msgs/msg/TFMessage", ":1:,1:,:,:,,"
    theirs, ours = transforms("base_link", "laser", x=1.0), transforms("base_link", "camera", x=3.0)
    ros_peer("publish", "/tf_static", kind, qos, theirs.hex())
    participant.publisher(node, "/tf_static", TF_MESSAGE, TF_STATIC_WRITER).write(ours)
    buffer = coframe.Buffer()
    participant.tf_reader(node, "/tf_static", buffer, static=True)
    eventually(lambda: buffer.can_transform("laser", "camera"))
    ros_peer("subscribe", "/tf_static", kind, qos)
    received = []
    eventually(lambda: received.extend(ros_peer("received")) or len(received) == 2)
    assert {entry[1] for entry in received} == {theirs.hex(), ours.hex()}


def test_a_message_without_an_attachment_is_dropped_with_a_warning(participant, node, ros_peer, eventually, caplog):
    subscription = participant.subscription(node, "/chatter", STRING, QoS())
    cdr = codec.serialize(STRING(data="x")).hex()
    eventually(lambda: knows_subscription(ros_peer, "/chatter"))
    ros_peer("publish_without_attachment", "/chatter", "std_msgs/msg/String", cdr)
    ros_peer("publish", "/chatter", "std_msgs/msg/String", "::,10:,:,:,,", cdr)
    eventually(subscription.pending)
    assert len(subscription.take()) == 1
    assert "Messages on /chatter at the key" in caplog.text
    assert "do not have the attachment" in caplog.text


def test_lost_messages_are_counted(participant, node, ros_peer, eventually):
    subscription = participant.subscription(node, "/chatter", STRING, QoS(depth=3))
    cdr = codec.serialize(STRING(data="x")).hex()
    eventually(lambda: knows_subscription(ros_peer, "/chatter"))
    for _ in range(2):
        ros_peer("publish", "/chatter", "std_msgs/msg/String", "::,10:,:,:,,", cdr)
    eventually(lambda: len(subscription.take()) > 0)
    ros_peer("skip", "/chatter", 5)
    ros_peer("publish", "/chatter", "std_msgs/msg/String", "::,10:,:,:,,", cdr)
    statuses = []
    eventually(lambda: statuses.append(subscription.take_status(_core.SAMPLE_LOST)) or statuses[-1])
    assert statuses[-1][:2] == (5, 5)


def test_our_client_calls_its_service(participant, node, ros_peer, eventually):
    response = SET_BOOL.Response(success=True, message="done")
    ros_peer("serve", "/robot1/switch", "std_srvs/srv/SetBool", codec.serialize(response).hex())
    replies = participant.subscription(node, "/robot1/switch", SET_BOOL.Response, SERVICE_QOS, kind="reply")
    requests = participant.publisher(node, "/robot1/switch", SET_BOOL.Request, SERVICE_QOS, kind="request")
    eventually(lambda: requests.matched == 1 and replies.matched == 1)
    request = codec.serialize(SET_BOOL.Request(data=True))
    header = RequestHeader(0x1234567890, 1)
    requests.write(request_header.join(header, request))
    eventually(replies.pending)
    (reply,) = replies.take()
    returned, cdr = request_header.split(reply.data)
    assert returned == header
    assert codec.deserialize(cdr, SET_BOOL.Response) == response
    (seen,) = ros_peer("received")
    assert seen[0].startswith(f"{participant.domain_id}/robot1/switch/std_srvs::srv::dds_::SetBool_/RIHS01_abe9e4bb")
    assert seen[1] == request.hex()
    assert numbers(seen[2]) == (1, requests.guid.hex())


def test_replies_that_are_not_understood_are_counted(participant, node, ros_peer, eventually, caplog):
    response = codec.serialize(SET_BOOL.Response(success=True, message="done"))
    wrong = [b"", bytes(7), struct.pack("<qqB16s", 1, 0, 16, b"another client"), struct.pack("<qqB16s", 2, 0, 15, b"")]
    ros_peer("serve", "/switch", "std_srvs/srv/SetBool", response.hex(), *[each.hex() for each in wrong])
    replies = participant.subscription(node, "/switch", SET_BOOL.Response, SERVICE_QOS, kind="reply")
    requests = participant.publisher(node, "/switch", SET_BOOL.Request, SERVICE_QOS, kind="request")
    eventually(lambda: requests.matched == 1 and replies.matched == 1)
    for number in (1, 2):
        header = RequestHeader(7, number)
        requests.write(request_header.join(header, codec.serialize(SET_BOOL.Request(data=True))))
        taken = []
        eventually(lambda taken=taken: taken.extend(replies.take()) or taken)
        assert [request_header.split(reply.data) for reply in taken] == [(header, response)]
    eventually(lambda: requests._endpoint.ignored == 8)
    [warning] = [record.message for record in caplog.records if "/switch" in record.message]
    assert warning.startswith(
        "A reply of /switch is ignored, because it is not a reply of rmw_zenoh_cpp to this client. "
    )


def test_its_client_calls_our_service(participant, node, ros_peer, eventually):
    replies = participant.publisher(node, "/switch", SET_BOOL.Response, SERVICE_QOS, kind="reply")
    requests = participant.subscription(node, "/switch", SET_BOOL.Request, SERVICE_QOS, kind="request")
    eventually(lambda: [token for token in ros_peer("tokens") if "/SS/" in token])
    request = codec.serialize(SET_BOOL.Request(data=True))
    ros_peer("call", "/switch", "std_srvs/srv/SetBool", request.hex())
    eventually(lambda: requests.pending() and replies.matched == 1)
    (received,) = requests.take()
    header, cdr = request_header.split(received.data)
    assert (header.sequence, cdr) == (1, request)
    response = codec.serialize(SET_BOOL.Response(success=True, message="on"))
    replies.write(request_header.join(header, response))
    answers = []
    eventually(lambda: answers.extend(ros_peer("received")) or len(answers) == 2)
    (_, _, gid), (_, answer, attachment) = answers
    assert answer == response.hex()
    assert numbers(attachment) == (1, gid)
    assert participant.services() == {"/switch": ["std_srvs/srv/SetBool_Request", "std_srvs/srv/SetBool_Response"]}


def test_requests_that_a_service_does_not_answer_are_bounded(
    participant, node, ros_peer, eventually, monkeypatch, caplog
):
    monkeypatch.setattr(services, "KEEP_ALL", 5)
    participant.publisher(node, "/switch", SET_BOOL.Response, SERVICE_QOS, kind="reply")
    requests = participant.subscription(node, "/switch", SET_BOOL.Request, QoS(3), kind="request")
    eventually(lambda: [token for token in ros_peer("tokens") if "/SS/" in token])
    pending = requests._endpoint._table._requests
    request = codec.serialize(SET_BOOL.Request(data=True))

    def call(count):
        for _ in range(count):
            ros_peer("call", "/switch", "std_srvs/srv/SetBool", request.hex())

    def waiting():
        return [header.sequence for known in pending.values() for header in known]

    call(7)
    eventually(lambda: waiting() == [5, 6, 7])
    assert [request_header.split(sample.data)[0].sequence for sample in requests.take()] == [5, 6, 7]
    call(3)
    eventually(lambda: waiting() == [6, 7, 8, 9, 10])
    eventually(lambda: requests._endpoint.dropped == 5)
    assert [record.message for record in caplog.records] == [
        "Requests of /switch are dropped: 3 wait for the node, or 5 for a response."
    ]
    ros_peer("call", "/switch", "std_srvs/srv/SetBool", b"\x09\x09\0\0\1".hex())
    eventually(lambda: "was not sent by rmw_zenoh_cpp" in caplog.text)
    assert waiting() == [6, 7, 8, 9, 10]


def test_a_killed_node_leaves_the_graph(participant, ros_peer, eventually):
    ros_peer("publish", "/chatter", "std_msgs/msg/String", "::,10:,:,:,,", "0001000001000000" + "00")
    eventually(lambda: ("/", "talker") in participant.nodes() and "/chatter" in participant.topics())
    ros_peer.process.kill()
    eventually(lambda: participant.nodes() == [] and participant.topics() == {})


def test_an_unknown_type_is_received_and_announced_once_its_hash_is_known(
    participant, node, ros_peer, eventually, caplog
):
    # This process does not know the type, as if std_msgs were a package of the user.
    endpoint = "custom_msgs/msg/Thing"
    subscription = participant.raw_subscription(node, "/thing", endpoint, QoS())
    assert "The definition of custom_msgs/msg/Thing on /thing is unknown" in caplog.text
    with pytest.raises(coframe.errors.WireError, match="needs the definition of custom_msgs/msg/Thing"):
        participant.raw_publisher(node, "/thing", endpoint, QoS())
    message = "/thing", "custom_msgs::msg::dds_::Thing_", "ab" * 32, "00010000" + "2a000000"
    eventually(lambda: ros_peer("publish_type", *message) or subscription.pending())
    assert subscription.take()[0].data == bytes.fromhex("000100002a000000")
    eventually(lambda: [token for token in ros_peer("tokens") if "/MS/" in token and "Thing_/RIHS01_abab" in token])
    participant.raw_publisher(node, "/thing", endpoint, QoS())  # the hash is known from the other node


def test_a_client_does_not_displace_the_requests_of_others(participant, node, ros_peer, eventually):
    other = participant.add_node("/", "other")
    requests = participant.subscription(node, "/switch", SET_BOOL.Request, QoS(10), kind="request")
    client = participant.publisher(other, "/switch", SET_BOOL.Request, SERVICE_QOS, kind="request")
    request = codec.serialize(SET_BOOL.Request(data=True))
    eventually(lambda: client.matched == 1 and [token for token in ros_peer("tokens") if "/SS/" in token])
    client.write(request_header.join(RequestHeader(1, 77), request))
    eventually(requests.pending)
    for _ in range(30):
        ros_peer("call", "/switch", "std_srvs/srv/SetBool", request.hex())
    eventually(lambda: requests._endpoint.dropped == 21)
    numbers = [request_header.split(sample.data)[0].sequence for sample in requests.take()]
    assert numbers == [77, *range(22, 31)]
