# SPDX-License-Identifier: Apache-2.0
"""Damaged SQLite recordings: coframe reads each row that an independent scan of the leaf pages finds, and no others."""

import random
import sqlite3
import struct

import pytest
from recordings import START
from sqlite_leaf_scan import rows_on_leaves

import coframe

pytestmark = [pytest.mark.slow, pytest.mark.timeout(1200)]

FILES = 200
ROWS = 600


def write(path, page_size, rng):
    """Write a recording with small and large messages; return its rows by number."""
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
    database.execute("INSERT INTO topics VALUES(1, '/small', 'std_msgs/msg/UInt8', 'cdr', '')")
    database.execute("INSERT INTO topics VALUES(2, '/large', 'std_msgs/msg/ByteMultiArray', 'cdr', '')")
    rows = {}
    for number in range(1, ROWS + 1):
        is_large = rng.random() < 0.05
        size = rng.randrange(page_size, 4 * page_size) if is_large else rng.randrange(8, 120)
        data = b"\0\1\0\0" + struct.pack("<I", number) + rng.randbytes(size)
        rows[number] = (2 if is_large else 1, START + number * 1000, data)
        database.execute("INSERT INTO messages VALUES(?, ?, ?, ?)", (number, *rows[number]))
    if rng.random() < 0.7:
        database.execute("CREATE INDEX timestamp_idx ON messages(timestamp ASC)")
    database.commit()
    database.close()
    return rows


def inner_pages(data, page_size):
    return [at for at in range(page_size, len(data) - page_size + 1, page_size) if data[at] == 5] or [page_size]


def flipped(data, places, rng):
    changed = bytearray(data)
    for at in places:
        changed[at] ^= 1 << rng.randrange(8)
    return bytes(changed)


def damage(data, page_size, rng):
    """Return the bytes of a file with one kind of damage."""
    start = rng.randrange(1, len(data) // page_size) * page_size
    end = min(start + rng.randrange(1, 6) * page_size, len(data))
    inner = rng.choice(inner_pages(data, page_size)) + rng.randrange(page_size - 40)
    kinds = {
        "a hole": lambda: data[:start] + bytes(end - start) + data[end:],
        "pages of another file": lambda: data[:start] + rng.randbytes(end - start) + data[end:],
        "a lost end": lambda: data[: start + rng.randrange(page_size)],
        "an end that was never written": lambda: data[:start] + bytes(len(data) - start),
        "a lost first page": lambda: bytes(page_size) + data[page_size:],
        "a lost schema": lambda: data[:100] + bytes(page_size - 100) + data[page_size:],
        "wrong pointers": lambda: data[:inner] + rng.randbytes(40) + data[inner + 40 :],
        "flipped bits": lambda: flipped(data, rng.choices(range(page_size, len(data)), k=rng.randrange(1, 20)), rng),
        "two pages exchanged": lambda: data[:start] + data[-page_size:] + data[start + page_size : -page_size]
        + data[start : start + page_size],
    }  # fmt: skip
    kind = rng.choice(list(kinds))
    return kind, kinds[kind]()


def read(path):
    """Return the messages by topic and time; empty if nothing can be read."""
    try:
        with coframe.open_bag(path) as bag:
            topics = [(topic, number) for topic, number in (("/small", 1), ("/large", 2)) if topic in bag.topics]
            found = {(number, one.received): one.data for topic, number in topics for one in bag.messages(topic)}
            return found, bag.problems
    except coframe.RecordingError as error:
        return {}, [str(error)]


@pytest.mark.parametrize("page_size", [512, 4096])
def test_all_rows_on_intact_leaves_are_read(tmp_path, page_size):
    rng = random.Random(page_size)
    kept = lost = 0
    for number in range(FILES):
        path = tmp_path / f"{number}.db3"
        rows = write(path, page_size, rng)
        kind, content = damage(path.read_bytes(), page_size, rng)
        path.write_bytes(content)
        written = {(topic, at): data for topic, at, data in rows.values()}
        scanned = {
            (values[1], values[2]): values[3]
            for row, values in rows_on_leaves(path, page_size)
            if len(values) == 4 and rows.get(row) == tuple(values[1:])
        }
        found, problems = read(path)
        if any("its topics are lost" in problem for problem in problems):
            continue
        unread = {key for key in scanned if found.get(key) != written[key]}
        # A flipped bit in the number of a row can make it that of another one, which is then there twice.
        assert len(unread) <= (3 if kind == "flipped bits" else 0), (
            f"{number}, {kind}: {len(unread)} of {len(scanned)} rows were not read: {problems}"
        )
        # A flipped bit in the data of a row cannot be seen; times and topics must be those of rows.
        strange = {key for key in found if key not in written}
        assert len(strange) <= 20, f"{number}, {kind}: rows that were never written: {problems}"
        # A flipped bit can also move a row to a topic that does not exist.
        if len(found) < ROWS - (2 if kind == "flipped bits" else 0):
            assert problems, f"{number}, {kind}: {ROWS - len(found)} rows are missing without a word"
        kept, lost = kept + len(found), lost + ROWS - len(found)
        path.unlink()
    assert kept > lost > 0
