# SPDX-License-Identifier: Apache-2.0
"""rosbag2_py: recordings that scripts write and read, compared with rosbags."""

import gc
from datetime import timedelta
from pathlib import Path
from typing import Any

import pytest
from rosbags.rosbag2 import Reader as RosbagsReader

import rosbag2_py
from coframe.bags import Writer
from rclpy.serialization import deserialize_message, serialize_message
from rosidl_runtime_py.utilities import get_message
from std_msgs.msg import Int32, String

CDR = rosbag2_py.ConverterOptions(input_serialization_format="cdr", output_serialization_format="cdr")


def write(path: Path, storage: str, count: int = 6) -> list[tuple[str, bytes, int]]:
    """Write messages as the tutorial does: two topics, three stamps with two messages each."""
    writer = rosbag2_py.SequentialWriter()
    writer.open(rosbag2_py.StorageOptions(uri=str(path), storage_id=storage), CDR)
    for name, kind in (("/chatter", "std_msgs/msg/String"), ("/numbers", "std_msgs/msg/Int32")):
        writer.create_topic(rosbag2_py.TopicMetadata(name=name, type=kind, serialization_format="cdr"))
    rows = []
    for index in range(count):
        topic, message = ("/chatter", String(data=f"hello {index}")) if index % 2 else ("/numbers", Int32(data=index))
        rows.append((topic, serialize_message(message), 1_700_000_000_000_000_000 + index // 2 * 1_000_000_000))
        writer.write(*rows[-1])
    del writer  # Upstream's writer has no close(); scripts delete it.
    gc.collect()
    return rows


def open_reader(path: Path, storage: str = "") -> rosbag2_py.SequentialReader:
    reader = rosbag2_py.SequentialReader()
    reader.open(rosbag2_py.StorageOptions(uri=str(path), storage_id=storage), CDR)
    return reader


def rest(reader: rosbag2_py.SequentialReader) -> list[tuple[str, bytes, int]]:
    rows = []
    while reader.has_next():
        rows.append(reader.read_next())
    return rows


@pytest.mark.parametrize(("storage", "suffix"), [("sqlite3", ".db3"), ("mcap", ".mcap"), ("", ".mcap")])
def test_what_is_written_is_read_by_rosbags_and_by_the_reader(tmp_path: Path, storage: str, suffix: str) -> None:
    rows = write(tmp_path / "run", storage)
    assert (tmp_path / f"run/run_0{suffix}").is_file()
    with RosbagsReader(tmp_path / "run") as theirs:
        assert [(c.topic, data, stamp) for c, stamp, data in theirs.messages()] == rows
        assert theirs.topics["/chatter"].msgtype == "std_msgs/msg/String"
    reader = open_reader(tmp_path / "run", storage)
    types = {topic.name: topic.type for topic in reader.get_all_topics_and_types()}
    assert types == {"/chatter": "std_msgs/msg/String", "/numbers": "std_msgs/msg/Int32"}
    assert rest(reader) == rows
    topic, data, _ = rows[1]
    assert deserialize_message(data, get_message(types[topic])) == String(data="hello 1")
    with pytest.raises(RuntimeError, match="Bag is at end"):
        reader.read_next()


def test_filters_and_seeking_continue_where_the_reader_is(tmp_path: Path) -> None:
    rows = write(tmp_path / "run", "mcap")
    reader = open_reader(tmp_path / "run")
    assert [reader.read_next(), reader.has_next()] == [rows[0], True]
    reader.set_filter(rosbag2_py.StorageFilter(topics=["/chatter"]))
    assert reader.read_next() == rows[1]
    reader.set_filter(rosbag2_py.StorageFilter(topics_regex="/num.*"))
    assert reader.read_next() == rows[2]
    reader.reset_filter()
    assert rest(reader) == rows[3:]
    reader.seek(rows[4][2])
    assert rest(reader) == rows[4:]
    reader.seek(0)
    reader.set_filter(rosbag2_py.StorageFilter(topics_regex_to_exclude="/num.*"))
    assert rest(reader) == rows[1::2]
    assert reader.set_read_order(rosbag2_py.ReadOrder())
    assert not reader.set_read_order(rosbag2_py.ReadOrder(reverse=True))
    limited = rosbag2_py.SequentialReader()
    limited.open(rosbag2_py.StorageOptions(uri=str(tmp_path / "run"), start_time_ns=rows[2][2], end_time_ns=rows[2][2]))
    assert rest(limited) == rows[2:4]


def test_real_recordings_equal_what_rosbags_reads(shared: Path) -> None:
    folder = shared / "recordings/world_talk_1hz"
    with RosbagsReader(folder) as theirs:
        expected = [(c.topic, bytes(data), stamp) for c, stamp, data in theirs.messages()]
        duration, start, count = theirs.duration, theirs.start_time, theirs.message_count
    assert rest(open_reader(folder)) == expected
    for metadata in (
        rosbag2_py.Info().read_metadata(str(folder), "sqlite3"),
        rosbag2_py.MetadataIo().read_metadata(str(folder)),
    ):
        assert (metadata.message_count, metadata.storage_identifier, metadata.version) == (count, "sqlite3", 5)
        assert metadata.starting_time.nanoseconds == start
        assert metadata.duration.nanoseconds == pytest.approx(duration, abs=1)
        assert metadata.duration // timedelta(seconds=1) == duration // 10**9
        assert {t.topic_metadata.name: t.message_count for t in metadata.topics_with_message_count}["/topic"] == 60
    text = str(metadata)
    assert "Files:             rosbag2_2023_11_29-19_52_49_0.db3\n" in text
    assert "Storage id:        sqlite3\nDuration:          59.890578723s\n" in text
    assert "Topic: /topic | Type: std_msgs/msg/String | Count: 60 | Serialization Format: cdr\n" in text


def test_a_new_index_replaces_lost_metadata(tmp_path: Path) -> None:
    rows = write(tmp_path / "run", "sqlite3")
    before = rosbag2_py.MetadataIo().read_metadata(str(tmp_path / "run"))
    (tmp_path / "run/metadata.yaml").unlink()
    assert not rosbag2_py.MetadataIo().metadata_file_exists(str(tmp_path / "run"))
    rosbag2_py.Reindexer().reindex(rosbag2_py.StorageOptions(uri=str(tmp_path / "run")))
    after = rosbag2_py.MetadataIo().read_metadata(str(tmp_path / "run"))
    assert after.message_count == before.message_count == len(rows)
    with RosbagsReader(tmp_path / "run") as theirs:
        assert theirs.message_count == len(rows)


def test_splitting_and_compression(tmp_path: Path) -> None:
    writer = rosbag2_py.SequentialCompressionWriter(
        rosbag2_py.CompressionOptions("zstd", rosbag2_py.CompressionMode.MESSAGE)
    )
    options = rosbag2_py.StorageOptions(uri=str(tmp_path / "run"), storage_id="mcap", max_bagfile_duration=2)
    writer.open(options, CDR)
    writer.create_topic(rosbag2_py.TopicMetadata(0, "/chatter", "std_msgs/msg/String", "cdr"))
    for second in range(5):
        writer.write("/chatter", serialize_message(String(data="x" * 1000)), second * 10**9)
    writer.close()
    assert len(list((tmp_path / "run").glob("*.mcap"))) == 3
    assert sum(path.stat().st_size for path in (tmp_path / "run").glob("*.mcap")) < 5000
    assert len(rest(open_reader(tmp_path / "run"))) == 5
    with Writer(tmp_path / "split", storage="sqlite3", max_size=2000) as sqlite:
        number = sqlite.add_topic("/chatter", "std_msgs/msg/String")
        for second in range(5):
            sqlite.write(number, serialize_message(String(data="x" * 1000)), second)
    assert len(list((tmp_path / "split").glob("*.db3"))) == 3
    with RosbagsReader(tmp_path / "split") as theirs:
        assert theirs.message_count == 5


def test_mistakes_are_runtime_errors_that_say_what_is_wrong(tmp_path: Path) -> None:
    write(tmp_path / "run", "mcap")
    reader, writer = rosbag2_py.SequentialReader(), rosbag2_py.SequentialWriter()
    options = rosbag2_py.StorageOptions(uri=str(tmp_path / "run"), storage_id="mcap")
    mistakes: list[tuple[Any, str]] = [
        (reader.has_next, "Bag is not open"),
        (lambda: reader.open(rosbag2_py.StorageOptions(uri=str(tmp_path / "none")), CDR), "none cannot be read"),
        (lambda: reader.open(options, rosbag2_py.ConverterOptions("cdr", "json")), "serialization format json"),
        (lambda: writer.write("/a", b"", 0), "Bag is not open"),
        (lambda: writer.open(options, CDR), "already exists"),
        (lambda: writer.open(rosbag2_py.StorageOptions(uri="x", storage_id="tape"), CDR), "No storage named 'tape'"),
        (lambda: rosbag2_py.Info().read_metadata(str(tmp_path), ""), "is not a recording"),
        (lambda: rosbag2_py.MetadataIo().read_metadata(str(tmp_path)), "parsing info file"),
    ]
    for call, expected in mistakes:
        with pytest.raises(RuntimeError, match=expected):
            call()
    writer.open(rosbag2_py.StorageOptions(uri=str(tmp_path / "new")), CDR)
    with pytest.raises(RuntimeError, match="Topic '/a' has not been created yet"):
        writer.write("/a", b"", 0)
    with pytest.raises(TypeError, match="missing: type, serialization_format"):
        rosbag2_py.TopicMetadata("/a")
    writer.close()


def test_filters_have_the_names_of_the_distributions(monkeypatch):
    current = rosbag2_py.StorageFilter(["/a"], ["/s/_service_event"], "b.*", ["/c"], [], "d.*")
    assert (current.topics, current.services_events, current.regex) == (["/a"], ["/s/_service_event"], "b.*")
    assert (current.exclude_topics, current.topics_regex_to_exclude) == (["/c"], "d.*")
    assert rosbag2_py.StorageFilter(topics_regex="x").regex == rosbag2_py.StorageFilter(regex="x").topics_regex == "x"
    with pytest.raises(TypeError, match="does not take the argument 'topic' here; it has topics, services_events"):
        rosbag2_py.StorageFilter(topic=["/a"])
    monkeypatch.setattr("rosbag2_py._options.since", lambda _: False)
    assert rosbag2_py.StorageFilter(["/a"], "b.*", "c.*").regex_to_exclude == "c.*"
    with pytest.raises(TypeError, match="takes 3 arguments, but 4 were given"):
        rosbag2_py.StorageFilter([], "", "", [])


def test_read_orders_have_the_names_of_ros():
    names = rosbag2_py.ReadOrderSortBy
    assert [names.ReceivedTimestamp.value, names.PublishedTimestamp.value, names.File.value] == [0, 1, 2]
    assert rosbag2_py.ReadOrder().sort_by is names.ReceivedTimestamp
