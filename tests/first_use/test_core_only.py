# SPDX-License-Identifier: Apache-2.0
"""The programs of the nodes on an installation without the optional packages."""

import subprocess
import sys

import pytest

HIDE = """
import importlib, sys
class Hidden:
    def find_spec(self, name, path=None, target=None):
        if name.split(".")[0] == "cyclonedds":
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)
sys.meta_path.insert(0, Hidden())
module = sys.argv.pop(1)
importlib.import_module(module).main()
"""


@pytest.mark.parametrize("module", ["robot_state_publisher", "joint_state_publisher", "coframe.lab.tf_listener"])
def test_a_missing_package_is_named_without_a_traceback(module):
    result = subprocess.run([sys.executable, "-c", HIDE, module], capture_output=True, text=True, check=False)
    assert result.returncode == 1
    assert "pip install 'coframe[dds]'" in result.stderr
    assert "Traceback" not in result.stderr
