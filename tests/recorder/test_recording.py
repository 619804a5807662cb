# SPDX-License-Identifier: Apache-2.0
"""The messages that are published on a graph, and those in the recording."""

import time

import numpy as np
import pytest
import recordings

import coframe
from coframe.bags import Writer, from_yaml
from coframe.frame_names import renaming
from coframe.messages import find, serialize
from coframe.recorder import Recorder
from coframe.recorder import _topic_subscriptions as topic_subscriptions
from coframe.recorder._frame_renaming import FrameRenamer
from coframe.recorder._message_queue import MessageSource
from coframe.recorder._topic_filter import TopicFilter
from coframe.wire import QoS

STRING, TF_MESSAGE = find("std_msgs/msg/String"), find("tf2_msgs/msg/TFMessage")
STAMP = 1_700_000_000_000_000_000


def text(words):
    return serialize(STRING(data=words))


def static(child, x=0.0):
    buffer = coframe.Buffer(None)
    buffer.set("base", child, coframe.Transform([x, 0, 0]), STAMP, static=True)
    return buffer.encode(static=True)


def data_by_topic(path):
    with coframe.open_bag(path) as bag:
        assert bag.problems == []
        return {name: [message.data for message in bag.messages(name)] for name in bag.topics}


@pytest.mark.dds_only("over Zenoh, a publisher needs the definition of its type")
def test_messages_of_any_type_are_recorded_unchanged(participant, node, eventually, tmp_path):
    early = participant.publisher(node, "/words", STRING, QoS(depth=50))
    raw = participant.raw_publisher(node, "/raw", "my_pkg/msg/Unknown", QoS(depth=3, reliable=False))
    hidden = participant.publisher(node, "/fibonacci/_action/status", STRING, QoS())
    statics = participant.raw_publisher(node, "/tf_static", TF_MESSAGE.ROS_TYPE, QoS(depth=1, transient_local=True))
    statics.write(static("lidar"))
    started = time.time_ns()
    reported = []
    with coframe.record(tmp_path / "run", on_topic=lambda *topic: reported.append(topic)) as recorder:
        eventually(lambda: early.matched and raw.matched and statics.matched)
        late = participant.publisher(node, "/later", STRING, QoS())
        eventually(lambda: late.matched)
        for i in range(20):
            for publisher in (early, late, hidden):
                publisher.write(text(f"{i}"))
            raw.write(b"\0\1\0\0" + bytes([i, 2, 3, 4]))
        eventually(lambda: recorder.statistics.messages == 61)
        statistics = recorder.statistics
    assert (statistics.topics, statistics.dropped, statistics.missing) == (4, {}, [])
    assert ("/raw", "my_pkg/msg/Unknown") in reported
    assert recorder.writer.undescribed == ["my_pkg/msg/Unknown"]
    data = data_by_topic(tmp_path / "run")
    assert data["/words"] == data["/later"] == [text(f"{i}") for i in range(20)]
    assert data["/raw"] == [b"\0\1\0\0" + bytes([i, 2, 3, 4]) for i in range(20)]
    assert data["/tf_static"] == [static("lidar")]
    assert "/fibonacci/_action/status" not in data
    with coframe.open_bag(tmp_path / "run") as bag:
        offered = {channel.topic: from_yaml(channel.offered_qos)[0] for channel in bag.channels()}
        assert started < bag.received_start < bag.received_end < time.time_ns()
    assert offered["/tf_static"].transient_local
    assert offered["/tf_static"].reliable
    assert not offered["/raw"].reliable


@pytest.mark.dds_only("over Zenoh, quality of service does not prevent communication")
def test_messages_of_publishers_with_different_qos_are_recorded_once(participant, node, eventually, tmp_path):
    qualities = [QoS(1, transient_local=True), QoS(10), QoS(10, reliable=False)]
    publishers = [participant.raw_publisher(node, "/tf_static", TF_MESSAGE.ROS_TYPE, qos) for qos in qualities]
    publishers[0].write(static("before"))
    with coframe.record(tmp_path / "run") as recorder:
        # The one that offers most is received by those that ask for less, too.
        eventually(lambda: [publisher.matched for publisher in publishers] == [3, 2, 1])
        for i, publisher in enumerate(publishers):
            publisher.write(static(f"frame{i}"))
        eventually(lambda: recorder.statistics.messages >= 4)
    expected = [static(name) for name in ("before", "frame0", "frame1", "frame2")]
    assert sorted(data_by_topic(tmp_path / "run")["/tf_static"]) == sorted(expected)


