# SPDX-License-Identifier: Apache-2.0
"""Containers load nodes in Python into one process, and name those in C++."""

import re
import sys

import pytest

from launch.actions import EmitEvent, GroupAction, OpaqueFunction, RegisterEventHandler
from launch.conditions import IfCondition
from launch.event_handlers import OnProcessIO
from launch.events import Shutdown
from launch_ros.actions import ComposableNodeContainer, LoadComposableNodes, PushRosNamespace, SetParameter, SetRemap
from launch_ros.actions.load_composable_nodes import get_composable_node_load_request
from launch_ros.descriptions import ComposableLifecycleNode, ComposableNode
from launch_ros.event_handlers import OnStateTransition
from rclpy.parameter import Parameter

NODES = """
import os
from rclpy.lifecycle import LifecycleNode
from rclpy.node import Node


class Camera(Node):
    def __init__(self):
        super().__init__("camera", namespace="own")
        rate = self.declare_parameter("rate", 1).value
        topic = self.resolve_topic_name("image")
        self.get_logger().info(f"PROCESS {os.getpid()} {self.get_fully_qualified_name()} {rate} {topic}")


class Managed(LifecycleNode):
    def __init__(self):
        LifecycleNode.__init__(self, "managed")
        self.get_logger().info(f"PROCESS {os.getpid()} {self.get_fully_qualified_name()}")

    def on_activate(self, state):
        self.get_logger().info(f"PROCESS {os.getpid()} active")
        return super().on_activate(state)


class Broken(Node):
    def __init__(self):
        super().__init__("broken")
        raise RuntimeError("no such device")
"""


@pytest.fixture(autouse=True)
def _workspace(tmp_path, monkeypatch, domain_id):
    monkeypatch.setenv("ROS_DOMAIN_ID", str(domain_id))
    package = tmp_path / "src" / "eyes"
    package.mkdir(parents=True)
    (package / "package.xml").write_text("<package><name>eyes</name></package>")
    (package / "setup.py").write_text(
        "setup(entry_points={'rclpy_components': ['eyes::Camera = eye_nodes:Camera',"
        " 'eyes::Managed = eye_nodes:Managed', 'eyes::Broken = eye_nodes:Broken']})"
    )
    (package / "eye_nodes.py").write_text(NODES)
    monkeypatch.setenv("COFRAME_PACKAGE_PATH", str(tmp_path / "src"))
    monkeypatch.delenv("AMENT_PREFIX_PATH", raising=False)


def container(*nodes, executable="component_container", package="rclcpp_components"):
    return ComposableNodeContainer(
        name="box",
        namespace="",
        package=package,
        executable=executable,
        output="screen",
        composable_node_descriptions=list(nodes),
    )


def all_of(*texts):
    """Return a handler that shuts down when a container has printed all texts."""
    seen = []

    def check(event):
        seen.append(event.text)
        is_done = all(text in b"".join(seen) for text in texts)
        return EmitEvent(event=Shutdown(reason="test")) if is_done else None

    return check


def processes(lines):
    return [match.groups() for line in lines if (match := re.search(r"PROCESS (\d+) (.*)$", line))]


@pytest.mark.parametrize(
    "executable", ["component_container", "component_container_mt", "component_container_isolated"]
)
def test_nodes_share_the_process_of_their_container(launched, executable):
    first = ComposableNode(
        package="eyes",
        plugin="eyes::Camera",
        name="left",
        namespace="robot",
        parameters=[{"rate": 30}],
        remappings=[("image", "/raw")],
        extra_arguments=[{"use_intra_process_comms": True}],
    )
    unwanted = ComposableNode(package="eyes", plugin="eyes::Camera", name="off", condition=IfCondition("false"))
    by_class = ComposableNode(package="eyes", plugin="eye_nodes:Camera")
    box = container(first, unwanted, by_class, executable=executable, package="rclpy_components")
    managed = ComposableNode(package="eyes", plugin="eyes::Managed", name="last")
    load = LoadComposableNodes(target_container="/box", composable_node_descriptions=[managed])
    end = RegisterEventHandler(OnProcessIO(target_action=box, on_stderr=all_of(b"/own/camera", b"/arm/last")))
    code, lines = launched(box, GroupAction([PushRosNamespace("arm"), load]), end)
    assert code == 0
    found = processes(lines)
    assert {text for _, text in found} == {"/robot/left 30 /raw", "/own/camera 1 /own/image", "/arm/last"}
    assert len({number for number, _ in found}) == 1


