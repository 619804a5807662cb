# SPDX-License-Identifier: Apache-2.0
"""Detection of a mixture of coframe's ROS packages with those of a ROS installation."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from coframe.workspace import ros_folders, ros_side


def test_only_coframes_packages():
    assert ros_folders.foreign_packages(tuple(sys.path)) == {}
    ros_side.check("rclpy")


def test_partial_ros_installation_before_coframe_is_rejected(tmp_path):
    package = tmp_path / "geometry_msgs"
    package.mkdir()
    (package / "__init__.py").touch()
    path = [str(tmp_path), str(ros_folders.ros_folder())]
    assert ros_folders.foreign_packages(tuple(path)) == {"geometry_msgs": str(tmp_path)}
    with pytest.raises(ImportError, match=r"import coframe's tf2_ros: geometry_msgs would .* a complete ROS 2"):
        ros_side.check("tf2_ros", path)


def test_documentation_quotes_the_error(tmp_path):
    (tmp_path / "geometry_msgs").mkdir()
    (tmp_path / "geometry_msgs" / "__init__.py").touch()
    with pytest.raises(ImportError) as caught:
        ros_side.check("tf2_ros", [str(tmp_path), str(ros_folders.ros_folder())])
    page = (Path(__file__).parents[2] / "docs" / "how-to" / "beside-ros2.md").read_text()
    assert f"ImportError: {caught.value}".replace(str(tmp_path), "/opt/ros/humble/lib/python3.10/site-packages") in page


def test_a_complete_ros_after_coframe_takes_precedence_and_single_packages_do_not(tmp_path):
    path = [str(ros_folders.ros_folder()), str(tmp_path)]
    for name in ("tf2_ros", "geometry_msgs"):  # as Debian's of ROS 1
        (tmp_path / name).mkdir()
        (tmp_path / name / "__init__.py").touch()
    ros_side.check("rclpy", path)
    (tmp_path / "rclpy").mkdir()
    (tmp_path / "rclpy" / "__init__.py").touch()
    ros_folders.foreign_packages.cache_clear()
    with pytest.raises(ImportError, match=r"tf2_nav_msgs: geometry_msgs, rclpy, tf2_ros would be imported"):
        ros_side.check("tf2_nav_msgs", path)


def test_directories_without_code_are_ignored(tmp_path):
    (tmp_path / "std_msgs").mkdir()
    ros_side.check("rclpy", [str(tmp_path), str(ros_folders.ros_folder())])


def test_sourced_ros_takes_precedence(tmp_path):
    (tmp_path / "rclpy").mkdir()
    (tmp_path / "rclpy" / "__init__.py").write_text("whose = 'theirs'")
    environment = {**os.environ, "PYTHONPATH": str(tmp_path)}
    code = "import rclpy; print(rclpy.whose)"
    result = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True)
    assert result.stdout == "theirs\n"
    code = "import tf2_ros"
    result = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=False)
    assert "cannot import coframe's tf2_ros: rclpy would be imported from" in result.stderr
