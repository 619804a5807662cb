# SPDX-License-Identifier: Apache-2.0
"""Recordings written by coframe, read by other programs."""

import errno
import io
import json
import os
import shutil
import subprocess
import sys
import threading
import tracemalloc
import zlib
from collections import Counter
from pathlib import Path

import pytest
import recordings
import yaml
import zstandard
from mcap.opcode import Opcode
from mcap.reader import make_reader
from mcap.records import Channel, Chunk, ChunkIndex, Message, Schema, Statistics, SummaryOffset
from mcap.stream_reader import StreamReader, breakup_chunk
from recordings import COUNT, SECOND, START, TF
from rosbags.interfaces import QosDurability
from rosbags.rosbag2 import Reader

import coframe
from coframe.bags import OfferedQos, Writer, from_yaml
from coframe.bags import _latched_messages as latched_messages
from coframe.bags import _mcap_writer as mcap_writer
from coframe.bags._mcap_writer import McapWriter
from coframe.bags._offered_qos import to_yaml

COMPRESSIONS = ("none", "zstd", "lz4")


def write_walk(path, *, close=True, flush_every=10, **options):
    """Write the walk; without closing the files, as if the recorder were killed."""
    writer = Writer(path, **options)
    topics = {name: writer.add_topic(name, TF) for name in ("/tf_static", "/tf")}
    for i, (topic, at, data) in enumerate(recordings.messages()):
        writer.write(topics[topic], data, at)
        if i % flush_every == 0:
            writer.flush()
    writer.flush()
    if not close:
        shutil.copytree(path, path.with_name("killed"))
    writer.close()
    return writer


def read_by_rosbags(path):
    with Reader(path) as reader:
        return [(connection.topic, at, bytes(data)) for connection, at, data in reader.messages()]


def read_by_mcap(file):
    """Read all messages and check all checksums."""
    with file.open("rb") as stream:
        list(StreamReader(stream, validate_crcs=True).records)
        stream.seek(0)
        found = [
            (channel.topic, message.log_time, message.data)
            for _, channel, message in make_reader(stream).iter_messages()
        ]
        stream.seek(0)
        return found, make_reader(stream).get_summary()


@pytest.mark.parametrize("compression", COMPRESSIONS)
@pytest.mark.parametrize(("close", "has_index"), [(True, True), (False, True), (False, False)])
def test_other_programs_open_finished_and_unfinished_recordings(tmp_path, monkeypatch, compression, close, has_index):
    """An unfinished recording has an index, too, unless it is too large to write with each chunk."""
    if not has_index:
        monkeypatch.setattr(mcap_writer, "_MAX_INDEX_BYTES", 700)  # the first chunks still have an index
    write_walk(tmp_path / "run", compression=compression, close=close)
    folder = tmp_path / ("run" if close else "killed")
    assert read_by_rosbags(folder) == recordings.messages()
    found, summary = read_by_mcap(folder / "run_0.mcap")
    assert found == recordings.messages()
    assert (summary is not None) == has_index
    with coframe.open_bag(folder) as bag:
        assert bag.problems == []
        recordings.assert_same(bag.buffer)


def test_the_index_matches_the_contents(tmp_path):
    writer = write_walk(tmp_path / "run")
    _, summary = read_by_mcap(tmp_path / "run" / "run_0.mcap")
    counts = {
        summary.channels[number].topic: count for number, count in summary.statistics.channel_message_counts.items()
    }
    assert counts == {"/tf": COUNT, "/tf_static": 1}
    assert summary.statistics.message_start_time == START + 1000
    assert len(summary.chunk_indexes) == summary.statistics.chunk_count > 3
    assert writer.messages == COUNT + 1
    assert writer.size == (tmp_path / "run" / "run_0.mcap").stat().st_size


