# SPDX-License-Identifier: Apache-2.0
"""`service call` and `action send_goal` without --timeout: they end if the server is silent or has ended."""

import os
import subprocess
import sys

import pytest

from coframe.cli.options import PositiveDuration

# Servers that accept a request or a goal and never finish it; with the argument "leave", the node is destroyed instead.
SILENT_SERVERS = """
import os, sys, threading, rclpy
from rclpy.action import ActionServer
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from std_srvs.srv import Trigger
from tf2_msgs.action import LookupTransform

def leave():
    node.destroy_node()
    rclpy.shutdown()
    os._exit(0)

def wait_for_ever(*_):
    if sys.argv[1:] == ["leave"]:
        threading.Thread(target=leave).start()
    threading.Event().wait()

rclpy.init()
node = rclpy.create_node("silent")
group = ReentrantCallbackGroup()
node.create_service(Trigger, "/silent", wait_for_ever, callback_group=group)
ActionServer(node, LookupTransform, "/endless", wait_for_ever, callback_group=group)
executor = MultiThreadedExecutor(4)
executor.add_node(node)
print("ready", flush=True)
executor.spin()
"""
CALL = ("service", "call", "/silent", "std_srvs/srv/Trigger")
GOAL = ("action", "send_goal", "/endless", "tf2_msgs/action/LookupTransform", "{}")


@pytest.fixture
def silent_servers(graph):
    programs = []

    def start(*words):
        command = [sys.executable, "-c", SILENT_SERVERS, *words]
        environment = {**os.environ, **graph.environment}
        programs.append(subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env=environment))
        assert programs[0].stdout.readline() == "ready\n"

    yield start
    programs[0].kill()
    programs[0].communicate()


def test_a_silent_server_ends_the_wait(run, silent_servers, monkeypatch):
    silent_servers()
    limit = PositiveDuration("1500ms")
    monkeypatch.setattr("coframe.cli.ros2.service.MAX_WAIT_FOR_RESPONSE", limit)
    monkeypatch.setattr("coframe.cli.ros2.action.MAX_WAIT_FOR_RESPONSE", limit)
    monkeypatch.setattr("coframe.cli.ros2.calls._RESPONSE_TIMEOUT", 0.5)
    text = run(*CALL, code=1)
    assert "The service /silent has not responded for 0.5 s. The command waits for at most 1500ms, which" in text
    assert "The service /silent did not respond within 1500ms." in text
    text = run(*GOAL, code=1)
    assert "Goal accepted with ID" in text
    assert "Goal canceled." in text or "Failed to cancel goal" in text
    assert "The action server /endless sent no feedback and no result for 1500ms." in text


@pytest.mark.parametrize(("words", "name"), [(CALL, "service /silent"), (GOAL, "action server /endless")])
def test_a_server_that_ended_ends_the_wait(run, silent_servers, monkeypatch, words, name):
    monkeypatch.setattr("coframe.cli.ros2.calls._MAX_ABSENCE", 0.5)
    silent_servers("leave")
    assert f"The {name} no longer exists: its node ended before it responded." in run(*words, code=1)


def test_a_server_that_does_not_appear_ends_the_wait(run, monkeypatch):
    monkeypatch.setattr("coframe.cli.ros2.service.MAX_WAIT_FOR_SERVER", PositiveDuration("300ms"))
    assert "There was no service /nothing within 300ms." in run(
        "service", "call", "/nothing", "std_srvs/srv/Trigger", code=1
    )
