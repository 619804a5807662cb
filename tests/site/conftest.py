# SPDX-License-Identifier: Apache-2.0
"""The built documentation site, and a browser that opens it from files."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from chromium import chromium

ROOT = Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def site(tmp_path_factory) -> Path:
    """Build the site once, with warnings as errors; COFRAME_SITE names one that is already built."""
    if built := os.environ.get("COFRAME_SITE"):
        return Path(built).resolve()
    pytest.importorskip("mkdocs", reason="the site needs the dependency group docs: make docs")
    pytest.importorskip("mkdocstrings_handlers.python", reason="the site needs the dependency group docs: make docs")
    folder = tmp_path_factory.mktemp("site")
    command = [sys.executable, "-m", "mkdocs", "build", "--strict", "--quiet", "--site-dir", str(folder)]
    environment = {**os.environ, "NO_MKDOCS_2_WARNING": "1"}
    result = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, check=False)
    assert result.returncode == 0, result.stdout + result.stderr
    return folder


@pytest.fixture(scope="module")
def browser():
    """Start one Chromium for all tests of a module."""
    with chromium() as started:
        yield started
