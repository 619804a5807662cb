# SPDX-License-Identifier: Apache-2.0
"""Completion of commands, options, frame names and topics in a shell."""

import os
import re
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


class Terminal:
    """A shell in a pseudo-terminal, in which a person presses keys."""

    def __init__(self, command, folder, environment):
        pty = pytest.importorskip("pty", reason="no pseudo-terminals")
        self.shown = b""
        self.process, self.file = pty.fork()
        if self.process == 0:
            os.chdir(folder)
            os.execvpe(command[0], command, environment)

    def press(self, keys, expected, again=b""):
        """Press keys, and wait until the terminal shows a text after them; press some of them again every 5 s."""
        begin, start = len(self.shown), time.monotonic()
        next_press = start
        while expected not in ESCAPES.sub(b"", self.shown[begin:]):
            now = time.monotonic()
            assert now - start < 60, self.shown
            if now >= next_press:
                os.write(self.file, keys)
                keys, next_press = again, now + 5
            if select.select([self.file], [], [], 0.1)[0]:
                read = os.read(self.file, 10_000)
                self.shown += read
                if b"\x1b[c" in read:  # fish asks what kind of terminal this is
                    os.write(self.file, b"\x1b[?62c")

    def close(self):
        os.kill(self.process, signal.SIGKILL)
        os.waitpid(self.process, 0)
        os.close(self.file)


ESCAPES = re.compile(rb"\x1b(\[[0-?]*[ -/]*[@-~]|\][^\x07\x1b]*(\x07|\x1b\\)|[()][A-Z0-9]|[=>])|\x07")


@pytest.fixture(
    params=["bash", pytest.param("zsh", marks=pytest.mark.slow), pytest.param("fish", marks=pytest.mark.slow)]
)
def terminal(request, tmp_path):
    """A real shell with a terminal, in which `coframe --install-completion` has been run."""
    shell = request.param
    if shutil.which(shell) is None:
        pytest.skip(f"{shell} is not installed")
    environment = {
        **{name: value for name, value in os.environ.items() if not name.startswith("XDG_")},
        "HOME": str(tmp_path),
        "PATH": f"{Path(sys.executable).parent}:{os.environ['PATH']}",
        "TERM": "xterm",
    }
    # The command asks which shell has started it.
    install = [shell, "-c", "coframe --install-completion; true"]
    installed = subprocess.run(install, env=environment, capture_output=True, text=True, check=True)
    assert f"{shell} completion installed" in installed.stdout
    opened = Terminal([shell, "-i"], tmp_path, environment)
    yield opened
    opened.close()


def test_the_frames_of_a_recording_by_tab(terminal, tmp_path):
    recordings.write_mcap(tmp_path / "walk.mcap")
    terminal.press(b"coframe lookup walk.mcap od\t", b"walk.mcap odom ")
    terminal.press(b"li\t", b"lidar ")
    terminal.press(b"\r", b"Translation")
    assert b"rror" not in terminal.shown


@pytest.mark.slow
@pytest.mark.usefixtures("domain_id")
def test_live_frames_by_tab(terminal, tmp_path):
    pytest.importorskip("dds_library", reason="frames are found over DDS")
    command = [sys.executable, "-m", "coframe.cli", "static", "--frame-id", "gripper_base"]
    command += ["--child-frame-id", "gripper_tip"]
    with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as publisher:
        try:
            terminal.press(b"coframe echo gripper_b\t", b"gripper_base ", again=b"\t")
        finally:
            publisher.terminate()
    assert completed("coframe echo gripper_b", tmp_path, ROS_DOMAIN_ID="no number") == []


def completed(line, folder, **variables):
    """Return what the shell offers for the last word of a command line."""
    environment = {
        **os.environ,
        **variables,
        "_COFRAME_COMPLETE": "bash_complete",
        "COMP_WORDS": line,
        "COMP_CWORD": str(len(line.split()) - 1),
    }
    script = "import sys; sys.argv = ['coframe']; import coframe.cli; coframe.cli.main()"
    result = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, env=environment, cwd=folder, check=False
    )
    assert result.stderr == ""
    kinds = [line.partition(",") for line in result.stdout.splitlines()]
    return [name for kind, _, name in kinds if kind == "plain"]
