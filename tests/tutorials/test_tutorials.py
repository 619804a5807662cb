# SPDX-License-Identifier: Apache-2.0
"""The programs of the official tutorials, written by us from their description, in a workspace that is never built.

They run as a user runs them: `coframe run`, `coframe launch` and the commands of ros2, each in a separate process.
"""

import os
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

pytest.importorskip("dds_library", reason="the programs speak DDS")

WORKSPACE = Path(__file__).with_name("workspace")
PATIENCE = 40.0  # seconds; the machine may be busy


class Terminal:
    """Runs commands in a workspace, in its own network."""

    def __init__(self, network, folder):
        self._network = network
        self._folder = folder
        self._programs = []

    def start(self, *words):
        """Start a command that runs until it is stopped; return a function that waits for a pattern in its output."""
        log = self._folder / f"{len(self._programs)}.log"
        with log.open("wb") as output:
            process = subprocess.Popen(
                self._command(words), stdout=output, stderr=subprocess.STDOUT, cwd=self._folder, env=self._environment()
            )
        self._programs.append(process)

        def shows(pattern):
            deadline = time.monotonic() + PATIENCE
            while not (found := re.search(pattern, log.read_text())):
                assert process.poll() is None or re.search(pattern, log.read_text()), log.read_text()
                assert time.monotonic() < deadline, log.read_text()
                time.sleep(0.02)
            return found

        return shows

    def run(self, *words, code=0):
        """Run a command to its end and return its output."""
        result = subprocess.run(
            self._command(words),
            capture_output=True,
            text=True,
            check=False,
            cwd=self._folder,
            env=self._environment(),
            timeout=PATIENCE,
        )
        assert result.returncode == code, result.stdout + result.stderr
        return result.stdout + result.stderr

    def interrupt(self):
        """Press Ctrl-C in all terminals; every program must end."""
        for program in self._programs:
            if program.poll() is None:
                program.send_signal(signal.SIGINT)
        codes = [program.wait(PATIENCE) for program in self._programs]
        self._programs.clear()
        return codes

    def close(self):
        for program in self._programs:
            program.kill()
            program.wait()

    def _command(self, words):
        return self._network.command(sys.executable, "-m", "coframe.cli", *words)

    def _environment(self):
        cache = {"XDG_CACHE_HOME": str(self._folder / "cache"), "XDG_CONFIG_HOME": str(self._folder / "config")}
        return {**os.environ, **cache, "PYTHONUNBUFFERED": "1"}


@pytest.fixture
def terminal(network, domain_id, tmp_path):  # noqa: ARG001 - the domain is in the environment
    folder = shutil.copytree(WORKSPACE, tmp_path / "workspace")
    opened = Terminal(network, folder)
    yield opened
    opened.close()


@pytest.mark.slow
def test_own_messages_and_services(terminal):
    listener = terminal.start("run", "py_pubsub", "listener")
    terminal.start("run", "py_pubsub", "talker")
    listener(r'I got: "\d+"')
    listener(r"center \d+\.0 radius 0\.5")
    assert re.search(r"^num: \d+\n---", terminal.run("topic", "echo", "/topic", "--once"), re.MULTILINE)
    assert "int64 sum" in terminal.run("interface", "show", "tutorial_interfaces/srv/AddThreeInts")
    service = terminal.start("run", "py_srvcli", "service")
    assert "Result: 6" in terminal.run("run", "py_srvcli", "client", "1", "2", "3")
    service(r"a: 1 b: 2 c: 3")
    words = ("/add_three_ints", "tutorial_interfaces/srv/AddThreeInts", "{a: 2, b: 3, c: 4}")
    assert "sum=9" in terminal.run("service", "call", *words)
    terminal.interrupt()


