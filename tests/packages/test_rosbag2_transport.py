# SPDX-License-Identifier: Apache-2.0
"""rosbag2_py: recording and replaying from scripts, and copying recordings."""

import threading
from pathlib import Path

import pytest

pytest.importorskip("dds_library", reason="players and recorders speak DDS")

import rclpy
import rosbag2_py
from rclpy.executors import SingleThreadedExecutor
from rclpy.serialization import deserialize_message, serialize_message
from std_msgs.msg import String

START = 1_700_000_000_000_000_000
STEP = 20_000_000


@pytest.fixture
def node(domain_id):
    rclpy.init(domain_id=domain_id)
    node = rclpy.create_node("peer")
    yield node
    node.destroy_node()
    rclpy.shutdown()


@pytest.fixture
def received(node):
    """The texts that arrive on /chatter, spun in a thread."""
    texts: list[str] = []
    node.create_subscription(String, "/chatter", lambda message: texts.append(message.data), 100)
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    thread = threading.Thread(target=executor.spin)
    thread.start()
    yield texts
    executor.shutdown()
    thread.join()


@pytest.fixture
def bag(tmp_path: Path) -> rosbag2_py.StorageOptions:
    options = rosbag2_py.StorageOptions(uri=str(tmp_path / "run"), storage_id="mcap")
    writer = rosbag2_py.SequentialWriter()
    writer.open(options, rosbag2_py.ConverterOptions("cdr", "cdr"))
    for topic in ("/chatter", "/other"):
        writer.create_topic(
            rosbag2_py.TopicMetadata(name=topic, type="std_msgs/msg/String", serialization_format="cdr")
        )
    for index in range(5):
        writer.write("/chatter", serialize_message(String(data=str(index))), START + index * STEP)
    writer.close()
    return options


def test_a_player_returns_at_the_end(bag, received, eventually):
    options = rosbag2_py.PlayOptions()
    options.rate = 2.0
    options.playback_duration = 3 * STEP / 1e9
    rosbag2_py.Player().play(bag, options)
    eventually(lambda: received == ["0", "1", "2", "3"])


def test_a_player_of_its_own_recording_is_controlled_by_methods(bag, received, eventually):
    options = rosbag2_py.PlayOptions()
    options.start_paused = True
    player = rosbag2_py.Player(bag, options)
    player.start_spin()
    assert player.get_starting_time() == START
    assert player.get_playback_duration() == 4 * STEP
    player.play()
    assert player.is_paused()
    assert player.wait_for_playback_to_start(10.0)
    assert not player.wait_for_playback_to_finish(0.01)
    assert player.play_next()
    eventually(lambda: received == ["0"])
    player.seek(START + 3 * STEP)
    player.resume()
    assert player.wait_for_playback_to_finish()
    player.stop()
    eventually(lambda: received == ["0", "3", "4"])


def test_a_replay_is_cancelled(bag):
    options = rosbag2_py.PlayOptions()
    options.loop = True
    player = rosbag2_py.Player("debug")
    threading.Timer(0.5, rosbag2_py.Player.cancel).start()
    player.play([bag], options)
    with pytest.raises(RuntimeError, match="no recording"):
        player.pause()
    options.topics_to_filter = ["/gone"]
    with pytest.raises(RuntimeError, match="has no topic /gone"):
        player.play(bag, options)


def test_a_recorder_writes_what_is_published(node, tmp_path, eventually):
    publisher = node.create_publisher(String, "/chatter", 100)
    options = rosbag2_py.RecordOptions()
    options.all_topics = True
    options.start_paused = True
    storage = rosbag2_py.StorageOptions(uri=str(tmp_path / "out"), storage_id="sqlite3")
    recorder = rosbag2_py.Recorder(storage, options)
    recorder.start_spin()
    recorder.record()
    assert recorder.is_paused()
    eventually(lambda: publisher.get_subscription_count() == 1)
    recorder.resume()
    for text in "ab":
        publisher.publish(String(data=text))
    eventually(lambda: (tmp_path / "out/metadata.yaml").is_file() and _texts(tmp_path / "out") == ["a", "b"])
    recorder.stop()
    assert (tmp_path / "out/out_0.db3").is_file()


def test_a_recorder_records_until_it_is_cancelled(node, tmp_path):
    publisher = node.create_publisher(String, "/chatter", 100)
    other = node.create_publisher(String, "/other", 100)
    timer = node.create_timer(0.01, lambda: [each.publish(String(data="x")) for each in (publisher, other)])
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    thread = threading.Thread(target=executor.spin)
    thread.start()
    options = rosbag2_py.RecordOptions()
    options.all = True
    options.exclude = "/o.*"
    threading.Timer(2.0, rosbag2_py.Recorder.cancel).start()
    rosbag2_py.Recorder().record(rosbag2_py.StorageOptions(str(tmp_path / "out"), "mcap"), options, "recorder")
    node.destroy_timer(timer)
    executor.shutdown()
    thread.join()
    assert _texts(tmp_path / "out")
    metadata = rosbag2_py.Info().read_metadata(str(tmp_path / "out"), "")
    assert "/other" not in {topic.topic_metadata.name for topic in metadata.topics_with_message_count}


def test_definitions_of_types():
    source = rosbag2_py.LocalMessageDefinitionSource()
    definition = source.get_full_text("std_msgs/msg/String")
    assert (definition.encoding, "string data" in definition.encoded_message_definition) == ("ros2msg", True)
    unknown = source.get_full_text("none_msgs/msg/Such")
    assert (unknown.encoding, unknown.encoded_message_definition) == ("unknown", "")


def test_metadata_with_data_of_the_user(bag):
    io = rosbag2_py.MetadataIo()
    metadata = io.read_metadata(bag.uri)
    metadata.custom_data = {"robot": "r2"}
    io.write_metadata(bag.uri, metadata)
    assert io.read_metadata(bag.uri).custom_data == {"robot": "r2"}
    assert rosbag2_py.BagMetadata(custom_data={"a": "b"}).custom_data == {"a": "b"}
    assert rosbag2_py.get_default_storage_id() in rosbag2_py.get_registered_writers()


def test_filters_of_jazzy(bag):
    reader = rosbag2_py.SequentialReader()
    reader.open(bag)
    reader.set_filter(rosbag2_py.StorageFilter(exclude_topics=["/chatter"]))
    assert not reader.has_next()
    reader.set_filter(rosbag2_py.StorageFilter(regex="/ch.*"))
    assert reader.read_next()[0] == "/chatter"
    assert reader.set_read_order(rosbag2_py.ReadOrder(rosbag2_py.ReadOrderSortBy.ReceivedTimestamp, False))


def test_rewriting_to_several_recordings(bag, tmp_path):
    config = tmp_path / "out.yaml"
    config.write_text(f"output_bags: [{{uri: {tmp_path / 'copy'}, all: true, storage_id: sqlite3}}]")
    rosbag2_py.bag_rewrite([bag], str(config))
    assert _texts(tmp_path / "copy") == ["0", "1", "2", "3", "4"]
    with pytest.raises(RuntimeError, match="already exists"):
        rosbag2_py.bag_rewrite([bag], str(config))


def _texts(path: Path) -> list[str]:
    reader = rosbag2_py.SequentialReader()
    reader.open_uri(str(path))
    texts = []
    while reader.has_next():
        topic, data, _ = reader.read_next()
        if topic == "/chatter":
            texts.append(deserialize_message(data, String).data)
    return texts
