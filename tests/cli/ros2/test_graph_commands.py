# SPDX-License-Identifier: Apache-2.0
"""`coframe topic`, `node`, `service`, `action` and `param` print what ros2cli prints about a node."""

import os
import re
import signal
import subprocess
import sys

import pytest
import yaml

NODE = "/robot1/program"


@pytest.fixture
def impatient(monkeypatch):
    """Give up early on names that do not exist."""
    monkeypatch.setattr("coframe.cli.ros2.graph.ENDPOINT_TIMEOUT", 1.0)


def test_lists(run, listed):
    listed(NODE, "node", "list")
    listed("/chatter [std_msgs/msg/String]", "topic", "list", "-t")
    listed("/lookup/_action/status", "topic", "list", "--include-hidden-topics")
    assert "_action" not in run("topic", "list", "--spin-time", "0.1")
    listed(" * /chatter [std_msgs/msg/String] 1 publisher", "topic", "list", "-v")
    listed("/point", "topic", "find", "geometry_msgs/msg/PointStamped")
    listed("/switch [std_srvs/srv/SetBool]", "service", "list", "-t")
    listed("/lookup [tf2_msgs/action/LookupTransform]", "action", "list", "-t")
    listed(f"    {NODE}", "action", "info", "/lookup")
    assert run("topic", "type", "chatter") == "std_msgs/msg/String\n"
    assert run("service", "type", "/switch") == "std_srvs/srv/SetBool\n"


def test_the_option_about_the_daemon_has_no_effect(run):
    assert "/chatter\n" in run("topic", "list", "--no-daemon")
    assert "program" in run("topic", "info", "--no-daemon", "--verbose", "/chatter")
    assert "std_msgs/msg/String" in run("node", "info", NODE, "--no-daemon")
    assert "--no-daemon" not in run("topic", "list", "--help")


def test_information_about_a_topic(run):
    assert run("topic", "info", "/chatter") == "Type: std_msgs/msg/String\nPublisher count: 1\nSubscription count: 0\n"
    verbose = run("topic", "info", "/chatter", "--verbose")
    assert "program" in verbose
    assert "RELIABLE" in verbose


def test_information_about_a_node(run):
    lines = run("node", "info", NODE).splitlines()
    sections = [line.strip(" :") for line in lines if re.fullmatch(r"  \S.*:", line)]
    assert sections == [
        "Subscribers",
        "Publishers",
        "Service Servers",
        "Service Clients",
        "Action Servers",
        "Action Clients",
    ]
    publishers = lines[lines.index("  Publishers:") + 1 : lines.index("  Service Servers:")]
    assert "    /chatter: std_msgs/msg/String" in publishers
    assert "    /commands: std_msgs/msg/String" in lines[: lines.index("  Publishers:")]
    assert "    /switch: std_srvs/srv/SetBool" in lines
    assert "    /lookup: tf2_msgs/action/LookupTransform" in lines


def test_echo(run):
    text, end = run("topic", "echo", "/point", "--once").rsplit("---\n", 1)
    message = yaml.safe_load(text)
    assert (message["header"]["frame_id"], message["point"], end) == ("map", {"x": 1.5, "y": 0.0, "z": 0.0}, "")
    assert run("topic", "echo", "/point", "--once", "--field", "point.x") == "1.5\n---\n"
    assert run("topic", "echo", "/point", "--once", "--csv").strip().endswith(",map,1.5,0.0,0.0")
    ending = run("topic", "echo", "/chatter", "--once", "--filter", "m.data.endswith('7')")
    assert re.fullmatch(r"data: hello \d*7\n---\n", ending)
    unknown = run("topic", "echo", "/chatter", "std_msgs/msg/Sting", "--once", code=1)
    assert "is invalid" in unknown
    assert "Did you mean 'std_msgs/msg/String'" in unknown
    assert "Invalid field 'text'" in run("topic", "echo", "/chatter", "--once", "--field", "text", code=2)


@pytest.mark.slow
@pytest.mark.usefixtures("impatient")
def test_unknown_names(run):
    assert "Unknown topic '/nothing'" in run("topic", "info", "/nothing", code=1)
    assert "Unable to find node '/nobody'\n  coframe node list" in run("node", "info", "/nobody", code=1)
    misspelled = NODE[:-1]
    assert f"Unable to find node '{misspelled}'\n  Did you mean '{NODE}'?" in run("node", "info", misspelled, code=1)
    assert "Did you mean '/chatter'?" in run("topic", "echo", "/chater", code=1)
    assert "No message" in run("topic", "echo", "/commands", "std_msgs/msg/String", "--timeout", "0.2", code=1)
    assert "Node not found: /nobody" in run("param", "get", "/nobody", "rate", code=1)


def test_publish(run, graph):
    output = run("topic", "pub", "/commands", "std_msgs/msg/String", "{data: go}", "--times", "20", "--rate", "50")
    assert "publisher: beginning loop" in output
    assert "publishing #2: std_msgs.msg.String(data='go')" in output
    assert graph.stdout.readline() == "go\n"
    wrong = run("topic", "pub", "/commands", "std_msgs/msg/String", "{dat: go}", code=2)
    assert "Failed to populate field" in wrong
    assert "coframe interface show" in wrong


def test_services_and_actions(run):
    output = run("service", "call", "/switch", "std_srvs/srv/SetBool", "{data: true}")
    assert "requester: making request: std_srvs.srv.SetBool_Request(data=True)" in output
    assert "response:\nstd_srvs.srv.SetBool_Response(success=True, message='on')\n" in output
    goal = run("action", "send_goal", "/lookup", "tf2_msgs/action/LookupTransform", "{source_frame: arm}")
    assert "    source_frame: arm" in goal
    assert "Goal accepted with ID: " in goal
    assert "child_frame_id: arm" in goal.split("Result:")[1]
    assert goal.endswith("Goal finished with status: SUCCEEDED\n")


