# SPDX-License-Identifier: Apache-2.0
"""joint_state_publisher as a node, and `coframe joints` as a user runs it."""

import math
import os
import select
import signal
import subprocess
import sys
from xml.dom import minidom

import pytest

from coframe.robots import RobotDescriptionError
from joint_state_publisher import JointStatePublisher
from joint_state_publisher import joint_state_publisher as upstream
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import DurabilityPolicy, QoSProfile
from sensor_msgs.msg import JointState
from std_msgs.msg import String

URDF = """<robot name="arm">
  <link name="base"/> <link name="a"/> <link name="b"/> <link name="c"/>
  <joint name="turn" type="continuous"><parent link="base"/><child link="a"/></joint>
  <joint name="lift" type="prismatic"><parent link="a"/><child link="b"/>
    <limit lower="0.2" upper="0.6" effort="1" velocity="1"/></joint>
  <joint name="follow" type="continuous"><parent link="b"/><child link="c"/>
    <mimic joint="lift" multiplier="2" offset="0.1"/></joint>
</robot>"""
LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
PARAMETERS = """
/**:
  ros__parameters: {rate: 50, publish_default_velocities: true}
/robots/joint_state_publisher:
  ros__parameters:
    source_list: [/measured]
    zeros: {turn: 0.5}
    dependent_joints:
      follow: {parent: turn, factor: -1.0, offset: 0.25}
other_node:
  ros__parameters: {rate: 1}
"""


def positions(message):
    return dict(zip(message.name, message.position, strict=True))


@pytest.fixture
def received(make_node):
    """A node that listens, and the joint states that it has received of the plain topic and of the robot's."""
    node = make_node("listener")
    found = {"/joint_states": [], "/robots/joint_states": []}
    for topic, messages in found.items():
        node.create_subscription(JointState, topic, messages.append, 10)
    return node, found


def test_node_with_a_parameter_file(context, received, wait_until, tmp_path):
    """Parameters by wildcard and by full name, sources, a changed description and an invalid one."""
    listener, found = received
    (tmp_path / "parameters.yaml").write_text(PARAMETERS)
    arguments = ["--ros-args", "--params-file", str(tmp_path / "parameters.yaml"), "-r", "__ns:=/robots"]
    node = JointStatePublisher(context=context, cli_args=arguments, start_parameter_services=False)
    messages = found["/robots/joint_states"]
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    executor.add_node(listener)
    spin = lambda: executor.spin_once(timeout_sec=0.05)  # noqa: E731
    descriptions = listener.create_publisher(String, "/robots/robot_description", LATCHED)
    measured = listener.create_publisher(JointState, "/measured", 10)
    try:
        descriptions.publish(String(data=URDF))
        wait_until(lambda: messages, spin)
        assert positions(messages[0]) == pytest.approx({"turn": 0.5, "lift": 0.4, "follow": -0.25})
        assert list(messages[0].velocity) == [0.0, 0.0, 0.0]
        assert list(messages[0].effort) == []
        assert messages[0].header.stamp.sec > 0

        wait_until(measured.get_subscription_count, spin)
        measured.publish(JointState(name=["turn", "lift"], position=[1.0]))  # Invalid: fewer positions than names.
        measured.publish(JointState(name=["turn", "follow"], position=[1.0, 9.0], velocity=[0.5, 9.0]))
        wait_until(lambda: positions(messages[-1])["turn"] == 1.0, spin)
        assert positions(messages[-1]) == pytest.approx({"turn": 1.0, "lift": 0.4, "follow": -0.75})
        assert list(messages[-1].velocity) == [0.5, 0.0, -0.5]

        descriptions.publish(String(data="<robot/>"))  # Not a robot description.
        descriptions.publish(String(data=URDF.replace("lift", "raise")))
        wait_until(lambda: "raise" in messages[-1].name, spin)
        assert positions(messages[-1]) == pytest.approx({"turn": 0.5, "raise": 0.4, "follow": -0.25})
    finally:
        node.destroy_node()


