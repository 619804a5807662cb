# SPDX-License-Identifier: Apache-2.0
"""`coframe view` and `coframe demo`, started from the command line."""

import json
import re
import signal
import subprocess
import sys
import time
import urllib.request

import numpy as np
import pytest

import coframe

pytest.importorskip("dds_library", reason="the commands join the ROS graph")

COMMAND = [sys.executable, "-m", "coframe.cli"]


def start(*arguments):
    """Start a command; return the process and the address that it prints."""
    process = subprocess.Popen([*COMMAND, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    line = process.stdout.readline()
    if not re.fullmatch(r"http://127\.0\.0\.1:\d+/\n", line):
        process.kill()
        pytest.fail(f"no address: {line!r} {process.communicate()}")
    return process, line.strip()


@pytest.mark.usefixtures("domain_id")
def test_the_demo_in_a_tab(open_tab):
    process, url = start("demo", "--no-browser", "--port", "0")
    try:
        assert urllib.request.urlopen(url).status in {200, 503}
        viewer = type("Viewer", (), {"url": url})
        tab = open_tab(viewer)
        tree = tab.wait("tree", lambda tree: len(tree["frames"]) == 11)
        assert tree["components"] == [{"root": "world", "size": 11}]
        stats = tab.wait("stats", lambda stats: any(row["rate"] and row["rate"] > 40 for row in stats["frames"]))
        rows = dict(zip([frame["name"] for frame in tree["frames"]], stats["frames"], strict=True))
        assert rows["link1"]["publisher"] == "/dynamic_tf_broadcaster"
        assert rows["link1"]["age"] < 5.0
        tab.send("fixed", frame="world")
        tab.send("subscribe", id=1, topic="/scan", options={})
        update = tab.frame_update(lambda update: update.displays)
        drawn = tab.drawings[next(iter(update.displays))]
        # The lab's hall: all walls and pillars are within ten meters.
        assert len(drawn.points) > 50
        assert np.isfinite(drawn.points).all()
        assert np.abs(drawn.points).max() < 20.0
    finally:
        process.send_signal(signal.SIGINT)
        output, errors = process.communicate(timeout=20)
    assert process.returncode == 0, errors
    assert "Traceback" not in output + errors


@pytest.mark.usefixtures("domain_id")
def test_view_answers_within_two_seconds_and_ends_on_ctrl_c(shared, open_tab):
    begin = time.monotonic()
    file = shared / "lab" / "rviz_config.yaml"
    process, url = start("view", "-d", str(file), "--use-sim-time", "--no-browser", "--port", "0")
    waited = time.monotonic() - begin
    tab = open_tab(type("Viewer", (), {"url": url}))
    hello = tab.wait("hello", lambda hello: hello["mode"] == "live")
    # No node publishes /clock, so the simulated time stands still; by default, the clock would be that of the system.
    tab.wait("pulse", lambda pulse: pulse["clock"] == "paused")
    process.send_signal(signal.SIGINT)
    output, errors = process.communicate(timeout=20)
    assert (process.returncode, output, errors) == (0, "", "")
    assert hello["mode"] == "live"
    assert hello["fixed"] == "base_link"
    assert waited < 8.0  # Two seconds on an idle machine.


def test_a_missing_recording_gives_a_message():
    result = subprocess.run([*COMMAND, "view", "nowhere.mcap"], capture_output=True, text=True, check=False)
    assert (result.returncode, result.stdout) == (1, "")
    assert result.stderr == (
        "coframe: nowhere.mcap cannot be read: No such file or directory\n"
        "  Check the path and the permission to read it.\n"
    )


def test_an_address_of_another_machine_gives_a_message():
    command = [*COMMAND, "view", "--host", "192.0.2.1", "--port", "0", "--no-browser"]
    result = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (result.returncode, result.stdout) == (1, "")
    assert result.stderr == (
        "coframe: cannot listen on 192.0.2.1: this machine does not have that address\n"
        "  Choose another host, or 127.0.0.1.\n"
    )


def test_a_replay_is_written_without_a_browser(shared, tmp_path):
    bag = shared / "recordings" / "tilt_laser.bag"
    (tmp_path / "my.rviz").write_text(
        """Visualization Manager:
  Displays:
    - {Class: rviz/LaserScan, Enabled: true, Name: Tilt, Topic: /scan, Color Transformer: AxisColor, Decay Time: 2}
    - {Class: rviz/LaserScan, Enabled: false, Name: Hidden, Topic: /scan}
  Global Options: {Fixed Frame: laser}
"""
    )
    for number, (options, fixed, displays) in enumerate(
        [
            ([], "tilt_base", ["Grid", "TF", "/scan", "/imu_data", "/position_gps", "/velocity"]),
            (["-d", "my.rviz"], "laser", ["Tilt", "Hidden"]),
        ]
    ):
        output = tmp_path / f"{number}.html"
        words = [*COMMAND, "view", str(bag), "-o", output.name, "--stop", "2s", "--rate", "10", *options]
        result = subprocess.run(words, capture_output=True, text=True, check=False, cwd=tmp_path)
        assert (result.returncode, result.stdout) == (0, ""), result.stderr
        assert f"{output.name}: " in result.stderr
        (block,) = re.findall(r'<script type="application/json" id="replay">(.*?)</script>', output.read_text())
        replay = json.loads(block)
        assert (replay["fixed"], replay["rate"]) == (fixed, 10.0)
        assert [display["name"] for display in replay["rviz"]["displays"]] == displays
        scan, *others = replay["displays"]
        assert [display["topic"] for display in others] == ([] if options else displays[3:])
        assert (scan["topic"], scan["color_by"]) == ("/scan", "axis" if options else "intensity")
        assert len(scan["drawings"]) > 5
    assert sorted(file.name for file in tmp_path.iterdir()) == ["0.html", "1.html", "my.rviz"]


@pytest.mark.parametrize(
    ("words", "text"),
    [
        (["view", "-o", "a.html"], "--output needs a recording"),
        (["view", "run.mcap", "-o", "a.pdf"], "--output a.pdf: unknown suffix '.pdf'. Suffix: .html"),
        (["view", "run.mcap", "--rate", "5"], "--rate can only be used with --output"),
    ],
)
def test_options_of_replays_are_checked(words, text):
    result = subprocess.run([*COMMAND, *words], capture_output=True, text=True, check=False)
    assert (result.returncode, result.stdout) == (2, "")
    assert result.stderr.startswith(f"coframe: {text}\n")


def test_xacro_arguments_are_passed_to_the_robot(tmp_path, open_tab):
    pytest.importorskip("xacro", reason="needs xacro")
    robot = tmp_path / "box.urdf.xacro"
    robot.write_text(
        '<robot name="box" xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:arg name="side" default="1"/>'
        '<link name="b"><visual><geometry><box size="$(arg side) 1 1"/></geometry></visual></link></robot>'
    )
    bag = tmp_path / "run"
    with coframe.bags.Writer(bag) as writer:
        moment = coframe.Buffer()
        moment.set("map", "b", coframe.Transform(), 1_700_000_000_000_000_000)
        writer.write(writer.add_topic("/tf", "tf2_msgs/msg/TFMessage"), moment.encode(static=False), received=1)
    process, url = start("view", str(bag), "--robot", str(robot), "side:=2.5", "--no-browser", "--port", "0")
    try:
        tab = open_tab(type("Viewer", (), {"url": url}))
        assert tab.wait("robot")["links"][0]["visuals"][0]["size"] == [2.5, 1.0, 1.0]
    finally:
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=20)
    for wrong, reason in ((["side:=1"], "can only be used with --robot"), ([str(bag), "x"], "NAME:=VALUE")):
        done = subprocess.run([*COMMAND, "view", *wrong], capture_output=True, text=True, check=False)
        assert done.returncode == 2
        assert reason in done.stderr
