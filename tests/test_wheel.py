# SPDX-License-Identifier: Apache-2.0
"""The wheel in an environment of its own, as `pip install` would have it."""

import os
import re
import subprocess
import sys
import venv
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]


def run(*command, **environment):
    command = [str(part) for part in command]
    result = subprocess.run(
        command, capture_output=True, text=True, cwd="/", env={**os.environ, **environment}, check=False
    )
    assert result.returncode == 0, result.stderr
    return result.stdout


@pytest.mark.slow
@pytest.mark.timeout(600)
def test_the_wheel_has_everything(tmp_path):
    run(sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", "--wheel-dir", tmp_path, ROOT)
    (wheel,) = tmp_path.glob("coframe-*.whl")
    venv.create(tmp_path / "env", with_pip=True)
    python = tmp_path / "env" / "bin" / "python"
    run(python, "-m", "pip", "install", "--quiet", f"{wheel}[dds,cli,viewer]")

    path, rclpy = run(python, "-c", "import sys, rclpy; print(sys.path[-1]); print(rclpy.__file__)").splitlines()
    assert path.endswith("coframe/ros"), "the ROS packages come last on the path"
    assert rclpy.startswith(path)
    packages = "tf2_ros, tf2_geometry_msgs, tf2_sensor_msgs, tf2_nav_msgs, tf2_visualization_msgs, tf_transformations"
    run(python, "-c", f"import {packages}, sensor_msgs_py")
    converters = "cv_bridge, image_geometry, laser_geometry, ros2_numpy, rosidl_runtime_py"
    run(python, "-c", f"import {converters}, angles, diagnostic_updater, message_filters")
    run(python, "-c", "import rosbag2_py, turtlesim.turtlesim_node; from nav2_msgs.action import NavigateToPose")
    (tmp_path / "own_msgs/msg").mkdir(parents=True)
    (tmp_path / "own_msgs/msg/Num.msg").write_text("int64 num 3\n")
    first = "from own_msgs.msg import Num; print(Num())"
    assert run(python, "-c", first, COFRAME_INTERFACES=str(tmp_path)) == "own_msgs.msg.Num(num=3)\n"
    shown = run(tmp_path / "env" / "bin" / "coframe", "demo", "--duration", "5", "--no-browser", ROS_DOMAIN_ID="201")
    assert re.search(r"^http://127\.0\.0\.1:\d+/$", shown, re.MULTILINE)
    page = "import coframe, urllib.request as u; print(u.urlopen(coframe.show(coframe.Buffer(), port=0).url).read())"
    assert "viewer.js" in run(python, "-c", page), "the page is in the wheel"
    assert re.search(r"^ *camera_link +end_effector +static", shown, re.MULTILINE)
