# SPDX-License-Identifier: Apache-2.0
"""Commands for several robots: the demo, the relay and prefixes."""

import json
import os
import re
import signal
import subprocess
from pathlib import Path

import pytest
from click.testing import CliRunner

import coframe
from coframe.cli.app import app
from coframe.messages import find
from coframe.wire.qos import TF_STATIC_WRITER

ARM = str(Path(coframe.__file__).with_name("lab") / "two_link_arm.urdf.xacro")
COMMAND = """
    import sys
    from coframe.cli import main
    sys.argv = ["coframe", *{arguments!r}]
    main()
"""


@pytest.fixture
def command(child):
    """Return a function that starts a command in its own process."""
    return lambda *arguments: child(COMMAND.format(arguments=arguments), PYTHONUNBUFFERED="1", COLUMNS="200")


@pytest.fixture
def ros(domain_id):
    """Return a connection that listens to /tf."""
    with coframe.connect("listener", domain=domain_id) as connection:
        yield connection


def interrupted(process):
    """Send Ctrl-C and return the exit code, stdout and stderr."""
    process.process.send_signal(signal.SIGINT)
    out, errors = process.process.communicate(timeout=20)
    return process.process.returncode, out, errors


def kill_robot(demo, name):
    """Kill one robot of the demo."""
    parent = str(demo.process.pid)
    found = subprocess.run(["pgrep", "-P", parent, "-f", f"__ns:=/{name} "], capture_output=True, text=True, check=True)
    [process] = found.stdout.split()
    os.kill(int(process), signal.SIGKILL)


@pytest.mark.slow
@pytest.mark.parametrize("own_topics", [False, True])
def test_a_demo_with_several_robots_of_which_one_stops(command, ros, eventually, own_topics):
    options = ["--own-topics"] if own_topics else []
    demo = command("demo", "--robots", "2", "--no-browser", "--port", "0", *options)

    def newest(name):
        return next((frame.newest for frame in ros.buffer.frames() if frame.name == f"{name}/base_link"), 0)

    # One tree with the bases of both robots.
    eventually(lambda: ros.buffer.can_transform("robot1/base_link", "robot2/base_link"))
    assert abs(ros.buffer.lookup("robot1/base_link", "robot2/base_link").translation[0]) > 1.5
    assert ros.buffer.can_transform("map", "robot1/camera_link")
    kill_robot(demo, "robot2")
    killed = newest("robot2")
    eventually(lambda: newest("robot1") > killed + 2 * 10**9)
    assert newest("robot2") < killed + 10**9
    code, text, errors = interrupted(demo)
    assert code == 0, errors
    assert "robot2 stopped: its process ended with exit code -9; its frames are stale" in text
    states = dict(re.findall(r"^(robot\d) +(\w+) +9 ", text, re.MULTILINE))
    assert states == {"robot1": "live", "robot2": "stale"}, text
    assert ("relay: robot2" in text) == own_topics
    at_end = newest("robot1")
    eventually(lambda: not any(one.is_present for one in ros.publishers()))
    assert newest("robot1") - at_end < 10**9


