# SPDX-License-Identifier: Apache-2.0
"""Keys, tokens, identifiers, attachments and QoS to the letter of rmw_zenoh_cpp. The values are those of ROS 2."""

import dataclasses

import pytest
from hypothesis import given
from hypothesis import strategies as st

pytest.importorskip("xxhash", reason="Zenoh's identifiers need xxhash")

from coframe.wire.names import Endpoint
from coframe.wire.qos import INFINITE, SENSOR, TF, TF_STATIC_WRITER, QoS
from coframe.wire.type_hashes import type_hash_of_name
from coframe.wire.zenoh import _keys as keys
from coframe.wire.zenoh import _tokens as tokens
from coframe.wire.zenoh._large_types import has_unbounded_bytes
from coframe.wire.zenoh._qos_text import decode_qos, encode_qos

STRING_HASH = "RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18"
# Tokens of rmw_zenoh_cpp, and the identifiers that its own routine computes from them.
TALKER = (
    "@ros2_lv/2/8b20917502ee955ac4476e0266340d5c/0/10/MP/%/%/talker/%chatter/"
    f"std_msgs::msg::dds_::String_/{STRING_HASH}/::,7:,:,:,,"
)
TALKER_GID = "ac170f31eadcd9ff0cd86d7a17907d1c"
LISTENER = "@ros2_lv/2/aac3178e146ba6f1fc6e6a4085e77f21/0/0/NN/%/%/listener"
LISTENER_GID = "49877999dacb858702d11ac823785912"
CHATTER = Endpoint("/robot1/chatter", "std_msgs/msg/String")


def test_the_identifier_is_the_hash_of_the_whole_token():
    assert keys.gid_of(TALKER).hex() == TALKER_GID
    assert keys.gid_of(LISTENER).hex() == LISTENER_GID


def test_the_token_of_a_publisher():
    node = tokens.NodeToken(2, "8b20917502ee955ac4476e0266340d5c", 0, "/", "talker")
    endpoint = Endpoint("/chatter", "std_msgs/msg/String")
    assert node.endpoint(10, tokens.PUBLISHER, endpoint, STRING_HASH, QoS(depth=7)) == TALKER


def test_the_token_of_a_node():
    assert tokens.NodeToken(2, "aac3178e146ba6f1fc6e6a4085e77f21", 0, "/", "listener").text == LISTENER
    assert tokens.NodeToken(0, "1f", 3, "/robot1/arm", "driver").text == "@ros2_lv/0/1f/3/3/NN/%/%robot1%arm/driver"


def test_the_token_of_a_subscription_to_large_messages():
    node = tokens.NodeToken(0, "1f", 0, "/", "camera")
    image = Endpoint("/image", "sensor_msgs/msg/Image")
    token = node.endpoint(4, tokens.SUBSCRIPTION, image, "RIHS01_00", QoS(depth=42), buffers=True)
    assert (
        token
        == "@ros2_lv/0/1f/0/4/MS/%/%/camera/%image/sensor_msgs::msg::dds_::Image_/RIHS01_00/::,:,:,:,,/backends:cpu:"
    )


@pytest.mark.parametrize(
    ("qos", "text"),
    [
        (QoS(depth=10), "::,10:,:,:,,"),
        (TF, "::,100:,:,:,,"),
        (TF_STATIC_WRITER, ":1:,1:,:,:,,"),
        (SENSOR, "2::,5:,:,:,,"),
        (QoS(depth=1000, transient_local=True, lifespan=10_000_000_000), ":1:,1000:,:10,0:,,"),
        (QoS(depth=42), "::,:,:,:,,"),
        (QoS(depth=1, keep_all=True, manual_liveliness=True, lease=1_500_000_000), "::2,1:,:,:3,1,500000000"),
        (QoS(depth=42, deadline=20_000_000), "::,:0,20000000:,:,,"),
        # Seconds and nanoseconds are compared with those of infinity one by one.
        (QoS(depth=42, deadline=9_223_372_036_000_000_001), "::,:,1:,:,,"),
    ],
)
def test_quality_of_service(qos, text):
    assert encode_qos(qos) == text
    assert decode_qos(text) == qos


def test_values_that_rmw_zenoh_sends_unresolved():
    assert decode_qos("0:0:0,0:0,0:0,0:0,0,0") == QoS(depth=1)  # system default
    assert decode_qos("4:4:,5:,:,:5,,") == QoS(depth=5)  # best available
    assert decode_qos("2:1:2,7:,:,:,,") == QoS(depth=7, reliable=False, transient_local=True, keep_all=True)
    assert decode_qos("::,:,:99999999999,0:,,").lifespan == INFINITE


@pytest.mark.parametrize(
    "text", ["", "::,10", "x::,10:,:,:,,", "::,10:,:,:,,,", "::,-1:,:,:,,", "::,10:,:,:", "::,٣:,:,:,,"]
)
def test_damaged_quality_of_service(text):
    assert decode_qos(text) is None


