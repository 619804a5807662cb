# SPDX-License-Identifier: Apache-2.0
"""coframe next to a sourced ROS 2 (a stand-in): what this ROS lacks works with its message classes."""

import ast
import json
import signal
import subprocess
import sys
from pathlib import Path

import pytest
import ros_stand_in

from coframe.cli.commands import COMMANDS
from coframe.workspace import ros_folders

ARM = Path(ros_folders.__file__).parent / "lab" / "two_link_arm.urdf.xacro"

TRANSFORMS = """
import sys
import numpy as np
import rclpy, tf2_ros, tf2_geometry_msgs
for module in (rclpy, tf2_ros, tf2_geometry_msgs):
    assert module.__file__.startswith(sys.argv[1]), module.__file__
import tf2_sensor_msgs, tf2_nav_msgs, tf2_visualization_msgs, tf_transformations, robot_state_publisher
for module in (tf2_sensor_msgs, tf2_nav_msgs, tf_transformations, robot_state_publisher):
    assert not module.__file__.startswith(sys.argv[1]), module.__file__
from geometry_msgs.msg import PoseStamped, TransformStamped, Quaternion
from nav_msgs.msg import Odometry, Path
from sensor_msgs.msg import Imu, LaserScan, PointCloud2
from sensor_msgs_py import point_cloud2
from std_msgs.msg import Header
from visualization_msgs.msg import Marker

buffer = tf2_ros.Buffer()
stamped = TransformStamped(header=Header(frame_id="base"), child_frame_id="laser")
stamped.transform.translation.x = 2.0
stamped.transform.rotation = Quaternion(**dict(zip("xyzw", tf_transformations.quaternion_from_euler(0, 0, np.pi / 2))))
buffer.set_transform_static(stamped, "test")
header = Header(frame_id="laser")

def transformed(message):
    result = buffer.transform(message, "base")
    assert type(result).__module__ == type(message).__module__, type(result)
    assert result.header.frame_id == "base"
    return result

cloud = transformed(point_cloud2.create_cloud_xyz32(header, [[1.0, 0.0, 0.0]]))
assert type(cloud) is PointCloud2
def points(cloud):
    return point_cloud2.read_points_numpy(cloud, ["x", "y", "z"])
np.testing.assert_allclose(points(cloud), [[2.0, 1.0, 0.0]], atol=1e-6)
scan = LaserScan(header=header, range_max=10.0, ranges=[1.0, 3.0], angle_increment=np.pi / 2)
cloud = buffer.transform(scan, "base")
assert type(cloud) is PointCloud2
np.testing.assert_allclose(points(cloud), [[2.0, 1.0, 0.0], [-1.0, 0.0, 0.0]], atol=1e-6)
imu = Imu(header=header)
imu.angular_velocity.x = 1.0
assert abs(transformed(imu).angular_velocity.y - 1.0) < 1e-9
odometry = Odometry(header=header)
odometry.pose.pose.position.x = 1.0
assert abs(transformed(odometry).pose.pose.position.y - 1.0) < 1e-9
path = transformed(Path(header=header, poses=[PoseStamped(header=header)]))
assert path.poses[0].pose.position.x == 2.0
assert transformed(Marker(header=header)).pose.position.x == 2.0
for program in sys.argv[2:]:
    import runpy
    assert "do_transform_cloud" in runpy.run_path(program)
print("all transformed")
"""

PACKAGES = """
import sys
import numpy as np
import sensor_msgs.msg
assert sensor_msgs.__file__.startswith(sys.argv[1])
import angles, cv_bridge, image_geometry, laser_geometry, message_filters, ros2_numpy, rosidl_runtime_py
from nav_msgs.msg import OccupancyGrid
from sensor_msgs.msg import CameraInfo, Image, LaserScan, PointCloud2
from std_msgs.msg import Header

header = Header(frame_id="camera")
header.stamp.sec = 5
image = cv_bridge.CvBridge().cv2_to_imgmsg(np.zeros((4, 6, 3), np.uint8), "bgr8", header)
assert type(image) is Image and image.header is header
assert cv_bridge.CvBridge().imgmsg_to_cv2(image).shape == ros2_numpy.numpify(image).shape == (4, 6, 3)
text = rosidl_runtime_py.message_to_yaml(image, no_arr=True)
assert text.startswith("header:\\n  stamp:\\n    sec: 5\\n") and "<sequence type: uint8, length: 72>" in text, text
again = Image()
rosidl_runtime_py.set_message_fields(again, {"header": {"stamp": {"sec": 7}}})
assert again.header.stamp.sec == 7
scan = LaserScan(header=header, range_max=10.0, ranges=[1.0, 2.0], angle_increment=0.1)
cloud = laser_geometry.LaserProjection().projectLaser(scan)
assert type(cloud) is PointCloud2 and len(ros2_numpy.numpify(cloud)["xyz"]) == 2
assert type(ros2_numpy.msgify(PointCloud2, ros2_numpy.numpify(cloud))) is PointCloud2
assert type(ros2_numpy.msgify(OccupancyGrid, np.zeros((2, 2), np.int8))) is OccupancyGrid
image_geometry.PinholeCameraModel().fromCameraInfo(CameraInfo(header=header))
received = []
inputs = message_filters.SimpleFilter(), message_filters.SimpleFilter()
message_filters.ApproximateTimeSynchronizer(inputs, 5, 0.1).registerCallback(lambda *pair: received.append(pair))
inputs[0].signalMessage(image)
inputs[1].signalMessage(scan)
assert received == [(image, scan)]
assert angles.normalize_angle(0.0) == 0.0
print("all converted")
"""


