# SPDX-License-Identifier: Apache-2.0
"""SQLite files that cost far more than their size, and journals: nothing is written next to a recording."""

import os
import shutil
import sqlite3
import struct
import subprocess
import sys
import time
from contextlib import closing
from pathlib import Path

import pytest
import recordings
import sqlite_pages
from click.testing import CliRunner
from hostile import examine
from recordings import COUNT

import coframe
from coframe.cli.app import app

MAX_SECONDS = 20  # two cores that others use too; without limits, most of these end in days
TOPICS = "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, serialization_format TEXT)"
MESSAGES = "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, data BLOB)"
TF = ("/tf", "tf2_msgs/msg/TFMessage")
SCAN = ("/scan", "sensor_msgs/msg/LaserScan")
ENDLESS = "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n)"
HOSTILE = {}


def hostile(sentence):
    """Register a function that writes a file, with what the problems of the recording contain."""

    def register(write):
        HOSTILE[write.__name__] = (write, sentence)
        return write

    return register


def database(path, *statements, topics=TOPICS, smuggled=()):
    """Write a database with a topic; `smuggled` are rows of sqlite_master that SQLite does not check."""
    with closing(sqlite3.connect(path)) as connection, connection:
        connection.execute(topics)
        connection.execute("INSERT INTO topics(id, name) VALUES (1, '/tf')")
        for statement in statements:
            connection.execute(statement)
        connection.execute("PRAGMA writable_schema = ON")
        connection.executemany("INSERT INTO sqlite_master VALUES (?, ?, ?, ?, ?)", smuggled)


def numbers(count):
    return f"(WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n WHERE i < {count}) SELECT i FROM n)"


@hostile("more bytes than the file")
def transforms_with_shared_data(path):
    sqlite_pages.shared_data(path, TF)


@hostile("more bytes than the file")
def scans_with_shared_data(path):
    sqlite_pages.shared_data(path, SCAN)


@hostile("contains a page twice")
def endless_rows(path):
    sqlite_pages.endless_rows(path, TF)


@hostile("more steps than in any valid recording")
def endless_rows_of_no_topic(path):
    sqlite_pages.endless_rows(path, TF, topic_of_rows=2)


@hostile("malformed")
def page_in_itself(path):
    sqlite_pages.page_in_itself(path, TF)


@hostile("neither a table nor an index")
def endless_view(path):
    database(
        path, f"CREATE VIEW messages AS {ENDLESS} SELECT i AS id, 1 AS topic_id, i AS timestamp, '' AS data FROM n"
    )


@hostile("neither a table nor an index")
def view_of_huge_values(path):
    database(path, "CREATE VIEW messages AS SELECT 1 AS id, 1 AS topic_id, 1 AS timestamp, zeroblob(500000000) AS data")


@hostile("neither a table nor an index")
def views_that_double(path):
    base = "CREATE VIEW v0 AS SELECT 1 AS id, 1 AS topic_id, 1 AS timestamp, x'00' AS data"
    views = [f"CREATE VIEW v{i} AS SELECT * FROM v{i - 1} UNION ALL SELECT * FROM v{i - 1}" for i in range(1, 40)]
    database(path, base, *views, "CREATE VIEW messages AS SELECT * FROM v39")


@hostile("the database cannot be read")
def view_below_the_name_of_a_table(path):
    view = f"CREATE VIEW messages AS {ENDLESS} SELECT i AS id, 1 AS topic_id, i AS timestamp, x'00' AS data FROM n"
    table = ("table", "messages", "messages", 2, "CREATE TABLE other(id)")
    database(path, smuggled=[table, ("view", "other", "other", 0, view)])


@hostile("neither a table nor an index")
def view_behind_a_comment(path):
    view = f"CREATE/* TABLE */VIEW messages AS {ENDLESS} SELECT i AS id FROM n"
    database(path, smuggled=[("view", "messages", "messages", 0, view)])


