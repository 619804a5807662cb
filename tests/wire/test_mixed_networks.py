# SPDX-License-Identifier: Apache-2.0
"""Participants of other distributions: how they describe their nodes, and which type hashes they announce.

The bytes are those of real participants: up to Humble, identifiers have 24 bytes; from Iron on, 16.
"""

import pytest

from coframe import _core
from coframe.messages import find
from coframe.messages.type_hash import type_hash
from coframe.type_names import TF_MESSAGE
from coframe.wire import QoS, request_header
from coframe.wire.dds import config, library
from coframe.wire.dds.topics import create_topic
from coframe.wire.rtps.discovery_info import TOPIC, NodeInfo, decode_info, encode_info
from coframe.wire.rtps.user_data import endpoint_user_data, type_hash_of
from coframe.wire.type_hashes import TF_MESSAGE_HASH

PARTICIPANT = "01103a4b5c6d7e8f90a1b2c3000001c1"
READER, WRITER = "01103a4b5c6d7e8f90a1b2c300000504", "01103a4b5c6d7e8f90a1b2c300000403"
NODE = NodeInfo("/arm", "talker", (bytes.fromhex(READER),), (bytes.fromhex(WRITER),))
PADDING = "0000000000000000"


def sample(padding):
    return bytes.fromhex(
        f"00010000{PARTICIPANT}{padding}"
        "01000000"
        "050000002f61726d00000000"  # "/arm"
        "0700000074616c6b65720000"  # "talker"
        f"01000000{READER}{padding}"
        f"01000000{WRITER}{padding}"
    )


class Foreign:
    """A participant that announces nodes in one form, and receives what others announce."""

    def __init__(self, domain_id, size):
        self.native = _core.DomainParticipant(domain_id, config.cyclone_config(), "enclave=/;")
        topic = create_topic(self.native.entity, TOPIC, "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_")
        qos = _core.QosProfile(depth=1, reliable=True, transient_local=True, keep_all=True)
        self.reader = _core.Reader(self.native.entity, topic, qos, "", None)
        self.endpoints = _core.EndpointReader(self.native.entity, _core.PUBLICATIONS, _core.Event())
        self.writer = _core.Writer(self.native.entity, topic, qos, "")
        self.sizes = {}
        name = {24: "humble_node", 16: "jazzy_node"}[size]
        self.writer.write(encode_info(self.native.guid, [NodeInfo("/", name)], size))

    def size_of(self, guid):
        for data, _, _ in self.reader.take(100):
            info = decode_info(data)
            self.sizes[info.participant] = info.gid_size
        return self.sizes.get(guid)

    def close(self):
        for each in (self.reader, self.endpoints, self.writer, self.native):
            each.close()


@pytest.fixture
def foreign(domain_id, participant):  # noqa: ARG001 - opens the domain
    """Return a function that adds a participant which announces identifiers of a size."""
    library.load()  # the foreign participants use Cyclone DDS
    made = []

    def add(size):
        made.append(Foreign(domain_id, size))
        return made[-1]

    yield add
    for each in made:
        each.close()


@pytest.mark.parametrize(("size", "padding"), [(16, ""), (24, PADDING)])
def test_descriptions_of_nodes_are_those_of_ros(size, padding):
    assert encode_info(bytes.fromhex(PARTICIPANT), [NODE], size) == sample(padding)
    assert decode_info(sample(padding)) == (bytes.fromhex(PARTICIPANT), [NODE], size)


