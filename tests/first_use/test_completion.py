# SPDX-License-Identifier: Apache-2.0
"""Completion of commands, options, frame names and topics in a shell."""

import os
import select
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
import recordings

import coframe


@pytest.mark.parametrize(
    ("line", "expected"),
    [("coframe loo", "lookup"), ("coframe lookup --js", "--json"), ("coframe lookup walk.mcap od", "odom")],
)
def test_completion(tmp_path, line, expected):
    recordings.write_mcap(tmp_path / "walk.mcap")
    assert expected in completed(line, tmp_path)


@pytest.mark.usefixtures("domain_id")
def test_completion_of_live_topics(tmp_path, eventually):
    pytest.importorskip("dds_library", reason="topics are found over DDS")
    with coframe.connect(tf_topic="/robot1/tf"):
        # A busy machine may need longer than the command waits for the discovery of topics.
        eventually(lambda: completed("coframe echo a b --tf-topic /ro", tmp_path) == ["/robot1/tf"])
        eventually(lambda: completed("coframe record /robot1/", tmp_path) == ["/robot1/tf"])


def test_completion_of_recordings(tmp_path):
    recordings.write_mcap(tmp_path / "walk.mcap")
    (tmp_path / "data" / "run").mkdir(parents=True)
    (tmp_path / "data" / "run" / "metadata.yaml").touch()
    assert completed("coframe frames w", tmp_path) == ["walk.mcap"]
    assert completed("coframe lookup data/", tmp_path) == ["data/run"]
    assert completed("coframe frames da", tmp_path) == [], "bash completes folders by itself"
    assert completed("coframe trajectory walk.mcap li", tmp_path) == ["lidar"]


def test_what_cannot_be_completed_is_silent(tmp_path):
    (tmp_path / "bad.mcap").write_bytes(b"\x89MCAP0\r\nnot a recording")
    assert completed("coframe lookup bad.mcap ba", tmp_path) == []
    assert completed("coframe trajectory missing/ ba", tmp_path) == []
    assert completed("coframe topic echo /", tmp_path, ROS_DOMAIN_ID="no number") == []


@pytest.mark.skipif(shutil.which("bash") is None, reason="no bash")
def test_a_tab_in_bash(tmp_path):
    """A real bash with a terminal, in which `coframe --install-completion` has been run."""
    pty = pytest.importorskip("pty", reason="no pseudo-terminals")
    recordings.write_mcap(tmp_path / "walk.mcap")
    folder = str(Path(sys.executable).parent)
    environment = {**os.environ, "HOME": str(tmp_path), "PATH": f"{folder}:{os.environ['PATH']}", "PS1": "$ "}
    # The command asks which shell has started it.
    install = ["bash", "-c", "coframe --install-completion; true"]
    installed = subprocess.run(install, env=environment, capture_output=True, text=True, check=True)
    assert "bash completion installed" in installed.stdout
    process, terminal = pty.fork()
    if process == 0:
        os.chdir(tmp_path)
        os.execvpe("bash", ["bash", "--rcfile", str(tmp_path / ".bashrc"), "-i"], environment)
    try:
        os.write(terminal, b"coframe lookup walk.mcap od\t")
        shown = typed_until(terminal, b"walk.mcap odom ")
        os.write(terminal, b"li\t")
        shown += typed_until(terminal, b"lidar ")
        assert b"rror" not in shown
    finally:
        os.kill(process, signal.SIGKILL)
        os.waitpid(process, 0)
        os.close(terminal)


def typed_until(terminal, text):
    """Return what a terminal shows until it contains a text."""
    shown, deadline = b"", time.monotonic() + 30
    while text not in shown:
        assert time.monotonic() < deadline, shown
        if select.select([terminal], [], [], 0.1)[0]:
            shown += os.read(terminal, 10_000)
    return shown


def completed(line, folder, **variables):
    """Return what the shell offers for the last word of a command line."""
    environment = {
        **os.environ,
        **variables,
        "_COFRAME_COMPLETE": "complete_bash",
        "COMP_WORDS": line,
        "COMP_CWORD": str(len(line.split()) - 1),
    }
    script = "import sys; sys.argv = ['coframe']; import coframe.cli; coframe.cli.main()"
    result = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, env=environment, cwd=folder, check=False
    )
    assert result.stderr == ""
    return result.stdout.split()
