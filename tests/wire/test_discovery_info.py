# SPDX-License-Identifier: Apache-2.0
import pytest
from hypothesis import given
from hypothesis import strategies as st

from coframe.wire.rtps.discovery_info import NodeInfo, decode_info, encode_info, gid_size

GUIDS = st.binary(min_size=16, max_size=16)
NAMES = st.from_regex(r"/?[a-z_]{1,30}", fullmatch=True)
NODES = st.lists(
    st.builds(
        NodeInfo,
        NAMES,
        NAMES,
        st.lists(GUIDS, max_size=4).map(tuple),
        st.lists(GUIDS, max_size=4).map(tuple),
    ),
    max_size=4,
)


@pytest.mark.parametrize(
    ("distro", "size"),
    [(None, 16), ("", 16), ("humble", 24), ("iron", 16), ("jazzy", 16), ("kilted", 16), ("rolling", 16)],
)
def test_the_identifiers_of_each_distribution(distro, size):
    assert gid_size({} if distro is None else {"ROS_DISTRO": distro}) == size


@given(GUIDS, NODES)
@pytest.mark.parametrize("size", [16, 24])
def test_both_identifier_sizes_are_decoded(size, guid, nodes):
    assert decode_info(encode_info(guid, nodes, size)) == (guid, nodes, size)


def test_big_endian():
    message = b"\0\0\0\0" + bytes(range(16)) + b"\0\0\0\1" + b"\0\0\0\2/\0\0\0" + b"\0\0\0\2a\0\0\0" + bytes(8)
    assert decode_info(message) == (bytes(range(16)), [NodeInfo("/", "a")], 16)


@given(st.binary(max_size=200))
def test_invalid_bytes_never_raise(data):
    decode_info(data)
    decode_info(b"\0\1\0\0" + data)


def test_an_invalid_length_is_rejected():
    assert decode_info(b"\0\1\0\0" + bytes(16) + b"\xff\xff\xff\xff") is None
