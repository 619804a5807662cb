# SPDX-License-Identifier: Apache-2.0
"""`coframe component` changes a running container, with the texts of ros2 component."""

import os
import re
import signal
import subprocess
import sys

import pytest

from coframe.workspace.packages.executables import find_executable


@pytest.fixture
def _box(graph, listed):
    """A container in the domain of the other node of these tests."""
    executable = find_executable("rclcpp_components", "component_container")
    environment = {**executable.environment(), **graph.environment}
    command = [*executable.command, "--ros-args", "-r", "__node:=box"]
    with subprocess.Popen(command, env=environment, stderr=subprocess.PIPE, text=True) as process:
        listed("/box", "component", "list", "--containers-only")
        yield
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=20)


@pytest.mark.usefixtures("_box")
def test_a_component_is_loaded_and_unloaded(run):
    talker = ("demo_nodes_py", "demo_nodes_py::Talker")
    options = ("-n", "speaker", "--node-namespace", "hall", "-r", "chatter:=/news", "-p", "use_sim_time:=true")
    assert run("component", "load", "box", *talker, *options) == (
        "Loaded component 1 into '/box' container node as '/hall/speaker'\n"
    )
    assert run("component", "load", "/box", "composition", "composition::Listener", "-q") == "2\n"
    assert run("component", "list", "box") == "1  /hall/speaker\n2  /listener\n"
    assert run("topic", "type", "/news") == "std_msgs/msg/String\n"
    assert "True" in run("param", "get", "/hall/speaker", "use_sim_time")
    assert run("component", "unload", "box", 1) == "Unloaded component 1 from '/box' container node\n"
    assert "Failed to unload component 7 from '/box'" in run("component", "unload", "box", 7, code=1)
    assert run("component", "list", "--spin-time", "2").startswith("/box\n  2  /listener\n")
    assert run("component", "list", "--containers-only", "--spin-time", "2") == "/box\n"


@pytest.mark.usefixtures("_box")
def test_mistakes_are_sentences(run, monkeypatch):
    assert "composable nodes in C++ are libraries" in run("component", "load", "box", "image_proc", "a::B", code=1)
    missing = run("component", "load", "box", "demo_nodes_py", "demo_nodes_py::Taker", code=1)
    assert "Did you mean 'demo_nodes_py::Talker'" in missing
    text = run("component", "load", "box", "demo_nodes_py", "json:dumps", code=1)
    assert "json:dumps of 'json:dumps' is not a subclass of rclpy.node.Node" in text
    absent = run("component", "load", "box", "demo_nodes_py", "no_such_module:Node", code=1)
    assert "ModuleNotFoundError: No module named 'no_such_module'" in absent
    wrong = run("component", "load", "box", "demo_nodes_py", "demo_nodes_py::Talker", "-p", "rate=3", code=2)
    assert "--parameter 'rate=3' is not NAME:=VALUE" in wrong
    monkeypatch.setattr("coframe.cli.ros2.graph.ENDPOINT_TIMEOUT", 0.2)
    assert "Unable to find container node '/bix'" in run("component", "list", "bix", code=1)
    assert run("component", "list", "box") == "", "nothing was loaded"


def test_types_and_a_container_of_its_own(run, graph):
    assert "demo_nodes_py\n  demo_nodes_py::Listener\n  demo_nodes_py::Talker\n" in run("component", "types")
    assert run("component", "types", "composition") == "composition::Listener\ncomposition::Talker\n"
    assert "no composable nodes in Python" in run("component", "types", "rclpy", code=1)
    words = ["component", "standalone", "demo_nodes_py", "demo_nodes_py::Talker", "-c", "alone", "-n", "single"]
    command = [sys.executable, "-m", "coframe.cli", *words]
    environment = {**os.environ, **graph.environment}
    with subprocess.Popen(
        command, env=environment, stdout=subprocess.PIPE, text=True, start_new_session=True
    ) as process:
        assert re.match(r"Loaded component 1 into '/alone' container node as '/single'", process.stdout.readline())
        os.killpg(process.pid, signal.SIGINT)
        process.communicate(timeout=20)
    assert process.returncode == 130
