# SPDX-License-Identifier: Apache-2.0
"""Typical ROS 2 scripts, which know nothing of coframe, as processes that communicate over DDS."""

import contextlib
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

pytest.importorskip("dds_library")
PROGRAMS = Path(__file__).parent / "programs"
PATIENCE = 60.0


@contextlib.contextmanager
def running(*commands):
    """Run programs until the end of the block; then they must end by Ctrl-C without an error message."""
    processes = [start(*command) for command in commands]
    try:
        yield
        for process in processes:
            assert process.poll() is None, process.communicate()
            process.send_signal(signal.SIGINT)
        for process in processes:
            _, errors = process.communicate(timeout=PATIENCE)
            assert "Traceback" not in errors, errors
    finally:
        for process in processes:
            process.kill()
            process.wait()


def start(program, *args):
    command = [sys.executable, str(PROGRAMS / f"{program}.py"), *map(str, args)]
    return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def outputs(*commands):
    """Return what programs print that end by themselves."""
    processes = [start(*command) for command in commands]
    deadline = time.monotonic() + PATIENCE
    texts = []
    try:
        for process in processes:
            text, errors = process.communicate(timeout=max(0.1, deadline - time.monotonic()))
            assert process.returncode == 0, errors
            texts.append(text)
    finally:
        for process in processes:
            process.kill()
            process.wait()
    return texts


@pytest.mark.usefixtures("domain_id")
def test_a_camera():
    with running(["camera_simulator"]):
        assert outputs(["color_tracker"]) == ["ray camera_optical_frame True True\n"]


@pytest.mark.slow
@pytest.mark.usefixtures("domain_id")
def test_color_and_depth():
    with running(["camera_simulator"], ["depth_to_cloud"]):
        assert outputs(["cloud_reader"]) == ["cloud (120, 160) (19200, 3) True [2.] 400\n"]


@pytest.mark.slow
@pytest.mark.usefixtures("domain_id")
def test_diagnostics():
    with running(["diagnosed_driver"]):
        (diagnostics,) = outputs(["diagnostics_monitor"])
    assert diagnostics == (
        "diagnostics WARN too hot sensor 12 85.0\nrate OK Desired frequency met; Timestamps are reasonable.\n"
    )


@pytest.mark.slow
@pytest.mark.usefixtures("domain_id")
def test_images(tmp_path):
    file = tmp_path / "saved.png"
    camera = ["camera_simulator", "--ros-args", "-p", "distance:=4.0"]
    saver = ["image_saver", "--ros-args", "-p", f"filename:={file}"]
    with running(camera, ["edge_detector"], saver):
        edges, distance, saved = outputs(["edge_counter"], ["stereo_distance"], ["save_client"])
    assert edges == "edges True True\n"
    assert distance == "distance 4.00 4.00\n"
    assert saved == "saved (120, 160, 3)\n"
    assert file.stat().st_size > 0


@pytest.mark.slow
@pytest.mark.usefixtures("domain_id")
def test_a_robot():
    with running(["robot_simulator"]):
        scan, heading, cache, grid, echo, csv = outputs(
            ["scan_to_cloud"],
            ["heading_controller", "--ros-args", "-p", "goal:=-3.0"],
            ["odometry_cache"],
            ["map_inflater"],
            ["generic_echo", "/odom"],
            ["generic_echo", "/imu", "--csv"],
        )
    assert scan == "scan odom 61 0.5\n"
    assert heading == "heading True extra True\n"
    assert cache == "cache True base_link\n"
    assert grid == "map (20, 30) 9 0.1\n"
    assert "child_frame_id: base_link\npose:\n  pose:\n    position:\n      x: " in echo
    assert "  covariance: '<array type: double[36]>'\n" in echo
    assert echo.endswith("keys header child_frame_id pose twist\n")
    assert len(csv.split(",")) == 40
    assert ",base_link,0.0,0.0," in csv


@pytest.mark.slow
@pytest.mark.usefixtures("domain_id")
def test_messages_from_yaml():
    values = "{header: {frame_id: map, stamp: now}, pose: {position: {x: 2}, orientation: {z: 1.0, w: 1.0}}}"
    with running(["yaml_publisher", "/goal_pose", "geometry_msgs/msg/PoseStamped", values]):
        assert outputs(["goal_receiver"]) == ["goal map 2.0 90 True\n"]


def test_files_of_packages(tmp_path, monkeypatch):
    config = tmp_path / "src" / "arm_config" / "config"
    config.mkdir(parents=True)
    (config / "limits.yaml").write_text("limits: [1, 2]")
    (config.parent / "package.xml").write_text("<package><name>arm_config</name></package>")
    index = tmp_path / "install" / "share" / "ament_index" / "resource_index"
    for kind, name, text in (("packages", "arm_plugins", ""), ("arm_plugins__pluginlib__plugin", "gripper", "g.xml")):
        (index / kind).mkdir(parents=True)
        (index / kind / name).write_text(text)
    (tmp_path / "install" / "share" / "arm_plugins").mkdir()
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path / "install"))
    monkeypatch.setenv("COFRAME_PACKAGE_PATH", str(tmp_path / "src"))
    assert outputs(["package_config"]) == ["limits [1, 2]\ninstalled True\nplugin gripper g.xml\nmissing True\n"]
