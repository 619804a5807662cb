# SPDX-License-Identifier: Apache-2.0
"""The demo leaves no temporary folders, even if it is killed."""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest

from coframe.lab.launcher import Launcher


@pytest.mark.skipif(os.name != "posix", reason="folders of killed processes stay behind")
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


@pytest.mark.skipif(os.name != "posix", reason="folders of killed processes stay behind")
def test_folders_of_processes_with_ids_of_another_container_are_kept(tmp_path, monkeypatch):
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    unlocked = tmp_path / "coframe-lab-99999999-x"  # no process has this number
    unlocked.mkdir()
    (unlocked / ".lock").touch()
    with Launcher(()) as running:
        assert not unlocked.exists()
        folder = Path(running._folder.name)
        renamed = folder.rename(tmp_path / "coframe-lab-99999999-y")
        with Launcher(()):
            assert renamed.exists()
        renamed.rename(folder)
