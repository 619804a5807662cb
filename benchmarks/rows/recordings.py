# SPDX-License-Identifier: Apache-2.0
"""Opening a recording: all transforms from its file into a buffer."""

import functools
import sqlite3
import tempfile
from collections.abc import Callable, Generator
from pathlib import Path
from typing import Any

import coframe
from benchmarks import motion, peers
from benchmarks.measuring import Contender, Row, Target, TimesAsFast
from benchmarks.motion import frame
from benchmarks.statement import Statement

TYPE = "tf2_msgs/msg/TFMessage"
MESSAGES, TRANSFORMS = 20_000, 2


@functools.cache
def messages() -> list[tuple[int, bytes]]:
    """Return receive time and bytes of the messages."""
    found = []
    for i in range(MESSAGES):
        moment = coframe.Buffer(None)
        for edge in range(TRANSFORMS):
            *translation, qx, qy, qz, qw = motion.values(edge, i)
            pose = coframe.Transform(translation, (qx, qy, qz, qw))
            moment.set(frame(edge), frame(edge + 1), pose, motion.stamp(edge, i))
        found.append((motion.stamp(0, i), moment.encode(static=False)))
    return found


def mcap(folder: Path) -> Path:
    peers.package("rosbags")
    from mcap.writer import Writer
    from rosbags.typesys import Stores, get_typestore

    definition, _ = get_typestore(Stores.ROS2_HUMBLE).generate_msgdef(TYPE, ros_version=2)
    path = folder / "run.mcap"
    with path.open("wb") as stream:
        writer: Any = Writer(stream)  # zstd, chunks of a megabyte
        writer.start(profile="ros2")
        channel = writer.register_channel("/tf", "cdr", writer.register_schema(TYPE, "ros2msg", definition.encode()))
        for at, data in messages():
            writer.add_message(channel, at, data, at)
        writer.finish()
    return path


def sqlite(folder: Path) -> Path:
    path = folder / "run.db3"
    database = sqlite3.connect(path)
    with database:
        database.execute(
            "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, serialization_format TEXT, "
            "offered_qos_profiles TEXT)"
        )
        database.execute(
            "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, data BLOB)"
        )
        database.execute("INSERT INTO topics VALUES (1, '/tf', ?, 'cdr', '')", (TYPE,))
        database.executemany("INSERT INTO messages(topic_id, timestamp, data) VALUES (1, ?, ?)", messages())
    database.close()
    return path


def statement(code: str, **names: object) -> Statement:
    return Statement(code, names, items=MESSAGES * TRANSFORMS)


def rosbags(path: Path) -> Statement:
    """Return a statement that reads and decodes all messages."""
    peers.package("rosbags")
    from rosbags.highlevel import AnyReader
    from rosbags.typesys import Stores, get_typestore

    code = """
with AnyReader([path], default_typestore=store) as reader:
    for connection, _, data in reader.messages():
        reader.deserialize(data, connection.msgtype)
"""
    return statement(code, AnyReader=AnyReader, path=path, store=get_typestore(Stores.ROS2_HUMBLE))


def tf_tree(path: Path) -> Statement:
    return statement("ingest(path)", ingest=peers.package("tf_tree").ingest_bag, path=path)


def opening(
    name: str, write: Callable[[Path], Path], reference: str, other: Callable[[Path], Contender], target: Target
) -> Row:
    def contenders() -> Generator[Contender]:
        with tempfile.TemporaryDirectory() as folder:
            path = write(Path(folder))
            with coframe.open_bag(path) as recording:
                assert [edge.samples for edge in recording.buffer.edges()] == [MESSAGES] * TRANSFORMS
            yield statement("open_bag(path)", open_bag=coframe.open_bag, path=path)
            yield other(path)

    return Row(f"open_bag, {name}, per transform", reference, contenders, target)


ROWS = [
    opening("MCAP, zstd", mcap, "rosbags, reading and decoding only", rosbags, TimesAsFast(10)),
    opening("MCAP, zstd", mcap, "tf_tree.ingest_bag", tf_tree, TimesAsFast(1)),
    opening("SQLite", sqlite, "rosbags, reading and decoding only", rosbags, TimesAsFast(10)),
]