@pytest.mark.slow
def test_parameters(terminal):
    shows = terminal.start("run", "python_parameters", "minimal_param_node")
    shows("Hello world!")
    assert "Set parameter successful" in terminal.run("param", "set", "/minimal_param_node", "my_parameter", "earth")
    shows("Hello earth!")
    described = terminal.run("param", "describe", "/minimal_param_node", "my_parameter")
    assert "This parameter is mine!" in described
    terminal.interrupt()
    launched = terminal.start("launch", "python_parameters", "python_parameters_launch.py")
    launched(r"\[minimal_param_node-1\].*Hello earth!")
    launched(r"\[minimal_param_node-1\].*Hello world!")
    assert terminal.interrupt() == [0]


@pytest.mark.slow
def test_actions(terminal):
    terminal.start("run", "action_tutorials_py", "fibonacci_action_server")
    client = terminal.start("run", "action_tutorials_py", "fibonacci_action_client")
    client(r"Received feedback: \[0, 1, 1\]")
    client(r"Result: \[0, 1, 1, 2, 3, 5, 8, 13, 21, 34, 55\]")
    words = ("/fibonacci", "tutorial_interfaces/action/Fibonacci", "{order: 3}", "--feedback")
    output = terminal.run("action", "send_goal", *words)
    assert "Goal finished with status: SUCCEEDED" in output
    assert "partial_sequence" in output
    terminal.interrupt()


@pytest.mark.slow
def test_one_turtle_follows_another_by_tf2(terminal):
    launched = terminal.start("launch", "learning_tf2_py", "turtle_tf2_demo_launch.py")
    launched("Successfully spawned turtle2")
    echo = terminal.start("echo", "turtle2", "turtle1")
    echo(r"Translation: \[")
    terminal.run("topic", "pub", "--once", "/turtle1/cmd_vel", "geometry_msgs/msg/Twist", "{linear: {x: 1.0}}")
    # The turtle that follows comes near: the distance in x falls below 1 m.
    echo(r"Translation: \[-?0\.\d+, -?0\.\d+")
    codes = terminal.interrupt()
    assert codes[0] == 0


@pytest.mark.slow
def test_static_transforms_and_a_state_publisher_with_a_rate(terminal):
    terminal.start("run", "learning_tf2_py", "static_turtle_tf2_broadcaster", "mystaticturtle", "0", "0", "1")
    assert "translation" in terminal.run("topic", "echo", "/tf_static", "--once", "--qos-durability", "transient_local")
    terminal.start("run", "urdf_tutorial_py", "state_publisher")
    echo = terminal.start("echo", "odom", "axis")
    echo(r"Translation: \[-?[012]\.\d+, -?[012]\.\d+, 0\.700\]")
    hz = terminal.start("topic", "hz", "/joint_states")
    hz(r"average rate: (2[5-9]|3[0-5])\.")
    terminal.interrupt()


@pytest.mark.slow
def test_lifecycle(terminal):
    terminal.start("run", "lifecycle_py", "talker")
    deadline = time.monotonic() + PATIENCE
    while "/lc_talker" not in terminal.run("lifecycle", "nodes"):
        assert time.monotonic() < deadline
    assert terminal.run("lifecycle", "get", "/lc_talker") == "unconfigured [1]\n"
    assert "/lc_talker" in terminal.run("lifecycle", "nodes").split()
    assert "Transitioning successful" in terminal.run("lifecycle", "set", "/lc_talker", "configure")
    assert "- activate [3]" in terminal.run("lifecycle", "list", "/lc_talker")
    terminal.run("topic", "echo", "/lifecycle_chatter", "std_msgs/msg/String", "--timeout", "0.5", code=1)
    terminal.run("lifecycle", "set", "/lc_talker", "activate")
    assert "Lifecycle HelloWorld #" in terminal.run("topic", "echo", "/lifecycle_chatter", "--once")
    assert "Unknown transition" in terminal.run("lifecycle", "set", "/lc_talker", "configure", code=1)
    assert terminal.run("lifecycle", "get", "/lc_talker") == "active [3]\n"
    terminal.interrupt()


@pytest.mark.slow
def test_a_new_package_runs_at_once(terminal):
    terminal.run("pkg", "create", "greetings", "--node-name", "hello", "--destination-directory", "src")
    shows = terminal.start("run", "greetings", "hello")
    shows("Hello from hello")
    terminal.interrupt()
