# SPDX-License-Identifier: Apache-2.0
"""Programs that use either implementation of DDS."""

import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

pytest.importorskip("coframe_fastdds._fastdds", reason="these tests need coframe-fastdds")
pytest.importorskip("dds_library", reason="these tests need Cyclone DDS")

PROGRAMS = Path(__file__).with_name("programs")


@pytest.fixture
def start(domain_id: int) -> Iterator[Callable[..., subprocess.Popen[str]]]:
    """Starts a program of this folder over a middleware."""
    assert domain_id
    started: list[subprocess.Popen[str]] = []

    def run(wire: str, program: str, *arguments: object, **environment: str) -> subprocess.Popen[str]:
        process = subprocess.Popen(
            [sys.executable, PROGRAMS / program, *map(str, arguments)],
            env={**os.environ, "COFRAME_WIRE": wire, **environment},
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        started.append(process)
        return process

    yield run
    for process in started:
        process.kill()
        process.communicate()