@pytest.mark.parametrize("close", [True, False])
def test_all_records_are_consistent(tmp_path, close):
    """Check what `mcap doctor` checks: order, times, counts, offsets and checksums."""
    write_walk(tmp_path / "run", close=close)
    data = (tmp_path / ("run" if close else "killed") / "run_0.mcap").read_bytes()
    records = list(StreamReader(io.BytesIO(data), emit_chunks=True, validate_crcs=True).records)
    header, footer = records[0], records[-1]
    assert (header.profile, bool(header.library)) == ("ros2", True)
    chunks = {index.chunk_start_offset: index for index in records if isinstance(index, ChunkIndex)}
    assert len(chunks) == sum(isinstance(record, Chunk) for record in records) > 3
    schemas, channels, latest, counts = {0}, {}, 0, Counter()
    for offset, index in sorted(chunks.items()):
        chunk = record_at(data, offset)
        assert offset + index.chunk_length == min(index.message_index_offsets.values())
        assert (len(chunk.data), chunk.uncompressed_size) == (index.compressed_size, index.uncompressed_size)
        inside = breakup_chunk(chunk)
        messages = [record for record in inside if isinstance(record, Message)]
        schemas |= {record.id for record in inside if isinstance(record, Schema)}
        channels |= {record.id: record for record in inside if isinstance(record, Channel)}
        assert schemas >= {channel.schema_id for channel in channels.values()}
        times = [message.log_time for message in messages]
        assert times == sorted(times)
        assert latest <= times[0] == chunk.message_start_time == index.message_start_time
        latest = times[-1]
        assert latest == chunk.message_end_time == index.message_end_time
        counts.update(channels[message.channel_id].topic for message in messages)
        for channel, where in index.message_index_offsets.items():
            entries = record_at(data, where)
            assert entries.channel_id == channel
            assert entries.records == [
                (message.log_time, place) for place, message in placed(chunk) if message.channel_id == channel
            ]
    assert counts == {"/tf": COUNT, "/tf_static": 1}
    (statistics,) = (record for record in records if isinstance(record, Statistics))
    assert (statistics.message_count, statistics.chunk_count) == (COUNT + 1, len(chunks))
    assert (statistics.message_start_time, statistics.message_end_time) == (START + 1000, latest)
    for group in (record for record in records if isinstance(record, SummaryOffset)):
        assert data[group.group_start] == group.group_opcode
    assert zlib.crc32(data[footer.summary_start : -4 - 8]) == footer.summary_crc


def record_at(data, offset):
    return next(StreamReader(io.BytesIO(data[offset:]), skip_magic=True, emit_chunks=True).records)


def placed(chunk):
    """Yield each message of a chunk and the offset of its record."""
    data, place = zstandard.decompress(chunk.data), 0
    while place < len(data):
        if data[place] == Opcode.MESSAGE:
            yield place, record_at(data, place)
        place += 9 + int.from_bytes(data[place + 1 : place + 9], "little")


def shape(value):
    """Return the keys in their order and the types of their values; of a list only the first element."""
    if isinstance(value, dict):
        return [(name, shape(part)) for name, part in value.items()]
    return [shape(part) for part in value[:1]] if isinstance(value, list) else type(value)


def test_metadata_have_the_keys_of_rosbag2_in_the_same_order(tmp_path, shared):
    offered = [OfferedQos(1, transient_local=True)]
    with Writer(tmp_path / "run") as writer:
        writer.write(writer.add_topic("/tf_static", TF, offered_qos=offered), recordings.messages()[0][2], START)
    ours, theirs = (
        yaml.safe_load((folder / "metadata.yaml").read_text())
        for folder in (tmp_path / "run", shared / "recordings" / "tb3_gazebo_walker")
    )
    assert shape(ours) == shape(theirs)
    profiles = (
        text["rosbag2_bagfile_information"]["topics_with_message_count"][0]["topic_metadata"]["offered_qos_profiles"]
        for text in (ours, theirs)
    )
    assert len({str(shape(yaml.safe_load(profile))) for profile in profiles}) == 1