@hostile("neither a table nor an index")
def virtual_table(path):
    database(path, "CREATE VIRTUAL TABLE messages USING fts5(topic_id, timestamp, data)")


@hostile("neither a table nor an index")
def trigger(path):
    database(path, MESSAGES, "CREATE TRIGGER t AFTER INSERT ON messages BEGIN SELECT 1; END")


@hostile("generated columns")
def generated_data(path):
    insert = f"INSERT INTO messages(topic_id, timestamp) SELECT 1, i FROM {numbers(1000)}"
    database(path, MESSAGES.replace("BLOB", "BLOB AS (zeroblob(500000000))"), insert)


@hostile("generated columns")
def generated_type(path):
    topics = TOPICS.replace("type TEXT", "type TEXT AS (hex(zeroblob(200000000)))")
    database(path, MESSAGES, topics=topics)


@hostile("more bytes than the file")
def one_value_for_all_rows(path):
    database(
        path,
        MESSAGES.replace(", data BLOB", ""),
        f"INSERT INTO messages(topic_id, timestamp) SELECT 1, i FROM {numbers(100_000)}",
        f"ALTER TABLE messages ADD COLUMN data BLOB DEFAULT x'{'00' * 9000}'",
    )


@hostile("no such column: rowid")
def table_without_rowid(path):
    database(path, f"{MESSAGES} WITHOUT ROWID")


@hostile("a column named rowid")
def rows_that_must_be_sorted(path):
    insert = "INSERT INTO messages VALUES ('b', 1, 1, x'00'), ('a', 1, 1, x'00')"
    database(path, MESSAGES.replace("id INTEGER PRIMARY KEY", "rowid TEXT"), insert)


@hostile("too many columns")
def many_columns(path):
    database(path, MESSAGES.replace("data", f"{', '.join(f'c{i}' for i in range(1900))}, data"))


@hostile("the database cannot be read")
def many_tables(path):
    rows = [("table", f"t{i}", f"t{i}", 2, f"CREATE TABLE t{i}(a, b, c)") for i in range(50_000)]
    database(path, MESSAGES, smuggled=rows)


@hostile("the database cannot be read")
def many_indexes(path):
    rows = [("index", f"i{i}", "messages", 4 + i, f"CREATE INDEX i{i} ON messages(topic_id)") for i in range(3000)]
    insert = f"INSERT INTO messages SELECT i, 1, i, zeroblob(3000) FROM {numbers(4000)}"
    database(path, MESSAGES, insert, smuggled=rows)


