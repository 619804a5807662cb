# SPDX-License-Identifier: Apache-2.0
"""The same transforms in all formats give the same lookups."""

import bz2
import gzip
import itertools
import lzma
import struct
import sys

import numpy as np
import pytest
import recordings
import yaml
import zstandard
from mcap.writer import CompressionType
from recordings import COUNT, SECOND, START, cdr, humble, messages, ros1
from rosbags.rosbag1 import Writer as Rosbag1Writer
from rosbags.rosbag2 import CompressionMode, StoragePlugin

import coframe
from coframe.bags import OfferedQos
from coframe.bags._compression import unpack
from coframe.bags._offered_qos import to_yaml
from coframe.bags.namespaces import TransformChoice
from coframe.doctor import observe_recording

RANGE_OF_IRON = b"""std_msgs/Header header
uint8 radiation_type
float32 field_of_view
float32 min_range
float32 max_range
float32 range
float32 variance
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
"""


def read(path):
    """Open a recording and assert that it has no problems."""
    recording = coframe.open_bag(path)
    assert recording.problems == []
    return recording


@pytest.mark.parametrize("chunked", [True, False])
@pytest.mark.parametrize("compression", CompressionType)
def test_mcap_with_all_compressions(tmp_path, compression, chunked):
    with read(recordings.write_mcap(tmp_path / "a.mcap", compression, chunked=chunked)) as recording:
        recordings.assert_same(recording.buffer)
        assert recording.topics["/tf"].messages == COUNT
        assert recording.span == (START, START + (COUNT - 1) * (SECOND // 20 + 1))
        for (_, at, data), message in zip(messages()[1:], recording.messages("/tf"), strict=True):
            assert (message.received, message.stamp, message.data) == (at, at - 1000, data)
            assert message.message.transforms[0].child_frame_id == "base"


@pytest.mark.parametrize("plugin", StoragePlugin)
@pytest.mark.parametrize("compression", [None, CompressionMode.FILE, CompressionMode.MESSAGE, CompressionMode.STORAGE])
def test_rosbag2_with_all_compressions(tmp_path, plugin, compression):
    if compression is CompressionMode.STORAGE and plugin is not StoragePlugin.MCAP:
        pytest.skip("SQLite has no compression of its own")
    with read(recordings.write_rosbag2(tmp_path / "bag", plugin, compression)) as recording:
        recordings.assert_same(recording.buffer)
        assert [m.message.transforms[0].child_frame_id for m in recording.messages("tf_static")] == ["lidar"]
        assert recording.message_at("/tf", START + SECOND).stamp == START + SECOND - SECOND // 20 + 19


@pytest.mark.parametrize("version", range(4, 10))
def test_all_versions_of_the_metadata(tmp_path, version):
    bag = recordings.write_rosbag2(tmp_path / "bag")
    text = yaml.safe_load((bag / "metadata.yaml").read_text())
    about = text["rosbag2_bagfile_information"]
    about["version"] = version
    for since, names in ((5, ("files",)), (6, ("custom_data",)), (8, ("ros_distro",))):
        if version < since:
            for name in names:
                del about[name]
    for topic in about["topics_with_message_count"]:
        if version < 9:
            topic["topic_metadata"]["offered_qos_profiles"] = to_yaml([OfferedQos()])
        if version < 7:
            del topic["topic_metadata"]["type_description_hash"]
    (bag / "metadata.yaml").write_text(yaml.safe_dump(text))
    with read(bag) as recording:
        recordings.assert_same(recording.buffer)
        assert recording.problems == []


@pytest.mark.parametrize("plugin", [StoragePlugin.SQLITE3, StoragePlugin.MCAP])
def test_a_closed_recording_keeps_its_transforms(tmp_path, plugin):
    with read(recordings.write_rosbag2(tmp_path / "bag", plugin)) as recording:
        messages = recording.messages("/tf")
        next(messages)
    recordings.assert_same(recording.buffer)
    for late in (messages, recording.messages("/tf")):
        with pytest.raises(coframe.RecordingError, match="is closed: its messages can no longer be read"):
            next(late)


def test_rosbag2_without_metadata_and_by_the_path_of_the_metadata(tmp_path):
    bag = recordings.write_rosbag2(tmp_path / "bag")
    recordings.assert_same(read(bag / "metadata.yaml").buffer)
    (bag / "metadata.yaml").unlink()
    (bag / "notes.txt").write_text("not part of it")
    recordings.assert_same(read(bag).buffer)
    recordings.assert_same(read(next(bag.glob("*.db3"))).buffer)


@pytest.mark.parametrize("version", [1, 2, 3, 4])
def test_all_schema_versions_of_sqlite(tmp_path, version):
    with read(recordings.write_sqlite(tmp_path / "bag" / "a.db3", version)) as recording:
        recordings.assert_same(recording.buffer)
        assert next(recording.messages("/tf")).message.transforms[0].header.frame_id == "odom"


@pytest.mark.parametrize("compression", [None, *Rosbag1Writer.CompressionFormat])
def test_bags_of_ros_1(tmp_path, compression):
    with read(recordings.write_rosbag1(tmp_path / "a.bag", compression)) as recording:
        recordings.assert_same(recording.buffer)
        message = next(recording.messages("/tf")).message
        assert type(message).__module__ == "tf2_msgs.msg"
        assert message.transforms[0].header.stamp.sec == START // SECOND


@pytest.mark.parametrize(
    ("name", "encoding", "encode"),
    [
        ("foxglove.FrameTransform", "json", recordings.foxglove_json),
        ("foxglove.FrameTransforms", "json", recordings.foxglove_json_many),
        ("foxglove.FrameTransform", "protobuf", recordings.foxglove_protobuf),
        ("foxglove.FrameTransforms", "protobuf", recordings.foxglove_protobuf_many),
        ("foxglove_msgs/msg/FrameTransform", "cdr", recordings.foxglove_cdr),
        ("foxglove_msgs/msg/FrameTransforms", "cdr", cdr),
        ("tf2_msgs/TFMessage", "ros1", ros1),
        ("tf/tfMessage", "ros1", ros1),
    ],
)
def test_foxglove_transforms_in_mcap(tmp_path, name, encoding, encode):
    types = dict.fromkeys(["/tf", "/tf_static"], (name, "", b"", encoding))
    with read(recordings.write_mcap(tmp_path / "a.mcap", rows=messages(encode), types=types)) as recording:
        recordings.assert_same(recording.buffer)
        if encoding == "json":
            assert "timestamp" in str(next(recording.messages("/tf")).message)


@pytest.mark.parametrize("name", [7, None, ["x"], "\ud800"])
def test_frame_names_in_json_that_are_not_text_are_damage(tmp_path, name):
    types = dict.fromkeys(["/tf", "/tf_static"], ("foxglove.FrameTransform", "", b"", "json"))
    rows = messages(recordings.foxglove_json)
    rows.insert(1, ("/tf", rows[0][1], recordings.foxglove_json("odom", name, coframe.Transform(), rows[0][1])))
    path = recordings.write_mcap(tmp_path / "a.mcap", rows=rows, types=types)
    with coframe.open_bag(path) as recording:
        [problem] = recording.problems
        assert problem.startswith("/tf: damaged messages; the first one: ")
        assert "base" in " ".join(recording.buffer.frame_names())
    [observation] = observe_recording(path).values()
    assert observation.damaged_messages == 1


@pytest.mark.parametrize("metadata", [True, False])
def test_a_recording_in_many_files(tmp_path, metadata):
    bag = tmp_path / "bag"
    bag.mkdir()
    rows = messages()
    parts = [
        rows[0:1] + rows[1:20],
        rows[0:1] + rows[20:40],
        rows[0:1] + rows[40:],
    ]  # each file repeats the static transforms
    names = ["run_2.mcap", "run_9.mcap", "run_10.mcap"]
    for name, part in zip(names, parts, strict=True):
        recordings.write_mcap(bag / name, rows=part)
    if metadata:
        listed = "\n".join(f"    - {name}" for name in names)
        (bag / "metadata.yaml").write_text(f"rosbag2_bagfile_information:\n  relative_file_paths:\n{listed}\n")
    with read(bag) as recording:
        recordings.assert_same(recording.buffer)
        assert (np.diff(recording.stamps("/tf")) > 0).all()
        assert len(list(recording.messages("/tf"))) == COUNT


def test_a_compressed_file(tmp_path):
    plain = recordings.write_mcap(tmp_path / "a.mcap")
    packed = tmp_path / "packed.mcap.zstd"
    packed.write_bytes(zstandard.compress(plain.read_bytes()))
    with read(packed) as recording:
        recordings.assert_same(recording.buffer)


def test_repeated_static_transforms_do_not_clear_dynamic_ones(tmp_path):
    rows = messages()
    rows.insert(40, ("/tf_static", rows[40][1], cdr("base", "lidar", coframe.Transform([9, 9, 9]), 0)))
    rows.insert(41, rows[0])
    recordings.assert_same(read(recordings.write_mcap(tmp_path / "a.mcap", rows=rows)).buffer)


def test_a_frame_with_static_and_dynamic_transforms_is_dynamic(tmp_path):
    rows = [*messages(), ("/tf_static", START, cdr("odom", "base", coframe.Transform(), 0))]
    recording = coframe.open_bag(recordings.write_mcap(tmp_path / "a.mcap", rows=rows))
    recordings.assert_same(recording.buffer)
    (problem,) = recording.problems
    assert "odom -> base is published both on /tf_static" in problem


@pytest.mark.parametrize("kind", ["ros2", "ros1"])
def test_a_prefix_renames_the_frames_of_one_robot(tmp_path, kind):
    """Messages of ROS 1 and ROS 2 get the same names."""
    write = {"ros2": recordings.write_mcap, "ros1": recordings.write_rosbag1}[kind]
    with coframe.open_bag(write(tmp_path / "run"), prefix="robot1/", keep="odom") as bag:
        assert sorted(bag.buffer.frame_names()) == ["odom", "robot1/base", "robot1/lidar"]
        assert bag.buffer.can_transform("odom", "robot1/lidar")
        assert (bag.frame("/base"), bag.frame("odom")) == ("robot1/base", "odom")


def test_robots_of_several_namespaces(tmp_path):
    def rows(namespace, prefix):
        for topic, at, parent, child, transform in recordings.walk():
            yield namespace + topic, at, cdr(prefix + parent, prefix + child, transform, at)

    apart = [*rows("/one", "one/"), *rows("/two", "two/")]
    recording = read(recordings.write_mcap(tmp_path / "apart.mcap", rows=apart))
    assert sorted(recording.buffers) == ["/one", "/two"]
    assert recording.buffer.lookup("one/odom", "one/lidar", START).source == "one/lidar"
    assert recording.buffer.lookup("two/odom", "two/lidar", START).source == "two/lidar"

    alike = recordings.write_mcap(tmp_path / "alike.mcap", rows=[*rows("/one", ""), *rows("/two", "")])
    recording = coframe.open_bag(alike)
    assert "/one/tf and /two/tf both contain the frame 'base'" in recording.problems[0]
    recordings.assert_same(recording.buffer)
    recordings.assert_same(recording.buffers["/two"])
    chosen = coframe.open_bag(alike, namespace="two")
    assert chosen.problems == []
    assert list(chosen.buffers) == ["/two"]
    one = {"tf_topic": "/one/tf", "tf_static_topic": "/one/tf_static"}
    chosen = coframe.open_bag(alike, **one, prefix="one/", keep=["odom"])
    recordings.assert_same(coframe.open_bag(alike, **one).buffer)
    assert chosen.buffer.can_transform("odom", "one/lidar")
    assert chosen.choice == TransformChoice(**one, prefix="one/", keep=("odom",))
    with pytest.raises(coframe.RecordingError, match="has no topic /three/tf"):
        coframe.open_bag(alike, tf_topic="/three/tf")
    unread = coframe.open_bag(alike, transforms=False)
    assert unread.buffer.frame_names() == []
    assert unread.topics["/one/tf"].messages > 0


def imu(at, frame="imu"):
    Imu = humble.types["sensor_msgs/msg/Imu"]  # noqa: N806
    Header, Time = humble.types["std_msgs/msg/Header"], humble.types["builtin_interfaces/msg/Time"]  # noqa: N806
    Quaternion, Vector3 = (humble.types[f"geometry_msgs/msg/{n}"] for n in ("Quaternion", "Vector3"))  # noqa: N806
    header = Header(Time(*divmod(at, SECOND)), frame)
    nothing = np.zeros(9)
    message = Imu(header, Quaternion(0, 0, 0, 1), nothing, Vector3(1, 2, 3), nothing, Vector3(4, 5, 6), nothing)
    return bytes(humble.serialize_cdr(message, "sensor_msgs/msg/Imu"))


@pytest.mark.parametrize("kind", ["mcap", "sqlite", "message"])
def test_messages_by_their_stamps(tmp_path, kind):
    """The stamps are 100 ms before the receive times, and two of them are swapped."""
    order = [0, 1, 3, 2, 4, 5]
    rows = [("/imu", START + i * SECOND, imu(START + at * SECOND - SECOND // 10)) for i, at in enumerate(order)]
    types = {"/imu": "sensor_msgs/msg/Imu"}
    if kind == "mcap":
        schema = (
            "sensor_msgs/msg/Imu",
            "ros2msg",
            humble.generate_msgdef(types["/imu"], ros_version=2)[0].encode(),
            "cdr",
        )
        path = recordings.write_mcap(tmp_path / "a.mcap", rows=rows, types={"/imu": schema})
    else:
        mode = CompressionMode.MESSAGE if kind == "message" else None
        path = recordings.write_rosbag2(tmp_path / "bag", StoragePlugin.SQLITE3, mode, rows, types)
    with read(path) as recording:
        assert (recording.start, recording.duration) == (START, 5 * SECOND)
        assert recording.topics["/imu"].rate == pytest.approx(1.0)
        stamps = [START + at * SECOND - SECOND // 10 for at in order]
        assert recording.stamps("/imu").tolist() == stamps
        assert [m.stamp for m in recording.messages("/imu")] == stamps
        assert [m.stamp for m in recording.messages("imu", stamps[1], stamps[4])] == [stamps[i] for i in (1, 2, 3)]
        assert recording.message_at("/imu", START + 2 * SECOND).stamp == stamps[3]
        assert recording.message_at("/imu", stamps[2]).stamp == stamps[2]
        assert recording.message_at("/imu", stamps[0] - 1) is None
        assert recording.message_at("/imu", stamps[0]).message.linear_acceleration.z == 6
        with pytest.raises(coframe.RecordingError, match="no topic 'imus'") as caught:
            recording.messages("imus")
        assert "/imu" in caught.value.hint


def test_times_of_messages_without_a_header_follow_the_recorded_clock(tmp_path):
    """The recorded clock runs at half the speed of the system clock."""
    Clock, Time = humble.types["rosgraph_msgs/msg/Clock"], humble.types["builtin_interfaces/msg/Time"]  # noqa: N806
    String = humble.types["std_msgs/msg/String"]  # noqa: N806
    rows = [
        ("/clock", START + i * SECOND, bytes(humble.serialize_cdr(Clock(Time(i // 2, i % 2 * SECOND // 2)), CLOCK)))
        for i in range(10)
    ]
    rows.append(("/said", START + 5 * SECOND, bytes(humble.serialize_cdr(String("hello"), "std_msgs/msg/String"))))
    types = {"/clock": CLOCK, "/said": "std_msgs/msg/String"}
    with read(recordings.write_rosbag2(tmp_path / "bag", rows=rows, types=types)) as recording:
        (said,) = recording.messages("/said")
        assert (said.stamp, said.received, said.message.data) == (5 * SECOND // 2, START + 5 * SECOND, "hello")


CLOCK = "rosgraph_msgs/msg/Clock"


@pytest.mark.parametrize("damaged", [False, True])
def test_protobuf_is_decoded_with_the_recorded_descriptors(tmp_path, damaged):
    pytest.importorskip("google.protobuf")
    definition = recordings.foxglove_protobuf_definition()
    types = {"/tf": ("foxglove.FrameTransform", "protobuf", definition[: -40 if damaged else None], "protobuf")}
    rows = [("/tf", START, recordings.foxglove_protobuf("a", "b", coframe.Transform([1.0, 2.0, 3.0]), START + 5))]
    rows.append(("/tf", START + 1, b"\x12\xffcut"))
    recording = coframe.open_bag(recordings.write_mcap(tmp_path / "a.mcap", rows=rows, types=types))
    first, second = recording.messages("/tf")
    if damaged:
        assert first.message == rows[0][2]
        assert "returned as bytes: its definition cannot be used" in recording.problems[-1]
        return
    decoded = first.message
    assert (decoded.parent_frame_id, decoded.translation.y, decoded.timestamp.nanos) == ("a", 2.0, 5)
    with pytest.raises(coframe.DecodeError, match=r"foxglove\.FrameTransform: "):
        _ = second.message


def test_protobuf_messages_are_bytes_without_the_package(tmp_path, monkeypatch):
    types = {"/tf": ("foxglove.FrameTransform", "protobuf", b"", "protobuf")}
    rows = [("/tf", START, recordings.foxglove_protobuf("a", "b", coframe.Transform(), START))]
    recording = coframe.open_bag(recordings.write_mcap(tmp_path / "a.mcap", rows=rows, types=types))
    monkeypatch.setitem(sys.modules, "google.protobuf", None)
    assert next(recording.messages("/tf")).message == rows[0][2]
    assert recording.problems[-1].endswith("the package protobuf is not installed (pip install 'coframe[protobuf]')")


def test_json_is_decoded_to_dictionaries(tmp_path):
    types = {"/tf": ("foxglove.FrameTransform", "jsonschema", b"{}", "json")}
    rows = [("/tf", START, recordings.foxglove_json("a", "b", coframe.Transform(), START + 5))]
    recording = coframe.open_bag(recordings.write_mcap(tmp_path / "a.mcap", rows=rows, types=types))
    message = next(recording.messages("/tf")).message
    assert (message["parent_frame_id"], message["timestamp"]["nsec"]) == ("a", 5)


def test_types_are_decoded_with_the_recorded_definitions(tmp_path):
    """Range has another field since Iron, one type is unknown elsewhere, and one has no definition."""
    iron = b"\0\1\0\0" + bytes(4) + bytes(4) + b"\2\0\0\0u\0" + b"\1\0" + np.arange(5, dtype="<f4").tobytes()
    types = {
        "/range": ("sensor_msgs/msg/Range", "ros2msg", RANGE_OF_IRON, "cdr"),
        "/own": ("own_msgs/msg/Own", "ros2msg", b"int32 number\nstring<=5 text\n", "cdr"),
        "/secret": ("secret_msgs/msg/Secret", "ros2msg", b"", "cdr"),
        "/broken": ("own_msgs/msg/Other", "ros2msg", b"no definition at all", "cdr"),
        "/evil": ("own_msgs/msg/X\nimport os", "ros2msg", b"int32 x", "cdr"),
        "/blob": ("any.Thing", "protobuf", b"", "protobuf"),
    }
    rows = [
        ("/range", START, iron),
        ("/own", START, b"\0\1\0\0" + b"\5\0\0\0" + b"\3\0\0\0hi\0"),
        *((topic, START, b"\0\1\0\0\7") for topic in ("/secret", "/broken", "/evil", "/blob")),
    ]
    recording = coframe.open_bag(recordings.write_mcap(tmp_path / "a.mcap", rows=rows, types=types))
    first = {topic: next(recording.messages(topic)).message for topic in recording.topics}
    assert (first["/range"].variance, first["/range"].header.frame_id) == (4, "u")
    assert (first["/own"].number, first["/own"].text) == (5, "hi")
    assert {first[topic] for topic in ("/secret", "/broken", "/evil", "/blob")} == {b"\0\1\0\0\7"}
    assert len(recording.problems) == 4
    assert any(
        "/secret: messages of type secret_msgs/msg/Secret are returned as bytes" in p for p in recording.problems
    )


def test_ros_1_messages_become_coframe_classes_if_they_match(tmp_path):
    scan = b"\1\0\0\0" + b"\5\0\0\0\6\0\0\0" + b"\5\0\0\0laser" + np.arange(7, dtype="<f4").tobytes()
    scan += b"\2\0\0\0" + np.array([1.5, 2.5], "<f4").tobytes() + bytes(4)
    types = {"/scan": "sensor_msgs/msg/LaserScan", "/note": "diagnostic_msgs/msg/KeyValue"}
    rows = [("/scan", START, scan), ("/note", START, b"\1\0\0\0k\2\0\0\0vv")]
    with read(recordings.write_rosbag1(tmp_path / "a.bag", rows=rows, types=types)) as recording:
        (message,) = recording.messages("/scan")
        assert type(message.message).__module__ == "sensor_msgs.msg"
        assert (message.stamp, message.message.header.frame_id) == (5 * SECOND + 6, "laser")
        assert list(message.message.ranges) == [1.5, 2.5]
        assert next(recording.messages("/note")).message.value == "vv"


def test_progress_increases_to_the_total(tmp_path):
    bag = tmp_path / "bag"
    bag.mkdir()
    for name in ("a", "b"):
        recordings.write_mcap(bag / f"{name}.mcap")
    recordings.write_sqlite(bag / "c.db3", 3)
    reported = []
    coframe.open_bag(bag, progress=lambda done, total: reported.append((done, total)))
    size = sum(file.stat().st_size for file in bag.iterdir())
    assert reported[-1] == (size, size)
    assert all(a[0] <= b[0] for a, b in itertools.pairwise(reported))
    assert len(reported) > 6


def test_reading_is_thread_safe(tmp_path):
    from concurrent.futures import ThreadPoolExecutor

    for path in (recordings.write_mcap(tmp_path / "a.mcap"), recordings.write_sqlite(tmp_path / "b" / "b.db3", 3)):
        with read(path) as recording, ThreadPoolExecutor(4) as pool:
            stamps = recording.stamps("/tf").tolist()
            found = list(pool.map(lambda stamp: recording.message_at("/tf", stamp).stamp, stamps * 20))
            assert found == stamps * 20


def test_a_read_only_folder(tmp_path):
    bag = recordings.write_rosbag2(tmp_path / "bag")
    before = sorted(bag.iterdir())
    bag.chmod(0o555)
    try:
        recordings.assert_same(read(bag).buffer)
        assert sorted(bag.iterdir()) == before
    finally:
        bag.chmod(0o755)


def test_files_that_are_not_recordings_are_errors(tmp_path):
    (tmp_path / "empty.mcap").touch()
    (tmp_path / "text.db3").write_text("hello, here is no database")
    (tmp_path / "old.bag").write_bytes(b"#ROSBAG V1.2\n")
    (tmp_path / "folder").mkdir()
    for name, reason in [
        ("empty.mcap", "the file is empty"),
        ("text.db3", "in none of these formats: MCAP, SQLite"),
        ("old.bag", "bags of version 1"),
        ("folder", "is not a recording"),
        ("gone", "cannot be read: No such file"),
    ]:
        with pytest.raises(coframe.RecordingError, match=reason) as caught:
            coframe.open_bag(tmp_path / name)
        assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("start", "reason"),
    [
        (
            b"version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\nsize 12345\n",
            "download the content with `git lfs pull`",
        ),
        (gzip.compress(b"\x89MCAP0\r\n"), "the file is compressed with gzip"),
        (bz2.compress(b"x"), "the file is compressed with bzip2"),
        (lzma.compress(b"x"), "the file is compressed with xz"),
        (b"PK\x03\x04 archive", "the file is a zip archive"),
        (b"<!DOCTYPE html><title>Log in</title>", "the file is a web page"),
        (bytes(4096), "the file begins with zeros"),
    ],
    ids=["lfs", "gzip", "bzip2", "xz", "zip", "page", "zeros"],
)
@pytest.mark.parametrize("suffix", [".mcap", ".db3", ".bag", ".gz"])
def test_other_files_are_named_for_what_they_are(tmp_path, start, reason, suffix):
    path = tmp_path / f"run{suffix}"
    path.write_bytes(start)
    with pytest.raises(coframe.RecordingError, match=reason):
        coframe.open_bag(path)


def test_a_chunk_of_two_zstd_frames():
    data = bytes(range(200))
    packed = zstandard.compress(data[:50]) + zstandard.compress(data[50:])
    assert unpack("zstd", packed, 200) == data


def test_records_of_later_versions_are_skipped_and_joined_files_are_reported(tmp_path):
    path = recordings.write_mcap(tmp_path / "a.mcap")
    whole = path.read_bytes()
    path.write_bytes(whole[:8] + b"\x20" + struct.pack("<Q", 5) + b"later" + whole[8:])
    with coframe.open_bag(path) as bag:
        recordings.assert_same(bag.buffer)
        assert any("a record of the unknown type 0x20 was skipped" in problem for problem in bag.problems)
    path.write_bytes(whole + whole)
    with coframe.open_bag(path) as bag:
        [problem] = bag.problems
        assert f"the last {len(whole)} bytes were not read" in problem
        assert "another MCAP file begins there" in problem
    path.write_bytes(whole)
    with coframe.open_bag(path) as bag:
        assert bag.problems == []


def test_import_coframe_stays_cheap():
    import subprocess
    import sys

    late = ["coframe.bags", "coframe.robots", "rosbags", "mcap", "sqlite3"]
    code = f"import sys, coframe; print([name for name in {late} if name in sys.modules])"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout == "[]\n"
