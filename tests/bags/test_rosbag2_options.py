# SPDX-License-Identifier: Apache-2.0
"""The options of `ros2 bag` work in coframe's commands, or are refused with the reason."""

import sqlite3

import pytest
from click.testing import CliRunner
from rosbags.rosbag2 import Reader

from coframe.bags import Writer
from coframe.cli.app import app
from coframe.cli.rosbag2_words import PLAY_WORDS, RECORD_WORDS
from rclpy.serialization import serialize_message
from std_msgs.msg import String

START = 1_700_000_000_000_000_000


def run(*words, code=0):
    result = CliRunner().invoke(app, [str(word) for word in words])
    assert result.exit_code == code, result.output
    return result.output


@pytest.fixture
def bag(tmp_path):
    """Two topics, and the events of a service."""
    with Writer(tmp_path / "run") as writer:
        topics = [writer.add_topic(name, "std_msgs/msg/String") for name in ("/a", "/b")]
        for index in range(4):
            writer.write(topics[index % 2], serialize_message(String(data=str(index))), START + index)
        events = writer.add_topic("/reset/_service_event", "std_srvs/srv/Empty_Event")
        for event in (0, 1, 2, 3, 0):
            writer.write(events, b"\0\1\0\0" + bytes([event]) + bytes(60), START + 10 + event)
    return tmp_path / "run"


def test_words_of_record():
    words = (
        "--topics /a /b -o out -b 0 -d 60 --max-cache-size 1000 --polling-interval 5 --exclude-regex x --log-level info"
    )
    assert RECORD_WORDS.translate(words.split()) == (
        ["--topics", "/a", "--topics", "/b", "-o", "out", "--max-duration", "60", "--backlog", "1000", "--exclude", "x"]
    )
    assert RECORD_WORDS.translate(["--max-bag-size=5", "-s", "sqlite3", "/a"]) == [
        "--max-size=5",
        "--storage",
        "sqlite3",
        "/a",
    ]
    assert RECORD_WORDS.translate(["--services", "/x", "/y", "--", "--topics"]) == [
        "--services",
        "/x",
        "--services",
        "/y",
        "--",
        "--topics",
    ]


def test_words_of_play():
    assert PLAY_WORDS.translate(["run", "--topics", "/a", "/b", "-l", "-s", "mcap"]) == [
        "run",
        "--topics",
        "/a",
        "--topics",
        "/b",
        "--loop",
    ]
    # The recording may also come last.
    assert PLAY_WORDS.translate(["--topics", "/a", "run"]) == ["--topics", "/a", "run"]
    assert PLAY_WORDS.translate(["--rate", "-1", "run"]) == ["--rate", "-1", "run"]


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        (("record", "--snapshot-mode"), "--max-duration"),
        (("record", "-a", "--qos-profile-overrides-path", "x"), "QoS of the publishers"),
        (("play", "run", "--publish-service-requests"), "coframe service call"),
        (("record", "-a", "--compression-mode", "file"), "requires --compression-format"),
        (("record", "--all", "/a"), "cannot be combined"),
        (("play",), "Missing argument BAG"),
        (("convert", "x"), "give either BAG and OUT"),
        (("list", "things"), "Kinds: readers"),
    ],
)
def test_what_does_not_exist_has_a_reason(words, reason):
    assert reason in run("bag", *words, code=2)


def test_services_of_a_recording(bag):
    assert run("bag", "info", bag, "-t") == "/a\n/b\n/reset/_service_event\n"
    row = next(line for line in run("bag", "info", bag, "-v").splitlines() if line.startswith("/reset "))
    assert row.split() == ["/reset", "std_srvs/srv/Empty", "2", "1", "1", "1"]


def test_formats_are_listed():
    assert {"mcap", "sqlite3"} <= set(run("bag", "list", "writers").splitlines())
    assert "readers:\n" in run("bag", "list")
    assert "mcap (.mcap)" in run("bag", "list", "readers", "--verbose").splitlines()


def test_metadata_is_written_again(bag):
    (bag / "metadata.yaml").unlink()
    assert "metadata.yaml was written" in run("bag", "reindex", bag, "mcap")
    with Reader(bag) as reader:
        assert reader.message_count == 9
    assert "is not a folder" in run("bag", "reindex", bag / "run_0.mcap", code=1)


def test_recordings_are_converted_as_a_file_describes(bag, tmp_path):
    options = tmp_path / "out.yaml"
    options.write_text(
        f"output_bags:\n- uri: {tmp_path / 'one'}\n  storage_id: sqlite3\n  topics: [/a]\n"
        f"- uri: {tmp_path / 'all'}\n  storage_id: mcap\n  all_topics: true\n"
    )
    run("bag", "convert", "-i", bag, "mcap", "-o", options)
    with Reader(tmp_path / "one") as reader:
        assert {connection.topic for connection in reader.connections} == {"/a"}
        assert [data for _, _, data in reader.messages()] == [serialize_message(String(data=text)) for text in "02"]
    with sqlite3.connect(tmp_path / "one" / "one_0.db3") as database:
        assert database.execute("SELECT count(*) FROM messages").fetchone() == (2,)
    with Reader(tmp_path / "all") as reader:
        assert reader.message_count == 9
    options.write_text("output_bags: 3")
    assert "has no list 'output_bags'" in run("bag", "convert", "-i", bag, "-o", options, code=1)
