# SPDX-License-Identifier: Apache-2.0
"""Ingesting TFMessage bytes into the buffer: recorded samples, and a hundred thousand damaged ones."""

import random

import pytest

import coframe

SECOND = 1_000_000_000


@pytest.fixture
def message():
    """Return the bytes of a TFMessage with five transforms."""
    source = coframe.Buffer()
    for i in range(5):
        source.set(f"frame_{i}", f"frame_{i + 1}", coframe.Transform([i, 0, 0]), (i + 1) * SECOND)
    return source.encode(static=False)


def test_bytes_of_a_real_ros_stack_are_ingested(shared):
    samples = shared / "wire_samples"
    buffer = coframe.Buffer()
    assert buffer.ingest(bytes.fromhex((samples / "humble_empty.hex").read_text())) == 0
    assert buffer.ingest(bytes.fromhex((samples / "humble_two_odom_base_laser.hex").read_text())) == 2
    base = buffer.lookup("odom", "base_link")
    assert base.stamp == 1_700_000_000_000_000_005
    assert base.values == pytest.approx((1, 2, 3, 0, 0, 0.5**0.5, 0.5**0.5))
    names = coframe.Buffer()
    assert names.ingest(bytes.fromhex((samples / "humble_utf8_and_negative.hex").read_text())) == 0
    assert names.statistics["refused"] == 1  # a NaN, as tf2 rejects it


def test_encoded_bytes_equal_those_of_a_real_ros_stack(shared):
    real = bytes.fromhex((shared / "wire_samples" / "humble_two_odom_base_laser.hex").read_text())
    buffer = coframe.Buffer()
    buffer.ingest(real)
    again = coframe.Buffer()
    assert again.ingest(buffer.encode(static=False)) == 2
    assert again.lookup("odom", "base_link") == buffer.lookup("odom", "base_link")
    assert len(buffer.encode(static=False)) == len(real)


def test_encoded_transforms_round_trip(message):
    buffer = coframe.Buffer()
    assert buffer.ingest(message) == 5
    assert buffer.ingest(message) == 5  # names are known now
    assert buffer.lookup("frame_1", "frame_2").stamp == 2 * SECOND
    assert buffer.encode(static=False) == message


def test_big_endian_is_supported():
    little = coframe.Buffer()
    little.set("a", "b", coframe.Transform([1, 2, 3]), 5 * SECOND + 7)
    words = little.encode(static=False)
    # header, count, sec, nanosec, two strings of 2 bytes each, 7 doubles
    swapped = bytes([0, 0, 0, 0])
    for start in (4, 8, 12, 16):
        swapped += words[start : start + 4][::-1]
    swapped += words[20:24] + words[24:28][::-1] + words[28:36]
    for start in range(36, 36 + 56, 8):
        swapped += words[start : start + 8][::-1]
    assert len(swapped) == len(words)
    big = coframe.Buffer()
    assert big.ingest(swapped) == 1
    assert big.lookup("a", "b") == little.lookup("a", "b")


@pytest.mark.parametrize(
    ("mangle", "reason"),
    [
        (lambda m: m[:0], "shorter than its 4-byte header"),
        (lambda m: b"\x00\x07\x00\x00" + m[4:], "does not say plain CDR"),
        (lambda m: m[:-1], "ends inside a number"),
        (lambda m: m[:4] + b"\xff\xff\xff\xff" + m[8:], "ends inside a number"),
        (lambda m: m[:4] + b"\x02\x00\x00\x00" + m[8:], "left over"),
        (lambda m: m[:16] + b"\xff\xff\xff\x7f" + m[20:], "longer than the message"),
        (lambda m: m.replace(b"frame_0\x00", b"frame_00", 1), "does not end with NUL"),
        (lambda m: m.replace(b"frame_0\x00", b"fr\x00me_0\x00", 1), "NUL inside"),
    ],
)
def test_damaged_messages_are_refused_and_counted(message, mangle, reason):
    buffer = coframe.Buffer()
    with pytest.raises(coframe.DecodeError, match=reason):
        buffer.ingest(mangle(message))
    assert buffer.frame_names() == []
    assert buffer.statistics["malformed"] == 1


