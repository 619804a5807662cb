# SPDX-License-Identifier: Apache-2.0
"""The demo leaves no temporary folders, even if it is killed."""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest

from coframe.lab.launcher import Launcher


@pytest.mark.skipif(os.name != "posix", reason="the ids of ended processes are not known")
def test_folders_of_killed_launchers_are_removed(tmp_path, monkeypatch):
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    script = "import os, signal; from coframe.lab.launcher import Launcher\n"
    script += "launcher = Launcher(()).__enter__(); os.kill(os.getpid(), signal.SIGKILL)"
    subprocess.run([sys.executable, "-c", script], check=False, env={**os.environ, "TMPDIR": str(tmp_path)})
    (left,) = tmp_path.glob("coframe-lab-*")
    with Launcher(()) as running:
        assert not left.exists()
        with Launcher(()):
            assert Path(running._folder.name).exists()
    assert list(tmp_path.iterdir()) == []
