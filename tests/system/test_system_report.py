# SPDX-License-Identifier: Apache-2.0
"""`coframe doctor --system`: what it finds on a machine, and what it says about it."""

import dataclasses
import errno
import json
import os
import socket
import subprocess
import sys

import pytest

pytest.importorskip("dds_library", reason="the command joins the graph")

from coframe.system import advise, collect
from coframe.system._variables import variables
from coframe.system.network import Interface
from coframe.wire.dds import library, participants

COMMAND = [sys.executable, "-c", "from coframe.cli import main; main()", "doctor", "--system"]
NODE = """
import sys, threading
from coframe.wire import Participant
participant = Participant.get()
participant.add_node("/arm", "planner")
print("ready", flush=True)
sys.stdin.read()
participant.close()
"""


def run(command, **environment):
    clean = {name: value for name, value in os.environ.items() if not name.startswith(("ROS_", "COFRAME_"))}
    return subprocess.run(command, capture_output=True, text=True, check=False, env={**clean, **environment})


def examine(network, *options, **environment):
    """Run the command in its own network; return its exit code and its data."""
    result = run(network.command(*COMMAND, "--json", "--duration", "0.3s", *options), **environment)
    assert result.stderr == ""
    return result.returncode, json.loads(result.stdout)


def texts(data, severity):
    return [finding["text"] for finding in data["findings"] if finding["severity"] == severity]


def test_a_machine_on_which_everything_works(network):
    code, data = examine(network)
    assert code == 0
    assert data["library"]["path"] == str(library.load().place.path)
    assert data["domain"] == 0
    assert data["discovery"] == "LOCALHOST"
    assert data["participants"] == [0, 100]
    [interface] = data["probe"]["interfaces"]
    assert interface == {"name": "lo", "address": "127.0.0.1", "used": True, "multicast": True, "problem": ""}
    assert data["probe"]["exchanged"]
    assert data["probe"]["multicast_ports"] == [7400, 7401]
    assert data["probe"]["receive_buffer"] > 0
    assert data["nodes"] == []
    assert texts(data, "note")[-2:][0].startswith(("Only processes", "No other node was found in domain 0"))


def test_nodes_and_participants_in_use(network):
    environment = {**os.environ, "ROS_DOMAIN_ID": "5", "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
    command = network.command(sys.executable, "-c", NODE)
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, env=environment) as other:
        assert other.stdout.readline() == "ready\n"
        command = network.command(*COMMAND, "--json", "--domain", "5")
        data = json.loads(run(command).stdout)
        other.communicate("")
    assert data["participants"] == [1, 100]
    assert data["nodes"] == ["/arm/planner"]
    assert not any("No other node" in text for text in texts(data, "note"))


@pytest.mark.skipif(sys.platform != "linux", reason="a setting of Linux")
def test_a_network_without_multicast(network):
    """No process may join a multicast group."""
    setting = "/proc/sys/net/ipv4/igmp_max_memberships"
    subprocess.run(network.command("sh", "-c", f"echo 0 > {setting}"), check=True)
    code = "from coframe.system.network import multicast_problem; print(multicast_problem('127.0.0.1'))"
    result = run(network.command(sys.executable, "-c", code))
    assert result.stdout == f"{os.strerror(errno.ENOBUFS)}\n"
    result = run(network.command(*COMMAND, "--json"))
    assert result.returncode == 1
    assert "Joining domain 0 failed" in texts(json.loads(result.stdout), "error")[0]


def test_report_in_a_notebook(monkeypatch):
    monkeypatch.setenv("ROS_DOMAIN_ID", "<b>")  # A test before this one can have loaded the DDS library.
    report = collect(listen=0.0)
    text = report._repr_html_()
    assert "ROS_DOMAIN_ID is &#x27;&lt;b&gt;&#x27;: a domain ID is an integer from 0 to 232." in text
    assert "Environment variables" in text
    assert "no ROS 2 is sourced" in text


