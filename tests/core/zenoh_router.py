# SPDX-License-Identifier: Apache-2.0
"""A Zenoh router in a separate process, for tests."""

import socket
import subprocess
import sys

_PROGRAM = """
import sys, zenoh
from coframe.wire.zenoh import config
session = zenoh.open(config.router_config({}, listen=[sys.argv[1]]))
print("ready", flush=True)
sys.stdin.read()
session.close()
"""


class Router:
    """A router on a free port of the loopback interface.

    Attributes:
        endpoint: Where it listens.
    """

    def __init__(self) -> None:
        with socket.socket() as probe:
            probe.bind(("127.0.0.1", 0))
            port = probe.getsockname()[1]
        self.endpoint = f"tcp/127.0.0.1:{port}"
        self._process = subprocess.Popen(
            [sys.executable, "-c", _PROGRAM, self.endpoint], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        )
        assert self._process.stdout is not None
        assert self._process.stdout.readline() == "ready\n"

    def environment(self) -> dict[str, str]:
        """Return the environment variables of processes that connect to it."""
        override = f'connect/endpoints=["{self.endpoint}"];listen/endpoints=["tcp/127.0.0.1:0"]'
        return {"COFRAME_WIRE": "zenoh", "ZENOH_CONFIG_OVERRIDE": override, "ZENOH_ROUTER_CHECK_ATTEMPTS": "5"}

    def close(self) -> None:
        """Stop it."""
        self._process.communicate(timeout=20)
