# SPDX-License-Identifier: Apache-2.0
"""coframe's tf2 inside a sourced ROS 2 (a stand-in): that side's nodes and messages, coframe's buffer."""

import ast
import json
import subprocess
import sys
from pathlib import Path

import pytest
import ros_stand_in
from inside_ros2 import verify
from zenoh_router import Router

from coframe.workspace import ros_folders


@pytest.fixture(scope="module")
def sourced(tmp_path_factory):
    """The folder of the stand-in."""
    folder = tmp_path_factory.mktemp("sourced")
    ros_stand_in.make(folder)
    return folder


def run(environment, *command):
    command = [str(part) for part in command]
    return subprocess.run(command, env=environment, capture_output=True, text=True, timeout=60, check=False)


@pytest.mark.usefixtures("domain_id")
@pytest.mark.parametrize(
    ("wire", "as_import"),
    [
        ("native", True),
        ("rclpy", False),
        pytest.param("rclpy", True, marks=pytest.mark.slow),
        pytest.param("native", False, marks=pytest.mark.slow),
    ],
)
def test_nodes_of_that_side_get_coframes_buffer(sourced, wire, as_import):
    pytest.importorskip("cyclonedds", reason="the stand-in speaks DDS")
    result = verify.listen(ros_stand_in.environment(sourced), wire, as_import=as_import)
    assert result.stdout == "passed\n", result.stderr


@pytest.mark.usefixtures("domain_id")
@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="transforms are shared on Linux only")
def test_nodes_of_that_side_share_transforms(sourced):
    pytest.importorskip("cyclonedds", reason="the stand-in speaks DDS")
    environment = {**ros_stand_in.environment(sourced), "COFRAME_SHARED": "1"}
    result = verify.listen(environment, "native", as_import=True)
    assert result.stdout == "passed\n", result.stderr


@pytest.mark.parametrize(
    ("variables", "problem"),
    [
        ({"RMW_IMPLEMENTATION": "rmw_fastrtps_cpp"}, "None"),
        ({"RMW_IMPLEMENTATION": "rmw_zenoh_cpp", "ROS_DISTRO": "jazzy"}, "None"),
        ({"RMW_IMPLEMENTATION": "rmw_zenoh_cpp"}, "the messages of Humble on Zenoh have no type hash"),
        (
            {"RMW_IMPLEMENTATION": "rmw_fastrtps_cpp", "COFRAME_WIRE": "zenoh"},
            "COFRAME_WIRE selects a different middleware from rmw_fastrtps_cpp.",
        ),
    ],
)
def test_whether_listeners_are_native_by_default(sourced, variables, problem):
    pytest.importorskip("cyclonedds", reason="native listeners need a DDS library")
    pytest.importorskip("zenoh", reason="native listeners need coframe[zenoh]")
    environment = ros_stand_in.environment(sourced)
    environment.pop("COFRAME_WIRE", None)
    code = "import coframe.ros2\nfrom tf2_ros import _side_sourced\nprint(_side_sourced._native_problem())"
    assert run(environment | variables, sys.executable, "-c", code).stdout.startswith(problem)


@pytest.mark.usefixtures("domain_id")
def test_native_listeners_over_zenoh(sourced):
    pytest.importorskip("zenoh", reason="the nodes use Zenoh")
    router = Router()
    zenoh = router.environment() | {"RMW_IMPLEMENTATION": "rmw_zenoh_cpp", "ROS_DISTRO": "jazzy"}
    try:
        result = verify.listen(ros_stand_in.environment(sourced) | zenoh, "native", as_import=True)
    finally:
        router.close()
    assert result.stdout == "passed\n", result.stderr


def test_importing_after_tf2_is_refused(sourced):
    code = "import tf2_ros\nimport coframe.ros2"
    result = run(ros_stand_in.environment(sourced), sys.executable, "-c", code)
    assert result.returncode == 1
    assert "Import coframe.ros2 before tf2_ros" in result.stderr.splitlines()[-1]


@pytest.mark.parametrize(("given", "used"), [(None, "SUBNET"), ("LOCALHOST", "LOCALHOST")])
def test_native_subscriptions_reach_what_that_side_reaches(sourced, given, used):
    environment = ros_stand_in.environment(sourced)
    for name in ("ROS_AUTOMATIC_DISCOVERY_RANGE", "ROS_LOCALHOST_ONLY"):
        environment.pop(name, None)
    if given:
        environment["ROS_AUTOMATIC_DISCOVERY_RANGE"] = given
    code = "import coframe.ros2\nfrom coframe.wire.dds import config\nprint(config.discovery_range())"
    assert run(environment, sys.executable, "-c", code).stdout == f"{used}\n"


def test_without_a_sourced_ros_the_classes_are_coframes():
    code = "import coframe.ros2, tf2_ros; assert coframe.ros2.Buffer is tf2_ros.Buffer; print(tf2_ros.__file__)"
    result = run(None, sys.executable, "-c", code)
    assert Path(result.stdout.strip()).is_relative_to(ros_folders.ros_folder())


def test_program_that_does_not_exist(sourced):
    result = run(ros_stand_in.environment(sourced), sys.executable, "-m", "coframe.ros2", "nowhere.py")
    assert result.returncode == 2
    assert result.stderr.splitlines()[-1].endswith("there is no file nowhere.py; for a module, use -m")


def test_tf2_uses_only_names_of_humble(shared):
    """On a sourced ROS, coframe's tf2 must not use names of rclpy and the messages that Humble does not have."""
    names = json.loads((shared / "interop" / "api_humble.json").read_text())
    home = ros_folders.ros_folder()
    files = [file for package in ("tf2_ros", "tf2_py") for file in (home / package).rglob("*.py")]
    unknown = [
        f"{file.name}: {node.module}.{name.name}"
        for file in files
        if file.name not in {"_side_coframe.py", "_native_subscriptions.py", "_shared_subscriptions.py"}
        for node in ast.walk(ast.parse(file.read_text()))
        if isinstance(node, ast.ImportFrom)
        and not str(node.module).startswith("tf2_")
        and isinstance(names.get(node.module), dict)
        for name in node.names
        if name.name not in names[node.module] and f"{node.module}.{name.name}" not in names
    ]
    assert unknown == []
