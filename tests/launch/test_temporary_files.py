# SPDX-License-Identifier: Apache-2.0
"""A launch that was killed leaves no files behind for long."""

import os
import subprocess
import sys

import pytest

WRITE = "from launch_ros.temporary_files import write_temporary_file; write_temporary_file('a: 1')"


@pytest.mark.skipif(os.name != "posix", reason="folders of killed processes stay behind")
def test_files_of_killed_launches_are_removed_by_the_next_one(tmp_path):
    def run(script):
        subprocess.run([sys.executable, "-c", script], check=False, env={**os.environ, "TMPDIR": str(tmp_path)})
        return list(tmp_path.glob("launch_params_*"))

    (left,) = run(f"{WRITE}; import os, signal; os.kill(os.getpid(), signal.SIGKILL)")
    assert [file.read_text() for file in left.glob("*.yaml")] == ["a: 1"]
    assert run(WRITE) == []
