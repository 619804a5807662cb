# SPDX-License-Identifier: Apache-2.0
"""Fixtures for the tests of rclpy: contexts, nodes and child processes."""

import io
import os
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from types import SimpleNamespace

import pytest
from rtps_peer import RtpsPeer

import rclpy
from rclpy.context import Context
from rclpy.impl import console
from rclpy.node import Node


@pytest.fixture
def context(domain_id: int) -> Iterator[Context]:
    """Return a context in a DDS domain that no other test uses."""
    context = Context()
    context.init([], domain_id=domain_id)
    yield context
    context.try_shutdown()


@pytest.fixture
def make_node(context: Context) -> Iterator[Callable[..., Node]]:
    """Return a function that creates nodes, which are destroyed after the test."""
    nodes: list[Node] = []

    def make(name: str = "tester", **options) -> Node:
        nodes.append(rclpy.create_node(name, context=context, start_parameter_services=False, **options))
        return nodes[-1]

    yield make
    for node in nodes:
        node.destroy_node()


@pytest.fixture
def node(make_node: Callable[..., Node]) -> Node:
    """Return a node."""
    return make_node()


@pytest.fixture
def wait_until() -> Callable[..., None]:
    """Return a function that waits for a condition and calls `meanwhile` in the meantime."""

    def wait(
        condition: Callable[[], object],
        meanwhile: Callable[[], object] = lambda: time.sleep(0.005),
        timeout: float = 30.0,
    ) -> None:
        deadline = time.monotonic() + timeout
        while not condition():
            assert time.monotonic() < deadline, "the condition did not come true in time"
            meanwhile()

    return wait


@pytest.fixture
def printed(monkeypatch: pytest.MonkeyPatch) -> Callable[[], str]:
    """Return a function that returns what rclpy's loggers have printed since the start of the test.

    In contrast to `capfd.readouterr`, which reads a file and then truncates it, no text is lost that another thread
    prints in between.
    """
    stream = io.StringIO()
    monkeypatch.setattr(console, "sys", SimpleNamespace(stdout=stream, stderr=stream))
    return stream.getvalue


@pytest.fixture
def start_peer(domain_id: int) -> Iterator[Callable[..., RtpsPeer]]:
    """Return a function that starts a participant of any DDS implementation in the domain of the test."""
    peers: list[RtpsPeer] = []

    def start(vendor: bytes) -> RtpsPeer:
        peers.append(RtpsPeer(domain_id, vendor))
        return peers[-1]

    yield start
    for peer in peers:
        peer.close()


class Script:
    """A Python program in a separate process whose output is collected."""

    def __init__(self, path: Path, *args: str) -> None:
        self.process = subprocess.Popen(
            [sys.executable, str(path), *args],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            env=os.environ | {"PYTHONUNBUFFERED": "1"},
        )
        self._lines: list[str] = []
        self._errors: list[str] = []
        self._threads = [
            threading.Thread(target=lambda: self._lines.extend(self.process.stdout), daemon=True),
            threading.Thread(target=lambda: self._errors.extend(self.process.stderr), daemon=True),
        ]
        for thread in self._threads:
            thread.start()

    @property
    def output(self) -> str:
        """The output on stdout so far."""
        return "".join(self._lines)

    @property
    def errors(self) -> str:
        """The output on stderr so far."""
        return "".join(self._errors)

    def end(self, timeout: float = 30.0) -> int:
        """Wait for the end of the program and return its exit code."""
        code = self.process.wait(timeout)
        for thread in self._threads:
            thread.join(timeout)
        self.process.stdout.close()
        self.process.stderr.close()
        return code


@pytest.fixture
def run_script(domain_id: int, tmp_path: Path) -> Iterator[Callable[..., Script]]:
    """Return a function that starts a program from its source text in the DDS domain of the test."""
    assert os.environ["ROS_DOMAIN_ID"] == str(domain_id)
    scripts: list[Script] = []

    def run(text: str, *args: str) -> Script:
        path = tmp_path / f"script_{len(scripts)}.py"
        path.write_text(text, encoding="utf-8")
        scripts.append(Script(path, *args))
        return scripts[-1]

    yield run
    for script in scripts:
        if script.process.poll() is None:
            script.process.kill()
            script.end()
