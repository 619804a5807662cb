# SPDX-License-Identifier: Apache-2.0
"""Truncated, damaged and malicious recordings: the intact part is read, and problems describe the rest."""

import itertools
import random
import sqlite3
import struct
import sys
import time

import numpy as np
import pytest
import recordings
from click.testing import CliRunner
from mcap.reader import make_reader
from mcap.writer import CompressionType
from recordings import COUNT, SECOND, START, messages
from rosbags.rosbag1 import Writer as Rosbag1Writer

import coframe
from coframe.cli.app import app

KINDS = [
    "zstd.mcap",
    "lz4.mcap",
    "plain.mcap",
    "unchunked.mcap",
    "protobuf.mcap",
    "plain.bag",
    "bz2.bag",
    "lz4.bag",
    "a.db3",
    "zstd.db3.zstd",
]


def write(folder, kind):
    """Write a recording of a kind; return its path."""
    name, _, suffix = kind.partition(".")
    path = folder / kind
    if suffix == "mcap":
        packed = {"zstd": CompressionType.ZSTD, "lz4": CompressionType.LZ4}.get(name, CompressionType.NONE)
        if name == "protobuf":
            pytest.importorskip("google.protobuf")
            type_ = ("foxglove.FrameTransform", name, recordings.foxglove_protobuf_definition(), name)
            rows, types = messages(recordings.foxglove_protobuf), dict.fromkeys(("/tf", "/tf_static"), type_)
            return recordings.write_mcap(path, packed, rows=rows, types=types)
        return recordings.write_mcap(path, packed, chunked=name != "unchunked")
    if suffix == "bag":
        return recordings.write_rosbag1(path, {f.name.lower(): f for f in Rosbag1Writer.CompressionFormat}.get(name))
    database = recordings.write_sqlite(folder / "plain.db3", 4)
    if suffix == "db3":
        return database.rename(path)
    import zstandard

    path.write_bytes(zstandard.compress(database.read_bytes()))
    return path


def survives(path):
    """Decode all messages; return the number of transforms, or None if the recording cannot be opened."""
    started = time.monotonic()
    try:
        recording = coframe.open_bag(path)
    except coframe.RecordingError:
        return None
    with recording:
        count = sum(edge.stored for edge in recording.buffer.edges())
        for topic in recording.topics:
            recording.message_at(topic, START)
            for message in recording.messages(topic):
                try:
                    _ = message.message
                except coframe.DecodeError:
                    continue
        assert all("\n" not in problem for problem in recording.problems)
    assert time.monotonic() - started < 5
    return count


@pytest.mark.parametrize("kind", KINDS)
def test_a_truncated_recording_is_read_up_to_its_end(tmp_path, kind):
    whole = write(tmp_path, kind).read_bytes()
    path = tmp_path / f"cut_{kind}"
    found = []
    for size in np.linspace(0, len(whole), 60).astype(int).tolist():
        path.write_bytes(whole[:size])
        found.append(survives(path) or 0)
    assert found[0] == 0
    assert found[-1] == COUNT + 1
    if "db3" not in kind:  # Only the first page of a database may be left.
        assert all(a <= b for a, b in itertools.pairwise(found))
        assert any(0 < count < COUNT for count in found)


@pytest.mark.parametrize("chunked", [True, False])
def test_an_mcap_file_of_a_killed_recorder(tmp_path, chunked):
    path = recordings.write_mcap(tmp_path / "a.mcap", CompressionType.NONE, chunked=chunked, finish=False)
    recording = coframe.open_bag(path)
    assert 40 < recording.topics["/tf"].messages <= COUNT
    (problem,) = recording.problems
    assert "truncated at byte" in problem


def test_only_the_damaged_chunk_is_lost(tmp_path):
    path = recordings.write_mcap(tmp_path / "a.mcap")
    data = bytearray(path.read_bytes())
    with path.open("rb") as stream:
        second = make_reader(stream).get_summary().chunk_indexes[1]
    frame = data.index(b"zstd", second.chunk_start_offset) + len("zstd") + 8
    data[frame : frame + 4] = bytes(4)
    path.write_bytes(data)
    recording = coframe.open_bag(path)
    assert COUNT - 20 < recording.topics["/tf"].messages < COUNT
    assert "cannot be unpacked: zstd reports" in recording.problems[0]