@pytest.mark.slow
@pytest.mark.parametrize("folder", ["run", "killed"])
def test_rerun_opens_it(tmp_path, folder):
    """The test needs `pip install rerun-sdk`, which has a hundred megabytes."""
    rerun = shutil.which("rerun", path=os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]]))
    if rerun is None:
        pytest.skip("Rerun is not installed (pip install rerun-sdk)")
    write_walk(tmp_path / "run", close=False)
    file, out = tmp_path / folder / "run_0.mcap", tmp_path / "out.rrd"
    for command in (["check", file], ["convert", file, "-o", out]):
        ended = subprocess.run([rerun, "mcap", *command], capture_output=True, text=True, check=False)
        assert ended.returncode == 0, ended.stderr
        assert "error" not in ended.stderr.lower()
    assert out.stat().st_size > 10_000


def test_recordings_contain_definitions_and_offered_qos(tmp_path):
    with Writer(tmp_path / "run") as writer:
        writer.write(writer.add_topic("/tf_static", TF), recordings.messages()[0][2], START)
        writer.write(writer.add_topic("/own", "my_pkg/msg/Own"), b"\0\1\0\0abcd", START)
        qos = [OfferedQos(3, reliable=False, transient_local=True, keep_all=True)]
        writer.write(writer.add_topic("/map", "nav_msgs/msg/OccupancyGrid", offered_qos=qos), b"\0\1\0\0", START)
    assert writer.undescribed == ["my_pkg/msg/Own"]
    with Reader(tmp_path / "run") as reader:
        by_topic = {connection.topic: connection for connection in reader.connections}
        assert "string child_frame_id" in by_topic["/tf_static"].msgdef.data
        assert by_topic["/tf_static"].ext.offered_qos_profiles[0].durability is QosDurability.TRANSIENT_LOCAL
        assert by_topic["/own"].msgdef.data == ""
        assert len(list(reader.messages())) == 3
    with coframe.open_bag(tmp_path / "run") as bag:
        offered = {channel.topic: from_yaml(channel.offered_qos) for channel in bag.channels()}
    assert offered == {"/tf_static": (OfferedQos(1, transient_local=True),), "/own": (), "/map": tuple(qos)}


@pytest.mark.parametrize("limit", [{"max_duration": "1s"}, {"max_size": 4000, "compression": "none"}])
def test_every_file_begins_with_the_static_transforms(tmp_path, limit):
    writer = write_walk(tmp_path / "run", **limit)
    files = sorted((tmp_path / "run").glob("*.mcap"))
    assert writer.files == len(files) >= 3
    for file in files:
        (topic, at, data), *rest = read_by_mcap(file)[0]
        assert (topic, data) == ("/tf_static", recordings.messages()[0][2])
        assert at <= rest[0][1]
        with coframe.open_bag(file) as alone:
            assert alone.buffer.lookup("odom", "lidar").target == "odom"
    with coframe.open_bag(tmp_path / "run") as bag:
        recordings.assert_same(bag.buffer)
        assert bag.topics["/tf"].messages == COUNT
    assert [row for row in read_by_rosbags(tmp_path / "run") if row[0] == "/tf"] == recordings.messages()[1:]


def test_latched_messages_are_the_valid_ones(tmp_path):
    def static(*children):
        buffer = coframe.Buffer(None)
        for child in children:
            buffer.set("base", child, coframe.Transform(), START, static=True)
        return buffer.encode(static=True)

    with Writer(tmp_path / "run", max_duration="1s") as writer:
        tf, text = (
            writer.add_topic("/tf_static", TF),
            writer.add_topic(
                "/robot_description", "std_msgs/msg/String", offered_qos=[OfferedQos(1, transient_local=True)]
            ),
        )
        for data in (static("a"), static("b"), static("a", "c"), b"\0\1\0\0cut"):
            writer.write(tf, data, START)
        for publisher, data in ((1, b"\0\1\0\0old"), (2, b"\0\1\0\0two"), (1, b"\0\1\0\0new")):
            writer.write(text, data, START, publisher=publisher)
        writer.write(writer.add_topic("/tf", TF), static("x"), START + SECOND)
    second = [data for topic, _, data in read_by_mcap(tmp_path / "run" / "run_1.mcap")[0] if topic != "/tf"]
    assert second == [static("b"), static("a", "c"), b"\0\1\0\0cut", b"\0\1\0\0two", b"\0\1\0\0new"]


