# SPDX-License-Identifier: Apache-2.0
"""Messages of a damaged SQLite recording are read from the pages that have them, and how many are missing is said."""

import shutil
import sqlite3
import struct
import time

import pytest
from recordings import SECOND, START

import coframe
from coframe.bags import RecordingError, repair
from coframe.bags.copying import copy_recordings

COUNT = 3000


def transforms():
    one = coframe.Buffer(None)
    one.set("odom", "mower", coframe.Transform([0.0, 2, 0]), START)
    data = bytearray(one.encode(static=False))
    for number in range(COUNT):
        data[8:16] = struct.pack("<iI", START // SECOND + number // 100, number % 100 * 10_000_000)
        yield bytes(data)


def write(path, page_size=4096, size=0):
    """Write a recording with /tf, and with messages of the given size on /camera after every tenth of them."""
    database = sqlite3.connect(path)
    database.execute(f"PRAGMA page_size = {page_size}")
    database.execute(
        "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
        "serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL)"
    )
    database.execute(
        "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, timestamp INTEGER NOT NULL, "
        "data BLOB NOT NULL)"
    )
    database.execute("INSERT INTO topics VALUES(1, '/tf', 'tf2_msgs/msg/TFMessage', 'cdr', '')")
    database.execute("INSERT INTO topics VALUES(2, '/camera', 'sensor_msgs/msg/Image', 'cdr', '')")
    insert = "INSERT INTO messages(topic_id, timestamp, data) VALUES(?, ?, ?)"
    for number, data in enumerate(transforms()):
        database.execute(insert, (1, START + number, data))
        if size and number % 10 == 0:
            database.execute(insert, (2, START + number, image(number, size)))
    database.execute("CREATE INDEX timestamp_idx ON messages(timestamp ASC)")
    database.commit()
    database.close()
    return path


def image(number, size):
    return struct.pack("<I", number) + bytes([number % 251]) * (size - 4)


def without_pages(path, first, number, page_size=4096):
    """Overwrite pages, counted from 0, with zeros."""
    data = bytearray(path.read_bytes())
    end = min((first + number) * page_size, len(data))
    data[first * page_size : end] = bytes(end - first * page_size)
    path.write_bytes(data)


def rows_on(path, first, number, page_size=4096):
    """Return how many rows of messages are on the pages, found by the time in their bytes."""
    data = path.read_bytes()[first * page_size : (first + number) * page_size]
    return data.count(b"odom")


@pytest.mark.parametrize("page_size", [1024, 4096, 65536])
@pytest.mark.parametrize("share", [0.3, 0.5, 0.65])
def test_a_hole_costs_only_the_messages_in_it(tmp_path, page_size, share):
    path = write(tmp_path / "a.db3", page_size)
    first = int(path.stat().st_size * share) // page_size
    lost = rows_on(path, first, 1, page_size)
    without_pages(path, first, 1, page_size)
    with coframe.open_bag(path) as bag:
        assert 0 < lost < COUNT
        assert bag.topics["/tf"].messages == COUNT - lost
        assert len(list(bag.messages("/tf"))) == COUNT - lost
        assert f"{COUNT - lost} messages read, {lost} messages of {COUNT} missing" in bag.problems[0]
        assert bag.buffer.lookup("odom", "mower", START + (COUNT - 1) * SECOND // 100).translation[1] == 2


@pytest.mark.parametrize("kind", ["zeros", "cut"])
def test_a_lost_end_costs_only_the_messages_in_it(tmp_path, kind):
    path = write(tmp_path / "a.db3")
    pages = path.stat().st_size // 4096
    kept = rows_on(path, 0, pages // 2)
    if kind == "zeros":
        without_pages(path, pages // 2, pages)
    else:
        path.write_bytes(path.read_bytes()[: pages // 2 * 4096])
    with coframe.open_bag(path) as bag:
        assert bag.topics["/tf"].messages == kept
        assert (
            f"{kept} messages read, 0 missing before the last one; how many come after it is unknown" in bag.problems[0]
        )
    report = repair(path, tmp_path / "repaired")
    assert report.messages == kept
    with coframe.open_bag(tmp_path / "repaired") as bag:
        assert bag.topics["/tf"].messages == kept


def test_large_messages_are_read_from_all_their_pages(tmp_path):
    path = write(tmp_path / "a.db3", size=20_000)
    without_pages(path, path.stat().st_size // 4096 // 2, 1)
    with coframe.open_bag(path) as bag:
        images = [bytes(message.data) for message in bag.messages("/camera")]
        numbers = [struct.unpack_from("<I", data)[0] for data in images]
        assert len(numbers) >= COUNT // 10 - 2
        assert numbers == sorted(set(numbers))
        assert all(data == image(number, 20_000) or 0 in data[4:] for data, number in zip(images, numbers, strict=True))


def test_topics_are_found_without_the_schema(tmp_path):
    path = write(tmp_path / "a.db3")
    data = bytearray(path.read_bytes())
    data[100:4096] = bytes(3996)
    path.write_bytes(data)
    with coframe.open_bag(path) as bag:
        assert {name: topic.messages for name, topic in bag.topics.items()} == {"/tf": COUNT, "/camera": 0}
        assert bag.topics["/camera"].type == "sensor_msgs/msg/Image"


@pytest.mark.parametrize("make", [repair, lambda source, target: copy_recordings([source], target)])
def test_nothing_is_written_if_nothing_can_be_read(tmp_path, make):
    path = write(tmp_path / "a.db3")
    path.write_bytes(path.read_bytes()[:4096])
    with pytest.raises(RecordingError, match=r"because no message can be read: a\.db3: the database is damaged"):
        make(path, tmp_path / "new")
    assert not (tmp_path / "new").exists()


def test_a_missing_write_ahead_log_is_named(tmp_path):
    database = sqlite3.connect(tmp_path / "live.db3")
    database.execute("PRAGMA journal_mode = WAL")
    database.execute("CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, serialization_format TEXT)")
    database.commit()
    shutil.copy(tmp_path / "live.db3", tmp_path / "copy.db3")
    database.close()
    with coframe.open_bag(tmp_path / "copy.db3") as bag:
        assert "its recorder wrote to copy.db3-wal, which is missing" in bag.problems[0]


def test_an_intact_recording_has_no_problems(tmp_path):
    with coframe.open_bag(write(tmp_path / "a.db3", size=5000)) as bag:
        assert bag.problems == []
        assert bag.topics["/tf"].messages == COUNT


@pytest.mark.parametrize("size", [512, 4096])
def test_pages_full_of_cells_that_are_no_rows_take_little_time(tmp_path, size):
    cell = b"\x40\x01" + b"\x81\x48" + b"\x01" * 60
    count = (size - 8 - len(cell)) // 2
    pointer = (size - len(cell)).to_bytes(2, "big")
    page = (b"\x0d\0\0" + count.to_bytes(2, "big") + b"\0\0\0" + pointer * count).ljust(size - len(cell), b"\0") + cell
    file = tmp_path / "hostile.db3"
    file.write_bytes(page * ((8 << 20) // size))
    begin = time.process_time()
    with pytest.raises(RecordingError, match="in none of these formats"):
        coframe.open_bag(file)
    assert time.process_time() - begin < 15.0  # a page has up to 250 cells, which took minutes
