# SPDX-License-Identifier: Apache-2.0
"""The installed package, in whatever environment runs these tests: no file of a checkout is used."""

import importlib
import importlib.metadata
import os
import platform
import re
import subprocess
import sys
import sysconfig
import threading
import urllib.request
from pathlib import Path

import numpy as np
import pytest

import coframe
from coframe.workspace.ros_folders import ros_folder

ROS = ros_folder()
SECOND = 1_000_000_000
PACKAGES = """
ament_index_python angles cv_bridge demo_nodes_py diagnostic_updater image_geometry laser_geometry launch launch_ros
message_filters rclpy ros2_numpy rosidl_runtime_py sensor_msgs_py tf2_geometry_msgs tf2_nav_msgs tf2_py tf2_ros
tf2_sensor_msgs tf2_visualization_msgs tf_transformations turtlesim geometry_msgs.msg nav2_msgs.action
"""


def python(program, **environment):
    command = [sys.executable, "-c", program]
    result = subprocess.run(
        command, capture_output=True, text=True, env={**os.environ, **environment}, check=False, timeout=60
    )
    assert result.returncode == 0, result.stderr
    return result.stdout


def script(name):
    return str(Path(sysconfig.get_path("scripts")) / (f"{name}.exe" if os.name == "nt" else name))


def dds_is_missing():
    probe = "import coframe; coframe.connect().close()"
    return subprocess.run([sys.executable, "-c", probe], capture_output=True, check=False, timeout=60).returncode != 0


needs_dds = pytest.mark.skipif(dds_is_missing(), reason="this environment has no DDS library")


def moving():
    buffer = coframe.Buffer()
    for second in (1, 2):
        buffer.set("odom", "base", coframe.Transform([second, 0, 0]), second * SECOND)
    buffer.set("base", "lidar", coframe.Transform([0, 0, 1]), static=True)
    return buffer


