# SPDX-License-Identifier: Apache-2.0
"""Commands whose output cannot be written as usual: other encodings, closed pipes, full disks, no temporary folder."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
import recordings

from coframe.course._view import view_of
from coframe.wire.dds.library import places
from coframe.workspace.packages.folders import existing_folders

FULL_DISK = Path("/dev/full")
UNREADABLE = "/" + 300 * "x"  # Looking it up is an error, as with a folder that the user may not read.


@pytest.fixture(scope="module")
def bag(tmp_path_factory):
    return recordings.write_mcap(tmp_path_factory.mktemp("bag") / "run.mcap")


def command(*words, **options):
    return [sys.executable, "-m", "coframe.cli", *map(str, words)], {"stderr": subprocess.PIPE, "text": True, **options}


def test_trees_are_drawn_in_any_encoding(bag):
    words, options = command("frames", bag, env={**os.environ, "PYTHONIOENCODING": "ascii"})
    done = subprocess.run(words, stdout=subprocess.PIPE, check=False, **options)
    assert (done.returncode, done.stderr) == (0, "")
    assert "`- " in done.stdout


@pytest.mark.skipif(not FULL_DISK.exists(), reason="needs a device that is always full")
@pytest.mark.parametrize("words", [["--help"], ["trajectory", "odom", "base"]])
def test_a_full_disk_is_reported_in_one_sentence(bag, words):
    words, options = command(*words[:1], *([] if words == ["--help"] else [bag]), *words[1:])
    with FULL_DISK.open("w") as output:
        done = subprocess.run(words, stdout=output, check=False, **options)
    assert done.returncode == 1
    assert done.stderr.startswith("coframe: ")
    assert done.stderr.endswith("No space left on device\n  Free some space, or write to another disk.\n")
    assert done.stderr.count("\n") == 2


@pytest.mark.skipif(os.name != "posix", reason="Windows reports a closed pipe as an invalid argument")
@pytest.mark.parametrize("name", ["--help", "frames"])
def test_a_closed_pipe_is_not_an_error(bag, name):
    words, options = command(name, *([bag] if name == "frames" else []))
    process = subprocess.Popen(words, stdout=subprocess.PIPE, **options)
    process.stdout.close()
    assert process.stderr.read() == ""
    process.stderr.close()
    process.wait(60)


CLOSED = [(0,), (1,), (2,), (0, 1, 2)]


def run_with_closed(descriptors, words, **options):
    """Run a command without some of its standard streams, as a shell does with ``>&-``."""

    def close():
        for number in descriptors:
            os.close(number)

    return subprocess.run(words, stdout=subprocess.PIPE, check=False, preexec_fn=close, **options)


@pytest.mark.skipif(os.name != "posix", reason="Windows has no closed streams")
@pytest.mark.parametrize("closed", CLOSED)
@pytest.mark.parametrize(
    ("words", "code"),
    [
        (["frames", "BAG"], 0),
        pytest.param(["bag", "info", "BAG"], 0, marks=pytest.mark.slow),
        pytest.param(["doctor", "BAG"], 0, marks=pytest.mark.slow),
        (["trajectory", "BAG", "odom", "base"], 0),
        (["doctor", "absent.mcap"], 1),
        (["--no-such-option"], 2),
    ],
)
def test_closed_streams(bag, tmp_path, words, code, closed):
    words, options = command(*[bag if word == "BAG" else word for word in words], cwd=tmp_path)
    done = run_with_closed(closed, words, **options)
    assert (done.returncode, "Traceback" in done.stderr) == (code, False), done.stderr
    assert bool(done.stdout) == (code == 0 and 1 not in closed)
    assert bool(done.stderr) == (code != 0 and 2 not in closed)


@pytest.mark.skipif(os.name != "posix", reason="Windows has no closed streams")
def test_no_file_gets_the_descriptor_of_a_closed_stream(tmp_path):
    """What native code and child processes print would otherwise be written into the file."""
    script = "import os, subprocess, sys; from coframe.cli import streams; streams.replace_closed_streams()\n"
    script += f"file = open({str(tmp_path / 'file')!r}, 'w')\n"
    script += (
        "os.write(1, b'native'); os.write(2, b'native'); subprocess.run(['sh', '-c', 'echo child; echo child >&2'])"
    )
    done = run_with_closed((0, 1, 2), [sys.executable, "-c", script])
    assert done.returncode == 0
    assert (tmp_path / "file").read_bytes() == b""


@pytest.mark.skipif(os.name != "posix", reason="Windows has no arguments in bytes")
@pytest.mark.parametrize(
    ("words", "code"),
    [
        (["frames", b"--prefix=\xff/"], 2),
        (["bag", "fix", "run.mcap", b"\xff"], 2),
        (["echo", "a", b"\xff"], 2),
        (["frames", b"\xff.mcap"], 0),
        (["frames", b"--output=f\xff/out.svg", "run.mcap"], 0),
    ],
)
def test_arguments_that_are_not_text_are_refused_unless_they_are_paths(bag, tmp_path, words, code):
    if sys.platform == "darwin" and code == 0:
        pytest.skip("its file systems have no such names")
    (tmp_path / "run.mcap").write_bytes(bag.read_bytes())
    if code == 0:
        Path(os.fsdecode(os.fsencode(tmp_path) + b"/\xff.mcap")).write_bytes(bag.read_bytes())
        Path(os.fsdecode(os.fsencode(tmp_path) + b"/f\xff")).mkdir()
    done = subprocess.run([sys.executable, "-m", "coframe.cli", *words], capture_output=True, cwd=tmp_path, check=False)
    assert (done.returncode, b"Traceback" in done.stderr) == (code, False), done.stderr
    assert (b"is not valid UTF-8" in done.stderr) == (code == 2)


def test_a_missing_temporary_folder_is_reported(tmp_path):
    script = "import tempfile; tempfile._candidate_tempdir_list = lambda: ['/absent']\n"
    script += f"from coframe.cli import run; run(['lab', 'check', {str(tmp_path)!r}])"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert done.stderr.startswith("coframe: No usable temporary directory found in ")
    assert done.stderr.endswith("\n  Set TMPDIR to a folder with write permission.\n")


def test_unreadable_folders_on_search_paths_are_skipped(monkeypatch):
    for name in ("PATH", "PYTHONPATH", "AMENT_PREFIX_PATH", "COFRAME_PACKAGE_PATH"):
        monkeypatch.setenv(name, os.pathsep.join([UNREADABLE, os.environ.get(name, "")]))
    words, options = command("--version")
    assert subprocess.run(words, stdout=subprocess.PIPE, check=False, **options).stderr == ""
    assert UNREADABLE not in dict(view_of(Path(), [], []).entries)
    assert Path(UNREADABLE) not in set(existing_folders("AMENT_PREFIX_PATH"))
    assert list(places({"LD_LIBRARY_PATH": UNREADABLE, "AMENT_PREFIX_PATH": UNREADABLE}))
