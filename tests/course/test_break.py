# SPDX-License-Identifier: Apache-2.0
"""The systems with a fault run, and the fault can be observed."""

import subprocess
import sys
import time

import pytest

import coframe
from coframe.course.faults import FAULTS
from coframe.course.running import running
from tf2_msgs.msg import TFMessage

NUMBERS = {fault.name: number for number, fault in enumerate(FAULTS, 1)}


@pytest.fixture
def start(domain_id):  # noqa: ARG001 - the domain is in the environment
    """Run the system with a fault, and a connection next to it, for the duration of the test."""
    opened = []

    def run(name):
        lines = []
        system = running(FAULTS[NUMBERS[name] - 1].programs, lambda *line: lines.append(line))
        ros = coframe.connect("observer")
        system.__enter__()
        opened.append((system, ros))
        return ros, lines

    yield run
    for system, ros in opened:
        system.__exit__(None, None, None)
        ros.close()


@pytest.mark.slow
@pytest.mark.parametrize("number", NUMBERS.values(), ids=list(NUMBERS))
def test_every_system_runs(number, domain_id):  # noqa: ARG001 - the domain is in the environment
    words = [sys.executable, "-m", "coframe.cli", "lab", "break", str(number), "--duration", "8"]
    result = subprocess.run(words, capture_output=True, text=True, timeout=60, check=False)
    assert result.returncode == 0, result.stderr
    assert "dynamic_tf_broadcaster" in result.stdout
    assert "ended with exit code" not in result.stdout
    assert FAULTS[number - 1].explanation not in result.stdout


@pytest.mark.slow
def test_a_closed_pipe_ends_the_system(domain_id):  # noqa: ARG001 - the domain is in the environment
    words = [sys.executable, "-m", "coframe.cli", "lab", "break", "4"]
    process = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    process.stdout.readline()
    process.stdout.close()
    assert process.wait(30) is not None
    assert process.stderr.read() == ""
    process.stderr.close()


@pytest.mark.slow
def test_faults_can_be_observed(start, eventually):
    ros, _ = start("wrong parent")
    eventually(lambda: ("base_link", "link2") in {(edge.parent, edge.child) for edge in ros.buffer.edges()})
    ros.close()


@pytest.mark.slow
def test_the_offset_is_in_the_stamps(start):
    ros, _ = start("clock offset")
    with_stamps = ros.subscribe("/tf", TFMessage)
    message = with_stamps.receive("20s")
    age = time.time() - message.transforms[0].header.stamp.sec
    assert 4 < age < 8