def test_latched_messages_have_a_limit(tmp_path, monkeypatch):
    monkeypatch.setattr(latched_messages, "MAX_BYTES", 100)
    latched = [OfferedQos(1, transient_local=True)]
    with Writer(tmp_path / "run", max_duration="1s") as writer:
        first, second = (writer.add_topic(name, "std_msgs/msg/String", offered_qos=latched) for name in ("/a", "/b"))
        for publisher in range(3):
            writer.write(first, b"%d" % publisher * 40, START, publisher=publisher)
        writer.write(second, b"short", START)
        assert writer.incomplete == ["/a"]
        writer.write(first, b"0" * 30, START, publisher=0)
        writer.write(first, b"3" * 20, START, publisher=3)
        writer.write(first, b"tick", START + SECOND, publisher=4)
    first, second = (read_by_mcap(tmp_path / "run" / f"run_{number}.mcap")[0] for number in range(2))
    assert len(first) == 6, "all messages are recorded"
    assert [data for _, _, data in second] == [b"1" * 40, b"0" * 30, b"3" * 20, b"short", b"tick"]


def test_latched_messages_are_stored_only_if_a_second_file_can_follow(tmp_path):
    latched = [OfferedQos(1, transient_local=True)]
    with Writer(tmp_path / "run") as writer:
        topic = writer.add_topic("/map", "std_msgs/msg/String", offered_qos=latched)
        tracemalloc.start()
        for publisher in range(30):
            writer.write(topic, bytes(1_000_000), START, publisher=publisher)
        writer.flush()
        assert tracemalloc.get_traced_memory()[0] < 5_000_000
        tracemalloc.stop()


def test_a_file_is_readable_wherever_its_writer_was_killed(tmp_path):
    """This includes positions inside a write, which the operating system may perform in part."""
    file = tmp_path / "a.mcap"
    writer = McapWriter(file)
    channel = writer.add_channel("/tf", TF, encoding="cdr", definition="", definition_format="", metadata={})
    rows = recordings.messages()[1:]
    for _, at, data in rows[:30]:
        writer.write(channel, data, at, at)
    writer.flush()
    before = file.read_bytes()
    for _, at, data in rows[30:]:
        writer.write(channel, data, at, at)
    writer.flush()
    after = file.read_bytes()
    writer.close()
    assert read_by_mcap(file)[0] == [("/tf", at, data) for _, at, data in rows]
    for done in range(len(before) - 50, len(after), 97):
        torn = tmp_path / "torn.mcap"
        torn.write_bytes(after[:done] + before[done:])
        with coframe.open_bag(torn) as bag:
            assert bag.topics["/tf"].messages >= 30
            assert next(bag.messages("/tf")).data == rows[0][2]


def test_a_recording_can_be_read_while_it_is_written(tmp_path):
    stopped = threading.Event()
    with Writer(tmp_path / "run", compression="none") as writer:
        tf = writer.add_topic("/tf", TF)
        rows = recordings.messages()[1:]
        for _, at, data in rows:
            writer.write(tf, data, at)
        writer.flush()

        def write():
            while not stopped.is_set():
                for _, at, data in rows:
                    writer.write(tf, data, at)
                    writer.flush()

        thread = threading.Thread(target=write)
        thread.start()
        counts = []
        try:
            for _ in range(30):
                with coframe.open_bag(tmp_path / "run") as bag:
                    counts.append(bag.topics["/tf"].messages)
        finally:
            stopped.set()
            thread.join()
    assert COUNT <= counts[0] < counts[-1]
    assert counts == sorted(counts)


def test_an_existing_folder_is_not_overwritten(tmp_path):
    (tmp_path / "run").mkdir()
    with pytest.raises(coframe.RecordingError, match="already exists and is not overwritten"):
        Writer(tmp_path / "run")
    with pytest.raises(coframe.RecordingError, match="cannot be created: "):
        Writer("/proc/run")
    with pytest.raises(ValueError, match="No compression named 'zip'"):
        Writer(tmp_path / "other", compression="zip")


