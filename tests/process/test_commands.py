# SPDX-License-Identifier: Apache-2.0
"""The commands as a user runs them: their output and exit codes."""

import re
import signal
import time

import pytest


def eventually(condition, what, patience=30.0):
    deadline = time.monotonic() + patience
    while not condition():
        assert time.monotonic() < deadline, f"timed out after {patience:g} s: {what()}"
        time.sleep(0.05)


def start_echo(processes, *arguments):
    processes.start("echo", "python", "-m", "coframe.cli", "echo", *arguments)


def test_echo_of_the_transforms_of_the_lab(processes, shared):
    processes.start("static", "python", shared / "lab" / "static_tf_broadcaster.py")
    start_echo(processes, "base_link", "camera_link", "5", "--limit", "3")
    # With only the static broadcaster, there are two trees. The hint names them.
    eventually(lambda: "The two trees are" in processes.text("echo"), lambda: processes.text("echo"))
    text = processes.text("echo")
    assert "Could not find a connection between 'base_link' and 'camera_link'" in text
    assert "'base_link' with imu_link, lidar_link" in text
    assert "'end_effector' with camera_link" in text
    assert "a transform with the child 'end_effector'" in text

    processes.start("dynamic", "python", shared / "lab" / "dynamic_tf_broadcaster.py")
    eventually(lambda: not processes.running("echo"), lambda: processes.text("echo"))
    found = re.findall(r"- Translation: \[(-?\d\.\d{3}), (-?\d\.\d{3}), 0\.120\]", processes.text("echo"))
    assert len(found) == 3
    # Two links of 0.5 and 0.4 m and the camera 0.05 m further, with the arm almost fully extended.
    for x, y in found:
        assert 0.85 < (float(x) ** 2 + float(y) ** 2) ** 0.5 < 0.951
    assert "- Rotation: in RPY (degree) [" in processes.text("echo")


def test_echo_of_an_unknown_frame_lists_the_known_frames(processes):
    processes.start("static", "python", "-m", "coframe.cli", "static", "--frame-id", "a", "--child-frame-id", "lidar")
    start_echo(processes, "a", "lider")
    eventually(lambda: "Did you mean" in processes.text("echo"), lambda: processes.text("echo"))
    assert "Did you mean 'lidar'? Known frames: a, lidar." in processes.text("echo")
    code, text = processes.end("echo", signal.SIGINT)
    assert code == 0
    assert "Traceback" not in text


def test_static_with_both_argument_styles(processes):
    processes.start("old", "python", "-m", "coframe.cli", "static", "1", "-2", "3", "0.5", "0", "0", "world", "old")
    new = ["--x", "1", "--y", "-2", "--z", "3", "--yaw", "0.5", "--frame-id", "world", "--child-frame-id", "new"]
    processes.start("new", "python", "-m", "coframe.cli", "static", *new)
    start_echo(processes, "old", "new", "-l", "1")
    eventually(lambda: not processes.running("echo"), lambda: processes.text("echo"))
    assert "- Translation: [0.000, 0.000, 0.000]" in processes.text("echo")
    for name in ("old", "new"):
        code, text = processes.end(name, signal.SIGTERM)
        assert code == 0, text
        assert (
            "Spinning until stopped - publishing transform\ntranslation: ('1.000000', '-2.000000', '3.000000')" in text
        )


@pytest.mark.parametrize(
    ("arguments", "code", "text"),
    [
        (["echo", "a", "b", "foo"], 2, "Failed to convert rate argument 'foo' to a floating-point number"),
        (["echo", "a", "b", "1.0foo"], 3, "Failed to convert rate argument '1.0foo' to a floating-point number"),
        (["echo", "a", "b", "-r", "0"], 1, "Rate must be > 0.0"),
        (["echo", "a"], 2, "Missing argument"),
        (["echo", "a", "b", "--domain", "999"], 2, "--domain"),
        (["static", "--x"], 1, "Not enough arguments for --x"),
        (["static", "--x", "one"], 1, "Failed to parse --x argument as float"),
        (["static", "--qw", "1", "--yaw", "1"], 1, "Cannot specify both quaternion and Euler rotations"),
        (["static", "--x", "1", "0", "0", "0", "0", "0", "0", "a", "b"], 1, "Cannot specify both new-style"),
        (["static", "0", "0", "a", "b"], 1, "Extra unparsed arguments on command-line"),
        (["static", "--child-frame-id", "b"], 1, "Frame id must not be empty"),
        (["static", "--frame-id", "b"], 1, "Child frame id must not be empty"),
        (["static", "--frame-id=a", "--color=red"], 1, "Extra unparsed arguments on command-line: --color"),
        (["static", "--frame-id", "a", "--child-frame-id", "\udcff"], 2, "the argument '\\udcff' is not valid UTF-8"),
        (
            ["static", "--frame-id=a", "--child-frame-id=b", "--tf-static-topic", "x y"],
            1,
            "Check the name of the topic",
        ),
        (["echo", "a", "b", "--tf-topic", "x y"], 1, "Check the name of the topic"),
        (["echo", "a", "b", "inf"], 1, "Rate must be at most 10000"),
        (["echo", "a", "b", "1e-300"], 1, "Period must be at most"),
        (["echo", "a", "b", "-c", "inf"], 2, "Invalid value for '--cache-time' / '-c': 'inf' is not a duration"),
        (["echo", "a", "b", "-o", "nan"], 2, "Invalid value for '-o': 'nan' is not a duration"),
        (["static", "--frame-id", "b", "--child-frame-id", "b"], 1, "cannot publish static transform from 'b' to 'b'"),
        (["frobnicate"], 2, "No such command"),
    ],
)
def test_wrong_usage_gives_an_error_and_an_exit_code(processes, arguments, code, text):
    processes.start("command", "python", "-m", "coframe.cli", *arguments)
    eventually(lambda: not processes.running("command"), lambda: processes.text("command"))
    assert text in processes.text("command")
    assert "Traceback" not in processes.text("command")
    assert processes.end("command")[0] == code