def test_prefixes_and_a_relay_on_the_command_line(command, ros, eventually):
    own = ["--tf-static-topic", "/robot1/tf_static"]
    mount = ["--frame-id", "map", "--child-frame-id", "odom"]
    command("static", "--x", "2", *mount, *own)
    command("static", "--x", "3", *mount, "--prefix", "robot2/", "--keep", "map")
    relay = command("relay", "--robots", "robot1,robot3", "--prefix-each", "--keep", "map,world", "--status")
    named = command("echo", "map", "r1odom", "-l", "1", "--prefix", "r1", "--keep", "map", *own)
    # Through the relay, as published, and with the prefix of the listener.
    for name, x in (("robot1", 2.0), ("robot2", 3.0)):
        eventually(lambda name=name: ros.buffer.can_transform("map", f"{name}/odom"))
        assert ros.buffer.lookup("map", f"{name}/odom").translation[0] == x
    out, errors = named.process.communicate(timeout=20)
    assert "- Translation: [2.000, 0.000, 0.000]" in out
    assert "the prefix 'r1' turns 'base_link' into 'r1base_link'; write 'r1/'" in errors
    row = relay.read()
    while "map -> robot1/odom" not in row:
        row = relay.read()
    pattern = r"map -> robot1/odom +robot1 +/robot1/tf_static +/static_transform_publisher_\w+ +/tf_static +static"
    assert re.search(pattern, row), row
    code, _, errors = interrupted(relay)
    assert code == 0, errors
    assert "/robot1/tf -> /tf, adding prefix robot1/" in errors


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        (["relay"], "a relay needs robots"),
        (["relay", "--robots", "a", "--to", "/a/tf"], "/a/tf is both an input and an output of the relay"),
        (["relay", "--robots", "a", "--max-error", "1mm"], "has no angle: give both, such as 1mm,0.1deg"),
        (
            ["demo", "--robots", "2", "--own-topics", "--tf-topic", "/robot1/tf"],
            "/robot1/tf is both an input and an output of the relay",
        ),
        (["relay", "--robots", "a", "--split", "--from", "/tf=a/"], "--split reads a single --from topic"),
        (["relay", "--from", "/a/tf=/a/"], "the prefix '/a/' begins with a slash"),
        (["echo", "a", "b", "--prefix", "/robot1/"], "the prefix '/robot1/' begins with a slash"),
        (
            ["relay", "--robots", "a", "--tf-static-topic", "a/tf_static"],
            "/a/tf_static is both an input and an output of the relay",
        ),
        (["robot", ARM, "--prefx", "robot1/"], "No option or argument '--prefx'"),
        (["joints", ARM, "first_length:=0.5", "surplus"], "No option or argument 'surplus'"),
        (["record", "--tf-topic", "/robot1/tf"], "--tf-topic and --tf-static-topic require --prefix"),
        (["static", "--frame-id", "a", "--child-frame-id", "b", "--prefix", "/r/"], "the prefix '/r/' begins"),
    ],
)
def test_wrong_usage(arguments, text):
    result = CliRunner().invoke(app, arguments)
    assert result.exit_code == 2
    assert text in result.stderr


def options():
    """Return the options of each command. `static` parses its own options and lists them in its help."""
    found = {"static": set(re.findall(r"--[a-z-]+", CliRunner().invoke(app, ["static", "--help"]).stdout))}
    groups = [("", app)]
    for name, command in groups:
        groups += [(f"{name} {inner}".strip(), each) for inner, each in getattr(command, "commands", {}).items()]
        if not hasattr(command, "commands"):
            found.setdefault(name, {option for parameter in command.params for option in parameter.opts})
    return found


# These and the commands of these groups copy messages of all topics unchanged, or have nothing to do with transforms.
OTHER_COMMANDS = {
    "bag burst",
    "bag convert",
    "bag edit",
    "bag list",
    "bag merge",
    "bag reindex",
    "bag slice",
    "run",
    "launch",
    "router",
}
OTHER_GROUPS = {
    "action",
    "calib",
    "calibrate",
    "component",
    "daemon",
    "interface",
    "lab",
    "lifecycle",
    "node",
    "param",
    "pkg",
    "ros2",
    "service",
    "topic",
}


def is_about_transforms(command):
    group, _, inner = command.partition(" ")
    return command not in OTHER_COMMANDS and not (inner and group in OTHER_GROUPS)


@pytest.mark.parametrize(
    ("command", "accepted"), [(name, accepted) for name, accepted in options().items() if is_about_transforms(name)]
)
def test_every_command_accepts_topics_and_a_prefix(command, accepted):
    assert {"--tf-topic", "--tf-static-topic", "--prefix", "--keep"} - accepted == set(), command


def test_monitor_applies_the_prefix(participant, node):
    publisher = participant.publisher(node, "/robot1/tf_static", find("tf2_msgs/msg/TFMessage"), TF_STATIC_WRITER)
    mounts = coframe.Buffer(None)
    mounts.set("map", "odom", coframe.Transform(), static=True)
    mounts.set("odom", "base_link", coframe.Transform(), static=True)
    publisher.write(mounts.encode(static=True))
    robot1 = [
        "--tf-topic",
        "/robot1/tf",
        "--tf-static-topic",
        "/robot1/tf_static",
        "--prefix",
        "robot1/",
        "--keep",
        "map",
    ]
    output = CliRunner().invoke(app, ["monitor", "--once", "--json", "--duration", "500ms", *robot1]).stdout
    assert [(edge["parent"], edge["child"]) for edge in json.loads(output)["edges"]] == [
        ("map", "robot1/odom"),
        ("robot1/odom", "robot1/base_link"),
    ]