FILLING = """
import sys
sys.path.insert(0, sys.argv[2])
import coframe, recordings
from coframe.bags import Writer
if len(sys.argv) > 3:
    import resource
    resource.setrlimit(resource.RLIMIT_FSIZE, (int(sys.argv[3]), int(sys.argv[3])))
writer = Writer(sys.argv[1], compression="none")
tf = writer.add_topic("/tf", recordings.TF)
try:
    for time in range(100):
        for topic, at, data in recordings.messages():
            writer.write(tf, data, at + time * 10**10)
        writer.flush()
except coframe.RecordingError as error:
    print(error)
try:
    writer.close()
except coframe.RecordingError as error:
    print(error)
print(writer.messages)
"""


def fill_a_limited_file(path):
    """Limit the size of the child's files; return its output and its exit code."""
    pytest.importorskip("resource")
    command = [sys.executable, "-c", FILLING, path, Path(recordings.__file__).parent, "30000"]
    return errno.EFBIG, subprocess.run(command, capture_output=True, text=True, check=True).stdout


def fill_a_small_disk(path):
    """Run the child with a small disk of its own, in a mount namespace."""
    in_namespace = ["unshare", "--user", "--map-root-user", "--mount", "sh", "-c"]
    mount = 'mkdir "$0" && mount -t tmpfs -o size=32k small "$0"'
    if not shutil.which("unshare") or subprocess.run([*in_namespace, mount, path], check=False).returncode != 0:
        pytest.skip("no small disk can be mounted here (unshare --user --mount)")
    path.rmdir()
    script = f'{mount} && "$@" && cp -r "$0/run" "$0.copy"'
    filling = [sys.executable, "-c", FILLING, path / "run", Path(recordings.__file__).parent]
    text = subprocess.run([*in_namespace, script, path, *filling], capture_output=True, text=True, check=True).stdout
    path.with_name(f"{path.name}.copy").rename(path.with_name("run"))
    return errno.ENOSPC, text.replace(str(path / "run"), str(path.with_name("run")))


@pytest.mark.parametrize("disk", ["limited file", "small disk"])
def test_a_full_disk_is_an_error_and_keeps_what_was_written(tmp_path, disk):
    if disk == "limited file":
        reason, text = fill_a_limited_file(tmp_path / "run")
    else:
        reason, text = fill_a_small_disk(tmp_path / "disk")
    first, *_, count = text.splitlines()
    assert first == f"{tmp_path / 'run'} cannot be written: {os.strerror(reason)}"
    walks, rest = divmod(int(count), COUNT + 1)
    assert (walks > 0, rest) == (True, 0)  # each flush writes one walk
    found, summary = read_by_mcap(tmp_path / "run" / "run_0.mcap")
    assert [data for *_, data in found] == walks * [data for *_, data in recordings.messages()]
    assert summary.statistics.message_count == int(count)
    assert len(read_by_rosbags(tmp_path / "run")) == int(count)


def test_invalid_times_of_publication_are_replaced(tmp_path):
    """Publishers can send any value, and DDS has values for "invalid" and "infinite"."""
    with Writer(tmp_path / "run") as writer:
        topic = writer.add_topic("/words", "std_msgs/msg/String")
        for published in (-(2**63), -1, 2**63 - 1, 2**64):
            writer.write(topic, b"\0\1\0\0", START, published=published)
    with (tmp_path / "run" / "run_0.mcap").open("rb") as stream:
        written = [message.publish_time for *_, message in make_reader(stream).iter_messages()]
    assert written == [START, START, 2**63 - 1, START]


def test_offered_qos_of_all_metadata_versions():
    profiles = (OfferedQos(), OfferedQos(7, reliable=False, transient_local=True), OfferedQos(keep_all=True))
    assert from_yaml(to_yaml(profiles)) == profiles
    words = [{"history": "keep_last", "depth": 7, "reliability": "best_effort", "durability": "transient_local"}]
    assert from_yaml(json.dumps(words)) == (OfferedQos(7, reliable=False, transient_local=True),)
    for damaged in ("", "[", "{}", "- 1", "- {history: 1}", "- {history: 1, depth: x, reliability: 1, durability: 1}"):
        assert from_yaml(damaged) == ()