@hostile("the database cannot be read")
def long_definition(path):
    keys = ", ".join(f"UNIQUE(c{i % 90}, c{i // 90})" for i in range(90 * 90) if i % 90 != i // 90)
    columns = ", ".join(f"c{i}" for i in range(90))
    definition = f"CREATE TABLE messages(id INTEGER PRIMARY KEY, {columns}, {keys})"
    database(path, smuggled=[("table", "messages", "messages", 2, definition)])


@hostile(None)
def long_statistics(path):
    insert = f"INSERT INTO sqlite_stat1 SELECT 'messages', NULL, hex(zeroblob(10000)) FROM {numbers(2000)}"
    database(path, MESSAGES, "ANALYZE", insert)


@hostile("no such column")
def missing_columns(path):
    database(path, "CREATE TABLE messages(id INTEGER PRIMARY KEY)", "INSERT INTO messages VALUES (1)")


@hostile("no table messages")
def no_messages(path):
    database(path)


@hostile(None)
def extreme_numbers(path):
    insert = "INSERT INTO messages VALUES ({0}, 1, {0}, x'00')"
    database(path, MESSAGES, *(insert.format(number) for number in (-(1 << 63), -1, 0, (1 << 63) - 1)))


@hostile("wrong type")
def texts_in_place_of_data(path):
    database(path, MESSAGES, f"INSERT INTO messages(topic_id, timestamp, data) SELECT 1, i, hex(i) FROM {numbers(9)}")


@hostile(None)
def free_pages_that_do_not_exist(path):
    database(path, MESSAGES)
    with path.open("r+b") as file:
        file.seek(32)
        file.write(struct.pack(">II", 0xFFFFFFFF, 0x7FFFFFFF))


@pytest.mark.parametrize("name", HOSTILE)
def test_a_hostile_database_takes_little_time_and_reports_why(tmp_path, name):
    write, sentence = HOSTILE[name]
    path = tmp_path / "run.db3"
    write(path)
    started = time.monotonic()
    problems = examine(path)
    assert time.monotonic() - started < MAX_SECONDS
    assert sentence is None or sentence in " ".join(problems)
    for command in (["bag", "info"], ["doctor"]):
        result = CliRunner().invoke(app, [*command, str(path)])
        assert "Traceback" not in result.output
    assert time.monotonic() - started < MAX_SECONDS


@pytest.mark.skipif(sys.platform == "win32", reason="Windows does not limit memory")
def test_hostile_databases_take_little_memory(tmp_path):
    for name, (write, _) in HOSTILE.items():
        write(tmp_path / f"{name}.db3")
    program = str(Path(__file__).with_name("hostile.py"))
    files = sorted(map(str, tmp_path.glob("*.db3")))
    done = subprocess.run([sys.executable, program, *files], capture_output=True, text=True, check=True)
    assert len(done.stdout.splitlines()) == len(files)
    assert "MemoryError" not in done.stdout


def state(folder):
    """Return names, contents and times of all files."""
    return {file.name: (file.read_bytes(), file.stat().st_mtime_ns) for file in sorted(folder.iterdir())}


def killed_recorder(folder, mode):
    """Write a recording whose recorder was killed while it removed messages: during the transaction, or after it."""
    path = recordings.write_sqlite(folder / "run.db3", 4)
    program = (
        "import os, sqlite3, sys\n"
        f"connection = sqlite3.connect({str(path)!r}, isolation_level=None)\n"
        f"connection.execute('PRAGMA journal_mode = {mode}')\n"
        "connection.execute('PRAGMA cache_size = 2')\n"
        "connection.execute('PRAGMA wal_autocheckpoint = 0')\n"
        "connection.execute('BEGIN')\n"
        "connection.execute('DELETE FROM messages WHERE id > 40')\n"
    )
    if mode == "DELETE":
        program += "connection.execute('UPDATE messages SET data = zeroblob(3000) WHERE id > 10')\n"
    else:
        program += "connection.execute('COMMIT')\n"
    subprocess.run([sys.executable, "-c", f"{program}os._exit(0)\n"], check=True)
    return path


def messages_of(path):
    with coframe.open_bag(path) as recording:
        return sum(topic.messages for topic in recording.topics.values()), recording.problems


def test_a_rollback_journal_is_applied_to_a_copy(tmp_path):
    path = killed_recorder(tmp_path, "DELETE")
    before = state(tmp_path)
    assert set(before) == {"run.db3", "run.db3-journal"}, "the recorder was killed during a transaction"
    assert messages_of(path) == (COUNT + 1, [])
    assert state(tmp_path) == before


@pytest.mark.parametrize("has_index", [True, False])
def test_a_write_ahead_log_is_read_without_changing_it(tmp_path, has_index):
    path = killed_recorder(tmp_path, "WAL")
    if not has_index:
        (tmp_path / "run.db3-shm").unlink()
    before = state(tmp_path)
    assert messages_of(path) == (40, [])
    assert state(tmp_path) == before
    link = tmp_path / "link.db3"
    link.symlink_to(path)
    assert messages_of(link) == (40, []), "the log is next to the file itself"


def test_a_recording_in_progress_is_read_without_changing_it(tmp_path):
    path = recordings.write_sqlite(tmp_path / "run.db3", 4)
    program = (
        "import sqlite3, sys\n"
        f"recorder = sqlite3.connect({str(path)!r}, isolation_level=None)\n"
        "recorder.execute('PRAGMA journal_mode = WAL')\n"
        "recorder.execute('DELETE FROM messages WHERE id > 50')\n"
        "print('recording', flush=True)\n"
        "sys.stdin.read()\n"
    )
    with subprocess.Popen([sys.executable, "-c", program], stdin=subprocess.PIPE, stdout=subprocess.PIPE) as recorder:
        recorder.stdout.readline()
        before = state(tmp_path)
        assert messages_of(path) == (50, [])
        assert state(tmp_path) == before


def test_opening_creates_no_files(tmp_path):
    path = recordings.write_sqlite(tmp_path / "run.db3", 4)
    with closing(sqlite3.connect(path)) as connection:
        connection.execute("PRAGMA journal_mode = WAL")
    before = state(tmp_path)
    assert messages_of(path) == (COUNT + 1, [])
    assert state(tmp_path) == before


def test_a_journal_cannot_delete_other_files(tmp_path):
    """Where two databases are changed together, SQLite deletes the file that their journals name."""
    victim = tmp_path / "notes.txt"
    victim.write_text("important")
    path = killed_recorder(tmp_path, "DELETE")
    name = str(victim).encode()
    with (tmp_path / "run.db3-journal").open("ab") as journal:
        journal.write(struct.pack(">I", 1) + name + struct.pack(">II", len(name), sum(name)))
        journal.write(b"\xd9\xd5\x05\xf9\x20\xa1\x63\xd7")
    before = state(tmp_path)
    _, problems = messages_of(path)
    assert "the journal belongs to several databases" in problems[0]
    assert state(tmp_path) == before


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no named pipes in folders")
@pytest.mark.parametrize("kind", ["wal", "journal", "shm"])
def test_journals_that_are_not_regular_files(tmp_path, kind):
    path = killed_recorder(tmp_path, "WAL")
    special = tmp_path / f"run.db3-{kind}"
    special.unlink(missing_ok=True)
    os.mkfifo(special)
    found, problems = messages_of(path)
    if kind == "shm":
        assert (found, problems) == (40, [])
    else:
        assert "the path is a named pipe" in problems[0]
        assert "the last messages are missing" in problems[0]


def test_a_copy_that_does_not_fit_is_not_made(tmp_path, monkeypatch):
    path = killed_recorder(tmp_path, "WAL")
    (tmp_path / "run.db3-shm").unlink()
    monkeypatch.setattr("coframe.bags._sqlite_database.MAX_RECOVERED", 1000)
    found, problems = messages_of(path)
    assert found == COUNT + 1
    assert "exceeds the maximum of 1000 for recovery" in problems[0]


def test_the_copy_is_removed(tmp_path, monkeypatch):
    folder = tmp_path / "temporary"
    folder.mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(folder))
    path = killed_recorder(tmp_path, "DELETE")
    with coframe.open_bag(path):
        assert list(folder.iterdir())
    assert not list(folder.iterdir())


def test_recordings_of_other_tools_are_read(tmp_path):
    """Their tables have other keys and other columns as well."""
    path = recordings.write_sqlite(tmp_path / "run.db3", 4)
    copy = tmp_path / "copy.db3"
    shutil.copy(path, copy)
    with closing(sqlite3.connect(copy, isolation_level=None)) as connection:
        connection.execute("ALTER TABLE messages RENAME TO old")
        connection.execute(
            "CREATE TABLE messages(id INTEGER, topic_id INTEGER, timestamp INTEGER, data BLOB, note TEXT)"
        )
        connection.execute("INSERT INTO messages SELECT id, topic_id, timestamp, data, 'x' FROM old")
        connection.execute("DROP TABLE old")
        connection.execute("CREATE INDEX by_topic ON messages(topic_id, timestamp)")
        connection.execute("ANALYZE")
    assert messages_of(copy) == messages_of(path) == (COUNT + 1, [])
