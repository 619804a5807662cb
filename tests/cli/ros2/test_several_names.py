# SPDX-License-Identifier: Apache-2.0
"""Commands about several topics, fields and parameters, and limits for waiting: what ros2cli has since Kilted."""

import os
import signal
import subprocess
import sys
import threading

import pytest
import yaml

import rclpy
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from std_msgs.msg import String

NODE = "/robot1/program"


@pytest.fixture
def lines_of(graph):
    """The first lines that a command prints which runs until Ctrl-C."""

    def read(number, *words):
        process = subprocess.Popen(
            [sys.executable, "-m", "coframe.cli", *words],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            env={**os.environ, **graph.environment},
        )
        lines = [process.stdout.readline() for _ in range(number)]
        process.send_signal(signal.SIGINT)
        process.communicate(timeout=20)
        return lines

    return read


def test_parameters_of_one_node(run):
    assert run("param", "get", NODE, "arm.joints", "use_sim_time") == (
        "arm.joints:\n  String values are: ['a', 'b']\nuse_sim_time:\n  Boolean value is: False\n"
    )
    partly = run("param", "get", NODE, "use_sim_time", "speed", code=1)
    assert "use_sim_time:\n  Boolean value is: False\n" in partly
    assert "Parameter not set: speed" in partly


def test_setting_several_parameters_reports_each(run):
    done = run("param", "set", NODE, "rate", "25.0", "arm.joints", "[c, d]")
    assert done == "rate: Set parameter successful\narm.joints: Set parameter successful\n"
    partly = run("param", "set", NODE, "rate", "50.0", "arm.joints", "[c]", code=1)
    assert "rate: Set parameter successful\n" in partly
    assert "arm.joints: Setting parameter failed: the arm has two joints" in partly
    run("param", "set", NODE, "arm.joints", "[a, b]")
    assert "no value for the parameter 'arm.joints'" in run("param", "set", NODE, "rate", "1.0", "arm.joints", code=2)


def test_one_parameter_of_all_nodes(run, listed):
    listed(NODE, "node", "list")
    assert f"{NODE}: Boolean value is: False\n" in run("param", "get", "use_sim_time")
    assert run("param", "get", "rate", "--hide-type") == f"{NODE}: 50.0\n"
    assert "No node has a parameter 'speed'" in run("param", "get", "speed", code=1)
    assert "give the name of a parameter" in run("param", "get", NODE, code=2)


def test_parameters_are_saved_to_a_file_named_after_the_node(run, tmp_path):
    assert "Saving to:" in run("param", "dump", NODE, "--output-dir", tmp_path)
    saved = yaml.safe_load((tmp_path / "robot1__program.yaml").read_text())
    assert saved[NODE]["ros__parameters"]["rate"] == 50.0
    assert "cannot be written" in run("param", "dump", NODE, "--output-dir", tmp_path / "absent", code=1)


def is_near_50_hz(row):
    return 30.0 < float(row.split()[1]) < 70.0


def test_a_table_of_several_topics(lines_of, eventually):
    header, rule, first, second = lines_of(4, "topic", "hz", "/chatter", "/point")
    assert header.split() == ["topic", "rate", "min_delta", "max_delta", "std_dev", "window"]
    assert set(rule.strip()) == {"="}
    assert sorted(line.split()[0] for line in (first, second)) == ["/chatter", "/point"]
    if not is_near_50_hz(first):  # a busy machine may pause for a second
        eventually(lambda: is_near_50_hz(lines_of(3, "topic", "hz", "/chatter", "/point")[2]))
    subscribed, header, _, first, _ = lines_of(5, "topic", "bw", "--all")
    assert "/chatter" in subscribed
    assert "_action" not in subscribed
    assert header.split() == ["topic", "rate", "mean", "min", "max", "window"]
    assert first.split()[2].endswith("B/s")


def test_a_rate_needs_a_topic(run):
    for command in ("hz", "bw"):
        assert "TOPIC and --all are mutually exclusive" in run("topic", command, code=2)
        assert "TOPIC and --all are mutually exclusive" in run("topic", command, "/point", "--all", code=2)


def test_echo_of_several_fields_and_of_elements(run):
    fields = run("topic", "echo", "/point", "--once", "--field", "point.x", "--field", "header.frame_id")
    assert fields == "1.5\nmap\n---\n"
    row = run("topic", "echo", "/point", "--once", "--csv", "--field", "point.x", "--field", "header.frame_id")
    assert row == "1.5,map\n"
    assert run("topic", "echo", "/chatter", "--once", "--field", "data[0]") == "h\n---\n"
    assert "Invalid field 'data[999]'" in run("topic", "echo", "/chatter", "--once", "--field", "data[999]", code=2)
    assert run("topic", "echo", "/point", "--once", "--clear", "--field", "point.x").endswith("1.5\n---\n")


@pytest.mark.skipif(not hasattr(signal, "SIGSTOP"), reason="stops a process")
def test_publishing_to_a_subscription_that_does_not_respond(graph):
    words = ["/commands", "std_msgs/msg/String", "{data: lost}", "--times", "3", "--rate", "4", "-w", "1"]
    process = subprocess.Popen(
        [sys.executable, "-m", "coframe.cli", "topic", "pub", *words],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, **graph.environment},
    )
    while "publishing #1" not in process.stdout.readline():
        assert process.poll() is None
    graph.send_signal(signal.SIGSTOP)
    try:
        _, errors = process.communicate(timeout=60)
    finally:
        graph.send_signal(signal.SIGCONT)
    assert process.returncode == 0
    assert errors == "coframe: not all subscriptions confirmed all messages within 3 s\n"