def test_keys_of_topics_services_and_actions():
    assert keys.data_key(0, CHATTER, STRING_HASH) == f"0/robot1/chatter/std_msgs::msg::dds_::String_/{STRING_HASH}"
    for kind, suffix in (("request", "_Request"), ("reply", "_Response")):
        service = Endpoint("/reset", f"std_srvs/srv/Empty{suffix}", kind)
        assert keys.data_key(7, service, "RIHS01_00") == "7/reset/std_srvs::srv::dds_::Empty_/RIHS01_00"
    goal = Endpoint("/tf2/_action/send_goal", "tf2_msgs/action/LookupTransform_SendGoal_Request", "request")
    assert keys.type_name(goal) == "tf2_msgs::action::dds_::LookupTransform_SendGoal_"
    feedback = Endpoint("/tf2/_action/feedback", "tf2_msgs/action/LookupTransform_FeedbackMessage")
    assert keys.type_name(feedback) == "tf2_msgs::action::dds_::LookupTransform_FeedbackMessage_"


def test_hashes_of_whole_services_are_known():
    service = Endpoint("/s", "std_srvs/srv/SetBool_Request", "request")
    expected = "RIHS01_abe9e4bb6b41b40e6789712c00ec8871923e089af3f667a79992a428cff2da0a"
    assert type_hash_of_name(keys.interface(service)) == expected
    for part in ("SendGoal", "GetResult"):
        assert type_hash_of_name(f"tf2_msgs/action/LookupTransform_{part}").startswith("RIHS01_")


def test_attachments():
    data = keys.Attachment(1, 2, bytes(range(16))).encode()
    assert data.hex() == "0100000000000000" + "0200000000000000" + "10" + bytes(range(16)).hex()
    assert keys.decode_attachment(data) == (1, 2, bytes(range(16)))
    zenoh_ext = pytest.importorskip("zenoh.ext")
    assert zenoh_ext.z_serialize((zenoh_ext.Int64(1), zenoh_ext.Int64(2), bytes(range(16)))).to_bytes() == data


@pytest.mark.parametrize("data", [b"", bytes(32), bytes(34), bytes(33), bytes(77)])
def test_damaged_attachments(data):
    assert keys.decode_attachment(data) is None


def test_tokens_are_read():
    token = tokens.decode_token(TALKER)
    assert token is not None
    assert (token.session, token.node, token.kind) == ("8b20917502ee955ac4476e0266340d5c", 0, "MP")
    assert (token.namespace, token.name, token.topic) == ("/", "talker", "/chatter")
    assert (token.type, token.type_hash) == ("std_msgs::msg::dds_::String_", STRING_HASH)
    assert dataclasses.asdict(token.qos)["depth"] == 7
    assert token.gid.hex() == TALKER_GID
    node = tokens.decode_token("@ros2_lv/0/1f/3/3/NN/%/%robot1%arm/driver")
    assert node is not None
    assert (node.namespace, node.name) == ("/robot1/arm", "driver")
    assert tokens.decode_token(TALKER + "/backends:cpu:") is not None


@pytest.mark.parametrize(
    "text",
    [
        "",
        "@ros2_lv",
        "@ros2_lv/0/1f/3/3/NN/%/%",
        "@ros2_lv/0/1f/x/3/NN/%/%/driver",
        "@ros2_lv/0/1f/3/3/XX/%/%/driver",
        "@other/0/1f/3/3/NN/%/%/driver",
        "@ros2_lv/0/1f/3/3/NN/%//driver",
        "@ros2_lv/0/1f/3/3/MP/%/%/driver",
        TALKER.replace("%chatter", "chatter"),
        TALKER.replace("::,7:,:,:,,", "nonsense"),
        TALKER + "x" * 5000,
    ],
)
def test_damaged_tokens_are_skipped(text):
    assert tokens.decode_token(text) is None


@given(st.lists(st.sampled_from([*TALKER.split("/"), "", "%", "-1", "٣", "RIHS01_", "*"]) | st.text(max_size=5)))
def test_any_token_is_read_or_skipped(chunks):
    token = tokens.decode_token("/".join(chunks))
    assert token is None or token.gid == keys.gid_of("/".join(chunks))


def test_types_with_unbounded_bytes():
    assert has_unbounded_bytes("sensor_msgs/msg/Image")
    assert has_unbounded_bytes("sensor_msgs/msg/PointCloud2")
    assert not has_unbounded_bytes("tf2_msgs/msg/TFMessage")
    assert not has_unbounded_bytes("sensor_msgs/msg/LaserScan")
    assert not has_unbounded_bytes("unique_identifier_msgs/msg/UUID")  # uint8[16]
    assert not has_unbounded_bytes("unknown_msgs/msg/Thing")