def test_a_record_with_a_wrong_length_is_skipped_using_the_index(tmp_path):
    path = recordings.write_mcap(tmp_path / "a.mcap")
    data = bytearray(path.read_bytes())
    first = data.index(b"zstd") - 4 - 28 - 9  # opcode and length of the first chunk
    assert data[first] == 0x06
    data[first + 1 : first + 9] = b"\xff" * 8
    path.write_bytes(data)
    recording = coframe.open_bag(path)
    assert COUNT / 2 < recording.topics["/tf"].messages < COUNT
    assert "are damaged" in recording.problems[0]


def test_transforms_in_a_chunk_with_a_flipped_bit_are_left_out(tmp_path):
    """One of them has another pose, and only the checksum shows it."""
    path = recordings.write_mcap(tmp_path / "a.mcap", CompressionType.NONE)
    data = bytearray(path.read_bytes())
    data[data.index(b"odom") + 60] ^= 1
    path.write_bytes(data)
    recording = coframe.open_bag(path)
    read = recording.topics["/tf"].messages
    assert COUNT / 2 < read < COUNT
    problems = " ".join(recording.problems)
    assert "its checksum does not match" in problems
    assert f"their transforms may be wrong ({COUNT - read} times)" in problems
    assert recording.buffer.trajectory("odom", "base").stamps[0] > START + SECOND // 10


def records(path):
    """Return the records of an MCAP file that are not in chunks: (opcode, content) each."""
    data, position, found = path.read_bytes(), 8, []
    while position < len(data) - 8:
        opcode, length = struct.unpack_from("<BQ", data, position)
        found.append((opcode, data[position + 9 : position + 9 + length]))
        position += 9 + length
    return found


def write_records(path, found):
    magic = b"\x89MCAP0\r\n"
    path.write_bytes(magic + b"".join(struct.pack("<BQ", code, len(data)) + data for code, data in found) + magic)
    return path


CHANNEL, MESSAGE, STATISTICS, DATA_END, FOOTER = 4, 5, 11, 15, 2


def without_summary(found):
    return [(FOOTER, bytes(20)) if code == FOOTER else (code, data) for code, data in found]


@pytest.mark.parametrize("lost", ["message", "private message", "nothing"])
def test_messages_that_the_recorder_counted_but_that_are_missing_are_reported(tmp_path, lost):
    path = recordings.write_mcap(tmp_path / "a.mcap", chunked=False)
    data = bytearray(path.read_bytes())
    if lost != "nothing":
        found = records(path)
        row = [number for number, (code, _) in enumerate(found) if code == MESSAGE][20]
        start = 8 + sum(9 + len(content) for _, content in found[:row])
        data[start] = 0x99 if lost == "private message" else 0x06
        if lost == "message":  # instead of one message, a message of a channel with no messages
            data[start], data[start + 9] = MESSAGE, 1 if data[start + 9] == 2 else 2
    path.write_bytes(data)
    problems = " ".join(coframe.open_bag(path).problems)
    assert (f"the statistics count {COUNT} messages on /tf, but {COUNT - 1} were read" in problems) == (
        lost != "nothing"
    )


@pytest.mark.parametrize(
    ("counts", "sentence"),
    [
        ({}, "the statistics count 7 messages, but 61 were read"),
        ({1: 1, 2: 6}, "the statistics count 6 messages on /tf, but 60 were read"),
        ({1: 1, 2: 60}, "the statistics contradict themselves: 7 messages in total, but 61 on all topics"),
        ({1: 1, 2: 60, 9: 3}, "the statistics count 3 messages on channel 9, but 0 were read"),
    ],
)
def test_statistics_that_disagree_with_the_messages_are_reported(tmp_path, counts, sentence):
    path = recordings.write_mcap(tmp_path / "a.mcap", chunked=False)
    listed = b"".join(struct.pack("<HQ", *pair) for pair in counts.items())
    body = struct.pack("<QHIIIIQQI", 7, 1, 2, 0, 0, 0, 0, 0, len(listed)) + listed
    found = [record for record in without_summary(records(path)) if record[0] <= MESSAGE or record[0] == DATA_END]
    start = 8 + sum(9 + len(content) for _, content in found[:-1])
    found = [*found[:-1], (STATISTICS, body), (FOOTER, struct.pack("<QQI", start, 0, 0))]
    recording = coframe.open_bag(write_records(tmp_path / "b.mcap", found))
    assert sentence in " ".join(recording.problems)
    recordings.assert_same(recording.buffer)
    ended = CliRunner().invoke(app, ["bag", "info", str(tmp_path / "b.mcap")])
    assert sentence in ended.stderr