@pytest.mark.parametrize("command", [[], ["demo"], ["echo"], ["static"]])
def test_help_has_an_example(processes, command):
    processes.start("help", "python", "-m", "coframe.cli", *command, "--help")
    eventually(lambda: not processes.running("help"), lambda: processes.text("help"))
    assert not command or "Example: coframe " + command[0] in processes.text("help")
    assert processes.end("help")[0] == 0


def test_demo_shows_the_complete_tree_and_stops_its_nodes(processes):
    processes.start("other", "python", "-m", "coframe.lab.simulated_lidar")
    processes.start("demo", "python", "-m", "coframe.cli", "demo", "--duration", "20", "--no-browser")
    received = processes.observe(1.0, "/scan_base_frame:sensor_msgs/msg/PointCloud2:volatile")
    assert len(received["/scan_base_frame"]) > 1
    eventually(lambda: not processes.running("demo"), lambda: processes.text("demo"), patience=60.0)
    code, text = processes.end("demo")
    assert code == 0, text
    for frame in ("world", "map", "odom", "base_link", "link1", "link2", "end_effector", "camera_link", "lidar_link"):
        assert re.search(rf"^ *{frame}\b", text, re.MULTILINE), text
    assert "not connected" not in text
    unwrapped = " ".join(text.split())
    assert processes.running("other"), processes.text("other")
    assert "already running in this domain: simulated_lidar. Stop it, or choose another domain" in unwrapped
    assert re.search(r"/scan_base_frame: \d+\.\d Hz, \d+ points in base_link", text)


@pytest.mark.slow
def test_demo_from_a_description_shows_the_same_tree(processes):
    pytest.importorskip("xacro", reason="the lab's robot is described in xacro")
    processes.start("demo", "python", "-m", "coframe.cli", "demo", "--urdf", "--duration", "12", "--no-browser")
    received = processes.observe(1.0, "/robot_description:std_msgs/msg/String:transient_local")
    assert "two_link_arm" in received["/robot_description"][0][1]["data"]
    eventually(lambda: not processes.running("demo"), lambda: processes.text("demo"))
    code, text = processes.end("demo")
    assert code == 0, text
    for frame, parent in (("link2", "link1"), ("end_effector", "link2"), ("camera_link", "end_effector")):
        assert re.search(rf"^ *{frame} +{parent}\b", text, re.MULTILINE), text
    assert re.search(r"^ *gripper_link +end_effector +static", text, re.MULTILINE), text
    assert "not connected" not in text


@pytest.mark.parametrize(
    ("how", "code"), [pytest.param(signal.SIGHUP, 0, marks=pytest.mark.slow), (signal.SIGKILL, -signal.SIGKILL)]
)
def test_all_nodes_stop_with_the_demo(processes, how, code, tmp_path, monkeypatch):
    """A closed terminal or a kill must not leave a second arm running for the next demo."""
    monkeypatch.setenv("TMPDIR", str(tmp_path))  # a killed demo does not delete the logs of its nodes
    processes.start("demo", "python", "-m", "coframe.cli", "demo")
    assert processes.observe(1.0, "/tf:tf2_msgs/msg/TFMessage:volatile")["/tf"]
    assert processes.end("demo", how)[0] == code
    eventually(
        lambda: not processes.observe(0.5, "/tf:tf2_msgs/msg/TFMessage:volatile", patience=2.0)["/tf"],
        lambda: "silence on /tf",
    )


def test_options_accept_an_equals_sign_and_topics_without_a_slash(processes):
    static = ["--frame-id=a", "--child-frame-id=b", "--x=-1.5", "--tf-static-topic=other_static"]
    processes.start("static", "python", "-m", "coframe.cli", "static", *static)
    start_echo(processes, "a", "b", "--limit=1", "--tf-static-topic=other_static")
    eventually(lambda: not processes.running("echo"), lambda: processes.text("echo"))
    assert "- Translation: [-1.500, 0.000, 0.000]" in processes.text("echo")
