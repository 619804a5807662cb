# SPDX-License-Identifier: Apache-2.0
"""``coframe launch`` with real nodes in processes, from a workspace that was never built."""

import os
import re
import signal
import subprocess
import sys
import threading
from pathlib import Path

import pytest

pytest.importorskip("dds_library", reason="the nodes speak DDS")

TALKER = """
import rclpy
from rclpy.node import Node
from std_msgs.msg import String


class Talker(Node):
    def __init__(self):
        super().__init__("talker")
        self.text = self.declare_parameter("text", "nothing").value
        self.publisher = self.create_publisher(String, "chatter", 10)
        self.create_timer(0.1, lambda: self.publisher.publish(String(data=self.text)))


def main():
    rclpy.init()
    try:
        rclpy.spin(Talker())
    except KeyboardInterrupt:
        pass
"""
LISTENER = """
import rclpy
from std_msgs.msg import String


def main():
    rclpy.init()
    node = rclpy.create_node("listener")
    node.create_subscription(String, "chatter", lambda m: print(node.get_fully_qualified_name(), m.data), 10)
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        print("clean end")
"""
LAUNCH_PY = """
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node, PushRosNamespace
from launch_ros.substitutions import FindPackageShare
from ament_index_python.packages import get_package_share_directory

SHARE = get_package_share_directory("demo_pkg")


def generate_launch_description():
    return LaunchDescription([
        DeclareLaunchArgument("text", default_value="from python"),
        PushRosNamespace("robot1"),
        Node(package="demo_pkg", executable="talker", name="speaker", parameters=[
            PathJoinSubstitution([FindPackageShare("demo_pkg"), "config", "talker.yaml"]),
            {"text": LaunchConfiguration("text")}], remappings=[("chatter", "/news")]),
        Node(package="demo_pkg", executable="listener", output="screen", remappings=[("chatter", "/news")]),
    ])
"""
LAUNCH_XML = """
<launch>
  <include file="$(find-pkg-share demo_pkg)/launch/talk.launch.yaml">
    <arg name="text" value="from $(var format xml)"/>
  </include>
  <group><push_ros_namespace namespace="robot1"/>
    <node pkg="demo_pkg" exec="listener" output="screen"><remap from="chatter" to="/news"/></node>
  </group>
</launch>
"""
LAUNCH_YAML = """
launch:
- arg: {name: text}
- node:
    pkg: demo_pkg
    exec: talker
    param: [{name: text, value: $(var text)}]
    remap: [{from: chatter, to: /news}]
"""


@pytest.fixture
def workspace(tmp_path, domain_id):  # noqa: ARG001 - the nodes have their own domain
    package = tmp_path / "ws" / "src" / "demo_pkg"
    files = {
        "package.xml": "<package><name>demo_pkg</name></package>",
        "setup.cfg": "[options.entry_points]\nconsole_scripts =\n  talker = demo_pkg.talker:main\n"
        "  listener = demo_pkg.listener:main\n",
        "demo_pkg/__init__.py": "",
        "demo_pkg/talker.py": TALKER,
        "demo_pkg/listener.py": LISTENER,
        "config/talker.yaml": "/robot1/speaker:\n  ros__parameters:\n    text: from the file\n",
        "launch/talk.launch.py": LAUNCH_PY,
        "launch/talk.launch.xml": LAUNCH_XML,
        "launch/talk.launch.yaml": LAUNCH_YAML,
    }
    for name, text in files.items():
        (package / name).parent.mkdir(parents=True, exist_ok=True)
        (package / name).write_text(text)
    return tmp_path / "ws"


class Launched:
    """A running ``coframe launch`` whose output is collected."""

    def __init__(self, *words, **options):
        command = [sys.executable, "-m", "coframe.cli", "launch", *map(str, words)]
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **options)
        self.lines = []
        self._thread = threading.Thread(target=self._read)
        self._thread.start()

    def _read(self):
        with self.process.stdout as stream:
            for line in stream:
                self.lines.append(line)

    @property
    def text(self):
        return "".join(self.lines)

    def pids(self):
        return [int(number) for number in re.findall(r"process started with pid \[(\d+)\]", self.text)]

    def end(self, how=signal.SIGINT):
        self.process.send_signal(how)
        code = self.process.wait(20)
        self._thread.join(20)
        return code