def test_without_a_library():
    result = run([*COMMAND, "--json"], COFRAME_DDS_LIBRARY="/absent/libddsc.so")
    data = json.loads(result.stdout)
    assert result.returncode == 1
    assert texts(data, "error") == ["The DDS library /absent/libddsc.so in COFRAME_DDS_LIBRARY does not exist."]
    assert "Use one of these options: " in data["findings"][0]["action"]
    assert data["probe"] is data["nodes"] is None
    assert data["installation"]["packages"]["numpy"]


def test_text_and_an_invalid_variable():
    result = run(COMMAND, ROS_DOMAIN_ID="five", RMW_IMPLEMENTATION="rmw_connextdds", ZENOH_CONFIG="x")
    assert result.returncode == 1
    assert "  error: ROS_DOMAIN_ID is 'five': a domain ID is an integer from 0 to 232." in result.stdout
    assert "  warning: RMW_IMPLEMENTATION is rmw_connextdds: " in result.stdout
    assert "  ZENOH_CONFIG=x: no effect on coframe" in result.stdout
    assert f"{library.load().place.path}: Cyclone DDS" in result.stdout
    assert "Traceback" not in result.stderr


@pytest.mark.parametrize("words", [["run.mcap"], ["--watch"], ["--sarif"]])
def test_what_cannot_be_combined(words):
    result = run([*COMMAND, *words])
    assert result.returncode == 2
    assert "--system cannot be combined with" in result.stderr


def test_variables_have_an_effect_or_none():
    found = {
        each.name: each.effect for each in variables({"ROS_DOMAIN_ID": "1", "ROS_OTHER": "1", "HOME": "/", "RMW_X": ""})
    }
    assert set(found) == {"ROS_DOMAIN_ID", "ROS_OTHER"}
    assert found["ROS_OTHER"] == "no effect on coframe"


def test_participant_indexes_in_use(domain_id):
    used, every = participants.participant_indexes(domain_id)
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as taken:
        taken.bind(("127.0.0.1", 7400 + 250 * domain_id + 10 + 2 * 42))
        assert participants.participant_indexes(domain_id) == (used + 1, every)
    assert participants.participant_indexes(232)[1] == 63  # the others would be beyond the last port


def test_advice_about_networks_and_ros(domain_id):
    """Changes of a real report that need another machine: several interfaces, small buffers, a mixed ROS."""
    real = collect(domain_id, listen=0.01, environment={"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"})
    wired = Interface("eth0", "10.0.0.1", used=True, multicast=False, problem="nothing was received within 2 s")
    wireless = Interface("wlan0", "10.0.1.1", used=False, multicast=None)
    probe = dataclasses.replace(real.probe, interfaces=[wired, wireless], receive_buffer=212992)
    mixed = dataclasses.replace(real.installation, foreign={"rclpy": "/opt/other"}, ros=None)
    report = dataclasses.replace(
        real, discovery="SUBNET", probe=probe, installation=mixed, participants=(90, 100), domain=150
    )
    found = [(one.severity, one.text) for one in advise(report)]
    assert [severity for severity, _ in found] == sorted(
        (severity for severity, _ in found), key=["error", "warning", "note"].index
    )
    assert found[0][1].startswith("Python imports rclpy from /opt/other, but no ROS 2 is sourced.")
    assert ("warning", "90 of 100 participant indexes of domain 150 are in use on this machine.") in found
    text = "Multicast does not work on eth0 (10.0.0.1): nothing was received within 2 s. No node on another machine"
    assert ("warning", f"{text} is found.") in found
    assert ("note", "DDS uses the interface eth0 of eth0, wlan0.") in found
    assert any("The receive buffer of a socket has 212992 bytes." in text for _, text in found)
    assert any("The ports of domain 150 begin at 44900" in text for _, text in found) == (sys.platform == "linux")
