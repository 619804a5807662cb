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


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="transforms are shared on Linux only")
@pytest.mark.usefixtures("domain_id")
def test_a_value_without_effect_is_reported_once():
    program = (
        "import rclpy, tf2_ros\n"
        "rclpy.init()\n"
        "node = rclpy.create_node('listener')\n"
        "listeners = [tf2_ros.TransformListener(tf2_ros.Buffer(), node) for _ in range(2)]\n"
    )
    environment = os.environ | {"COFRAME_SHARED": "yes"}
    command = [sys.executable, "-c", program]
    ended = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=60, check=False)
    sentence = "COFRAME_SHARED is 'yes', which has no effect. Set it to 1 to share transforms with other processes.\n"
    assert (ended.returncode, ended.stderr) == (0, sentence)
