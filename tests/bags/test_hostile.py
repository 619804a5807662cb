# SPDX-License-Identifier: Apache-2.0
"""Recordings that are made to exhaust memory or time: each is read in a process with little memory."""

import json
import re
import sqlite3
import struct
import subprocess
import sys
from contextlib import closing
from pathlib import Path

import pytest
import recordings
from mcap.writer import CompressionType
from recordings import START, TF, messages

import coframe
from coframe.bags import storage
from coframe.messages import find, serialize

_LIMIT = 10  # seconds of a processor; each takes less than one


def with_schema(text, type_="lab/msg/Big", topic="/big"):
    rows = [*messages(), (topic, START, b"\0\1\0\0" + bytes(64))]
    return {"rows": rows, "types": {topic: (type_, "ros2msg", text, "cdr")}}


OTHER_FIELDS = b"lab/Head header\nstring[] name\nstring position\nint32 msg\nint32 data\n"
OTHER_HEAD = b"=" * 80 + b"\nMSG: lab/Head\nint32 stamp\nint32 frame_id\n"
WELL_KNOWN = {
    "/robot_description": "std_msgs/msg/String",
    "/joint_states": "sensor_msgs/msg/JointState",
    "/rosout": "rcl_interfaces/msg/Log",
    "/clock": "rosgraph_msgs/msg/Clock",
    "/scan": "sensor_msgs/msg/LaserScan",
    "/points": "sensor_msgs/msg/PointCloud2",
    "/robot/tf": TF,
}


def redefined(path, text=OTHER_FIELDS + OTHER_HEAD):
    """Write types with well-known names and other fields."""
    zeros = b"\0\1\0\0" + bytes(1000)
    rows = [*messages(), *[(topic, START + i, zeros) for topic in WELL_KNOWN for i in range(3)]]
    types = {topic: (type_, "ros2msg", text, "cdr") for topic, type_ in WELL_KNOWN.items()}
    recordings.write_mcap(path, rows=rows, types=types)


def redefined_without_use(path):
    redefined(path, b"string[300000000] x")


def many_joints(path):
    """Write a message with 100 000 joints among 10 000 others: the table of all positions would have 8 GB."""
    names = [(f"joint{i}", 0.0) for i in range(100_000)]
    state = find("sensor_msgs/msg/JointState")
    many = serialize(state(name=[name for name, _ in names], position=[0.0] * len(names)))
    one = serialize(state(name=["joint0"], position=[0.0]))
    rows = [*messages(), *[("/joint_states", START + i, many if i == 0 else one) for i in range(10_000)]]
    recordings.write_mcap(
        path, rows=rows, types={"/joint_states": ("sensor_msgs/msg/JointState", "ros2msg", b"", "cdr")}
    )


def strings(path):
    recordings.write_mcap(path, **with_schema(b"string[1000000000] x"))


def strings_of_tf(path):
    recordings.write_mcap(path, **with_schema(b"string[300000000] x", TF, "/robot/tf"))


def numbers(path):
    recordings.write_mcap(path, **with_schema(b"float64[2000000000] x"))


def doubling(path):
    parts = ["lab/L0 a\nlab/L0 b\n"]
    parts += [f"MSG: lab/L{i}\nlab/L{i + 1} a\nlab/L{i + 1} b\n" for i in range(30)]
    text = f"{'=' * 80}\n".join([*parts, "MSG: lab/L30\nfloat64 x\n"])
    recordings.write_mcap(path, **with_schema(text.encode()))


def brackets_in_channel(path):
    from mcap.writer import Writer

    with path.open("wb") as stream:
        writer = Writer(stream)
        writer.start()
        schema = writer.register_schema(TF, "ros2msg", b"")
        channel = writer.register_channel("/tf", "cdr", schema, {"offered_qos_profiles": "[" * 100_000})
        writer.add_message(channel, START, messages()[1][2], START)
        writer.finish()