@pytest.fixture
def launch():
    started = []

    def start(*words, **options):
        started.append(Launched(*words, **options))
        return started[-1]

    yield start
    for each in started:
        if each.process.poll() is None:
            each.end(signal.SIGTERM)


def are_gone(pids):
    """Return whether no process of these is there, except as a zombie."""
    states = [Path(f"/proc/{pid}/stat") for pid in pids]
    return all(not state.exists() or state.read_text().rpartition(")")[2].split()[0] == "Z" for state in states)


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (["demo_pkg", "talk.launch.py"], "[listener-2] /robot1/listener from python"),
        (["demo_pkg", "talk.launch.py", "text:=5 % of it"], "[listener-2] /robot1/listener 5 % of it"),
        (["src/demo_pkg/launch/talk.launch.xml", "format:=file"], "[listener-2] /robot1/listener from file"),
    ],
)
def test_nodes_of_a_package_that_was_never_built(launch, workspace, eventually, words, expected):
    running = launch(*words, cwd=workspace)
    eventually(lambda: expected in running.text or running.process.poll() is not None)
    assert running.end() == 0, running.text
    assert expected in running.text
    assert "user interrupted with ctrl-c (SIGINT)" in running.text
    assert "[listener-2] clean end" in running.text
    assert running.text.count("process has finished cleanly") == 2
    assert len(running.pids()) == 2
    assert are_gone(running.pids())


def test_nodes_end_when_they_are_killed_and_when_the_launcher_is(launch, workspace, eventually):
    running = launch("demo_pkg", "talk.launch.py", cwd=workspace)
    eventually(lambda: "from python" in running.text)
    talker, listener = running.pids()
    os.kill(talker, signal.SIGKILL)
    eventually(lambda: "exit code -9, cmd '" in running.text)
    assert not are_gone([listener])
    if sys.platform == "linux":
        running.end(signal.SIGKILL)
        eventually(lambda: are_gone([listener]))


@pytest.mark.slow
def test_arguments_and_the_description_are_shown_without_a_launch(workspace):
    def run(*words):
        command = [sys.executable, "-m", "coframe.cli", "launch", *words]
        return subprocess.run(command, capture_output=True, text=True, cwd=workspace, check=False)

    shown = run("demo_pkg", "talk.launch.py", "--show-args")
    assert shown.stdout == (
        "Arguments (pass arguments as '<name>:=<value>'):\n\n"
        "    'text':\n        no description given\n        (default: 'from python')\n"
    )
    tree = run("src/demo_pkg/launch/talk.launch.py", "--print").stdout
    assert "└── Node(cmd=['listener', '--ros-args'" in tree
    missing = run("demo_pkg", "talk.lunch.py")
    assert missing.returncode == 1
    assert "No launch file 'talk.lunch.py' in the package 'demo_pkg'." in missing.stderr
    assert "Did you mean 'talk.launch.py'" in missing.stderr
    assert "No package named 'demo'. \n" not in run("demo", "x.launch.py").stderr
    assert "Did you mean 'demo_pkg'" in run("demo_pgk", "x.launch.py").stderr
    assert "The name of the launch file is missing. Launch files in demo_pkg: talk.launch.py" in run("demo_pkg").stderr
    assert "malformed launch argument 'text=1'" in run("demo_pkg", "talk.launch.py", "text=1").stderr


def test_an_unknown_executable_is_one_sentence(launch, workspace):
    file = workspace / "bad.launch.xml"
    file.write_text("<launch><node pkg='demo_pkg' exec='talkr'/></launch>")
    running = launch(file, cwd=workspace)
    assert running.process.wait(20) == 1
    running._thread.join(20)
    assert "No executable 'talkr' in the package 'demo_pkg'. Did you mean 'talker'?" in running.text
    assert "Traceback" not in running.text
