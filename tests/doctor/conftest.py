# SPDX-License-Identifier: Apache-2.0
"""Fixtures that run the doctor on recordings and on real processes."""

import json
import subprocess
import sys

import pytest
from nodes import NODE

from coframe.doctor import diagnose, observe_recording


@pytest.fixture
def examine(tmp_path):
    """Return the report on a run or on the recording at a path."""

    def examine(run, folder="", **options):
        (tmp_path / folder).mkdir(exist_ok=True)
        path = run.write(tmp_path / folder) if hasattr(run, "write") else run
        (observation,) = observe_recording(path).values()
        return diagnose(observation, **options)

    return examine


@pytest.fixture
def only(examine):
    """Return the only finding with its consequences; fail if there are several or none."""

    def only(run, code):
        report = examine(run)
        assert [finding.code for finding in report.findings] == [code], "\n".join(map(str, report.findings))
        return report.findings[0]

    return only


class Inside:
    """Runs Python in its own network namespace, isolated from other tests."""

    def __init__(self, network):
        self._network = network
        self._running = []

    def start(self, *arguments, **options):
        process = subprocess.Popen(
            self._network.command(sys.executable, *arguments),
            **{"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, **options},
        )
        self._running.append(process)
        return process

    def run(self, *arguments):
        command = self._network.command(sys.executable, *arguments)
        return subprocess.run(command, capture_output=True, text=True, check=False, timeout=90)

    def doctor(self, *arguments):
        """Return the report as data."""
        result = self.run("-m", "coframe.cli", "doctor", "--json", *arguments)
        assert "Traceback" not in result.stderr, result.stderr
        data = json.loads(result.stdout)
        assert result.returncode == (0 if data["healthy"] else 1)
        return data

    def close(self):
        for process in self._running:
            process.kill()
            process.wait()


@pytest.fixture
def inside(network, domain_id):  # noqa: ARG001 - sets the domain for the processes
    pytest.importorskip("dds_library", reason="the processes communicate over DDS")
    processes = Inside(network)
    yield processes
    processes.close()


@pytest.fixture
def start(inside):
    """Return a function that starts a node with a name and a body."""
    return lambda name, body, **options: inside.start("-c", NODE.replace("{body}", body), name, **options)
