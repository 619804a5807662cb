# SPDX-License-Identifier: Apache-2.0
"""A router of these tests, and other processes that connect to it."""

import json
import os
import subprocess
import sys
import textwrap
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("zenoh", reason="these tests need eclipse-zenoh")

from zenoh_router import Router

from coframe.wire import GraphNode, Participant


@pytest.fixture(scope="session")
def router() -> Iterator[Router]:
    """A router on its own port. Tests have their own domains."""
    started = Router()
    yield started
    started.close()


@pytest.fixture
def zenoh_domain(router: Router, domain_id: int, monkeypatch: pytest.MonkeyPatch) -> int:
    """A domain on Zenoh, for this process and its children."""
    for name, value in router.environment().items():
        monkeypatch.setenv(name, value)
    return domain_id


@pytest.fixture
def participant(zenoh_domain: int) -> Iterator[Participant]:
    """The participant of this process in the domain of the test."""
    joined = Participant.get(zenoh_domain)
    yield joined
    joined.close()


@pytest.fixture
def node(participant: Participant) -> GraphNode:
    return participant.add_node("/robot1", "tester")


class RosPeer:
    """The program `ros_peer.py`."""

    def __init__(self, endpoint: str, domain: int, name: str) -> None:
        program = Path(__file__).with_name("ros_peer.py")
        self.name = name
        self.process = subprocess.Popen(
            [sys.executable, "-I", program, endpoint, str(domain), name],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        self.zid = self._answer()

    def __call__(self, command: str, *arguments: Any) -> Any:
        assert self.process.stdin
        self.process.stdin.write(json.dumps([command, *arguments]) + "\n")
        self.process.stdin.flush()
        return self._answer()

    def _answer(self) -> Any:
        assert self.process.stdout
        line = self.process.stdout.readline()
        assert line, "the peer has ended"
        return json.loads(line)

    def close(self) -> None:
        assert self.process.stdin
        self.process.stdin.close()
        self.process.wait(20)
        self.process.stdout.close()


@pytest.fixture
def ros_peer(router: Router, zenoh_domain: int) -> Iterator[RosPeer]:
    """An independent node in the domain of the test."""
    peer = RosPeer(router.endpoint, zenoh_domain, "talker")
    yield peer
    peer.close()


@pytest.fixture
def child(zenoh_domain: int) -> Iterator[Callable[[str], subprocess.Popen[str]]]:
    """Return a function that runs code in another process of the domain; it reads and writes lines."""
    assert zenoh_domain
    children: list[subprocess.Popen[str]] = []

    def start(code: str) -> subprocess.Popen[str]:
        children.append(
            subprocess.Popen(
                [sys.executable, "-c", textwrap.dedent(code)],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.PIPE,
                text=True,
                env=dict(os.environ),
            )
        )
        return children[-1]

    yield start
    for process in children:
        if process.poll() is None:
            process.kill()
        process.communicate()
