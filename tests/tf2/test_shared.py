# SPDX-License-Identifier: Apache-2.0
"""The drop-in tests of listeners and broadcasters with COFRAME_SHARED=1. `make test-shared` runs many more."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

DROP_IN = Path(__file__).with_name("drop_in") / "test_listeners_and_broadcasters.py"


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="transforms are shared on Linux only")
def test_listeners_and_broadcasters_with_shared_transforms():
    ended = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", str(DROP_IN)],
        env=os.environ | {"COFRAME_SHARED": "1"},
        capture_output=True,
        text=True,
        timeout=100,
        check=False,
    )
    assert ended.returncode == 0, ended.stdout