def zeros(size):
    """Return a zstd frame of zeros, which does not state its size: blocks of 128 kB that repeat one byte."""
    block = 1 << 17
    heads = [(block << 3 | 1 << 1 | (i == size // block - 1)).to_bytes(3, "little") for i in range(size // block)]
    return b"\x28\xb5\x2f\xfd\0\x38" + b"".join(head + b"\0" for head in heads)


def chunks(path, size=512 << 20):
    """Write 200 chunks that unpack to 512 MB each."""
    bomb = zeros(size)
    head = struct.pack("<QQQI", 0, 0, size, 0) + b"\4\0\0\0zstd" + struct.pack("<Q", len(bomb))
    record = b"\6" + struct.pack("<Q", len(head) + len(bomb)) + head + bomb
    path.write_bytes(b"\x89MCAP0\r\n" + record * 200)


def generated(path, table="messages"):
    columns = {"topics": "id INTEGER PRIMARY KEY, type TEXT, serialization_format TEXT", "messages": "id, timestamp"}
    made = "AS (hex(zeroblob(400000000)))"
    with sqlite3.connect(path) as database:
        names = (
            ("name TEXT " + made, "topic_id, data BLOB") if table == "topics" else ("name", f"topic_id, data {made}")
        )
        database.execute(f"CREATE TABLE topics({columns['topics']}, {names[0]})")
        database.execute(f"CREATE TABLE messages(id INTEGER PRIMARY KEY, timestamp INTEGER, {names[1]})")
        database.execute("INSERT INTO topics(id, type, serialization_format) VALUES (1, ?, 'cdr')", (TF,))
        database.executemany("INSERT INTO messages(timestamp, topic_id) VALUES (?, 1)", [(START,)])
    database.close()


def generated_topics(path):
    generated(path, "topics")


def index(path):
    """Write an index of chunks, all of which are in the index."""

    def record(data=b"", **fields):
        header = b""
        for name, value in fields.items():
            part = name.encode() + b"=" + value
            header += struct.pack("<I", len(part)) + part
        return struct.pack("<I", len(header)) + header + struct.pack("<I", len(data)) + data

    bag = b"#ROSBAG V2.0\n"
    head = record(b" " * 100, op=b"\3", index_pos=bytes(8))
    head = record(b" " * 100, op=b"\3", index_pos=struct.pack("<Q", len(bag) + len(head)))
    bag += head
    size = len(record(op=b"\6", chunk_pos=bytes(8)))
    first = len(bag)
    infos = (record(op=b"\6", chunk_pos=struct.pack("<Q", first + 1 + size * i)) for i in range(60_000))
    damaged = bytearray(bag + b"".join(infos))
    # The data section begins with damage, so that the reader continues at the positions in the index.
    damaged[first - 104 : first - 100] = struct.pack("<I", 101)
    path.write_bytes(damaged)


def times(path):
    bad = [
        recordings.foxglove_json("a", "b", coframe.Transform(), 5 * 10**9).replace(b'"sec": 5', b'"sec": ' + number)
        for number in (b"1e400", b"9" * 30, b"9" * 5000, b"-1e300")
    ]
    rows = [*messages(recordings.foxglove_json), *[("/tf", START, data) for data in bad]]
    kind = ("foxglove.FrameTransform", "jsonschema", b"", "json")
    recordings.write_mcap(path, rows=rows, types=dict.fromkeys(("/tf", "/tf_static"), kind))


def header(path):
    recordings.write_sqlite(path, 4)
    data = bytearray(path.read_bytes())
    data[16:56] = bytes(range(100, 140))
    path.write_bytes(data)


def footer(path):
    data = bytearray(recordings.write_mcap(path, CompressionType.NONE).read_bytes())
    path.write_bytes(data[:8] + data[-37:])


def with_metadata(text):
    def write(path):
        recordings.write_rosbag2(path)
        (path / "metadata.yaml").write_text(text)

    return write


ALIASES = "a: &a [x]\n" + "\n".join(f"b{i}: &b{i} [*{'a' if not i else f'b{i - 1}'}, *a, *a]" for i in range(20))
DOUBLING = "a: &c0 [x]\n" + "\n".join(f"b{i}: &c{i} [*c{i - 1}, *c{i - 1}]" for i in range(1, 40))
BAG = "rosbag2_bagfile_information:\n  compression_mode: "
MADE = {
    "strings.mcap": (strings, "the maximum is 67108864"),
    "strings_of_tf.mcap": (strings_of_tf, "the maximum is 67108864"),
    "numbers.mcap": (numbers, "the maximum is 67108864"),
    "doubling.mcap": (doubling, "the maximum is 67108864"),
    "redefined.mcap": (redefined, ""),
    "redefined_without_use.mcap": (redefined_without_use, "the maximum is 67108864"),
    "many_joints.mcap": (many_joints, ""),
    "brackets.mcap": (brackets_in_channel, ""),
    "chunks.mcap": (chunks, "more than 1000 times as many"),
    "generated.db3": (generated, "the table messages has generated columns"),
    "generated_topics.db3": (generated_topics, "the table topics has generated columns"),
    "index.bag": (index, "damaged"),
    "times.mcap": (times, "damaged messages"),
    "header.db3": (header, "the database is damaged (file is not a database)"),
    "footer.mcap": (footer, "the footer is damaged"),
    "aliases": (
        with_metadata(f"{DOUBLING}\n{BAG}*c39\n  compression_format: *c39"),
        "after its aliases (*) are expanded",
    ),
    "few_aliases": (with_metadata(f"{ALIASES}\n{BAG}*a"), ""),
    "list": (with_metadata(f"{BAG}none\nunused: [{'1,' * 5_000_000}1]"), "values"),
    "metadata_brackets": (with_metadata("[" * 50_000), "levels deep"),
    "sixty": (with_metadata(f"{BAG}1{':1' * 500_000}"), "digits"),
}


@pytest.fixture(scope="module")
def examined(tmp_path_factory):
    """Problems and seconds by name; names are missing if the process ended before."""
    folder = tmp_path_factory.mktemp("hostile")
    for name, (write, _) in MADE.items():
        write(folder / name)
    command = [sys.executable, str(Path(__file__).with_name("hostile.py")), *[str(folder / name) for name in MADE]]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as process:
        try:
            output, _ = process.communicate(timeout=_LIMIT * len(MADE))
        except subprocess.TimeoutExpired:
            process.kill()
            output, _ = process.communicate()
    return dict(zip(MADE, map(json.loads, output.splitlines()), strict=False))


@pytest.mark.parametrize("name", MADE)
def test_a_hostile_recording_takes_little_memory_and_time(examined, name):
    problems, seconds = examined[name]
    assert seconds < _LIMIT
    assert MADE[name][1] in " ".join(problems), problems
    assert not any(re.search(r"^\w*Error: ", problem) for problem in problems), problems


def test_chunks_of_a_plausible_size_have_a_budget_together(tmp_path, monkeypatch):
    monkeypatch.setattr(storage, "MIN_BUDGET", 64 << 20)
    chunks(tmp_path / "run.mcap", 16 << 20)
    recording = coframe.open_bag(tmp_path / "run.mcap")
    refused = [each for each in recording.problems if "the chunks before it have 67108864 unpacked bytes" in each]
    assert len(refused) > 190, recording.problems
    assert "cannot be unpacked" in refused[0]
    assert "the limit is 67108864" in refused[0]


def test_messages_that_unpack_to_512_megabytes_are_refused(tmp_path):
    import zstandard
    from rosbags.rosbag2 import CompressionMode, StoragePlugin

    bag = recordings.write_rosbag2(tmp_path / "bag", StoragePlugin.SQLITE3, CompressionMode.MESSAGE)
    streamed = zeros(512 << 20)
    assert len(zstandard.ZstdDecompressor().stream_reader(streamed).read(1 << 30)) == 512 << 20
    stated = zstandard.compress(bytes(200 << 20), 1)
    (database,) = bag.glob("*.db3")
    with sqlite3.connect(database) as opened:
        (topic,) = opened.execute("SELECT id FROM topics WHERE name = '/tf'").fetchone()
        for data in (streamed, stated):
            opened.execute("INSERT INTO messages(topic_id, timestamp, data) VALUES (?, ?, ?)", (topic, START, data))
    opened.close()
    recording = coframe.open_bag(bag)
    recordings.assert_same(recording.buffer)
    problems = " ".join(recording.problems)
    assert problems.count("to more than the maximum of") == 2


def test_a_file_that_was_compressed_as_a_whole_does_not_fill_the_disk(tmp_path, monkeypatch):
    from rosbags.rosbag2 import CompressionMode, StoragePlugin

    monkeypatch.setattr(storage, "MIN_BUDGET", 8 << 20)
    bag = recordings.write_rosbag2(tmp_path / "bag", StoragePlugin.SQLITE3, CompressionMode.FILE)
    (packed,) = bag.glob("*.zstd")
    packed.write_bytes(packed.read_bytes() + zeros(64 << 20))
    with coframe.open_bag(bag) as recording:
        recordings.assert_same(recording.buffer)
        assert f"{packed.name} unpacks to more than the maximum of 8388608 bytes" in " ".join(recording.problems)


def test_empty_blocks_without_end_are_not_read(tmp_path):
    """A file of zero bytes after the magic number is a sequence of empty blocks."""
    path = tmp_path / "run.db3.zstd"
    path.write_bytes(b"\x28\xb5\x2f\xfd" + bytes(40 << 20))
    with pytest.raises(coframe.RecordingError, match=r"is damaged: \d+ bytes unpack to only 0"):
        coframe.open_bag(path)


@pytest.mark.parametrize("topic", ["/tf", "/camera"])
def test_messages_with_a_high_ratio_have_a_budget_together(tmp_path, monkeypatch, topic):
    import zstandard
    from rosbags.rosbag2 import CompressionMode, StoragePlugin

    monkeypatch.setattr(storage, "MIN_BUDGET", 32 << 20)
    bag = recordings.write_rosbag2(tmp_path / "bag", StoragePlugin.SQLITE3, CompressionMode.MESSAGE)
    (database,) = bag.glob("*.db3")
    message = zstandard.compress(bytes(8 << 20), 1)
    with closing(sqlite3.connect(database)) as opened, opened:
        opened.execute("INSERT INTO topics VALUES (99, '/camera', 'x', 'cdr', '', '')")
        (number,) = opened.execute("SELECT id FROM topics WHERE name = ?", (topic,)).fetchone()
        row = "INSERT INTO messages(topic_id, timestamp, data) VALUES (?, ?, ?)"
        opened.executemany(row, [(number, START + index, message) for index in range(20)])
    with coframe.open_bag(bag) as recording:
        for _ in range(2):  # Reading a message again does not count again.
            found = [message for message in recording.messages(topic) if len(message.data) == 8 << 20]
            assert len(found) == 4
        assert "a message of" in " ".join(recording.problems)
        assert "to more than the maximum of" in " ".join(recording.problems)
