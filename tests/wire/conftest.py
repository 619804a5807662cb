"""Other processes to talk to, and waiting for what they do."""

import os
import subprocess
import sys
import textwrap
import time
from collections.abc import Callable, Iterator

import pytest

pytest.importorskip("cyclonedds", reason="the wire needs cyclonedds")

from coframe.wire import GraphNode, Participant

_PATIENCE = 20.0  # seconds; two cores that others use too


@pytest.fixture
def participant(domain_id: int) -> Iterator[Participant]:
    """This process's participant in the test's own domain."""
    joined = Participant.get(domain_id)
    yield joined
    joined.close()


@pytest.fixture
def node(participant: Participant) -> GraphNode:
    return participant.add_node("/", "tester")


@pytest.fixture
def eventually() -> Callable[[Callable[[], object]], None]:
    """Waits until a condition holds; fails when it does not in time."""

    def wait(condition: Callable[[], object]) -> None:
        deadline = time.monotonic() + _PATIENCE
        while not condition():
            assert time.monotonic() < deadline, "waited in vain"
            time.sleep(0.005)

    return wait


class Child:
    """A Python process that runs `code` and talks by lines."""

    def __init__(self, code: str, environment: dict[str, str]) -> None:
        self.process = subprocess.Popen(
            [sys.executable, "-c", textwrap.dedent(code)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            env={**os.environ, **environment},
        )

    def read(self) -> str:
        """The next line it prints."""
        assert self.process.stdout
        line = self.process.stdout.readline()
        if not line:
            pytest.fail(f"the child process ended: {self.finish()}")
        return line.rstrip("\n")

    def finish(self) -> tuple[int, str]:
        """Lets it go on past `input()`, waits for its end: the exit code and what it wrote to stderr."""
        _, errors = self.process.communicate("\n", timeout=_PATIENCE)
        return self.process.returncode, errors

    def kill(self) -> None:
        if self.process.returncode is None:
            self.process.kill()
            self.process.communicate()


@pytest.fixture
def child(domain_id: int) -> Iterator[Callable[..., Child]]:
    """Starts processes in the test's domain: child("code", ROS_DISTRO="jazzy")."""
    children: list[Child] = []

    def start(code: str, **environment: str) -> Child:
        children.append(Child(code, {"ROS_DOMAIN_ID": str(domain_id), **environment}))
        return children[-1]

    yield start
    for started in children:
        started.kill()