@pytest.mark.dds_only("the other participant is one of DDS")
def test_the_form_is_that_of_the_other_participants(participant, foreign, eventually):
    warnings = []
    participant.on_warning(warnings.append)
    participant.add_node("/", "ours")
    own = participant._session.native.guid
    humble = foreign(24)
    eventually(lambda: humble.size_of(own) == 24)
    assert warnings == []
    # Both forms are on the network now: the preferred one is used, and a warning says whose tools do not work.
    jazzy = foreign(16)
    eventually(lambda: jazzy.size_of(own) == 16)
    eventually(lambda: warnings)
    (text,) = warnings
    assert text.startswith(
        "Nodes of ROS 2 Humble or earlier (/humble_node) cannot list the nodes of this process, because"
    )
    assert set(participant.nodes()) == {("/", "ours"), ("/", "jazzy_node"), ("/", "humble_node")}
    jazzy.close()
    eventually(lambda: humble.size_of(own) == 24)


@pytest.mark.dds_only("the other participant is one of DDS")
def test_other_processes_of_coframe_are_not_followed(participant, child, foreign, eventually):
    other = child("import coframe\nwith coframe.connect('other'): input()", ROS_DISTRO="humble")
    eventually(lambda: ("/", "other") in participant.nodes())
    assert participant._session._announcer.gid_size == 16
    humble = foreign(24)
    eventually(lambda: humble.size_of(participant._session.native.guid) == 24)
    assert other.finish() == (0, "")


@pytest.mark.dds_only("the other participant is one of DDS")
def test_endpoints_announce_the_hash_of_their_type(participant, node, foreign, eventually):
    string, trigger = find("std_msgs/msg/String"), find("std_srvs/srv/Trigger")
    participant.publisher(node, "/chatter", string, QoS(), user_data="more=1;")
    participant.publisher(node, "/reset", trigger.Request, QoS(), kind="request")
    participant.static_broadcaster(node)
    jazzy, seen = foreign(16), {}

    def discovered():
        own = participant._session.native.guid
        seen.update({change[4]: change[7] for change in jazzy.endpoints.take() if change[3] == own})
        return {"rt/chatter", "rq/resetRequest", "rt/tf_static", TOPIC} <= seen.keys()

    eventually(discovered)
    digits = "df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18"
    assert seen["rt/chatter"] == f"typehash=RIHS01_{digits};more=1;".encode()
    assert seen["rq/resetRequest"] == f"typehash={type_hash(trigger.Request)};".encode()
    assert seen["rt/tf_static"] == f"typehash={TF_MESSAGE_HASH};".encode()
    # The hash of Iron and later, without which their rmw_cyclonedds_cpp warns about the endpoint.
    digits_of_info = "91a0593bacdcc50ea9bdcf849a938b128412cc1ea821245c663bcd26f83c295e"
    assert seen[TOPIC] == f"typehash=RIHS01_{digits_of_info};coframe=adapts;".encode()
    (publisher,) = participant.publishers("/chatter")
    assert publisher.type_hash == f"RIHS01_{digits}"


def test_user_data():
    assert type_hash(find(TF_MESSAGE)) == TF_MESSAGE_HASH
    assert endpoint_user_data("unknown_msgs/msg/Thing", "more=1;") == "more=1;"
    hashed = "RIHS01_" + "0f" * 32
    for data in (f"typehash={hashed};", f"serviceid=01.0f.ab;typehash={hashed};"):
        assert type_hash_of(data.encode()) == hashed
    for data in (
        b"",
        b"enclave=/;",
        b"typehash=;",
        b"typehash=RIHS01_0f;",
        b"\xff\0typehash",
        b"other" + hashed.encode(),
    ):
        assert type_hash_of(data) == ""


def test_header_of_services():
    """rmw_cyclonedds puts the client (u64) and the sequence number (i64) before a request, rmw_fastrtps nothing."""
    cyclone = bytes.fromhex("00010000 efcdab8967452301 0200000000000000 01")
    assert request_header.join(request_header.RequestHeader(0x0123456789ABCDEF, 2), b"\0\1\0\0\1") == cyclone
    assert request_header.split(cyclone) == ((0x0123456789ABCDEF, 2), b"\0\1\0\0\1")
    assert request_header.split(bytes.fromhex("0001000001000000")) is None
