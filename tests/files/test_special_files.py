# SPDX-License-Identifier: Apache-2.0
"""Named pipes, devices, sockets, folders, links and sparse files instead of every file that coframe reads."""

import subprocess
import sys
import time

import pytest
from click.testing import CliRunner
from special_files import KINDS, readers

from coframe.cli.app import app

pytestmark = [
    pytest.mark.skipif(sys.platform == "win32", reason="Windows has no such files in folders"),
    pytest.mark.timeout(60, method="thread"),
]
MAX_SECONDS = 10  # two cores that others use too
READERS = readers()
# Readers for which a link to a device is a file outside their folder, or for which the file is simply absent.
OTHER_TEXTS = {"mesh", "packaged_file", "resource"}


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("name", READERS)
def test_each_reader_names_what_the_file_is(tmp_path, name, kind):
    if sys.platform != "linux" and kind in {"kernel", "memory"}:
        pytest.skip("/proc is Linux's")
    reader, sentence = READERS[name], KINDS[kind].sentence
    path = tmp_path / reader.file
    KINDS[kind].make(path)
    started = time.monotonic()
    try:
        reader.read(path)
    except reader.errors as error:
        text = f"{error} {getattr(error, 'hint', '')}"
        assert not sentence or sentence in text or name in OTHER_TEXTS
        assert not sentence or reader.file in text
    else:
        assert not sentence or not reader.errors, "the file is not one that can be read"
    assert time.monotonic() - started < MAX_SECONDS


COMMAND_KINDS = ("pipe", "zero", "folder", "loop", "memory", "sparse")
COMMANDS = [
    *((words, f"run.{suffix}") for words in (["bag", "info"], ["doctor"]) for suffix in ("mcap", "db3", "bag")),
    (["frames"], "run.mcap"),
    (["bag", "fix", "{}", "out"], "run.mcap"),
    (["bag", "convert", "{}", "out"], "run.db3"),
    (["bag", "play"], "run.mcap"),
    (["play"], "run.mcap"),
    (["lookup", "{}", "a", "b"], "run.mcap"),
    (["why", "{}", "a", "b"], "run.mcap"),
    (["trajectory", "{}", "a", "b"], "run.mcap"),
    (["plot", "{}", "a->b.x", "-o", "out.html"], "run.mcap"),
    (["cloud", "{}", "/points", "--frame", "map", "-o", "out.ply", "--at", "1s"], "run.mcap"),
    (["view", "{}", "-o", "out.html"], "run.mcap"),
    (["view", "--no-browser", "--port", "0", "-d"], "view.rviz"),
    (["view", "--no-browser", "--port", "0", "--robot"], "robot.urdf"),
    (["robot"], "robot.urdf"),
    (["robot"], "robot.xacro"),
    (["joints"], "robot.urdf"),
    (["compare", "{}", "{}"], "path.tum"),
    (["compare", "{}", "{}"], "path.npz"),
    (["launch", "--show-args"], "a.launch.py"),
    (["launch", "--show-args"], "a.launch.xml"),
    (["launch", "--show-args"], "a.launch.yaml"),
]


@pytest.mark.parametrize("kind", COMMAND_KINDS)
@pytest.mark.parametrize(("words", "file"), COMMANDS, ids=[" ".join([*words, file]) for words, file in COMMANDS])
@pytest.mark.usefixtures("domain_id")
def test_each_command_ends_with_a_sentence(tmp_path, monkeypatch, words, file, kind):
    if sys.platform != "linux" and kind in {"kernel", "memory"}:
        pytest.skip("/proc is Linux's")
    monkeypatch.chdir(tmp_path)
    KINDS[kind].make(tmp_path / file)
    words = words if "{}" in words else [*words, "{}"]
    started = time.monotonic()
    result = CliRunner().invoke(app, [word.replace("{}", file) for word in words])
    assert time.monotonic() - started < MAX_SECONDS
    assert result.exception is None or isinstance(result.exception, SystemExit)
    assert result.exit_code == 1 or (words[0] == "compare" and kind == "folder")
    assert "Traceback" not in result.output
    assert file in result.output or "/proc/" in result.output
    assert KINDS[kind].sentence in " ".join(result.output.split())


def test_a_batch_reports_each_recording(tmp_path, monkeypatch):
    """It reads each one in a separate process."""
    monkeypatch.chdir(tmp_path)
    for kind in COMMAND_KINDS:
        (tmp_path / kind).mkdir()
        KINDS[kind].make(tmp_path / kind / "run.mcap")
    files = [f"{kind}/run.mcap" for kind in COMMAND_KINDS]
    result = CliRunner().invoke(app, ["batch", "a", "b", *files, "-o", "out"])
    assert result.exit_code == 1
    for kind, file in zip(COMMAND_KINDS, files, strict=True):
        assert any(file in line and KINDS[kind].sentence in line for line in result.output.splitlines())


def test_a_pipe_on_purpose_gets_the_way_out():
    """A shell passes the output of another program as an unnamed pipe."""
    command = [sys.executable, "-m", "coframe.cli", "bag", "info", "/dev/stdin"]
    done = subprocess.run(command, input="content", capture_output=True, text=True, timeout=30, check=False)
    assert done.returncode == 1
    assert (
        "/dev/stdin cannot be read: the path is a pipe, not a regular file; write its content to a file first"
        in done.stderr
    )