def test_nodes_in_cpp_are_named_in_one_sentence(launched):
    plugins = ["image_proc::RectifyNode", "eyes::Filter"]
    nodes = [ComposableNode(package=name.partition(":")[0], plugin=name) for name in plugins]
    broken = ComposableNode(package="eyes", plugin="eyes::Broken")
    good = ComposableNode(package="eyes", plugin="eyes::Camera")
    box = container(*nodes, broken, good)
    code, lines = launched(box, RegisterEventHandler(OnProcessIO(target_action=box, on_stderr=all_of(b"PROCESS"))))
    errors = [line for line in lines if line.startswith("[ERROR] [launch_ros")]
    assert code == 0
    (sentence,) = [line for line in errors if "image_proc" in line]
    assert sentence.startswith(
        "[ERROR] [launch_ros.actions.load_composable_nodes]: /box: composable nodes in C++ are libraries, which need a "
        "ROS 2 installation; not loaded: image_proc::RectifyNode, eyes::Filter. Use nodes in Python"
    )
    assert any("Failed to load node 'eyes::Broken'" in line and "no such device" in line for line in errors)
    assert [text for _, text in processes(lines)] == ["/own/camera 1 /own/image"]


def test_a_container_that_ends_is_not_waited_for(launched, tmp_path):
    program = tmp_path / "short.py"
    program.write_text(f"#!{sys.executable}\n")
    program.chmod(0o755)
    box = ComposableNodeContainer(
        name="box",
        namespace="",
        executable=str(program),
        composable_node_descriptions=[ComposableNode(package="eyes", plugin="eyes::Camera")],
    )
    _, lines = launched(box)
    assert any("Abandoning wait for the '/box/_container/load_node' service" in line for line in lines)


def test_a_request_contains_the_surroundings_of_the_launch_file(context, tmp_path):
    file = tmp_path / "all.yaml"
    file.write_text(
        "/**: {ros__parameters: {a: 1}}\n/robot/left: {ros__parameters: {b: [left, right]}}\n"
        "/other: {ros__parameters: {c: 3}}\n"
    )
    for action in (PushRosNamespace("robot"), SetRemap("tf", "/tf"), SetParameter("use_sim_time", value=True)):
        action.execute(context)
    node = ComposableNode(
        package="eyes", plugin="eyes::Camera", name="left", parameters=[str(file), {"d": 2.5}], remappings=[("a", "b")]
    )
    request = get_composable_node_load_request(node, context)
    assert (request.node_name, request.node_namespace) == ("left", "/robot")
    assert request.remap_rules == ["tf:=/tf", "a:=b"]
    found = {each.name: Parameter.from_parameter_msg(each).value for each in request.parameters}
    assert found == {"use_sim_time": True, "a": 1, "b": ["left", "right"], "d": 2.5}


def test_containers_in_xml(launched, parse, tmp_path):
    description = parse(
        """<launch>
          <node_container pkg="rclpy_components" exec="component_container" name="box" namespace="" output="screen">
            <composable_node pkg="eyes" plugin="eyes::Camera" name="left">
              <param name="rate" value="5"/>
            </composable_node>
            <composable_node pkg="eyes" plugin="eyes::Camera" name="off" if="false"/>
          </node_container>
        </launch>""",
        tmp_path,
    )
    box = description.entities[0]
    _, lines = launched(
        *description.entities, RegisterEventHandler(OnProcessIO(target_action=box, on_stderr=all_of(b"PROCESS")))
    )
    assert [text for _, text in processes(lines)] == ["/own/left 5 /own/image"]


def test_lifecycle_nodes_of_a_container_are_activated(launched, parse, tmp_path):
    description = parse(
        """<launch>
          <node_container pkg="rclpy_components" exec="component_container" name="box" namespace="" output="screen">
            <composable_lifecycle_node pkg="eyes" plugin="eyes::Managed" name="first" autostart="true"/>
            <composable_lifecycle_node pkg="eyes" plugin="eyes::Managed" name="second"/>
          </node_container>
        </launch>""",
        tmp_path,
    )
    box = description.entities[0]
    seen = []
    transitions = OnStateTransition(
        goal_state="active", entities=[OpaqueFunction(function=lambda context: seen.append(context.locals.event))]
    )
    end = RegisterEventHandler(OnProcessIO(target_action=box, on_stderr=all_of(b"active", b"/second")))
    _, lines = launched(RegisterEventHandler(transitions), *description.entities, end)
    texts = [text for _, text in processes(lines)]
    assert sorted(texts) == ["/first", "/second", "active"]
    assert not ComposableLifecycleNode(package="eyes", plugin="eyes::Managed").node_autostart
    assert {event.action.node_name for event in seen} <= {"/first"}