@pytest.mark.parametrize(
    ("arguments", "reason"),
    [
        (["rate:=0"], "parameter 'rate' must be greater than 0 Hz and at most 1 MHz, but is 0"),
        (["rate:=fast"], "parameter 'rate' must be a number, but is 'fast'"),
        (["use_mimic_tags:=1"], "parameter 'use_mimic_tags' must be true or false, but is 1"),
        (["source_list:=a"], "parameter 'source_list' must be a list of topics, but is 'a'"),
        (["dependent_joints.a.factor:=2.0"], "must at least have a parent. 'a' has no parent"),
        (["dependent_joints.a:=b"], "Invalid dependent_joint name 'a'"),
    ],
)
def test_invalid_parameters(context, arguments, reason):
    words = ["--ros-args", *(word for argument in arguments for word in ("-p", argument))]
    with pytest.raises(ValueError, match=reason):
        JointStatePublisher(context=context, cli_args=words, start_parameter_services=False)


def test_programs_report_errors_in_one_message(tmp_path):
    (tmp_path / "arm.urdf").write_text(URDF)
    circle = ["--ros-args", "-p", "dependent_joints.lift.parent:=follow"]
    file = str(tmp_path / "arm.urdf")
    endless = "Found an infinite recursive mimic chain: ['lift', 'follow', 'lift']"
    wrong = {
        endless: ["joint_state_publisher", file, *circle],
        f"coframe: {endless}": ["coframe.cli", "joints", file, *circle],
        "no joint named 'trun'": ["coframe.cli", "joints", file, "--zero", "trun=1"],
        "coframe: failed to initialize rcl: Couldn't parse parameter override rule: '-p x'": [
            "coframe.cli",
            "robot",
            file,
            "--ros-args",
            "-p",
            "x",
        ],
        "No such file": ["robot_state_publisher", file, "--ros-args", "--params-file", "/nowhere"],
    }
    processes = {
        text: subprocess.Popen([sys.executable, "-m", *command], stderr=subprocess.PIPE, text=True)
        for text, command in wrong.items()
    }
    for text, process in processes.items():
        _, errors = process.communicate(timeout=60)
        assert process.returncode in {1, 2}
        assert text in errors
        assert "Traceback" not in errors