@pytest.fixture(scope="module")
def sourced(tmp_path_factory):
    """The folder of the stand-in."""
    folder = tmp_path_factory.mktemp("sourced")
    ros_stand_in.make(folder)
    return folder


def run(sourced, *command, timeout=60):
    environment = ros_stand_in.environment(sourced)
    return subprocess.run(
        [sys.executable, *map(str, command)],
        env=environment,
        capture_output=True,
        text=True,
        timeout=timeout,
        check=False,
    )


def test_packages_transform_the_messages_of_that_side(sourced):
    lab = Path(__file__).resolve().parents[3] / "shared" / "lab" / "sensor_transform.py"
    result = run(sourced, "-c", TRANSFORMS, sourced, *([lab] if lab.is_file() else []))
    assert result.stdout == "all transformed\n", result.stderr


def test_every_command_and_lab_node_starts(sourced):
    code = (
        "import json, sys; from click.testing import CliRunner; from coframe.cli.command_line import CommandLine\n"
        "for name in json.loads(sys.argv[1]):\n"
        "    result = CliRunner().invoke(CommandLine(), [name, '--help'])\n"
        "    assert result.exit_code == 0, (name, result.output, result.exception)\n"
        "import importlib, pkgutil, coframe.lab, coframe.nodes\n"
        "for package in (coframe.lab, coframe.nodes):\n"
        "    for module in pkgutil.iter_modules(package.__path__, package.__name__ + '.'):\n"
        "        importlib.import_module(module.name)\n"
    )
    result = run(sourced, "-c", code, json.dumps(list(COMMANDS)))
    assert result.returncode == 0, result.stderr


@pytest.mark.slow
@pytest.mark.usefixtures("domain_id")
def test_demo_robot_and_joints_run(sourced):
    pytest.importorskip("dds_library", reason="the nodes speak DDS")
    pytest.importorskip("xacro", reason="the arm is a xacro file")
    environment = ros_stand_in.environment(sourced)
    options = {"env": environment, "stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "text": True}
    programs = [
        subprocess.Popen([sys.executable, "-m", "coframe.cli", command, str(ARM), *arguments], **options)
        for command, *arguments in (
            ("robot", "--prefix", "other/", "--ros-args", "-r", "joint_states:=/other/joint_states"),
            ("joints", "--ros-args", "-r", "__ns:=/other"),
        )
    ]
    try:
        frames = "other/base_link", "other/end_effector"
        found = run(sourced, "-m", "coframe.cli", "lookup", *frames, "--duration", "20s")
        assert found.returncode == 0, found.stderr
        demo = run(sourced, "-m", "coframe.cli", "demo", "--urdf", "--no-browser", "--duration", "6", timeout=90)
        assert demo.returncode == 0, demo.stdout + demo.stderr
        assert "end_effector" in demo.stdout
    finally:
        for program in programs:
            program.send_signal(signal.SIGINT)
        outputs = [program.communicate(timeout=20)[0] for program in programs]
    assert [program.returncode for program in programs] == [0, 0], outputs
    assert "publishing on /joint_states" in outputs[1]


def test_only_names_of_humble_are_used(shared):
    """Whatever runs on a sourced ROS uses only names that Humble's packages have."""
    names = json.loads((shared / "interop" / "api_humble.json").read_text())
    home = ros_folders.ros_folder()
    package = Path(ros_folders.__file__).parent
    own = {*ros_folders.PACKAGES, "ament_index_python"}
    files = [
        *(file for folder in home.iterdir() if folder.name not in own for file in folder.rglob("*.py")),
        *(package / "lab").glob("*.py"),
        *(package / "nodes").glob("*.py"),
        *(package / "cli").glob("*.py"),
    ]
    unknown = [
        f"{file.name}: {node.module}.{name.name}"
        for file in files
        for node in ast.walk(ast.parse(file.read_text()))
        if isinstance(node, ast.ImportFrom)
        and isinstance(names.get(node.module), dict)  # the others are not in that installation
        and not file.is_relative_to(home / node.module.split(".")[0])
        for name in node.names
        if name.name not in names[node.module] and f"{node.module}.{name.name}" not in names
    ]
    assert unknown == []


def test_packages_that_the_ros_lacks_work_with_its_messages(sourced):
    result = run(sourced, "-c", PACKAGES, sourced)
    assert result.stdout == "all converted\n", result.stderr
