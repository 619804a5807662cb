# SPDX-License-Identifier: Apache-2.0
"""`coframe record` and `coframe play` as a user runs them: killed, with a full disk, and controlled by keys."""

import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
from mcap.reader import make_reader
from rosbags.rosbag2 import Reader

import coframe

TREE = ("python", "-m", "coframe.lab.complete_tf_tree")
CLI = ("python", "-m", "coframe.cli")
STATIC_CHILDREN = {"camera_link", "gripper_link", "imu_link", "lidar_link", "map"}


LISTENER = """
import sys, time
from pathlib import Path
import coframe, numpy as np
stamps_file, answers = map(Path, sys.argv[1:])
with coframe.connect("listener", cache=None) as ros:
    print("ready", flush=True)
    while not stamps_file.exists():
        time.sleep(0.05)
    stamps = np.load(stamps_file)
    while not ros.buffer.can_transform("world", "camera_link", int(stamps[-1])):
        time.sleep(0.05)
    np.save(answers, ros.buffer.lookup_many("world", "camera_link", stamps).matrix)
"""


def eventually(condition, what, patience=40.0):
    deadline = time.monotonic() + patience
    while not condition():
        assert time.monotonic() < deadline, f"timed out: {what()}"
        time.sleep(0.05)


def count(path):
    """Return the number of messages on /tf in a folder that is being written."""
    try:
        with coframe.open_bag(path) as bag:
            return bag.topics["/tf"].messages if "/tf" in bag.topics else 0
    except coframe.RecordingError:
        return 0


def start_recording(processes, path, *options, messages=100):
    processes.start("record", *CLI, "record", "-o", path, *options)
    eventually(lambda: count(path) >= messages, lambda: processes.text("record") + processes.text("tree"))


def assert_others_open_it(path):
    """Read a recording with other libraries and return the number of messages."""
    with Reader(path) as reader:
        by_rosbags = len(list(reader.messages()))
    by_mcap = 0
    for file in sorted(path.glob("*.mcap")):
        with file.open("rb") as stream:
            by_mcap += len(list(make_reader(stream, validate_crcs=True).iter_messages()))
    assert by_rosbags == by_mcap
    return by_mcap


def statics(bag):
    return {edge.child for edge in bag.buffer.edges() if edge.static}


def test_a_killed_recorder_loses_at_most_the_last_second(processes, tmp_path):
    processes.start("tree", *TREE)
    start_recording(processes, tmp_path / "run", messages=150)
    killed = time.time_ns()
    processes.end("record", signal.SIGKILL)
    assert assert_others_open_it(tmp_path / "run") > 150
    with coframe.open_bag(tmp_path / "run") as bag:
        assert bag.problems == []
        assert statics(bag) == STATIC_CHILDREN
        assert killed - bag.received_end < 1_000_000_000
        moving = next(edge for edge in bag.buffer.edges() if edge.child == "link1")
        assert moving.samples > 100
        assert moving.longest_gap < 1_000_000_000


def test_ctrl_c_writes_the_index_and_a_summary(processes, tmp_path):
    processes.start("tree", *TREE)
    start_recording(processes, tmp_path / "run", "/tf", "/gone", messages=20)
    code, text = processes.end("record")
    assert code == 0
    assert f"{tmp_path / 'run'}: " in text
    assert " messages on 1 topic, " in text
    assert "coframe: no message was received on /gone" in text
    assert "Traceback" not in text
    with (tmp_path / "run" / "run_0.mcap").open("rb") as stream:
        assert make_reader(stream).get_summary().statistics.message_count == assert_others_open_it(tmp_path / "run")
    processes.start("again", *CLI, "record", "-o", tmp_path / "run")
    eventually(lambda: not processes.running("again"), lambda: processes.text("again"))
    assert processes.text("again").startswith(f"coframe: {tmp_path / 'run'} already exists and is not overwritten")


def test_a_full_disk_stops_recording_with_an_error(processes, tmp_path):
    processes.start("tree", *TREE)
    record = f"{sys.executable} -m coframe.cli record -o {tmp_path / 'run'} --compression none"
    processes.start("record", "sh", "-c", f"ulimit -f 80; exec {record}")
    eventually(lambda: not processes.running("record"), lambda: processes.text("record"))
    code, text = processes.end("record")
    assert code == 1
    assert f"coframe: {tmp_path / 'run'} cannot be written: " in text
    assert "The messages written before this error can be read." in text
    assert "Traceback" not in text
    assert assert_others_open_it(tmp_path / "run") > 10
    with coframe.open_bag(tmp_path / "run") as bag:
        assert bag.problems == []
        assert statics(bag) == STATIC_CHILDREN


