# SPDX-License-Identifier: Apache-2.0
"""Messages with equal receive times come in rosbag2's order, also after conversion, slicing and merging.

rosbag2 reads SQLite by `ORDER BY messages.timestamp, messages.id`, and MCAP by time and then by position in the file.
"""

import random
import sqlite3

import pytest
import recordings
from mcap.records import Message
from mcap.stream_reader import StreamReader
from mcap.writer import CompressionType
from recordings import START

import coframe
from coframe.bags.copying import copy_recordings

pytestmark = [pytest.mark.slow, pytest.mark.timeout(1200)]

RECORDINGS = 150
TOPICS = ["/d", "/a", "/tf", "/c", "/b"]
KIND = ("std_msgs/msg/UInt32", "ros2msg", b"uint32 data", "cdr")


def rows(rng):
    """Return messages, numbered in the order of writing, of which many have equal times and some are early."""
    times = [START + rng.randrange(rng.choice([1, 3, 20, 1000])) for _ in range(rng.randrange(1, 120))]
    if rng.random() < 0.5:
        times.sort()
    return [(rng.choice(TOPICS), at, b"\0\1\0\0" + number.to_bytes(4, "little")) for number, at in enumerate(times)]


def number_of(data):
    return int.from_bytes(data[4:8], "little")


def by_rosbag2(path):
    """Return the numbers of the messages in the order in which rosbag2 reads a file."""
    if path.suffix == ".db3":
        database = sqlite3.connect(path)
        query = (
            "SELECT data FROM messages JOIN topics ON messages.topic_id = topics.id "
            "ORDER BY messages.timestamp, messages.id"
        )
        found = [number_of(data) for (data,) in database.execute(query)]
        database.close()
        return found
    with path.open("rb") as stream:
        in_file = [record for record in StreamReader(stream).records if isinstance(record, Message)]
    return [number_of(record.data) for record in sorted(in_file, key=lambda record: record.log_time)]


@pytest.mark.parametrize("kind", ["db3", "chunks", "no chunks"])
def test_the_order_is_that_of_rosbag2(tmp_path, kind):
    rng = random.Random(kind)
    for number in range(RECORDINGS):
        made = rows(rng)
        types = dict.fromkeys(TOPICS, KIND)
        if kind == "db3":
            path = recordings.write_sqlite(tmp_path / f"{number}.db3", 3, rows=made, type_=KIND[0])
        else:
            path = tmp_path / f"{number}.mcap"
            recordings.write_mcap(path, CompressionType.ZSTD, chunked=kind == "chunks", rows=made, types=types)
        expected = by_rosbag2(path)
        assert sorted(expected) == list(range(len(made)))
        with coframe.open_bag(path) as bag:
            assert [number_of(data) for _, _, data in bag.in_order()] == expected
            start = START + rng.randrange(20)
            times = {number_of(data): at for _, at, data in bag.in_order()}
            after = [each for each in expected if times[each] >= start]
            assert [number_of(data) for _, _, data in bag.in_order(start=start)] == after
            chosen = rng.sample(sorted(bag.topics), rng.randrange(1, len(bag.topics) + 1))
            of_topics = {number_of(data) for topic, _, data in made if topic in chosen}
            assert [number_of(data) for _, _, data in bag.in_order(chosen)] == [e for e in expected if e in of_topics]
        if number % 10 == 0:
            copied = copy_recordings([path], tmp_path / f"{number}").path
            (file,) = copied.glob("*.mcap")
            assert by_rosbag2(file) == expected