def test_a_channel_with_a_second_definition_has_the_messages_behind_it(tmp_path):
    path = recordings.write_mcap(tmp_path / "a.mcap", chunked=False)
    found = without_summary(records(path))
    end = next(number for number, (code, _) in enumerate(found) if code == DATA_END)
    (moving,) = (data for code, data in found[:end] if code == CHANNEL and b"/tf_static" not in data)
    middle = [number for number, (code, _) in enumerate(found[:end]) if code == MESSAGE][41]
    other = moving.replace(b"\x03\0\0\0/tf", b"\x05\0\0\0/fork")
    found = [*found[:middle], (CHANNEL, other), *found[middle:end], found[end], (FOOTER, bytes(20))]
    recording = coframe.open_bag(write_records(tmp_path / "b.mcap", found))
    assert {name: topic.messages for name, topic in recording.topics.items()} == {
        "/tf": 40,
        "/tf_static": 1,
        "/fork": 20,
    }
    assert "defined differently for /tf and for /fork" in " ".join(recording.problems)


def test_a_chunk_that_only_the_index_knows_is_reported(tmp_path):
    path = recordings.write_mcap(tmp_path / "a.mcap")
    data = bytearray(path.read_bytes())
    with path.open("rb") as stream:
        second = make_reader(stream).get_summary().chunk_indexes[1]
    data[second.chunk_start_offset] = 0x90  # the opcode of an application
    path.write_bytes(data)
    recording = coframe.open_bag(path)
    assert COUNT / 2 < recording.topics["/tf"].messages < COUNT
    problems = " ".join(recording.problems)
    assert f"there is no chunk at byte {second.chunk_start_offset}, where the index lists one" in problems
    assert f"the statistics count {COUNT} messages on /tf" in problems


def test_a_bag_of_ros_1_without_its_index(tmp_path):
    path = recordings.write_rosbag1(tmp_path / "a.bag")
    data = path.read_bytes()
    where = data.index(b"index_pos=") + len("index_pos=")
    path.write_bytes(data[: int.from_bytes(data[where : where + 8], "little")])
    recordings.assert_same(coframe.open_bag(path).buffer)


def test_only_the_damaged_chunk_of_a_ros_1_bag_is_lost(tmp_path):
    path = recordings.write_rosbag1(tmp_path / "a.bag")
    data = bytearray(path.read_bytes())
    second = data.index(b"op=\x05", data.index(b"op=\x05") + 1)
    data[second - 8 : second - 4] = b"\xff\xff\xff\x7f"  # the length of the chunk's header
    path.write_bytes(data)
    recording = coframe.open_bag(path)
    assert COUNT / 2 < recording.topics["/tf"].messages < COUNT
    assert "are damaged" in recording.problems[0]


def test_damaged_messages_are_skipped_and_counted(tmp_path):
    rows = [*messages(), *[("/tf", START + i, b"\0\1\0\0\xff\xff\xff\xff") for i in range(5)]]
    recording = coframe.open_bag(recordings.write_mcap(tmp_path / "a.mcap", rows=rows))
    recordings.assert_same(recording.buffer)
    (problem,) = recording.problems
    assert problem.startswith("/tf: damaged messages; the first one: ")
    assert problem.endswith("(5 times)")


def test_transforms_that_tf2_refuses_are_reported(tmp_path):
    good = messages()[1][2]
    rows = [*messages(), ("/tf", START, good[:-8] + np.array(np.nan).tobytes())]
    recording = coframe.open_bag(recordings.write_mcap(tmp_path / "a.mcap", rows=rows))
    recordings.assert_same(recording.buffer)
    (problem,) = recording.problems
    assert problem == "transforms that tf2 rejects: NaN, an invalid rotation, an empty name, or equal frame names"


def test_mixed_clocks_are_reported(tmp_path):
    later = recordings.cdr("odom", "ball", coframe.Transform(), START + 10_000 * recordings.SECOND)
    recording = coframe.open_bag(recordings.write_mcap(tmp_path / "a.mcap", rows=[*messages(), ("/tf", START, later)]))
    assert recording.problems == [
        "two clocks are mixed: the stamps of odom -> ball are hours apart from those of odom -> base"
    ]
    assert recording.span[1] < START + 10 * recordings.SECOND


