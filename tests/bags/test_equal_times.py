# SPDX-License-Identifier: Apache-2.0
"""Messages with equal receive times keep the order in which they were written, as in rosbag2."""

import sqlite3
import struct

import pytest
from mcap.reader import make_reader
from mcap.writer import Writer as McapWriter
from rosbags.rosbag1 import Writer as Rosbag1Writer

import coframe
from coframe.bags import repair
from coframe.bags.copying import copy_recordings
from coframe.time import SECOND

# What a simulator publishes in each step: the sensors before the clock and the transforms, and one topic twice.
STEP = ["/wheels", "/clock_source", "/map", "/wheels", "/bumper", "/clock_source"]
STEPS = 4
PERIOD = SECOND // 10
WRITTEN = list(range(STEPS * len(STEP)))


def rows():
    return [(topic, SECOND + step * PERIOD) for step in range(STEPS) for topic in STEP]


def text(number):
    return struct.pack("<I", 3) + f"{number:02}\0".encode()


def number_of(data):
    return int(bytes(data).rstrip(b"\0")[-2:])


def write_db3(path):
    with sqlite3.connect(path) as database:
        database.execute("CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, serialization_format TEXT)")
        database.execute(
            "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, data BLOB)"
        )
        names = sorted(set(STEP))
        for index, name in enumerate(names, start=1):
            database.execute("INSERT INTO topics VALUES(?, ?, 'std_msgs/msg/String', 'cdr')", (index, name))
        for number, (topic, at) in enumerate(rows()):
            values = (names.index(topic) + 1, at, b"\0\1\0\0" + text(number))
            database.execute("INSERT INTO messages(topic_id, timestamp, data) VALUES(?, ?, ?)", values)
    database.close()


def write_mcap(path, chunk_size=100):
    with path.open("wb") as stream:
        writer = McapWriter(stream, chunk_size=chunk_size)
        writer.start(profile="ros2")
        schema = writer.register_schema("std_msgs/msg/String", "ros2msg", b"string data\n")
        channels = {}
        for number, (topic, at) in enumerate(rows()):
            # A second publisher of a topic has a channel of its own.
            key = (topic, number % 2)
            if key not in channels:
                channels[key] = writer.register_channel(topic, "cdr", schema, {"publisher": str(number)})
            writer.add_message(channels[key], at, b"\0\1\0\0" + text(number), at)
        writer.finish()


def write_ros1(path):
    with Rosbag1Writer(path) as writer:
        connections = {
            topic: writer.add_connection(topic, "std_msgs/msg/String", msgdef="string data\n", md5sum="0" * 32)
            for topic in sorted(set(STEP))
        }
        for number, (topic, at) in enumerate(rows()):
            writer.write(connections[topic], at, struct.pack("<I", 2) + f"{number:02}".encode())


WRITERS = {"db3": write_db3, "mcap": write_mcap, "bag": write_ros1}


@pytest.fixture(params=WRITERS)
def path(request, tmp_path):
    file = tmp_path / f"steps_0.{request.param}"
    WRITERS[request.param](file)
    return file


def in_file(folder):
    """Return the messages of a new MCAP recording in the order of the file, as the package mcap reads them."""
    (file,) = folder.glob("*.mcap")
    with file.open("rb") as stream:
        return [number_of(message.data) for *_, message in make_reader(stream).iter_messages(log_time_order=False)]


def test_messages_are_read_in_the_order_of_the_file(path):
    with coframe.open_bag(path) as bag:
        assert [number_of(data) for *_, data in bag.in_order()] == WRITTEN
        late = bag.in_order(None, SECOND + 2 * PERIOD)
        assert [number_of(data) for *_, data in late] == WRITTEN[2 * len(STEP) :]
        chosen = [number for number, (topic, _) in enumerate(rows()) if topic in {"/wheels", "/map"}]
        assert [number_of(data) for *_, data in bag.in_order(["/map", "/wheels"])] == chosen


def test_the_messages_of_one_topic_are_in_the_order_of_the_file(path):
    with coframe.open_bag(path) as bag:
        for topic in set(STEP):
            own = [number for number, (name, _) in enumerate(rows()) if name == topic]
            assert [number_of(message.data) for message in bag.messages(topic)] == own


def test_rosbag2_py_reads_and_seeks_in_the_order_of_the_file(path):
    import rosbag2_py

    if path.suffix == ".bag":
        pytest.skip("rosbag2 does not read bags of ROS 1")
    reader = rosbag2_py.SequentialReader()
    reader.open_uri(str(path))
    found = []
    while reader.has_next():
        found.append(number_of(reader.read_next()[1]))
    assert found == WRITTEN
    reader.seek(SECOND + PERIOD)
    found = []
    while reader.has_next():
        found.append(number_of(reader.read_next()[1]))
    assert found == WRITTEN[len(STEP) :]


def test_copies_keep_the_order_of_the_file(path, tmp_path):
    copy_recordings([path], tmp_path / "converted")
    assert in_file(tmp_path / "converted") == WRITTEN
    repair(path, tmp_path / "repaired")
    assert in_file(tmp_path / "repaired") == WRITTEN
    copy_recordings([path], tmp_path / "sliced", span=lambda _: (SECOND + PERIOD, SECOND + 3 * PERIOD))
    assert in_file(tmp_path / "sliced") == WRITTEN[len(STEP) : 3 * len(STEP)]


def test_merging_keeps_the_order_of_each_recording(path, tmp_path):
    copy_recordings([path, path], tmp_path / "merged")
    steps = [WRITTEN[first : first + len(STEP)] for first in range(0, len(WRITTEN), len(STEP))]
    assert in_file(tmp_path / "merged") == [number for step in steps for number in [*step, *step]]


def test_the_files_of_one_recording_come_one_after_the_other(tmp_path):
    write_mcap(tmp_path / "run_0.mcap")
    write_mcap(tmp_path / "run_1.mcap")
    with coframe.open_bag(tmp_path) as bag:
        numbers = [number_of(data) for *_, data in bag.in_order()]
    assert numbers[: 2 * len(STEP)] == [*range(len(STEP)), *range(len(STEP))]
