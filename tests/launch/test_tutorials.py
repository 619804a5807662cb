# SPDX-License-Identifier: Apache-2.0
"""The launch files of the official tutorials, written from their description, with real nodes."""

import sys

import pytest

pytest.importorskip("dds_library", reason="the nodes speak DDS")

import rclpy
from geometry_msgs.msg import Twist
from launch import LaunchDescription, LaunchService
from launch.actions import (
    EmitEvent,
    ExecuteProcess,
    GroupAction,
    IncludeLaunchDescription,
    LogInfo,
    OpaqueFunction,
    RegisterEventHandler,
    TimerAction,
)
from launch.event_handlers import OnExecutionComplete, OnProcessExit, OnProcessIO, OnProcessStart, OnShutdown
from launch.events import Shutdown
from launch.substitutions import EnvironmentVariable, LocalSubstitution
from launch_ros.actions import Node, PushRosNamespace
from rclpy.executors import SingleThreadedExecutor
from turtlesim.msg import Pose

SIMULATION = """
<launch>
  <arg name="background_r" default="0"/>
  <node pkg="turtlesim" exec="turtlesim_node" name="sim" output="screen">
    <param name="background_r" value="$(var background_r)"/>
  </node>
</launch>
"""
SPAWN = """
import rclpy
from turtlesim.srv import Spawn

rclpy.init()
node = rclpy.create_node("caller")
client = node.create_client(Spawn, "/spawn")
assert client.wait_for_service(30)
future = client.call_async(Spawn.Request(x=2.0, y=3.0, theta=0.2, name="turtle2"))
rclpy.spin_until_future_complete(node, future)
print(future.result().name)
"""
MIMIC = """
launch:
- node:
    pkg: turtlesim
    exec: mimic
    name: mimic
    remap:
    - {from: /input/pose, to: /turtlesim1/turtle1/pose}
    - {from: /output/cmd_vel, to: /turtlesim2/turtle1/cmd_vel}
"""


@pytest.mark.usefixtures("domain_id")
def test_one_turtle_mimics_another(tmp_path, capfd):
    """Two simulators in namespaces, included from XML and YAML files with arguments, and a mimic between them."""
    (tmp_path / "sim.launch.xml").write_text(SIMULATION)
    (tmp_path / "mimic.launch.yaml").write_text(MIMIC)

    def included(name, **arguments):
        return IncludeLaunchDescription(str(tmp_path / name), launch_arguments=list(arguments.items()))

    context = rclpy.Context()
    rclpy.init(context=context)
    node = rclpy.create_node("observer", context=context)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    poses = []
    node.create_subscription(Pose, "/turtlesim2/turtle1/pose", poses.append, 10)
    commands = node.create_publisher(Twist, "/turtlesim1/turtle1/cmd_vel", 10)
    service = LaunchService()

    def watch(_context):
        """Drive the first turtle until the second one has moved, then end the system."""
        executor.spin_once(timeout_sec=0.001)
        if poses and poses[-1].x > 5.6:
            return EmitEvent(event=Shutdown(reason="it has moved"))
        twist = Twist()
        twist.linear.x = 2.0
        commands.publish(twist)
        return TimerAction(period=0.02, actions=[OpaqueFunction(function=watch)])

    service.include_launch_description(
        LaunchDescription(
            [
                GroupAction([PushRosNamespace("turtlesim1"), included("sim.launch.xml", background_r="122")]),
                GroupAction([PushRosNamespace("turtlesim2"), included("sim.launch.xml")]),
                included("mimic.launch.yaml"),
                OpaqueFunction(function=watch),
            ]
        )
    )
    assert service.run() == 0
    executor.shutdown()
    node.destroy_node()
    context.try_shutdown()
    text = capfd.readouterr().out
    assert "Starting turtlesim with node name /turtlesim1/sim" in text
    assert "Starting turtlesim with node name /turtlesim2/sim" in text
    assert text.count("process has finished cleanly") == 3, text


@pytest.mark.usefixtures("domain_id")
def test_event_handlers(capfd):
    """A simulator; when it has started, a turtle is spawned by a service call; its end shuts the system down."""
    simulator = Node(package="turtlesim", executable="turtlesim_node", name="sim", output="screen")
    spawn = ExecuteProcess(
        cmd=[
            sys.executable,
            "-c",
            SPAWN,
        ],
        name="spawn",
    )
    service = LaunchService()
    service.include_launch_description(
        LaunchDescription(
            [
                RegisterEventHandler(
                    OnProcessStart(target_action=simulator, on_start=[LogInfo(msg="turtlesim started"), spawn])
                ),
                RegisterEventHandler(
                    OnProcessIO(
                        target_action=spawn,
                        on_stdout=lambda event: LogInfo(msg=f"spawn says {event.text.decode().strip()}"),
                    )
                ),
                RegisterEventHandler(
                    OnExecutionComplete(
                        target_action=spawn,
                        on_completion=[
                            LogInfo(msg="spawn finished"),
                            EmitEvent(event=Shutdown(reason="the turtle is there")),
                        ],
                    )
                ),
                RegisterEventHandler(
                    OnProcessExit(
                        target_action=simulator,
                        on_exit=[LogInfo(msg=[EnvironmentVariable("HOME", default_value="x"), " closed the window"])],
                    )
                ),
                RegisterEventHandler(
                    OnShutdown(on_shutdown=[LogInfo(msg=["asked to shut down: ", LocalSubstitution("event.reason")])])
                ),
                simulator,
            ]
        )
    )
    assert service.run() == 0
    lines = capfd.readouterr().out.splitlines()
    logged = [line.removeprefix("[INFO] [launch.user]: ") for line in lines if "[launch.user]" in line]
    assert logged[:4] == [
        *("turtlesim started", "spawn says turtle2", "spawn finished", "asked to shut down: the turtle is there"),
    ]
    assert logged[4].endswith(" closed the window")
    assert any("Spawning turtle [turtle2] at x=[2.000000], y=[3.000000]" in line for line in lines)
