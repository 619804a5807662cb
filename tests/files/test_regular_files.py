# SPDX-License-Identifier: Apache-2.0
"""The rule for files from outside, and folders that contain special files."""

import os
import subprocess
import sys
import threading

import pytest
import recordings
from recordings import COUNT
from special_files import KINDS

import coframe
from coframe._files.regular_files import (
    UnsuitableFileError,
    check_regular,
    open_regular,
    read_regular,
    read_regular_text,
    reading_hint,
)

posix = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no named pipes in folders")


def test_a_file_is_read_up_to_its_limit(tmp_path):
    path = tmp_path / "text.txt"
    path.write_bytes(b"first\r\nsecond")
    assert read_regular(path, 13) == b"first\r\nsecond"
    assert read_regular_text(path, 13) == "first\nsecond"
    with open_regular(str(path)) as file:
        assert file.read(5) == b"first"
    with pytest.raises(UnsuitableFileError, match=r"cannot be read: the file is larger than the maximum of 12 bytes"):
        read_regular(path, 12)
    with pytest.raises(UnsuitableFileError, match="larger than the maximum of 12 bytes"):
        check_regular(path, 12)
    check_regular(path, 13)
    check_regular(path)


def test_the_limit_is_stated_in_mebibytes(tmp_path):
    path = tmp_path / "large"
    path.write_bytes(bytes((2 << 20) + 1))
    with pytest.raises(UnsuitableFileError, match="the file is larger than the maximum of 2 MiB"):
        read_regular(path, 2 << 20)


def test_errors_are_those_of_the_system_and_of_values(tmp_path):
    with pytest.raises(FileNotFoundError) as missing:
        read_regular(tmp_path / "none", 1)
    assert reading_hint(missing.value) == "Check the path and the permission to read it."
    for name in ("a\0b", "\ud800"):
        with pytest.raises(UnsuitableFileError, match="the name of the file is not valid"):
            open_regular(name)
    with pytest.raises(ValueError, match="the path is a folder, not a file") as folder:
        open_regular(tmp_path)
    assert reading_hint(folder.value) == ""


@posix
def test_a_writer_that_waits_for_a_reader_still_waits(tmp_path):
    """Opening the pipe for reading would let it continue, and then end it with a broken pipe."""
    path = tmp_path / "pipe"
    os.mkfifo(path)
    written = threading.Event()

    def write():
        path.write_text("content")
        written.set()

    thread = threading.Thread(target=write, daemon=True)
    thread.start()
    with pytest.raises(UnsuitableFileError, match="the path is a named pipe"):
        open_regular(path)
    assert not written.wait(0.2)
    assert path.read_text() == "content"
    thread.join(10)


@posix
def test_a_file_that_becomes_a_pipe_is_refused(tmp_path, monkeypatch):
    path = tmp_path / "file"
    path.write_text("content")
    before = path.stat()
    path.unlink()
    os.mkfifo(path)
    monkeypatch.setattr("coframe._files.regular_files.os.stat", lambda _: before)
    with pytest.raises(UnsuitableFileError, match="the path is a named pipe"):
        open_regular(path)


@posix
def test_files_with_plausible_holes_are_read(tmp_path):
    path = tmp_path / "file"
    path.write_bytes(bytes(8192))
    os.truncate(path, 60 << 20)
    check_regular(path)
    os.truncate(path, 70 << 20)
    with pytest.raises(
        UnsuitableFileError, match="the file is sparse: the disk stores only 8192 of its 73400320 bytes"
    ):
        check_regular(path)
    with path.open("r+b") as file:
        file.write(bytes(1 << 20))
    check_regular(path)


@posix
def test_special_files_in_a_folder_do_not_hide_the_recording(tmp_path):
    recordings.write_mcap(tmp_path / "run_0.mcap")
    for number, kind in enumerate(KINDS, start=1):
        KINDS[kind].make(tmp_path / f"run_{number}.mcap")
        KINDS[kind].make(tmp_path / f"notes_{number}.txt")
    os.mkfifo(tmp_path / "metadata.yaml")
    with coframe.open_bag(tmp_path) as recording:
        assert sum(topic.messages for topic in recording.topics.values()) == COUNT + 1
        problems = "\n".join(recording.problems)
    assert "metadata.yaml cannot be read: the path is a named pipe" in problems
    assert "run_1.mcap cannot be read: the path is a named pipe" in problems
    assert "run_2.mcap cannot be read: the path is a device" in problems
    assert "notes" not in problems


@posix
def test_a_special_file_in_the_metadata_is_named(tmp_path):
    recordings.write_mcap(tmp_path / "run_0.mcap")
    os.mkfifo(tmp_path / "run_1.mcap")
    (tmp_path / "metadata.yaml").write_text(
        "rosbag2_bagfile_information: {relative_file_paths: [run_0.mcap, run_1.mcap, run_2.mcap]}"
    )
    with coframe.open_bag(tmp_path) as recording:
        assert recording.problems == [
            f"run_1.mcap cannot be read: {KINDS['pipe'].sentence}",
            "metadata.yaml lists run_2.mcap, which does not exist",
        ]


@posix
def test_opening_a_special_file_takes_no_memory(tmp_path):
    """Each one ends at once with 100 MB of addresses more than Python with coframe has."""
    program = (
        "import resource, sys\n"
        "import coframe, coframe.robots, coframe.trajectories\n"
        "from coframe.viewer.rviz.config import RvizConfig\n"
        "used = int(open('/proc/self/statm').read().split()[0]) * resource.getpagesize()\n"
        "resource.setrlimit(resource.RLIMIT_AS, (used + (100 << 20),) * 2)\n"
        "for read in (coframe.open_bag, coframe.robots.load, coframe.trajectories.read_trajectory, RvizConfig.load):\n"
        "    for path in sys.argv[1:]:\n"
        "        try:\n"
        "            read(__import__('pathlib').Path(path))\n"
        "        except coframe.CoframeError as error:\n"
        "            print(error)\n"
    )
    if sys.platform != "linux":
        pytest.skip("reads /proc")
    paths = []
    for kind in KINDS:
        paths.append(tmp_path / f"{kind}.mcap")
        KINDS[kind].make(paths[-1])
    done = subprocess.run(
        [sys.executable, "-c", program, *map(str, paths)], capture_output=True, text=True, timeout=60, check=False
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert len(done.stdout.splitlines()) == 4 * len(KINDS)


@posix
def test_links_that_lead_to_themselves(tmp_path, monkeypatch):
    """They are neither a traceback as an output, nor as a folder of meshes, nor on the path of Python."""
    monkeypatch.chdir(tmp_path)
    recordings.write_mcap(tmp_path / "run.mcap")
    for name in ("loop", "loop.svg", "loop.mcap"):
        (tmp_path / name).symlink_to(name)
    monkeypatch.setenv("PYTHONPATH", str(tmp_path / "loop"))
    run = [sys.executable, "-m", "coframe.cli"]
    for words, sentence in (
        (["frames", "run.mcap", "-o", "loop.svg"], ""),
        (["view", "run.mcap", "--mesh-root", "loop", "-o", "out.html"], ""),
        (["bag", "info", "loop.mcap"], "loop.mcap cannot be read: Too many levels of symbolic links"),
    ):
        done = subprocess.run([*run, *words], capture_output=True, text=True, timeout=60, check=False)
        assert "Traceback" not in done.stderr
        assert sentence in done.stderr
        assert "Did you mean" not in done.stderr