def test_a_huge_stated_size_allocates_no_memory(tmp_path):
    import zstandard

    bomb = zstandard.compress(bytes(1 << 28), 19)
    chunk = b"".join(
        [(0).to_bytes(8, "little")] * 2
        + [(1 << 40).to_bytes(8, "little"), bytes(4), b"\4\0\0\0zstd", len(bomb).to_bytes(8, "little"), bomb]
    )
    path = tmp_path / "a.mcap"
    path.write_bytes(b"\x89MCAP0\r\n" + b"\x06" + len(chunk).to_bytes(8, "little") + chunk)
    recording = coframe.open_bag(path)
    assert "a chunk claims to have 1099511627776 bytes; the maximum is" in recording.problems[0]


def test_malicious_databases_are_problems(tmp_path):
    """They have views that never end, missing columns, or values of other types."""
    trap = tmp_path / "view.db3"
    with sqlite3.connect(trap) as database:
        database.execute("CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, serialization_format TEXT)")
        database.execute(
            "CREATE VIEW messages AS WITH RECURSIVE n(id) AS (SELECT 1 UNION ALL SELECT id + 1 FROM n)"
            " SELECT id, 1 AS topic_id, id AS timestamp, x'00' AS data FROM n"
        )
    database.close()
    assert "messages is neither a table nor an index" in coframe.open_bag(trap).problems[0]
    other = tmp_path / "other.db3"
    with sqlite3.connect(other) as database:
        database.execute("CREATE TABLE topics(id, name, type, serialization_format)")
        database.execute("CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id, timestamp, data)")
        database.execute("INSERT INTO topics VALUES (1, '/tf', 'tf2_msgs/msg/TFMessage', 'cdr'), ('x', 2, 3, NULL)")
        database.execute("INSERT INTO messages VALUES (1, 1, 'soon', x'00'), (2, 1, 5, NULL), (3, 1, 5, 'text')")
    database.close()
    problem = "other.db3: rows with a time or data of the wrong type, or with more than 512 MiB (3 times)"
    assert coframe.open_bag(other).problems == [problem]


@pytest.mark.parametrize(
    "text",
    [
        "",
        "[1, 2",
        "rosbag2_bagfile_information: 5",
        "rosbag2_bagfile_information: {relative_file_paths: [1, null, ../../etc/passwd]}",
        "a: &a [x]\n" + "\n".join(f"b{i}: &b{i} [*a, *a]" for i in range(50)),
        "\0",
        "!!python/object/apply:os.system ['true']",
    ],
)
def test_a_recording_with_damaged_metadata_is_read(tmp_path, text):
    bag = recordings.write_rosbag2(tmp_path / "bag")
    (bag / "metadata.yaml").write_text(text)
    recording = coframe.open_bag(bag)
    recordings.assert_same(recording.buffer)
    assert recording.problems


def mutated(rng, data):
    """Return the bytes with some of them changed, removed, repeated or swapped."""
    out = bytearray(data)
    for _ in range(rng.choice([1, 1, 2, 4, 16])):
        if not out:
            break
        where = rng.randrange(len(out))
        kind = rng.random()
        if kind < 0.5:
            out[where] = rng.choice([0, 1, 0x7F, 0x80, 0xFF, rng.randrange(256)])
        elif kind < 0.7:
            out[where : where + rng.choice([4, 8])] = rng.choice(
                [b"\xff" * 8, b"\0" * 8, rng.randbytes(8), b"\0\0\0\x80"]
            )
        elif kind < 0.8:
            del out[where : where + rng.choice([1, 4, 50])]
        elif kind < 0.9:
            out[where:where] = out[where : where + 100]
        else:
            del out[where:]
    return bytes(out) or b"\0"


def most_memory():
    """Return the peak memory of this process in bytes."""
    resource = pytest.importorskip("resource")
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * (1 if sys.platform == "darwin" else 1024)


def fuzz(folder, kind, cases, seed):
    before = most_memory()
    whole = write(folder, kind).read_bytes()
    path = folder / f"mutated_{kind}"
    rng = random.Random(seed)
    rejected = partly = 0
    for _ in range(cases):
        path.write_bytes(mutated(rng, whole))
        count = survives(path)
        rejected += count is None
        partly += count is not None and 0 < count < COUNT + 1
    assert rejected < cases
    assert partly > 0
    assert most_memory() - before < 1 << 30


@pytest.mark.parametrize("kind", KINDS)
def test_mutated_recordings_raise_only_recording_errors(tmp_path, kind):
    fuzz(tmp_path, kind, 200, 5)


@pytest.mark.slow
@pytest.mark.timeout(1200)
@pytest.mark.parametrize("kind", KINDS)
def test_twenty_thousand_mutated_recordings_raise_only_recording_errors(tmp_path, kind):
    fuzz(tmp_path, kind, 20_000 // len(KINDS), time.time_ns())