@pytest.mark.dds_only("the publisher is a native writer of DDS")
def test_topics_without_a_ros_type_are_refused(participant, node, eventually, tmp_path):
    from coframe import _core
    from coframe.wire.dds import config, library
    from coframe.wire.dds.topics import create_topic

    library.load()
    other = _core.DomainParticipant(participant.domain_id, config.cyclone_config(), "enclave=/;")
    topic = create_topic(other.entity, "rt/raw", "NotOfRos")
    foreign = _core.Writer(other.entity, topic, _core.QosProfile(1, True, True, False), "")
    publisher = participant.publisher(node, "/words", STRING, QoS())
    with coframe.record(tmp_path / "run") as recorder:
        eventually(lambda: publisher.matched)
        publisher.write(text("hello"))
        foreign.forward(b"\0\1\0\0abcd")
        eventually(lambda: recorder.statistics.messages == 1)
        assert recorder.statistics.unrecordable == ["/raw"]
    foreign.close()
    other.close()
    assert data_by_topic(tmp_path / "run") == {"/words": [text("hello")]}


@pytest.mark.parametrize(
    ("choice", "chosen"),
    [
        ((None, None, None), {"/tf", "/tf_static", "/scan"}),
        ((["tf", "/gone"], None, None), {"/tf"}),
        ((None, "/tf.*", None), {"/tf", "/tf_static"}),
        ((["/scan"], "/tf", None), {"/scan", "/tf"}),
        ((None, None, "/tf.*"), {"/scan"}),
        ((None, ".*", "/scan"), {"/tf", "/tf_static", "/a/_action/feedback"}),
    ],
)
def test_topic_filter(choice, chosen):
    topic_filter = TopicFilter(*choice)
    assert {topic for topic in ("/tf", "/tf_static", "/scan", "/a/_action/feedback") if topic_filter(topic)} == chosen


@pytest.mark.parametrize(
    ("choice", "chosen"),
    [
        ({"types": ["sensor_msgs/msg/LaserScan"]}, {"/scan"}),
        ({"services": ["reset"]}, {"/reset/_service_event"}),
        ({"services": True, "exclude_services": ["/reset"]}, {"/stop/_service_event"}),
        ({"topics": ["/tf"], "services": True}, {"/tf", "/reset/_service_event", "/stop/_service_event"}),
        ({"exclude_topics": ["tf"]}, {"/scan"}),
        ({"exclude_types": ["sensor_msgs/msg/LaserScan"]}, {"/tf"}),
        ({"hidden": True, "exclude": "/tf|/.*_service_event"}, {"/scan"}),
    ],
)
def test_topic_filter_by_types_and_services(choice, chosen):
    graph = {
        "/tf": "tf2_msgs/msg/TFMessage",
        "/scan": "sensor_msgs/msg/LaserScan",
        "/reset/_service_event": "std_srvs/srv/Empty_Event",
        "/stop/_service_event": "std_srvs/srv/Empty_Event",
    }
    topic_filter = TopicFilter(**choice)
    assert {topic for topic, ros_type in graph.items() if topic_filter(topic, ros_type)} == chosen


def test_requested_topics_without_a_publisher_are_missing():
    assert TopicFilter(["/tf", "gone"], None, None).missing({"/tf"}) == ["/gone"]
    with pytest.raises(ValueError, match="is not a valid regular expression"):
        TopicFilter(None, "(", None)


class SlowDisk(Writer):
    """A slow writer."""

    def write(self, *arguments, **options):
        time.sleep(0.01)
        super().write(*arguments, **options)


def test_a_slow_disk_drops_the_oldest_messages_but_no_static_transforms(participant, node, eventually, tmp_path):
    count, size = 300, 10_000
    publisher = participant.publisher(node, "/words", STRING, QoS(depth=count))
    statics = participant.raw_publisher(node, "/tf_static", TF_MESSAGE.ROS_TYPE, QoS(depth=1, transient_local=True))
    recorder = Recorder(
        SlowDisk(tmp_path / "run"),
        TopicFilter(None, None, None),
        domain=None,
        backlog=50 * size,
        on_topic=lambda *_: None,
    )
    with recorder:
        eventually(lambda: publisher.matched and statics.matched)
        for i in range(count):
            publisher.write(text(f"{i:{size}}"))
            if i == 5:
                statics.write(static("lidar"))
        eventually(lambda: recorder.statistics.messages + sum(recorder.statistics.dropped.values()) == count + 1)
    dropped = recorder.statistics.dropped["/words"]
    assert dropped > 50
    data = data_by_topic(tmp_path / "run")
    assert data["/tf_static"] == [static("lidar")]
    assert len(data["/words"]) == count - dropped
    # The newest messages are recorded.
    assert data["/words"][-40:] == [text(f"{i:{size}}") for i in range(count - 40, count)]