def test_parameters(run, tmp_path):
    assert "  rate" in run("param", "list", NODE).splitlines()
    assert run("param", "list").splitlines()[0] == f"{NODE}:"
    assert "  rate (type: double)" in run("param", "list", NODE, "--param-type").splitlines()
    assert run("param", "get", NODE, "rate") == "Double value is: 50.0\n"
    assert run("param", "get", NODE, "arm.joints", "--hide-type") == "['a', 'b']\n"
    described = run("param", "describe", NODE, "rate")
    assert "  Type: double\n  Description: in Hz\n  Constraints:\n    Min value: 0.5\n" in described
    assert run("param", "set", NODE, "rate", "20.0") == "Set parameter successful\n"
    assert "Setting parameter failed: the arm has two joints" in run("param", "set", NODE, "arm.joints", "[a]", code=1)
    dumped = run("param", "dump", NODE)
    parameters = yaml.safe_load(dumped)[NODE]["ros__parameters"]
    assert (parameters["rate"], parameters["arm"]) == (20.0, {"joints": ["a", "b"]})
    read_only = "start_type_description_service: true"
    text = dumped.replace("20.0", "30.0").replace("use_sim_time: false", "").replace(read_only, "")
    (tmp_path / "file.yaml").write_text(text)
    assert "Set parameter rate successful" in run("param", "load", NODE, tmp_path / "file.yaml")
    assert run("param", "get", NODE, "rate") == "Double value is: 30.0\n"
    assert "not set" in run("param", "get", NODE, "speed", code=1)


@pytest.mark.parametrize(
    ("arguments", "reason"),
    [
        (("topic", "pub", "/2nd", "std_msgs/msg/String"), "'/2nd' cannot be a topic name: topic name token must not"),
        (("topic", "pub", "/a", "../../x"), "The passed type '../../x' is invalid"),
        (("topic", "pub", "/a", "std_msgs/msg/String", "--node-name", "a b"), "'a b' cannot be a node name"),
        (("topic", "pub", "/a", "std_msgs/msg/String", "--rate", "nan"), "rate must be greater than zero"),
        (("topic", "bw", "/chatter", "--window", "9" * 25), "is not in the range"),
        (("topic", "echo", "/chatter", "--qos-depth", "9" * 25), "is not in the range"),
    ],
)
def test_impossible_names_and_numbers(run, arguments, reason):
    code = 1 if "../../x" in arguments else 2
    assert reason in " ".join(run(*arguments, code=code).split())


@pytest.mark.parametrize("domain", ["abc", "9" * 5000, "9" * 9])
def test_an_impossible_domain(domain):
    done = subprocess.run(
        [sys.executable, "-m", "coframe.cli", "topic", "list"],
        env={**os.environ, "ROS_DOMAIN_ID": domain},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 1
    assert done.stderr.startswith("coframe: ")
    assert "from 0 to 232" in done.stderr


@pytest.mark.slow
def test_a_name_that_no_topic_can_have_is_not_waited_for(run):
    message = run("topic", "hz", "bad name", code=1)
    assert "coframe: '/bad name' is not a valid topic name: topic name must not contain characters" in message


@pytest.mark.slow
def test_figures_of_a_topic_that_is_published_later(graph):
    environment = {**os.environ, **graph.environment}
    command = [sys.executable, "-m", "coframe.cli", "topic"]
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True, "env": environment}
    rate = subprocess.Popen([*command, "hz", "/pont"], **pipes)
    warning = rate.stderr.readline()
    publisher = subprocess.Popen(
        [*command, "pub", "/pont", "std_msgs/msg/String", "{data: a}", "--rate", "50", "--print", "1000"],
        stdout=subprocess.DEVNULL,
        env=environment,
    )
    line = rate.stdout.readline()
    for process in (publisher, rate):
        process.send_signal(signal.SIGINT)
    rate.communicate(timeout=20)
    publisher.wait(timeout=20)
    assert "topic [/pont] does not appear to be published yet: waiting for it. Did you mean '/point'?" in warning
    assert re.match(r"average rate: \d+\.\d{3}\n", line), line


@pytest.mark.parametrize(
    ("command", "pattern"),
    [
        ("hz", r"average rate: (4\d|5\d)\.\d{3}\n\tmin: \d\.\d{3}s max: \d\.\d{3}s std dev: \d\.\d{5}s window: \d+\n"),
        ("bw", r"\d\.\d\d KB/s from \d+ messages\n\tMessage size mean: \d\d\.\d\d B min: \d\d\.00 B max: \d\d\.00 B\n"),
        ("delay", r"average delay: \d\.\d{3}\n\tmin: -?\d\.\d{3}s max: \d\.\d{3}s std dev: \d\.\d{5}s window: \d+\n"),
    ],
)
def test_figures_of_a_topic(graph, command, pattern):
    # The commands run until Ctrl-C, so they are processes.
    process = subprocess.Popen(
        [sys.executable, "-m", "coframe.cli", "topic", command, "/point"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env={**os.environ, **graph.environment},
    )
    lines = ""
    while not re.search(pattern, lines) and lines.count("\n") < 30:  # a busy machine may pause for a second
        lines += process.stdout.readline()
    process.send_signal(signal.SIGINT)
    rest, errors = process.communicate(timeout=20)
    assert re.search(pattern, lines + rest), lines + rest
    assert not errors