def test_command_without_a_terminal(context, received, wait_until, tmp_path):
    listener, found = received
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(listener)
    (tmp_path / "arm.urdf").write_text(URDF)
    command = [sys.executable, "-m", "coframe.cli", "joints", str(tmp_path / "arm.urdf"), "--zero", "turn=-0.5"]
    process = subprocess.Popen(
        [*command, "--rate", "50", "--ros-args", "-p", "publish_default_velocities:=true", "-p", "delta:=1e-9"],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    messages = found["/joint_states"]
    try:
        wait_until(lambda: len(messages) > 1, lambda: executor.spin_once(timeout_sec=0.05), timeout=30.0)
        assert positions(messages[0]) == pytest.approx({"turn": -0.5, "lift": 0.4, "follow": 0.9}, abs=1e-6)
        assert positions(messages[1])["turn"] > positions(messages[0])["turn"], (
            "the parameter 'delta' of the command line is not applied"
        )
        assert messages[0].velocity.tolist() == [0.0, 0.0, 0.0]
    finally:
        process.send_signal(signal.SIGINT)
        output, errors = process.communicate(timeout=20)
    assert (process.returncode, output) == (0, "publishing on /joint_states\n")
    assert "Traceback" not in errors


def test_sliders_of_the_viewer(context, received, wait_until, tmp_path):
    pytest.importorskip("websockets", reason="the viewer's server")
    listener, found = received
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(listener)
    (tmp_path / "arm.urdf").write_text(URDF)
    command = [sys.executable, "-m", "coframe.cli", "joints", str(tmp_path / "arm.urdf"), "--gui", "--no-browser"]
    process = subprocess.Popen([*command, "--port", "0"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    sliders = listener.create_publisher(JointState, "/coframe_joints/sliders", 10)
    messages = found["/joint_states"]

    def spin():
        executor.spin_once(timeout_sec=0.05)
        sliders.publish(JointState(name=["turn", "lift", "follow"], position=[1.25, 0.5, 9.0]))

    try:
        assert process.stdout.readline().startswith("http://127.0.0.1:")
        expected = {"turn": 1.25, "lift": 0.5, "follow": 1.1}
        wait_until(lambda: messages and positions(messages[-1]) == pytest.approx(expected), spin, timeout=30.0)
    finally:
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=20)
    assert process.returncode == 0
    assert "Traceback" not in errors


@pytest.mark.skipif(sys.platform == "win32", reason="requires a Unix pseudo-terminal")
def test_sliders_of_the_terminal(context, received, wait_until, tmp_path):
    import pty

    listener, found = received
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(listener)
    (tmp_path / "arm.urdf").write_text(URDF)
    controller, terminal = pty.openpty()
    command = [sys.executable, "-m", "coframe.cli", "joints", str(tmp_path / "arm.urdf"), "--rate", "50"]
    process = subprocess.Popen(
        command,
        stdin=terminal,
        stdout=terminal,
        stderr=terminal,
        start_new_session=True,
        env={**os.environ, "TERM": "xterm"},
    )
    os.close(terminal)
    screen = bytearray()

    def spin():
        executor.spin_once(timeout_sec=0.02)
        while select.select([controller], [], [], 0)[0]:
            try:
                screen.extend(os.read(controller, 65536))
            except OSError:  # The program has ended.
                return

    def pressed(key, **expected):
        os.write(controller, key)
        wait_until(lambda: positions(found["/joint_states"][-1]) == pytest.approx(expected), spin)

    try:
        wait_until(lambda: found["/joint_states"] and b"lift" in screen, spin, timeout=30.0)
        pressed(b"\x1b[B\x1b[C", turn=0.0, lift=0.404, follow=0.908)
        pressed(b"\x1b[5~", turn=0.0, lift=0.444, follow=0.988)
        pressed(b"0", turn=0.0, lift=0.4, follow=0.9)
        pressed(b"\x1b[5~" * 9, turn=0.0, lift=0.6, follow=1.3)  # The slider stops at the joint limit.
        os.write(controller, b"q")
        wait_until(lambda: process.poll() is not None, spin)
        assert process.returncode == 0
        spin()
        assert b"Traceback" not in screen
        assert b"follow" not in screen  # Mimic joints have no slider.
    finally:
        if process.poll() is None:
            process.kill()
            process.wait()
        os.close(controller)


def test_attributes_and_methods_that_upstreams_window_uses(context, tmp_path):
    file = tmp_path / "arm.urdf"
    file.write_text(URDF)
    words = ["--ros-args", "-p", "dependent_joints.lift.parent:=turn", "-p", "publish_default_velocities:=true"]
    options = {"context": context, "start_parameter_services": False}
    node = upstream.JointStatePublisher(str(file), cli_args=words, **options)
    changes = []
    node.set_source_update_cb(lambda: changes.append("source"))
    node.set_robot_description_update_cb(lambda: changes.append("robot"))
    try:
        assert node.joint_list == ["turn", "lift", "follow"]
        assert node.parse_dependent_joints() == {"lift": {"parent": "turn", "factor": 1.0, "offset": 0.0}}
        assert node.dependent_joints["follow"] == {"parent": "lift", "factor": 2.0, "offset": 0.1}
        assert node.get_param("rate") == 10
        turn = node.free_joints["turn"]
        assert (turn["min"], turn["max"], turn["zero"], turn["velocity"]) == pytest.approx(
            (-math.pi, math.pi, 0.0, 0.0)
        )
        assert "effort" not in turn
        turn["position"] = 0.5
        assert node.states.fields().positions == pytest.approx([0.5, 0.5, 1.1])
        node.source_cb(JointState(name=["turn"], position=[0.7]))
        assert turn["position"] == 0.7
        node.update(0.1)
        assert turn["position"] == pytest.approx(0.8)
        free, names, dependent = node.init_urdf(minidom.parseString(URDF.replace("follow", "tool")))
        assert (list(free), names, list(dependent)) == (["turn"], ["turn", "lift", "tool"], ["lift", "tool"])
        node.configure_robot(URDF.replace("follow", "tool"))
        assert node.joint_list == ["turn", "lift", "tool"]
        node.robot_description_cb(String(data=URDF))
        assert node.joint_list == ["turn", "lift", "follow"]
        assert changes == ["source", "robot", "robot"]
        with pytest.raises(RobotDescriptionError, match="COLLADA"):
            node.init_collada(None)
    finally:
        node.destroy_node()


@pytest.mark.parametrize("words", [[], ["-p", "source_list:=[]"]])
def test_an_empty_list_of_sources(context, words):
    node = JointStatePublisher(context=context, cli_args=["--ros-args", *words], start_parameter_services=False)
    assert not node.get_parameter("source_list").value
    node.destroy_node()
