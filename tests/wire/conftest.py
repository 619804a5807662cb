# SPDX-License-Identifier: Apache-2.0
"""Child processes to communicate with."""

import os
import subprocess
import sys
import textwrap
from collections.abc import Callable, Iterator, Sequence

import pytest

pytest.importorskip("dds_library", reason="the wire needs a DDS library")

from coframe.wire import GraphNode, Participant

_PATIENCE = 20.0  # seconds; two cores that others use too


@pytest.fixture
def domain_id(domain_id: int, claim_domain, monkeypatch: pytest.MonkeyPatch) -> Iterator[int]:
    """A domain ID that no earlier test of this process has left open. IDs are reused."""
    used = {domain for _, domain in Participant._instances}
    if domain_id not in used:
        yield domain_id
        return
    with claim_domain(excluded=used) as number:
        monkeypatch.setenv("ROS_DOMAIN_ID", str(number))
        yield number


@pytest.fixture
def participant(domain_id: int) -> Iterator[Participant]:
    """The participant of this process in the domain of the test."""
    joined = Participant.get(domain_id)
    yield joined
    joined.close()


@pytest.fixture
def node(participant: Participant) -> GraphNode:
    return participant.add_node("/", "tester")


class Child:
    """A child process that communicates by lines on standard input and output."""

    def __init__(self, command: list[str], environment: dict[str, str]) -> None:
        self.process = subprocess.Popen(
            command,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            env={**os.environ, **environment},
        )

    def read(self) -> str:
        """Return the next line of its output."""
        assert self.process.stdout
        line = self.process.stdout.readline()
        if not line:
            pytest.fail(f"the child process ended: {self.finish()}")
        return line.rstrip("\n")

    def ask(self, line: str) -> str:
        """Send a line, and return the next line of its output."""
        assert self.process.stdin
        self.process.stdin.write(f"{line}\n")
        self.process.stdin.flush()
        return self.read()

    def finish(self) -> tuple[int, str]:
        """Let it continue after `input()`, wait for its exit, and return the exit code and stderr."""
        _, errors = self.process.communicate("\n", timeout=_PATIENCE)
        return self.process.returncode, errors

    def kill(self) -> None:
        if self.process.returncode is None:
            self.process.kill()
            self.process.communicate()


@pytest.fixture
def child(domain_id: int) -> Iterator[Callable[..., Child]]:
    """Return a function that starts processes in the domain of the test: child("code", ROS_DISTRO="jazzy")."""
    children: list[Child] = []

    def start(code: str, python: Sequence[str] = (sys.executable,), **environment: str) -> Child:
        command = [*python, "-c", textwrap.dedent(code)]
        children.append(Child(command, {"ROS_DOMAIN_ID": str(domain_id), **environment}))
        return children[-1]

    yield start
    for started in children:
        started.kill()


@pytest.fixture
def beside_rosless(network, domain_id: int) -> Iterator[Callable[[str], None]]:
    """Run code with coframe and an independent program in a separate network; fail if the code fails.

    The independent program sends on every interface it sees, so it never runs on the machine's own network.
    """
    pytest.importorskip("rosless", reason="an independent RTPS program")
    started: list[Child] = []

    def run(code: str) -> None:
        command = network.command(sys.executable, "-c", _BESIDE_ROSLESS + textwrap.dedent(code))
        started.append(Child(command, {"ROS_DOMAIN_ID": str(domain_id)}))
        exit_code, errors = started[-1].finish()
        assert exit_code == 0, errors

    yield run
    for process in started:
        process.kill()


_BESIDE_ROSLESS = """
import time, rosless, coframe
from coframe.messages import codec, find
from coframe.wire import Participant, QoS
STRING, TF_MESSAGE = find("std_msgs/msg/String"), find("tf2_msgs/msg/TFMessage")
def eventually(condition):
    deadline = time.monotonic() + 15
    while not condition():
        assert time.monotonic() < deadline, "timed out after 15 s"
        time.sleep(0.005)
participant = Participant.get()
node = participant.add_node("/", "tester")
peer = rosless.Node(participant.domain_id)
"""
