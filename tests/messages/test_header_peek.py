# SPDX-License-Identifier: Apache-2.0
"""Stamps and frames read from the first bytes of messages."""

import random
import struct

import numpy as np
import pytest

from coframe.messages import find, serialize
from coframe.messages.encapsulation import byte_order
from coframe.messages.header_peek import StampReader, begins_with_header, first_stamp, peek_header, stamp_reader
from coframe.messages.schema_classes import ResolvedSchema
from coframe.messages.schemas import parse_schema
from coframe.messages.slices import Slices

SECOND = 1_000_000_000
FALLBACK = 77
STAMP = 12 * SECOND + 34


def scan(stamp: int = STAMP, frame: str = "laser"):
    message = find("sensor_msgs/msg/LaserScan")(ranges=[1.0, 2.0])
    message.header.frame_id = frame
    message.header.stamp.sec, message.header.stamp.nanosec = divmod(stamp, SECOND)
    return message


def big_endian_header(seconds: int, nanoseconds: int, frame: bytes, identifier: bytes = b"\0\0") -> bytes:
    return identifier + b"\0\0" + struct.pack(">iII", seconds, nanoseconds, len(frame)) + frame


def stamps(reader, *messages: bytes) -> list[int]:
    fallback = np.full(len(messages), FALLBACK, dtype=np.int64)
    found = reader.stamps(Slices.join(messages), fallback).tolist()
    assert found == [FALLBACK if stamp is None else stamp for stamp in map(reader.stamp, messages)]
    return found


def test_the_representation_identifier_decides_the_byte_order():
    assert byte_order(b"\x00\x01\x00\x00") == "<"
    assert byte_order(memoryview(b"\x00\x00\x00\x00")) == ">"
    assert byte_order(b"\x00\x01\x00\x03rest") == "<"  # the options say how many bytes of padding there are
    for other in (b"\x00\x02\x00\x00", b"\x00\x03\x00\x00", b"\x00\x07\x00\x00", b"\x01\x01\x00\x00"):
        assert byte_order(other) is None
    assert byte_order(b"\x00\x01\x00") is None
    assert byte_order(b"") is None


def test_the_header_of_a_message_is_read_in_both_byte_orders():
    assert peek_header(serialize(scan())) == (STAMP, "laser")
    assert peek_header(big_endian_header(12, 34, b"laser\0")) == (STAMP, "laser")
    assert peek_header(serialize(scan(-3 * SECOND))) == (-3 * SECOND, "laser")
    assert peek_header(serialize(scan(frame=""))) == (STAMP, "")
    assert peek_header(big_endian_header(12, 34, b"")) == (STAMP, "")
    assert peek_header(big_endian_header(12, 34, b"a\xff\0")) == (STAMP, r"a\xff")


@pytest.mark.parametrize(
    "message",
    [
        b"",
        b"\x00\x01",
        serialize(scan())[:15],
        serialize(scan())[:20],
        big_endian_header(12, 34, b"laser\0", b"\x00\x02"),
        big_endian_header(12, 34, b"laser"),
        big_endian_header(12, 34, b"la\0er\0"),
        b"\x00\x01\x00\x00" + b"\xff" * 40,
    ],
)
def test_a_damaged_header_is_not_read(message):
    assert peek_header(message) is None


def test_types_that_begin_with_a_header_are_known():
    assert begins_with_header("sensor_msgs/msg/LaserScan")
    assert not begins_with_header("std_msgs/msg/String")
    assert not begins_with_header("tf2_msgs/msg/TFMessage")
    assert not begins_with_header("custom_msgs/msg/Unknown")
    assert not begins_with_header("no type at all")


def test_stamps_of_messages_with_a_header():
    reader = stamp_reader("sensor_msgs/msg/LaserScan")
    big = big_endian_header(5, 6, b"laser\0")
    wrong = big_endian_header(5, 6, b"laser\0", b"\x00\x07")
    messages = [serialize(scan()), big, wrong, serialize(scan(-1)), serialize(scan())[:11], b""]
    assert stamps(reader, *messages) == [STAMP, 5 * SECOND + 6, FALLBACK, -1, FALLBACK, FALLBACK]
    assert stamps(reader) == []


def test_the_stamp_of_a_sequence_is_that_of_its_first_message():
    marker = find("visualization_msgs/msg/Marker")()
    marker.header.stamp.sec = 5
    array = find("visualization_msgs/msg/MarkerArray")
    reader = stamp_reader("visualization_msgs/msg/MarkerArray")
    empty = serialize(array()) + b"\x01" * 8  # as another field would follow the empty sequence
    assert stamps(reader, serialize(array(markers=[marker, marker])), empty) == [5 * SECOND, FALLBACK]


def test_messages_of_ros_1_have_a_sequence_number_and_unsigned_seconds():
    reader = stamp_reader("sensor_msgs/msg/LaserScan", "ros1")
    message = struct.pack("<IIII", 9, 3_000_000_000, 34, 5) + b"laser"
    assert stamps(reader, message, message[:11]) == [3_000_000_000 * SECOND + 34, FALLBACK]
    sequence = stamp_reader("tf2_msgs/msg/TFMessage", "ros1")
    assert stamps(sequence, struct.pack("<IIII", 1, 9, 12, 34), struct.pack("<IIII", 0, 9, 12, 34)) == [STAMP, FALLBACK]
    assert stamps(stamp_reader("rosgraph_msgs/msg/Clock", "ros1"), struct.pack("<II", 12, 34)) == [STAMP]


def test_an_unknown_type_is_read_by_its_definition():
    def reader(definition: bytes):
        schema = parse_schema(definition, "custom_msgs/msg/Unknown", "ros2msg")
        first = first_stamp(ResolvedSchema(schema))
        return None if first is None else StampReader(first, "cdr")

    message = big_endian_header(12, 34, b"laser\0")
    assert stamps(reader(b"# a comment\nuint8 A = 1\nstd_msgs/Header header\n"), message) == [STAMP]
    assert stamps(reader(b"builtin_interfaces/Time stamp\n"), message) == [STAMP]
    assert reader(b"string text\n") is None
    assert reader(b"") is None
    assert stamp_reader("sensor_msgs/msg/LaserScan", "protobuf") is None
    assert stamp_reader("std_msgs/msg/String") is None


def test_random_bytes_never_raise():
    numbers = random.Random(4)
    readers = [
        stamp_reader(name, encoding)
        for name in ("sensor_msgs/msg/LaserScan", "tf2_msgs/msg/TFMessage", "rosgraph_msgs/msg/Clock")
        for encoding in ("cdr", "ros1")
    ]
    starts = [b"\x00\x01\x00\x00", b"\x00\x00\x00\x00", b""]
    messages = [numbers.choice(starts) + numbers.randbytes(numbers.randrange(40)) for _ in range(500)]
    for reader in readers:
        stamps(reader, *messages)
    for message in messages:
        peek_header(message)
