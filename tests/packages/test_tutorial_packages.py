# SPDX-License-Identifier: Apache-2.0
"""Packages that tutorials and launch files of others use: nav2_common, turtle_tf2_py, demo_nodes, ros2topic."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
import yaml

from launch import LaunchContext
from launch.conditions import IfCondition
from nav2_common.launch import HasNodeParams, LaunchConfigAsBool, ReplaceString, RewrittenYaml


@pytest.fixture
def parameters(tmp_path):
    file = tmp_path / "params.yaml"
    file.write_text(
        "amcl:\n  ros__parameters:\n    use_sim_time: false\n    alpha: 0.2\n    odom: <robot>/odom\n"
        "planner:\n  ros__parameters:\n    use_sim_time: false\n    plugins: [grid, lattice]\n    grid: {rate: 5.0}\n"
    )
    return file


def rewritten(*arguments, **options):
    return yaml.safe_load(Path(RewrittenYaml(*arguments, **options).perform(LaunchContext())).read_text())


def test_values_are_rewritten_by_name_and_by_path(parameters):
    changes = {
        "use_sim_time": "True",
        "planner.ros__parameters.grid.rate": "7.5",
        "planner.ros__parameters.plugins.1": "other",
        "amcl.ros__parameters.new.value": "3",
        "no.such.path": "4",
    }
    found = rewritten(str(parameters), changes, convert_types=True)
    assert found == {
        "amcl": {"ros__parameters": {"use_sim_time": True, "alpha": 0.2, "odom": "<robot>/odom", "new": {"value": 3}}},
        "planner": {"ros__parameters": {"use_sim_time": True, "plugins": ["grid", "other"], "grid": {"rate": 7.5}}},
    }
    text = rewritten(str(parameters), {"alpha": "0.5"})
    assert text["amcl"]["ros__parameters"]["alpha"] == "0.5", "numbers are texts unless they are converted"


def test_names_are_rewritten_and_a_namespace_is_added(parameters):
    found = rewritten(
        str(parameters), {}, root_key="robot1", key_rewrites={"amcl": "mcl"}, value_rewrites={"<robot>/odom": "odom"}
    )
    assert list(found) == ["robot1"]
    assert found["robot1"]["mcl"]["ros__parameters"]["odom"] == "odom"
    assert "amcl" not in found["robot1"]


def test_strings_are_replaced_under_a_condition(parameters):
    context = LaunchContext()
    path = ReplaceString(str(parameters), {"<robot>": "r1"}, condition=IfCondition("true")).perform(context)
    assert "odom: r1/odom" in Path(path).read_text()
    assert ReplaceString(str(parameters), {"<robot>": "r1"}, IfCondition("false")).perform(context) == str(parameters)


def test_questions_about_parameters_and_configurations(parameters):
    context = LaunchContext()
    assert HasNodeParams(str(parameters), "amcl").perform(context) == "True"
    assert HasNodeParams(str(parameters), "none").perform(context) == "False"
    for text, value in (("on", "True"), ("1", "True"), ("False", "False"), ("x", "False")):
        context.launch_configurations["a"] = text
        assert LaunchConfigAsBool("a").perform(context) == value


def test_packages_of_messages_that_coframe_does_not_have_are_explained():
    for statement in ("from unitree_api.msg import Request", "import px4_msgs.msg"):
        done = subprocess.run([sys.executable, "-c", statement], capture_output=True, text=True, check=False)
        assert "coframe interface add FOLDER" in done.stderr.splitlines()[-1]


@pytest.fixture
def environment(domain_id):
    pytest.importorskip("dds_library", reason="the nodes speak DDS")
    return {**os.environ, "ROS_DOMAIN_ID": str(domain_id)}


def command(*words):
    return [sys.executable, "-m", "coframe.cli", *words]


def test_the_services_of_the_demo_nodes(environment):
    server = subprocess.Popen(command("run", "demo_nodes_cpp", "add_two_ints_server"), env=environment)
    try:
        client = subprocess.run(
            command("run", "demo_nodes_py", "add_two_ints_client"),
            env=environment,
            capture_output=True,
            text=True,
            timeout=60,
            check=True,
        )
    finally:
        server.send_signal(signal.SIGINT)
        server.wait(timeout=20)
    assert "Result of add_two_ints: 5" in client.stdout + client.stderr


def test_launch_files_of_the_tutorials_are_found():
    done = subprocess.run(
        command("launch", "demo_nodes_cpp", "talker_listener.launch.py", "--print"),
        capture_output=True,
        text=True,
        check=True,
    )
    assert "talker" in done.stdout
    assert "listener" in done.stdout


def test_a_blackboard_keeps_every_parameter(environment):
    words = command(
        "run", "demo_nodes_cpp", "parameter_blackboard", "--ros-args", "-p", "some:=1", "-p", "other.one:=a"
    )
    program = subprocess.Popen(words, env=environment, stderr=subprocess.PIPE, text=True)
    try:
        assert "named '/parameter_blackboard' ready, and serving" in program.stderr.readline()
        get = command("param", "get", "/parameter_blackboard", "other.one")
        done = subprocess.run(get, env=environment, capture_output=True, text=True, check=True)
        assert done.stdout == "String value is: a\n"
        new = command("param", "set", "/parameter_blackboard", "new", "[1, 2]")
        assert subprocess.run(new, env=environment, capture_output=True, text=True, check=True).stdout
    finally:
        program.send_signal(signal.SIGINT)
        program.communicate(timeout=20)


def test_talkers_and_listeners_with_options_of_quality(environment):
    talker = subprocess.Popen(command("run", "demo_nodes_py", "talker_qos", "-n", "60"), env=environment)
    try:
        listener = subprocess.run(
            command("run", "demo_nodes_py", "listener_qos", "-n", "1"),
            env=environment,
            capture_output=True,
            text=True,
            timeout=60,
            check=True,
        )
        assert "Best effort listener" in listener.stderr
        assert "I heard: [Hello World: " in listener.stderr
    finally:
        talker.send_signal(signal.SIGINT)
        talker.wait(timeout=20)


def test_a_static_turtle(environment):
    words = command(
        "run", "turtle_tf2_py", "static_turtle_tf2_broadcaster", "mystaticturtle", *["0", "0", "1", "0", "0", "0"]
    )
    program = subprocess.Popen(words, env=environment)
    try:
        latched = ("--qos-durability", "transient_local", "--qos-reliability", "reliable")
        echo = command("topic", "echo", "/tf_static", "tf2_msgs/msg/TFMessage", "--once", *latched)
        done = subprocess.run(echo, env=environment, capture_output=True, text=True, timeout=60, check=True)
        assert "child_frame_id: mystaticturtle" in done.stdout
    finally:
        program.send_signal(signal.SIGINT)
        program.wait(timeout=20)
    mistake = subprocess.run([*words[:-1], "x"], env=environment, capture_output=True, text=True, check=False)
    assert mistake.returncode == 1
    assert "must be numbers, not 0 0 1 0 0 x" in mistake.stderr


def test_two_simulators_are_launched():
    done = subprocess.run(
        command("launch", "turtlesim", "multisim.launch.py", "--print"), capture_output=True, text=True, check=True
    )
    assert "turtlesim_node" in done.stdout


def test_xacro_says_which_file_is_missing():
    words = command("run", "xacro", "xacro", "/no/such.xacro")
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    assert done.returncode != 0
    assert done.stderr.startswith("error: No such file or directory: /no/such.xacro")
    assert "Traceback" not in done.stderr


def test_keys_drive_a_robot(node, environment, wait_until):
    import pty

    import rclpy
    from geometry_msgs.msg import Twist

    received = []
    node.create_subscription(Twist, "cmd_vel", received.append, 10)
    executor = rclpy.executors.SingleThreadedExecutor(context=node.context)
    executor.add_node(node)
    ours, theirs = pty.openpty()
    words = command("run", "teleop_twist_keyboard", "teleop_twist_keyboard")
    program = subprocess.Popen(words, stdin=theirs, stdout=subprocess.PIPE, text=True, env=environment)
    try:
        while "currently:\tspeed 0.5\tturn 1.0" not in program.stdout.readline():
            pass
        wait_until(lambda: node.count_publishers("/cmd_vel") == 1, timeout=20.0)
        wait_until(
            lambda: any(message.linear.x == 0.5 and message.angular.z == 1.0 for message in received),
            lambda: (os.write(ours, b"u"), executor.spin_once(timeout_sec=0.1)),
            timeout=20.0,
        )
        os.write(ours, b"w")
        assert "speed 0.55" in program.stdout.readline()
        program.send_signal(signal.SIGINT)
        assert program.wait(timeout=20) == 0
    finally:
        program.kill()
        program.wait()
        program.stdout.close()
        os.close(ours)
        os.close(theirs)


def test_xacro_is_an_executable_of_its_package(tmp_path):
    pytest.importorskip("xacro")
    file = tmp_path / "a.xacro"
    file.write_text('<robot name="a" xmlns:xacro="http://ros.org/xacro"><link name="${1 + 1}"/></robot>')
    done = subprocess.run(command("run", "xacro", "xacro", str(file)), capture_output=True, text=True, check=True)
    assert '<link name="2"/>' in done.stdout


def test_a_turtle_follows_the_first_one(node, environment, wait_until):
    import rclpy
    from ros2topic.api import get_msg_class, get_topic_names
    from tf2_ros import Buffer, TransformListener

    demo = subprocess.Popen(command("launch", "turtle_tf2_py", "turtle_tf2_demo.launch.py"), env=environment)
    buffer = Buffer()
    listener = TransformListener(buffer, node)
    executor = rclpy.executors.SingleThreadedExecutor(context=node.context)
    executor.add_node(node)

    def distance():
        found = buffer.lookup_transform("turtle2", "turtle1", rclpy.time.Time()).transform.translation
        return (found.x**2 + found.y**2) ** 0.5

    def spin():
        executor.spin_once(timeout_sec=0.05)

    try:
        wait_until(lambda: buffer.can_transform("turtle2", "turtle1", rclpy.time.Time()), spin, timeout=60.0)
        first = distance()
        wait_until(lambda: distance() < 0.7 * first, spin, timeout=60.0)
        assert "/turtle2/cmd_vel" in get_topic_names(node=node)
        assert get_msg_class(node, "turtle2/cmd_vel").__name__ == "Twist"
        assert get_msg_class(node, "/nothing") is None
    finally:
        demo.send_signal(signal.SIGINT)
        demo.wait(timeout=30)
        listener.unregister()


def test_a_navigator_drives_to_a_pose(make_node, environment, monkeypatch):
    import threading

    import rclpy
    from geometry_msgs.msg import PoseStamped
    from nav2_msgs.action import NavigateToPose
    from nav2_simple_commander.robot_navigator import BasicNavigator, TaskResult
    from rclpy.action import ActionServer

    def execute(goal):
        goal.publish_feedback(NavigateToPose.Feedback(distance_remaining=1.5))
        time.sleep(0.3)
        goal.succeed() if goal.request.pose.pose.position.x < 2.0 else goal.abort()
        return NavigateToPose.Result()

    nav2 = make_node("nav2")
    server = ActionServer(nav2, NavigateToPose, "navigate_to_pose", execute)
    executor = rclpy.executors.SingleThreadedExecutor(context=nav2.context)
    executor.add_node(nav2)
    thread = threading.Thread(target=executor.spin)
    thread.start()
    monkeypatch.setenv("ROS_DOMAIN_ID", environment["ROS_DOMAIN_ID"])
    rclpy.init()
    navigator = BasicNavigator()
    try:
        pose = PoseStamped()
        for x, result in ((1.0, TaskResult.SUCCEEDED), (3.0, TaskResult.FAILED)):
            pose.pose.position.x = x
            assert navigator.goToPose(pose)
            while not navigator.isTaskComplete():
                pass
            assert navigator.getResult() is result
            assert navigator.getFeedback().distance_remaining == 1.5
    finally:
        navigator.destroyNode()
        rclpy.shutdown()
        executor.shutdown()
        thread.join()
        server.destroy()
