# SPDX-License-Identifier: Apache-2.0
"""The programs of the nodes on a machine without a DDS library."""

import os
import subprocess
import sys

import pytest


@pytest.mark.parametrize("module", ["robot_state_publisher", "joint_state_publisher", "coframe.lab.tf_listener"])
def test_a_missing_library_is_named_without_a_traceback(module):
    code = f"import importlib; importlib.import_module({module!r}).main()"
    result = subprocess.run(
        [sys.executable, "-c", code],
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, "COFRAME_DDS_LIBRARY": "/absent/libddsc.so"},
    )
    assert result.returncode == 1
    assert "The DDS library /absent/libddsc.so in COFRAME_DDS_LIBRARY does not exist." in result.stderr
    assert "Traceback" not in result.stderr