def test_a_lookup_interpolates():
    assert moving().lookup("odom", "lidar", 3 * SECOND // 2).translation.tolist() == [1.5, 0, 1]


def test_threads_share_a_buffer():
    buffer, wrong = moving(), []

    def look_up():
        for i in range(2000):
            stamp = SECOND + i * 400_000
            x = buffer.lookup("odom", "lidar", stamp).x
            if abs(x - stamp / SECOND) > 1e-9:
                wrong.append(x)

    threads = [threading.Thread(target=look_up) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not wrong


@pytest.mark.skipif(not sysconfig.get_config_var("Py_GIL_DISABLED"), reason="CPython with the GIL")
def test_the_gil_stays_off():
    program = "import coframe, tf2_ros, sys; print(sys._is_gil_enabled())"
    assert python(program, PYTHON_GIL="") == "False\n"


def test_many_lookups_at_once():
    stamps = np.linspace(SECOND, 2 * SECOND, 1000).astype(np.int64)
    many = moving().lookup_many("odom", "lidar", stamps)
    np.testing.assert_allclose(many.translation[:, 0], stamps / SECOND, atol=1e-9)


@pytest.mark.parametrize("package", PACKAGES.split())
def test_a_ros_package_is_found(package):
    module = importlib.import_module(package)
    assert str(ROS) in str(module.__file__ or module.__path__)


def test_ros_packages_come_last_on_the_path():
    assert python("import sys; print(sys.path[-1])").strip() == str(ROS)


def test_own_interfaces_are_found(tmp_path):
    (tmp_path / "own_msgs/msg").mkdir(parents=True)
    (tmp_path / "own_msgs/msg/Num.msg").write_text("int64 num 3\n")
    printed = python("from own_msgs.msg import Num; print(Num())", COFRAME_INTERFACES=str(tmp_path))
    assert printed == "own_msgs.msg.Num(num=3)\n"


def test_the_versions_agree():
    assert coframe.__version__ == importlib.metadata.version("coframe")


def test_the_page_is_served():
    pytest.importorskip("websockets", reason="needs coframe[viewer]")
    viewer = coframe.show(coframe.Buffer(), port=0)
    with viewer:
        for file, content in (("", b"viewer.js"), ("assets/page.js", b"three.js"), ("replay.html", b'id="replay"')):
            with urllib.request.urlopen(f"{viewer.url.rstrip('/')}/{file}") as answer:
                assert content in answer.read()


@needs_dds
@pytest.mark.usefixtures("domain_id")
def test_the_report_about_this_system():
    pytest.importorskip("click", reason="needs coframe[cli]")
    command = [script("coframe"), "doctor", "--system"]
    shown = subprocess.run(command, capture_output=True, text=True, check=False, timeout=100).stdout
    assert f"coframe {coframe.__version__}, numpy {np.__version__}" in shown
    assert f"Python {platform.python_version()} (CPython" in shown
    assert "not found" not in shown.partition("DDS library\n")[2].partition("\n")[0]
    assert "a message through the library within this process: received" in shown


def test_a_recording_is_written_and_read(tmp_path):
    pytest.importorskip("zstandard", reason="needs coframe[bags]")
    from coframe import bags, messages
    from tf2_msgs.msg import TFMessage

    with bags.Writer(tmp_path / "bag") as writer:
        writer.write(writer.add_topic("/tf", "tf2_msgs/msg/TFMessage"), messages.serialize(TFMessage()), SECOND)
    assert list(coframe.open_bag(tmp_path / "bag").topics) == ["/tf"]


def test_a_replay_is_written(tmp_path):
    for module in ("click", "zstandard", "websockets"):
        pytest.importorskip(module, reason="needs coframe[cli,bags,viewer]")
    from coframe import bags, messages
    from geometry_msgs.msg import TransformStamped
    from tf2_msgs.msg import TFMessage

    transform = TransformStamped(child_frame_id="lidar")
    transform.header.frame_id = "base"
    transform.transform.rotation.w = 1.0
    with bags.Writer(tmp_path / "bag") as writer:
        topic = writer.add_topic("/tf", "tf2_msgs/msg/TFMessage")
        for second in (1, 2):
            transform.header.stamp.sec = second
            writer.write(topic, messages.serialize(TFMessage(transforms=[transform])), second * SECOND)
    command = [script("coframe"), "view", tmp_path / "bag", "-o", tmp_path / "replay.html"]
    subprocess.run(command, check=True, capture_output=True, timeout=100)
    assert b'"format":"coframe-replay"' in (tmp_path / "replay.html").read_bytes()


@needs_dds
@pytest.mark.usefixtures("domain_id")
def test_a_node_publishes_a_transform():
    program = """
import coframe, rclpy, time
from tf2_ros import StaticTransformBroadcaster
from geometry_msgs.msg import TransformStamped
rclpy.init()
message = TransformStamped(child_frame_id="lidar")
message.header.frame_id = "base"
message.transform.rotation.w = 1.0
broadcaster = StaticTransformBroadcaster(rclpy.create_node("sender"))
broadcaster.sendTransform(message)
with coframe.connect() as connection:
    print(connection.buffer.lookup("base", "lidar", timeout="20s").translation.tolist())
rclpy.shutdown()
"""
    assert python(program).splitlines()[-1] == "[0.0, 0.0, 0.0]"


@needs_dds
@pytest.mark.usefixtures("domain_id")
def test_the_demo_runs():
    pytest.importorskip("click", reason="needs coframe[cli]")
    shown = subprocess.run(
        [script("coframe"), "demo", "--duration", "5", "--no-browser"],
        capture_output=True,
        text=True,
        check=True,
        timeout=100,
    ).stdout
    assert re.search(r"^http://127\.0\.0\.1:\d+/$", shown, re.MULTILINE)
    assert re.search(r"^ *camera_link +end_effector +static", shown, re.MULTILINE)
