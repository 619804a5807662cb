# SPDX-License-Identifier: Apache-2.0
"""Processes in a separate network, and an independent program that subscribes to their topics."""

import json
import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

OBSERVER = Path(__file__).with_name("observer.py")


class Processes:
    """Starts processes in the network and domain of the test."""

    def __init__(self, network, domain_id, folder):
        self.network = network
        self.domain_id = domain_id
        self._folder = folder
        self._running = {}

    def start(self, name, *command):
        """Start a command, where `python` is this Python. Its output goes to a file."""
        command = [sys.executable if part == "python" else part for part in command]
        log = self._folder / f"{name}.log"
        with log.open("wb") as output:
            self._running[name] = subprocess.Popen(
                self.network.command(*command),
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=subprocess.STDOUT,
                env={**os.environ, "PYTHONUNBUFFERED": "1"},
            )

    def text(self, name):
        """Return the output of a process so far."""
        return (self._folder / f"{name}.log").read_text()

    def running(self, name):
        return self._running[name].poll() is None

    def end(self, name, how=signal.SIGINT):
        """Send a signal, wait for the process to exit, and return its exit code and output."""
        process = self._running[name]
        process.send_signal(how)
        code = process.wait(20)
        return code, self.text(name)

    def close(self):
        for process in self._running.values():
            if process.poll() is None:
                process.kill()
                process.wait()

    def observe(self, seconds, *topics, patience=30.0):
        """Return the messages that the independent program receives on TOPIC:TYPE:DURABILITY ... topics.

        It receives for a few seconds after the first message, for which it waits at most `patience` seconds.
        """
        command = self.network.command(sys.executable, OBSERVER, self.domain_id, patience, seconds, *topics)
        result = subprocess.run(command, capture_output=True, text=True, timeout=90, check=False)
        assert result.returncode == 0, result.stderr
        return json.loads(result.stdout)


@pytest.fixture(autouse=True, scope="session")
def _programs() -> None:
    # Not at the top of this file: pytest ends with a traceback if the folder is named on the command line.
    pytest.importorskip("dds_library", reason="the processes speak DDS")
    pytest.importorskip("rosless", reason="the independent RTPS program")


@pytest.fixture
def processes(network, domain_id, tmp_path) -> Iterator[Processes]:
    started = Processes(network, domain_id, tmp_path)
    yield started
    started.close()
