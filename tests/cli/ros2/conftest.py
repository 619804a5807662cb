# SPDX-License-Identifier: Apache-2.0
"""One node in a separate process, for all tests of this folder, and the command line in this process."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

pytest.importorskip("dds_library", reason="the commands speak DDS")

from click.testing import CliRunner

from coframe.cli.app import app


@pytest.fixture(scope="session")
def graph(claim_domain):
    """The node of graph_program.py, in its own domain."""
    with claim_domain() as domain:
        environment = {"ROS_DOMAIN_ID": str(domain), "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"}
        program = subprocess.Popen(
            [sys.executable, Path(__file__).with_name("graph_program.py")],
            stdout=subprocess.PIPE,
            text=True,
            env={**os.environ, **environment},
        )
        assert program.stdout.readline() == "ready\n"
        program.environment = environment
        yield program
        program.kill()
        program.wait()
        program.stdout.close()


@pytest.fixture
def run(graph, monkeypatch):
    """Run a command in the domain of the node; return its result."""
    for name, value in graph.environment.items():
        monkeypatch.setenv(name, value)

    def invoke(*words, code=0):
        result = CliRunner().invoke(app, [str(word) for word in words])
        assert code is None or result.exit_code == code, result.output
        return result.output

    return invoke


@pytest.fixture
def listed(run, eventually):
    """Whether a command that lists the graph prints a line soon; it waits only briefly for discovery each time."""

    def wait(line, *words):
        eventually(lambda: line in run(*words, "--spin-time", "0.1").splitlines())

    return wait