@pytest.mark.usefixtures("domain_id")
def test_keys_control_the_replay(network, shared):
    pty = pytest.importorskip("pty")
    master, terminal = pty.openpty()
    bag = shared / "recordings" / "world_talk_1hz"
    command = [sys.executable, "-m", "coframe.cli", "play", str(bag), "--start-paused", "--delay", "10ms", "--clock"]
    player = subprocess.Popen(network.command(*command), stdin=terminal, stdout=terminal, stderr=terminal)
    os.close(terminal)
    shown = bytearray()

    def read_until(words):
        eventually(
            lambda: shown.extend(os.read(master, 1000)) or words in shown, lambda: shown.decode(errors="replace")
        )

    try:
        read_until(b"0 messages, paused")
        os.write(master, b"\x1b[C")
        read_until(b"1 message, paused")
        os.write(master, b"\x1b[A")
        os.write(master, b" ")
        read_until(b"rate 1.1")
        player.send_signal(signal.SIGINT)
        assert player.wait(20) == 0
    finally:
        player.kill()
        player.wait()
        os.close(master)
    assert b"Traceback" not in shown


@pytest.mark.parametrize(
    ("arguments", "code", "reason"),
    [
        (("record", "--max-size", "big"), 2, "--max-size: 'big' is not a size"),
        (("record", "--max-size", "9" * 400), 2, "' is not a size"),
        (("record", "--backlog", "9" * 400 + "GB"), 2, "' is not a size"),
        (("record", "--compression", "zip"), 2, "No compression named 'zip'"),
        (("record", "-a", "/tf"), 2, "--all cannot be combined with TOPIC"),
        (("record", "-e", "["), 2, "is not a valid regular expression"),
        (("play", "gone"), 1, "gone cannot be read"),
        (("play", "gone", "--rate", "0"), 2, "above 0"),
        (("play", "gone", "--remap", "/tf"), 2, "is not of the form OLD:=NEW"),
    ],
)
def test_wrong_usage_gives_an_error(arguments, code, reason, tmp_path, monkeypatch):
    from click.testing import CliRunner

    from coframe.cli.app import app

    monkeypatch.chdir(tmp_path)
    result = CliRunner().invoke(app, arguments)
    assert (result.exit_code, list(tmp_path.iterdir())) == (code, [])
    assert reason in result.output


@pytest.mark.slow
def test_an_independent_program_receives_the_replay(processes, shared):
    bag = shared / "recordings" / "tb3_gazebo_walker"
    processes.start("play", *CLI, "play", bag, "--rate", "4", "--delay", "5s")
    topics = ("/tf:tf2_msgs/msg/TFMessage:volatile", "/tf_static:tf2_msgs/msg/TFMessage:transient_local")
    received = processes.observe(8.0, *topics)
    with coframe.open_bag(bag) as recording:
        children = {
            transform["child_frame_id"] for _, message in received["/tf_static"] for transform in message["transforms"]
        }
        assert children == statics(recording)
        assert len(received["/tf"]) == recording.topics["/tf"].messages
    code, text = processes.end("play")
    assert code == 0, text


@pytest.mark.slow
def test_the_replay_of_a_killed_recording_gives_the_same_transforms(processes, tmp_path):
    """Compare the transforms of the demo with those of the replay of a recording whose recorder was killed."""
    bag, stamps_file = tmp_path / "run", tmp_path / "stamps.npy"
    answers = {name: tmp_path / f"{name}.npy" for name in ("original", "played")}

    def listen(name):
        processes.start(name, "python", "-c", LISTENER, stamps_file, answers[name])
        eventually(lambda: "ready" in processes.text(name), lambda: processes.text(name))

    processes.start("demo", *CLI, "demo", "--no-browser", "--port", "0")
    listen("original")
    processes.start("record", *CLI, "record", "-o", bag)
    eventually(lambda: count(bag) >= 500, lambda: processes.text("record"))  # 5 s at 100 Hz
    killed = time.time_ns()
    processes.end("record", signal.SIGKILL)
    assert_others_open_it(bag)
    with coframe.open_bag(bag) as recording:
        assert recording.problems == []
        assert killed - recording.received_end < 1_000_000_000
        assert recording.received_end - recording.received_start > 4_000_000_000
        assert len(statics(recording)) == len(STATIC_CHILDREN)
        assert {"/scan", "/scan_base_frame", "/tf", "/tf_static"} <= set(recording.topics)
        edges = [edge for edge in recording.buffer.edges() if edge.parent and not edge.static]
        first, last = max(edge.oldest for edge in edges), min(edge.newest for edge in edges)
        stamps = first + np.linspace(0, last - first, 500).astype(np.int64)
        recorded = recording.buffer.lookup_many("world", "camera_link", stamps).matrix
    np.save(tmp_path / "unnamed.npy", stamps)
    (tmp_path / "unnamed.npy").rename(stamps_file)
    eventually(lambda: not processes.running("original"), lambda: processes.text("original"))
    processes.end("demo")
    listen("played")
    processes.start("play", *CLI, "play", bag, "--delay", "3s")
    eventually(lambda: not processes.running("played"), lambda: processes.text("played"))
    original, played = (np.load(file) for file in answers.values())
    np.testing.assert_allclose(recorded, original, rtol=0, atol=1e-12)
    np.testing.assert_allclose(played, original, rtol=0, atol=1e-12)