def test_publishing_the_messages_of_a_file(run, tmp_path):
    file = tmp_path / "messages.yaml"
    file.write_text("data: first\n---\ndata: second\n---\n")
    received = []
    with Context() as context:
        # A subscription in the process of the publisher, because another process may discover the publisher too late.
        node = rclpy.create_node("reader", context=context)
        node.create_subscription(String, "/lines", lambda message: received.append(message.data), 10)
        output = run("topic", "pub", "/lines", "std_msgs/msg/String", "--yaml-file", file, "-r", "50", "-w", "1")
        executor = SingleThreadedExecutor(context=context)
        executor.add_node(node)
        while len(received) < 2:
            executor.spin_once()
    assert "publishing #1: std_msgs.msg.String(data='first')" in output
    assert "publishing #2: std_msgs.msg.String(data='second')" in output
    assert "#3" not in output
    assert received == ["first", "second"]
    absent = run("topic", "pub", "/lines", "std_msgs/msg/String", "--yaml-file", tmp_path / "none", code=1)
    assert "cannot be read" in absent


def test_types_of_actions_and_their_names(run, listed):
    listed("/lookup", "action", "find", "tf2_msgs/action/LookupTransform")
    assert run("action", "type", "/lookup") == "tf2_msgs/action/LookupTransform\n"
    assert run("action", "find", "-c", "example_interfaces/action/Fibonacci") == "0\n"


def test_information_about_a_service(run):
    info = run("service", "info", "/switch")
    assert info == "Type: std_srvs/srv/SetBool\nClients count: 0\nServices count: 1\n"


def test_the_endpoints_of_a_service(run):
    verbose = run("service", "info", "/switch", "--verbose")
    server = verbose.split("Services count: ")[1]
    for line in ("Node name: program", "Node namespace: /robot1", "Endpoint type: SERVER", "Endpoint count: 2"):
        assert line in server.splitlines()
    assert "Unknown service '/swich'\n  Did you mean '/switch'?" in run("service", "info", "/swich", code=1)


def test_the_events_of_a_service(run, graph):
    echo = subprocess.Popen(
        [sys.executable, "-m", "coframe.cli", "service", "echo", "/switch", "--flow-style"],
        stdout=subprocess.PIPE,
        text=True,
        env={**os.environ, **graph.environment},
    )
    events = []

    def read_until_a_response():  # of the first call that is seen from its start
        for line in echo.stdout:
            if line.strip() != "---" and (events or "REQUEST_RECEIVED" in line):
                events.append(yaml.safe_load(line))
            if len(events) == 2:
                return

    read = threading.Thread(target=read_until_a_response)
    read.start()
    try:
        for _ in range(60):
            run("service", "call", "/switch", "std_srvs/srv/SetBool", "{data: true}")
            read.join(timeout=0.2)
            if not read.is_alive():
                break
    finally:
        echo.send_signal(signal.SIGINT)
        read.join(timeout=20)
        echo.communicate(timeout=20)
    request, response = events
    assert (request["info"]["event_type"], request["request"]) == ("REQUEST_RECEIVED", [{"data": True}])
    assert response["info"]["event_type"] == "RESPONSE_SENT"
    assert response["response"] == [{"success": True, "message": "on"}]


def test_the_feedback_and_status_of_an_action(run, graph):
    command = [sys.executable, "-m", "coframe.cli", "action", "echo", "/lookup", "--flow-style"]
    echo = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, env={**os.environ, **graph.environment})
    try:
        run("action", "send_goal", "/lookup", "tf2_msgs/action/LookupTransform", "{source_frame: arm}")
        assert echo.stdout.readline() == "interface: STATUS_TOPIC\n"
        assert yaml.safe_load(echo.stdout.readline())["status_list"]
    finally:
        echo.send_signal(signal.SIGINT)
        echo.communicate(timeout=20)


def test_a_service_type_of_two_parts(run):
    assert "response:" in run("service", "call", "/switch", "std_srvs/SetBool", "{data: true}")
    assert "is invalid" in run("service", "call", "/switch", "std_srvs/SetBoo", code=1)


def test_waiting_for_a_server_has_a_word_and_a_limit(run, monkeypatch):
    monkeypatch.setattr("coframe.cli.ros2.calls.ENDPOINT_TIMEOUT", 0.2)
    call = run("service", "call", "/swich", "std_srvs/srv/SetBool", "--timeout", "0.5s", code=1)
    assert "There is no service /swich yet: waiting for it for at most 0.5s. Did you mean '/switch'?" in call
    assert "There was no service /swich within 0.5s." in call
    kind = "tf2_msgs/action/LookupTransform"
    goal = run("action", "send_goal", "/lokup", kind, "{}", "--timeout", "0.5", code=1)
    assert "There is no action server /lokup yet: waiting for it for at most 0.5. Did you mean '/lookup'?" in goal
    assert "There was no action server /lokup within 0.5." in goal
