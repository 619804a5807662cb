# SPDX-License-Identifier: Apache-2.0
"""What every test may ask for."""

import gc
import itertools
import os
import shutil
import signal
import socket
import subprocess
import time
from collections.abc import Callable, Container, Iterator
from contextlib import AbstractContextManager, contextmanager
from pathlib import Path
from typing import Any

import pytest

# Shells start background jobs with Ctrl-C ignored, and children would inherit that: tests are about Ctrl-C, too.
signal.signal(signal.SIGINT, signal.default_int_handler)

# The ports of higher domains are in the range from which the system takes ports for other sockets.
_DOMAINS = 96
_CLAIM_PORT = 31_500  # plus the domain: the TCP port that a test binds as long as it uses a domain
_PATIENCE = 60.0  # seconds; two cores that others use too
_domain_ids = itertools.count(os.getpid())


_WIRE = os.environ.get("COFRAME_WIRE")
_ZENOH = _WIRE == "zenoh"
_SKIPPED = {"zenoh": ("dds_only", "cyclone_only"), "fastdds": ("cyclone_only",)}.get(_WIRE or "", ())


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Skip what cannot pass over another middleware (`make test-zenoh`, `make test-fastdds`)."""
    for item in items if _SKIPPED else ():
        for name in _SKIPPED:
            if (mark := item.get_closest_marker(name)) is not None:
                item.add_marker(pytest.mark.skip(reason=f"{name}: {mark.args[0]}"))


def pytest_collection_finish() -> None:
    """Leave the tests themselves out of garbage collections: a million objects that no test has made."""
    gc.collect()
    gc.freeze()


@pytest.fixture(scope="session", autouse=_ZENOH)
def zenoh_router() -> Iterator[Any]:
    """The router of this test process, if the suite runs over Zenoh."""
    from zenoh_router import Router

    router = Router()
    os.environ.update(router.environment())
    yield router
    router.close()


@contextmanager
def _claim_domain(excluded: Container[int] = ()) -> Iterator[int]:
    for _ in range(_DOMAINS):
        number = 1 + next(_domain_ids) % _DOMAINS
        with socket.socket() as claim:
            try:
                claim.bind(("127.0.0.1", _CLAIM_PORT + number))
            except OSError:  # another process uses the domain
                continue
            if number not in excluded:
                yield number
                return
    pytest.fail("tests use all DDS domains of this machine")


@pytest.fixture(scope="session")
def claim_domain() -> Callable[..., AbstractContextManager[int]]:
    """Claims a DDS domain that no other test process of this machine uses, until the context ends."""
    return _claim_domain


@pytest.fixture
def domain_id(monkeypatch: pytest.MonkeyPatch) -> Iterator[int]:
    """A DDS domain of this test's own, also set as ROS_DOMAIN_ID for this process and its children."""
    with _claim_domain() as number:
        monkeypatch.setenv("ROS_DOMAIN_ID", str(number))
        monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
        yield number


@pytest.fixture
def eventually() -> Callable[[Callable[[], object]], None]:
    """Waits until a condition holds; fails when it does not in time."""

    def wait(condition: Callable[[], object]) -> None:
        deadline = time.monotonic() + _PATIENCE
        while not condition():
            assert time.monotonic() < deadline, "the condition was not met in time"
            time.sleep(0.005)

    return wait


@pytest.fixture(scope="session")
def shared() -> Path:
    """The folder of recordings and samples next to the project; the test skips where it is absent."""
    folder = Path(__file__).resolve().parents[2] / "shared"
    if not folder.is_dir():
        pytest.skip("no folder `shared` next to the project: recordings and wire samples are not there")
    return folder


class Network:
    """A network namespace with nothing but a loopback interface: foreign RTPS programs use every interface they see."""

    def __init__(self) -> None:
        self._rights = [] if os.geteuid() == 0 else ["--user", "--map-root-user"]
        self._holder = subprocess.Popen(
            ["unshare", *self._rights, "--net", "sh", "-c", _UP],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        if self._holder.stdout.readline() != "up\n":
            self.close()
            pytest.skip("no network namespace can be made here (unshare --net)")

    def command(self, *command: object) -> list[str]:
        """The command, to be run inside."""
        user = ["--user", "--preserve-credentials"] if self._rights else []
        return ["nsenter", "--target", str(self._holder.pid), *user, "--net", *map(str, command)]

    def close(self) -> None:
        """The namespace goes with its last process."""
        self._holder.stdin.close()
        self._holder.wait(10)
        self._holder.stdout.close()


_UP = "ip link set lo up && ip link set lo multicast on && echo up && exec cat"


@pytest.fixture
def network() -> Iterator[Network]:
    """A network of this test's own."""
    yield from _network()


@pytest.fixture(scope="session")
def session_network() -> Iterator[Network]:
    """A network for programs that run once for several tests."""
    yield from _network()


def _network() -> Iterator[Network]:
    if not (shutil.which("unshare") and shutil.which("nsenter") and shutil.which("ip")):
        pytest.skip("network namespaces need unshare, nsenter and ip")
    network = Network()
    yield network
    network.close()
