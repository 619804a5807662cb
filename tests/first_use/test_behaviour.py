# SPDX-License-Identifier: Apache-2.0
"""What a new user meets first: each test was a mistake of a command."""

import json
import re

import pytest
import recordings
from click.testing import CliRunner
from recordings import SECOND, START

import coframe
from coframe.bags import Writer
from coframe.cli.app import app

TF = "tf2_msgs/msg/TFMessage"


def run(*arguments, **options):
    """Run a command; return (exit code, stdout, stderr)."""
    result = CliRunner().invoke(app, [str(argument) for argument in arguments], **options)
    assert result.exception is None or isinstance(result.exception, SystemExit), result.exception
    return result.exit_code, result.stdout, result.stderr


@pytest.fixture
def empty(tmp_path):
    """A recording with two topics and no messages."""
    with Writer(tmp_path / "empty") as writer:
        writer.add_topic("/tf", TF)
        writer.add_topic("/scan", "sensor_msgs/msg/LaserScan")
    return tmp_path / "empty"


class TestView:
    def test_a_fixed_frame_given_by_hand_beats_the_rviz_file(self):
        from coframe.viewer._state import ViewerState
        from coframe.viewer.rviz.config import RvizConfig
        from coframe.viewer.sources.source import BufferSource

        text = "Visualization Manager: {Class: '', Global Options: {Fixed Frame: base_link, Frame Rate: 30}}"
        state = ViewerState(BufferSource(coframe.Buffer(), "", "buffer"), fixed="world", rviz=RvizConfig.parse(text))
        state.executor.shutdown()
        assert state.fixed == "world"
        description = state.rviz.description()["global"]
        assert (description["fixed_frame"], description["frame_rate"]) == ("world", 30.0)


class TestFolders:
    def test_unrelated_recordings_are_named(self, tmp_path):
        later = [(topic, at + 800 * 86_400 * SECOND, data) for topic, at, data in recordings.messages()]
        recordings.write_mcap(tmp_path / "lab.mcap")
        recordings.write_mcap(tmp_path / "drive.mcap", rows=later)
        code, out, error = run("bag", "info", tmp_path)
        assert (code, out) == (1, "")
        assert "contains 2 recordings from different times: drive.mcap, lab.mcap" in error
        assert "Give the path of one of them." in error

    def test_a_split_recording_is_one(self, tmp_path):
        later = [(topic, at + 3600 * SECOND, data) for topic, at, data in recordings.messages()]
        recordings.write_mcap(tmp_path / "run_0.mcap")
        recordings.write_mcap(tmp_path / "run_1.mcap", rows=later)
        assert run("bag", "info", tmp_path)[0] == 0

    def test_recordings_in_subfolders_are_named(self, tmp_path):
        for name in ("one", "two"):
            Writer(tmp_path / name).close()
        code, _, error = run("bag", "info", tmp_path)
        assert code == 1
        assert "Give one of the recordings in this folder: one, two." in error


class TestBagInfo:
    def test_topics_without_messages_are_listed(self, empty):
        code, out, _ = run("bag", "info", empty)
        assert code == 0
        assert re.search(r"^/scan +sensor_msgs/msg/LaserScan +0 +-$", out, re.MULTILINE)

    def test_an_empty_recording_has_no_dates(self, empty):
        code, out, _ = run("bag", "info", empty)
        assert code == 0
        assert "The recording contains no messages." in out
        assert "1970" not in out

    def test_two_messages_in_microseconds_have_no_rate(self, tmp_path):
        rows = [("/tf_static", START + i * 22_000, data) for i, (_, _, data) in enumerate(recordings.messages()[:2])]
        recording = coframe.open_bag(recordings.write_mcap(tmp_path / "a.mcap", rows=rows))
        assert recording.topics["/tf_static"].rate == 0.0

    def test_size_format_and_compression_are_shown(self, tmp_path):
        code, out, _ = run("bag", "info", recordings.write_mcap(tmp_path / "a.mcap"))
        assert code == 0
        assert re.search(r"^storage   MCAP, compression zstd, \d+\.\d kB in 1 file$", out, re.MULTILINE)

    def test_edges_are_in_tree_order(self, tmp_path):
        code, out, _ = run("bag", "info", recordings.write_mcap(tmp_path / "a.mcap"), "--json")
        assert code == 0
        assert [(edge["parent"], edge["child"]) for edge in json.loads(out)["edges"]] == [
            ("odom", "base"),
            ("base", "lidar"),
        ]

    def test_lines_do_not_end_with_spaces(self, tmp_path):
        _, out, _ = run("bag", "info", recordings.write_mcap(tmp_path / "a.mcap"))
        assert [line for line in out.splitlines() if line != line.rstrip()] == []

    def test_a_reason_is_printed_once(self, tmp_path):
        from coframe.messages import find, serialize

        imu = find("sensor_msgs/msg/Imu")()
        imu.header.frame_id = "imu_link"
        names = [f"/imu{i}" for i in range(18)]
        rows = [*recordings.messages(), *((name, START, serialize(imu)) for name in names)]
        types = dict.fromkeys(names, ("sensor_msgs/msg/Imu", "ros2msg", b"", "cdr"))
        code, out, _ = run("bag", "info", recordings.write_mcap(tmp_path / "a.mcap", rows=rows, types=types))
        assert code == 0
        assert out.count("No frame named 'imu_link'") == 1
        assert "and 13 more: No frame named 'imu_link'" in out


