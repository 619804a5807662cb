# SPDX-License-Identifier: Apache-2.0
"""The messages that a graph receives when a recording is replayed."""

import time

import numpy as np
import pytest
import recordings
from click.testing import CliRunner
from recordings import COUNT, SECOND, START, TF

import coframe
from coframe.bags import OfferedQos, Writer
from coframe.cli.app import app
from coframe.messages import deserialize, find, serialize
from coframe.recorder import _topic_publishers as topic_publishers
from coframe.recorder._playback_clock import PlaybackClock
from coframe.wire import QoS

STRING, CLOCK = "std_msgs/msg/String", "rosgraph_msgs/msg/Clock"
LATCHED = OfferedQos(1, transient_local=True)
DEEP = QoS(depth=1000)
SETTLED = "200ms"


def text(words):
    return serialize(find(STRING)(data=words))


@pytest.fixture
def bag(tmp_path):
    """The moving robot with words at 20 Hz, and descriptions at 0 s, 1 s and 2 s."""
    rows = [(topic, TF, at, data, ()) for topic, at, data in recordings.messages()]
    rows += [("/words", STRING, START + 5000 + i * SECOND // 20, text(f"{i}"), ()) for i in range(COUNT)]
    rows += [("/robot", STRING, START + 7000 + i * SECOND, text(f"robot {i}"), (LATCHED,)) for i in range(3)]
    with Writer(tmp_path / "run") as writer:
        for topic, ros_type, at, data, qos in sorted(rows, key=lambda row: row[2]):
            writer.write(writer.add_topic(topic, ros_type, offered_qos=qos), data, at)
    return tmp_path / "run"


@pytest.fixture
def listen(participant, node):
    """Return a function that subscribes to a topic and returns a function that returns the samples so far."""

    def subscribe(topic, ros_type=STRING, qos=DEEP):
        subscription = participant.raw_subscription(node, topic, ros_type, qos)
        received = []

        def samples():
            received.extend(subscription.take(1000))
            return received

        return samples

    return subscribe


def words(samples):
    return [deserialize(sample.data, find(STRING)).data for sample in samples]


def test_order_and_timing_of_a_replay(bag, listen):
    received_words, moved = listen("/words"), listen("/tf", TF)
    with coframe.play(bag, delay=SETTLED, rate=3.0) as player:
        assert player.wait("20s")
        assert player.played == 1 + 2 * COUNT + 3
        assert player.problems == []
    assert words(received_words()) == [f"{i}" for i in range(COUNT)]
    assert [sample.data for sample in moved()] == [data for topic, _, data in recordings.messages() if topic == "/tf"]
    sent = {
        topic: np.array([s.source_timestamp for s in samples])
        for topic, samples in (("w", received_words()), ("t", moved()))
    }
    # The order of the recording: a transform, then the words 4 us later, then the next transform.
    assert (sent["t"] < sent["w"]).all()
    assert (sent["w"][:-1] < sent["t"][1:]).all()
    late = (sent["w"] - sent["w"][0]) - np.arange(COUNT) * SECOND / 20 / 3
    assert np.median(np.abs(late)) < 0.02 * SECOND
    assert late.min() > -0.02 * SECOND


def test_a_recording_is_replayed_with_a_prefix_and_other_topics(listen, tmp_path):
    odometry = find("nav_msgs/msg/Odometry")()
    odometry.header.frame_id, odometry.child_frame_id = "odom", "base"
    with Writer(tmp_path / "run") as writer:
        for topic, at, data in recordings.messages():
            writer.write(writer.add_topic(topic, TF), data, at)
        writer.write(writer.add_topic("/odom", type(odometry).ROS_TYPE), serialize(odometry), START + SECOND)
    received_words, unprefixed = listen("/odom", type(odometry).ROS_TYPE), listen("/tf", TF)
    words = [
        "--tf-topic",
        "/robot1/tf",
        "--tf-static-topic",
        "robot1/tf_static",
        "--prefix",
        "robot1/",
        "--keep",
        "odom",
    ]
    pace = ["--rate", "100", "--delay", SETTLED]
    with coframe.connect("listener", tf_topic="/robot1/tf", tf_static_topic="/robot1/tf_static", cache=None) as ros:
        result = CliRunner().invoke(app, ["play", str(tmp_path / "run"), *words, *pace])
    assert (result.exit_code, result.stdout) == (0, f"played {COUNT + 2} messages\n")
    poses = ros.buffer.trajectory("odom", "robot1/lidar").matrix
    np.testing.assert_allclose(poses, recordings.expected().trajectory("odom", "lidar").matrix, rtol=0, atol=1e-14)
    assert not unprefixed()
    [received] = [deserialize(sample.data, type(odometry)) for sample in received_words()]
    assert (received.header.frame_id, received.child_frame_id) == ("odom", "robot1/base")


@pytest.mark.usefixtures("participant")
def test_a_listener_gets_the_transforms_of_the_original_from_any_start(bag):
    for start, first in (("0s", 0), ("1500ms", 30)):
        with (
            coframe.connect("listener", cache=None) as ros,
            coframe.play(bag, delay=SETTLED, rate=10, start_offset=start) as player,
        ):
            assert player.wait("20s")
            stamps = START + np.linspace((first + 1) * SECOND // 20 + 100, (COUNT - 1) * SECOND // 20, 200).astype(
                np.int64
            )
            received = ros.buffer.lookup_many("odom", "lidar", stamps).matrix
            np.testing.assert_allclose(
                received, recordings.expected().lookup_many("odom", "lidar", stamps).matrix, rtol=0, atol=1e-14
            )


def test_latched_messages_are_published_first_and_reach_late_subscribers(bag, listen, eventually):
    with coframe.play(bag, delay=SETTLED, start_offset="1500ms", paused=True, rate=4.0) as player:
        late = QoS(depth=10, transient_local=True)
        statics, robot, received_words = (
            listen("/tf_static", TF, late),
            listen("/robot", STRING, late),
            listen("/words"),
        )
        eventually(lambda: statics() and robot())
        (transform,) = deserialize(statics()[0].data, find(TF)).transforms
        assert (transform.header.frame_id, transform.child_frame_id) == ("base", "lidar")
        assert words(robot()) == ["robot 1"]
        assert received_words() == []
        player.resume()
        assert player.wait("20s")
        assert words(robot()) == ["robot 1", "robot 2"]
        assert words(received_words()) == [f"{i}" for i in range(30, COUNT)]


def test_static_transforms_have_their_values_at_the_start(tmp_path, listen):
    def static(**frames):
        buffer = coframe.Buffer(None)
        for child, x in frames.items():
            buffer.set("base", child, coframe.Transform([x, 0, 0]), START, static=True)
        return buffer.encode(static=True)

    with Writer(tmp_path / "run") as writer:
        topic = writer.add_topic("/tf_static", TF)
        for i, data in enumerate([static(a=1.0), static(b=1.0), static(a=2.0), static(a=3.0, c=1.0)]):
            writer.write(topic, data, START + i * SECOND)
    received = listen("/tf_static", TF)
    with coframe.play(tmp_path / "run", delay=SETTLED, rate=20, start_offset="2500ms") as player:
        assert player.wait("20s")
    published = [
        {t.child_frame_id: t.transform.translation.x for t in deserialize(sample.data, find(TF)).transforms}
        for sample in received()
    ]
    assert published == [{"a": 2.0, "b": 1.0, "c": 1.0}, {"a": 3.0, "b": 1.0, "c": 1.0}]


def test_pause_step_and_rate(bag, listen, eventually):
    received_words = listen("/words")
    with coframe.play(bag, topics=["words"], delay=SETTLED, paused=True) as player:
        player.step()
        player.step()
        eventually(lambda: len(received_words()) == 2)
        assert words(received_words()) == ["0", "1"]
        assert player.clock.paused
        assert player.is_playing
        player.set_rate(100)
        player.resume()
        begun = time.monotonic()
        assert player.wait("20s")
        assert time.monotonic() - begun < 2.0
        assert len(words(received_words())) == COUNT
        with pytest.raises(ValueError, match="above 0 and at most 1000"):
            player.set_rate(0)


def test_loop_and_clock(bag, listen, eventually):
    received_words, ticks = listen("/words"), listen("/clock", CLOCK)
    with coframe.play(bag, topics=["/words", "/tf_static"], delay=SETTLED, rate=30, loop=True, clock=200) as player:
        eventually(lambda: len(received_words()) > 2 * COUNT + 10)
        assert player.is_playing
    assert words(received_words())[: 2 * COUNT] == 2 * [f"{i}" for i in range(COUNT)]
    published = [deserialize(sample.data, find(CLOCK)).clock for sample in ticks()]
    times = np.array([clock.sec * SECOND + clock.nanosec for clock in published])
    assert times[0] == START + 1000
    assert times.max() <= START + 3 * SECOND
    jumps = np.diff(times)
    assert 1 <= np.count_nonzero(jumps < 0) <= 3
    assert np.median(jumps[jumps > 0]) == pytest.approx(30 * SECOND / 200, rel=0.5)


def test_a_clock_of_one_message_per_century(bag, listen, eventually):
    ticks = listen("/clock", CLOCK)
    with coframe.play(bag, topics=["/words"], delay=SETTLED, rate=30, clock=1e-21) as player:
        eventually(ticks)
        assert player.wait("20s")  # the thread that publishes the clock has not failed, which pytest would report


def test_remapped_topics(bag, listen):
    received_words, nothing = listen("/robot1/words"), listen("/words")
    with coframe.play(bag, delay=SETTLED, rate=50, remap={"words": "/robot1/words"}) as player:
        assert player.wait("20s")
    assert len(received_words()) == COUNT
    assert nothing() == []


def test_topics_that_were_recorded_without_a_slash(listen, tmp_path):
    moved = listen("/robot1/tf", TF)
    rows = [(topic.strip("/"), at, data) for topic, at, data in recordings.messages()]
    types = {topic: (TF, "ros2msg", b"", "cdr") for topic, *_ in rows}
    bag = recordings.write_mcap(tmp_path / "a.mcap", rows=rows, types=types)
    arguments = [str(bag), "--tf-topic", "robot1/tf", "--topics", "/tf", "--rate", "100", "--delay", SETTLED]
    result = CliRunner().invoke(app, ["play", *arguments])
    assert (result.exit_code, len(moved())) == (0, COUNT), result.output


def test_a_bag_of_ros_1(shared, listen):
    moved, scans = listen("/tf", TF), listen("/scan", "sensor_msgs/msg/LaserScan")
    with coframe.play(shared / "recordings" / "tilt_laser.bag", delay=SETTLED, rate=30) as player:
        assert player.wait("20s")
        assert player.problems == []  # types that ROS 2 does not have are published as well
    assert len(moved()) == 711
    assert deserialize(scans()[0].data, find("sensor_msgs/msg/LaserScan")).header.frame_id == "/laser"


def test_damaged_messages_are_skipped_and_reported(tmp_path, listen):
    with Writer(tmp_path / "run") as writer:
        topics = [writer.add_topic("/words", STRING), writer.add_topic("/tf_static", TF)]
        for i, data in enumerate((text("a"), b"", b"xy", text("b"))):
            for topic in topics:
                writer.write(topic, data, START + i)
    received_words = listen("/words")
    with coframe.play(tmp_path / "run", delay=SETTLED) as player:
        assert player.wait("20s")
        assert len(player.problems) == 2
        assert all("damaged messages are skipped" in problem for problem in player.problems)
    assert words(received_words()) == ["a", "b"]


def test_topics_beyond_the_limit_are_reported_and_transforms_come_first(tmp_path, listen, monkeypatch):
    monkeypatch.setattr(topic_publishers, "MAX_TOPICS", 3)
    with Writer(tmp_path / "run") as writer:
        for number in range(5):
            writer.write(writer.add_topic(f"/words{number}", STRING), text(f"{number}"), START)
        for topic, at, data in recordings.messages()[:2]:
            writer.write(writer.add_topic(topic, TF), data, at)
    received = [listen(f"/words{number}") for number in range(5)]
    moved = listen("/tf", TF)
    with coframe.play(tmp_path / "run", delay=SETTLED) as player:
        assert player.wait("20s")
        assert player.problems == ["4 topics are not replayed: the maximum is 3. Select topics."]
    assert [len(samples()) for samples in received] == [1, 0, 0, 0, 0]
    assert len(moved()) == 1


def test_the_depth_of_a_latched_publisher_has_a_limit():
    """DDS does not announce the depth to other processes."""
    assert topic_publishers._combined_qos([QoS(depth=1 << 30, transient_local=True)]).depth == 1000


def test_invalid_topic_names_are_skipped_and_reported(tmp_path, listen):
    with Writer(tmp_path / "run") as writer:
        for topic in ("words", "", "/" + "x" * 70_000, "/words", "/a b\x1b[2J"):
            writer.write(writer.add_topic(topic, STRING), text(topic), START)
        writer.write(writer.add_topic("/typeless", ""), text("x"), START)
    received_words = listen("/words")
    with coframe.play(tmp_path / "run", delay=SETTLED) as player:
        assert player.wait("20s")
        assert [problem.partition(" is not replayed")[0] for problem in player.problems[:2]] == ["words", ""]
        assert "The limit is 256 bytes" in player.problems[2]
    assert words(received_words()) == ["/words"]


@pytest.mark.parametrize(
    ("options", "reason"),
    [
        ({"topics": ["/gone"]}, "has no topic /gone"),
        ({"start_offset": "1h"}, "lasts 2.950 s: the replay cannot start at 3600.000 s"),
        ({"start_offset": -SECOND}, "cannot start at -1.000 s"),
        ({"rate": 0.0}, "above 0 and at most 1000"),
        ({"rate": float("nan")}, "above 0 and at most 1000"),
        ({"clock": 1e9}, "above 0 Hz and at most 1000 Hz"),
    ],
)
def test_invalid_arguments_raise_an_error(bag, options, reason):
    with pytest.raises(ValueError, match=reason):
        coframe.play(bag, **options)


def test_the_playback_clock_pauses_resumes_and_jumps():
    clock = PlaybackClock(100, 2.0, paused=False)
    assert clock.now == 100  # not yet begun
    clock.jump(1000)
    assert clock.wait_until(20_000_000)
    assert clock.now >= 20_000_000
    clock.set_paused(True)
    held = clock.now
    assert not clock.stopped
    assert clock.sleep(0.01)
    assert clock.now == held
    clock.step()
    assert clock.wait_until(held + SECOND)
    assert clock.now == held + SECOND
    clock.stop()
    assert not clock.wait_until(held + 2 * SECOND)
    assert not clock.sleep(100)


def test_several_recordings_are_replayed_as_one(listen, tmp_path):
    """Their messages are merged by receive time, and the replay ends at a time or after a duration."""
    for name, first in (("even", 0), ("odd", 1)):
        with Writer(tmp_path / name) as writer:
            topic = writer.add_topic(f"/{name}", STRING)
            for i in range(first, 10, 2):
                writer.write(topic, text(f"{i}"), START + i * SECOND // 20)
    even, odd = listen("/even"), listen("/odd")
    paths = [tmp_path / "even", tmp_path / "odd"]
    with coframe.play(paths, delay=SETTLED) as player:
        assert player.wait("20s")
        assert player.recording.duration == 9 * SECOND // 20
    assert (words(even()), words(odd())) == (["0", "2", "4", "6", "8"], ["1", "3", "5", "7", "9"])
    sent = [sample.source_timestamp for pair in zip(even(), odd(), strict=True) for sample in pair]
    assert sent == sorted(sent)
    for limit in ({"duration": "150ms"}, {"end": START + 3 * SECOND // 20}):
        with coframe.play(paths, delay=0, **limit) as player:
            assert player.wait("20s")
            assert player.played == 4
    with coframe.play(paths, delay=0, regex="/e.*", exclude_topics=["odd"]) as player:
        assert player.wait("20s")
        assert player.played == 5


def test_a_replay_can_be_moved(listen, tmp_path, eventually):
    with Writer(tmp_path / "run") as writer:
        topic = writer.add_topic("/words", STRING)
        for i in range(10):
            writer.write(topic, text(f"{i}"), START + i * SECOND // 100)
    received = listen("/words")
    with coframe.play(tmp_path / "run", delay=SETTLED, paused=True) as player:
        assert player.wait_for_start("20s")
        player.step(2)
        eventually(lambda: len(received()) == 2)
        player.seek(START + 7 * SECOND // 100)
        player.resume()
        assert player.wait("20s")
    assert words(received()) == ["0", "1", "7", "8", "9"]


def test_a_burst_has_no_pauses(listen, tmp_path):
    with Writer(tmp_path / "run") as writer:
        topic = writer.add_topic("/words", STRING)
        for i in range(6):
            writer.write(topic, text(f"{i}"), START + i * 100 * SECOND)
    received = listen("/words")
    begin = time.monotonic()
    result = CliRunner().invoke(app, ["bag", "burst", str(tmp_path / "run"), "-n", "4", "--delay", SETTLED])
    assert (result.exit_code, result.output) == (0, "published 4 messages\n")
    assert time.monotonic() - begin < 60
    assert words(received()) == ["0", "1", "2", "3"]