def test_a_failed_start_leaves_no_files_and_no_node(participant, tmp_path):
    (tmp_path / "run").mkdir()
    with pytest.raises(coframe.RecordingError, match="already exists"):
        coframe.record(tmp_path / "run")
    with pytest.raises(ValueError, match="not a valid regular expression"):
        coframe.record(tmp_path / "other", regex="[")
    with pytest.raises(coframe.WireError):
        coframe.record(tmp_path / "third", domain=1000)
    assert [path.name for path in tmp_path.iterdir()] == ["run"]
    assert [name for _, name in participant.nodes()] == []


@pytest.mark.dds_only("over Zenoh, a publisher needs the definition of its type")
def test_one_robot_is_recorded_under_a_prefix(participant, node, eventually, tmp_path):
    scan = find("sensor_msgs/msg/LaserScan")()
    scan.header.frame_id = "lidar"
    latched = QoS(depth=1, transient_local=True)
    statics = participant.raw_publisher(node, "/robot1/tf_static", TF_MESSAGE.ROS_TYPE, latched)
    statics.write(static("lidar"))
    kind = type(scan).ROS_TYPE
    scans = [participant.raw_publisher(node, f"/{name}/scan", kind, QoS(10)) for name in ("robot1", "robot2")]
    raw = participant.raw_publisher(node, "/robot1/raw", "my_pkg/msg/Unknown", QoS(3))
    robot = {"tf_topic": "/robot1/tf", "tf_static_topic": "/robot1/tf_static", "prefix": "robot1/", "keep": ["base"]}
    with coframe.record(tmp_path / "run", **robot) as recorder:
        eventually(lambda: raw.matched and all(publisher.matched for publisher in scans))
        for publisher in scans:
            publisher.write(serialize(scan))
        scans[0].write(b"\0\1\0\0cut off")
        raw.write(b"\0\1\0\0bytes")
        eventually(lambda: recorder.statistics.messages == 5)
        assert recorder.statistics.not_renamed == ["/robot1/raw"]
    with coframe.open_bag(tmp_path / "run") as bag:
        assert bag.buffer.lookup("base", "robot1/lidar").translation.tolist() == [0, 0, 0]
        first, cut = bag.messages("/robot1/scan")
        assert first.message.header.frame_id == "robot1/lidar"
        assert cut.data == b"\0\1\0\0cut off"
        assert [one.message.header.frame_id for one in bag.messages("/robot2/scan")] == ["lidar"]
        assert [one.data for one in bag.messages("/robot1/raw")] == [b"\0\1\0\0bytes"]


def test_a_topic_with_two_unknown_types_is_reported_once():
    frames = FrameRenamer(renaming("robot1/"), "/robot1/tf", "/robot1/tf_static")
    for kind in ("my_pkg/msg/Unknown", "my_pkg/msg/Other"):
        for topic in ("/robot1/raw", "/robot1/b", "/robot2/raw"):
            assert frames.rename_message(MessageSource(topic, kind, latched=False), b"bytes") == b"bytes"
    assert list(frames.not_renamed) == ["/robot1/raw", "/robot1/b"]


def test_recorded_transforms_give_the_same_lookups(participant, node, eventually, tmp_path):
    publishers = {
        "/tf": participant.raw_publisher(node, "/tf", TF_MESSAGE.ROS_TYPE, QoS(100)),
        "/tf_static": participant.raw_publisher(node, "/tf_static", TF_MESSAGE.ROS_TYPE, QoS(1, transient_local=True)),
    }
    walk = recordings.messages()
    with coframe.record(tmp_path / "run", max_size=3000, compression="none") as recorder:
        eventually(lambda: all(publisher.matched for publisher in publishers.values()))
        for topic, _, data in walk:
            publishers[topic].write(data)
            if topic == "/tf_static":
                eventually(lambda: recorder.statistics.messages)
        eventually(lambda: recorder.statistics.messages >= len(walk))
    assert recorder.writer.files >= 3
    with coframe.open_bag(tmp_path / "run") as bag:
        assert bag.problems == []
        recordings.assert_same(bag.buffer)
    for file in (tmp_path / "run").glob("*.mcap"):
        with coframe.open_bag(file) as bag:
            assert not np.isnan(bag.buffer.lookup("odom", "lidar").translation).any()


def test_publishers_that_come_and_go_do_not_fill_the_memory(participant, node, eventually, tmp_path, monkeypatch):
    monkeypatch.setattr(topic_subscriptions, "MAX_PUBLISHERS", 3)
    with coframe.record(tmp_path / "run", topics=["/words"]) as recorder:
        for i in range(6):
            publisher = participant.publisher(node, "/words", STRING, QoS())
            eventually(lambda publisher=publisher: publisher.matched)
            publisher.write(text(f"{i}"))
            eventually(lambda i=i: recorder.statistics.messages == i + 1)
            publisher.close()
        assert len(recorder._subscriptions._offers) <= 3
    assert data_by_topic(tmp_path / "run") == {"/words": [text(f"{i}") for i in range(6)]}