class TestEmptyRecordings:
    @pytest.mark.parametrize("words", [["frames"], ["lookup", "a", "b"], ["why", "a", "b"]], ids=lambda words: words[0])
    def test_commands_do_not_mention_the_ros_domain(self, empty, words):
        command, *frames = words
        code, out, error = run(command, empty, *frames)
        assert code == 1
        assert "domain" not in out + error
        assert "contains no transforms" in out + error


class TestTimes:
    def test_a_time_of_day_with_simulation_stamps(self, tmp_path):
        pose = coframe.Transform()
        rows = [("/tf", START + i * SECOND, recordings.cdr("odom", "base", pose, i * SECOND)) for i in range(1, 20)]
        bag = recordings.write_mcap(tmp_path / "sim.mcap", rows=rows)
        code, _, error = run("lookup", bag, "odom", "base", "--at", "2023-11-14T22:13:25Z")
        assert code == 2
        assert "the stamps of the recording are simulation time, from 1.000000000 to 19.000000000 s" in error
        assert "--at 0s to 18" in error

    def test_edges_of_a_recording_have_no_age(self, tmp_path):
        recording = coframe.open_bag(recordings.write_mcap(tmp_path / "a.mcap"))
        assert {edge.age for edge in recording.buffer.edges()} == {None}
        (edge,) = recording.buffer.edges(["base"], now=recording.end)
        assert 0 <= edge.age < SECOND


class TestPlurals:
    def test_one_message_on_one_topic(self, tmp_path):
        bag = recordings.write_mcap(tmp_path / "a.mcap", rows=recordings.messages()[:1])
        code, out, _ = run("bag", "fix", bag, tmp_path / "fixed")
        assert code == 0
        assert "1 message on 1 topic copied" in out
        assert not re.search(r"\b1 (messages|topics|transforms|frames)\b", out)


@pytest.mark.usefixtures("domain_id")
def test_recording_nothing_is_reported(tmp_path):
    pytest.importorskip("dds_library")
    code, out, error = run("record", "/nothing", "-o", tmp_path / "run", "--duration", "500ms")
    assert code == 1
    assert "0 messages on 0 topics" in out
    assert "no messages were recorded" in error


class TestSuggestions:
    def test_a_misspelled_file(self, tmp_path):
        recordings.write_mcap(tmp_path / "walk.mcap")
        code, _, error = run("bag", "info", tmp_path / "wlak.mcap")
        assert code == 1
        assert f"Did you mean '{tmp_path / 'walk.mcap'}'?" in error

    def test_an_absent_file(self, tmp_path):
        recordings.write_mcap(tmp_path / "walk.mcap")
        assert f"Recordings in '{tmp_path}': walk.mcap." in run("bag", "info", tmp_path / "q")[2]
        assert f"There is no folder '{tmp_path / 'absent'}'." in run("bag", "info", tmp_path / "absent" / "q")[2]

    def test_a_misspelled_topic(self, tmp_path):
        recording = coframe.open_bag(recordings.write_mcap(tmp_path / "a.mcap"))
        with pytest.raises(coframe.RecordingError) as caught:
            recording.messages("/tf_statik")
        assert "Did you mean '/tf_static'?" in caught.value.hint