def test_names_that_are_not_utf8_are_refused():
    buffer = coframe.Buffer()
    source = coframe.Buffer()
    source.set("abc", "def", coframe.Transform(), 5)
    assert buffer.ingest(source.encode(static=False).replace(b"abc", b"\xff\xfe\xfd")) == 0
    assert buffer.statistics["refused"] == 1


def mutate(rng, message):
    data = bytearray(message)
    choice = rng.random()
    if choice < 0.2:
        return bytes(data[: rng.randrange(len(data))])
    if choice < 0.3:
        return rng.randbytes(rng.randrange(200))
    for _ in range(rng.choice([1, 1, 2, 8])):
        data[rng.randrange(len(data))] = rng.choice([0, 1, 0x7F, 0x80, 0xFF, rng.randrange(256)])
    if choice < 0.4:
        data += rng.randbytes(rng.randrange(40))
    return bytes(data)


def test_a_hundred_thousand_mutated_messages(message):
    rng = random.Random(1)
    buffer = coframe.Buffer()
    malformed = 0
    for _ in range(100_000):
        try:
            buffer.ingest(mutate(rng, message))
        except coframe.DecodeError:
            malformed += 1
    counts = buffer.statistics
    assert counts["messages"] == 100_000
    assert counts["malformed"] == malformed > 1000
    assert counts["stored"] > 1000
    assert buffer.ingest(message) >= 0  # still in good health
    buffer.all_frames_as_yaml()


def encoded(*links):
    """Return the bytes of a TFMessage with transforms (parent, child, seconds)."""
    source = coframe.Buffer()
    for parent, child, seconds in links:
        source.set(parent, child, coframe.Transform([seconds, 0, 0]), seconds * SECOND)
    return source.encode(static=False)


def test_names_can_change_from_message_to_message():
    """Names are cached by position in the messages of a source; here they move, grow, shrink and change pairs."""
    rng = random.Random(2)
    names = [*"abcdefg", "ab", "abc", "abcd", "abcde" * 3, "abcde" * 3 + "f", "é", "éa"]
    fast, slow = coframe.Buffer(), coframe.Buffer()
    for second in range(1, 2000):
        children = rng.sample(names, rng.randrange(1, 6)) if rng.random() < 0.5 else names[:4]
        links = [(rng.choice(["world", "map", "world", "odometry"]), child, second) for child in children]
        assert fast.ingest(encoded(*links)) == len(links)
        for parent, child, seconds in links:
            slow.set(parent, child, coframe.Transform([seconds, 0, 0]), seconds * SECOND)
    assert fast.all_frames_as_yaml() == slow.all_frames_as_yaml()
    for child in names:
        (theirs,) = (frame for frame in slow.frames() if frame.name == child)
        (ours,) = (frame for frame in fast.frames() if frame.name == child)
        assert (ours.parent, ours.samples, ours.newest) == (theirs.parent, theirs.samples, theirs.newest)
        assert fast.lookup(theirs.parent, child) == slow.lookup(theirs.parent, child)


def test_a_truncated_name_after_good_messages_is_malformed(message):
    buffer = coframe.Buffer()
    buffer.ingest(message)
    for end in range(len(message)):
        with pytest.raises(coframe.DecodeError):
            buffer.ingest(message[:end])
    assert buffer.statistics["malformed"] == len(message)
    assert buffer.ingest(message) == 5


def test_the_byte_order_can_change_after_good_messages():
    little = encoded(("a", "b", 5))
    buffer = coframe.Buffer()
    assert buffer.ingest(little) == 1
    with pytest.raises(coframe.DecodeError):
        buffer.ingest(b"\x00\x00" + little[2:])


def test_the_next_message_inserts_a_removed_frame_again():
    buffer = coframe.Buffer()
    buffer.ingest(encoded(("a", "b", 1), ("b", "c", 1)))
    buffer.remove_frame("b")
    assert not buffer.can_transform("a", "c")
    buffer.ingest(encoded(("a", "b", 2), ("b", "c", 2)))
    assert buffer.lookup("a", "c").stamp == 2 * SECOND
