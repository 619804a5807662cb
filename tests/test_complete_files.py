# SPDX-License-Identifier: Apache-2.0
"""Output files are complete or do not appear, also on a full disk."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

import coframe
from coframe._files.complete_files import complete_or_absent, write_complete
from coframe.bags import Writer
from coframe.messages import find, serialize

# A limit on the size of files has the same effect as a full disk, and needs no mounted file system.
_WITH_SMALL_FILES = """
import resource, signal, sys
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (300, 300))
from coframe.cli import main
sys.argv = ["coframe", *sys.argv[1:]]
main()
"""


@pytest.fixture(scope="module")
def bag(tmp_path_factory):
    path = tmp_path_factory.mktemp("recording") / "run"
    message, stamped = find("tf2_msgs/msg/TFMessage"), find("geometry_msgs/msg/TransformStamped")
    with Writer(path) as writer:
        topic = writer.add_topic("/tf", "tf2_msgs/msg/TFMessage")
        for second in (1, 2, 3):
            moved = stamped(child_frame_id="base_link")
            moved.header.frame_id = "odom"
            moved.header.stamp.sec = second
            moved.transform.rotation.w = 1.0
            writer.write(topic, serialize(message(transforms=[moved])), second * 1_000_000_000)
    return path


def test_an_error_keeps_the_earlier_file(tmp_path):
    file = tmp_path / "out.txt"
    write_complete(file, b"first")

    def write_and_be_interrupted():
        with complete_or_absent(file) as part:
            part.write_bytes(b"sec")
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        write_and_be_interrupted()
    assert file.read_bytes() == b"first"
    assert list(tmp_path.iterdir()) == [file]


def test_two_writers_of_one_file_do_not_disturb_each_other(tmp_path):
    file = tmp_path / "out.txt"
    with complete_or_absent(file) as earlier:
        earlier.write_bytes(b"earlier")
        write_complete(file, b"between")
        assert file.read_bytes() == b"between"
    assert file.read_bytes() == b"earlier"
    assert list(tmp_path.iterdir()) == [file]


def test_an_error_names_the_file_itself(tmp_path):
    file = tmp_path / "missing" / "out.txt"
    with pytest.raises(FileNotFoundError) as caught:
        write_complete(file, b"text")
    assert caught.value.filename == str(file)
    assert ".part" not in str(caught.value)


@pytest.mark.skipif(sys.platform == "win32", reason="symbolic links need a privilege")
def test_a_symbolic_link_stays(tmp_path):
    (tmp_path / "real.txt").write_text("first")
    (tmp_path / "link.txt").symlink_to("real.txt")
    write_complete(tmp_path / "link.txt", b"second")
    assert (tmp_path / "link.txt").is_symlink()
    assert (tmp_path / "real.txt").read_text() == "second"


@pytest.mark.skipif(not Path("/dev/null").exists(), reason="there are no such devices")
def test_a_device_is_written_directly():
    write_complete("/dev/null", b"text")
    assert not Path("/dev/null").is_file()


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no limit on the size of files")
@pytest.mark.parametrize(
    ("name", "command"),
    [
        ("out.svg", ("frames", "BAG", "-o", "OUT")),
        ("out.png", ("frames", "BAG", "-o", "OUT")),
        ("out.html", ("plot", "BAG", "odom:base_link.x", "-o", "OUT")),
    ],
)
def test_a_picture_that_does_not_fit_leaves_the_earlier_one(bag, tmp_path, name, command):
    if name.endswith(".png"):
        pytest.importorskip("matplotlib")
    out = tmp_path / "pictures" / name
    out.parent.mkdir()
    out.write_text("earlier")
    words = [word.replace("BAG", str(bag)).replace("OUT", str(out)) for word in command]
    done = subprocess.run(
        [sys.executable, "-c", _WITH_SMALL_FILES, *words],
        env={**os.environ, "COLUMNS": "300", "PYTHONDONTWRITEBYTECODE": "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 1
    assert done.stderr.startswith(f"coframe: {out} cannot be written: File too large\n")
    assert out.read_text() == "earlier"
    assert list(out.parent.iterdir()) == [out]


def test_plots_with_a_read_only_home_print_nothing_of_matplotlib(tmp_path):
    pytest.importorskip("matplotlib")
    # A file instead of a folder: not writable, also for root.
    (tmp_path / "home").write_text("")
    home = str(tmp_path / "home")
    environment = {key: value for key, value in os.environ.items() if not key.startswith(("XDG_", "MPL"))}
    code = "from coframe.plotting.image import check_installed; check_installed(); import matplotlib.font_manager"
    done = subprocess.run(
        [sys.executable, "-c", code],
        env={**environment, "HOME": home, "USERPROFILE": home},
        capture_output=True,
        text=True,
        check=True,
    )
    assert done.stderr == ""


def test_the_lab_leaves_no_folder_with_some_of_its_files(tmp_path, monkeypatch):
    from coframe.course import folders

    def full(path, content):
        if path.name != "README.md":
            raise OSError(28, "No space left on device", str(path))
        write_complete(path, content)

    monkeypatch.setattr(folders, "write_complete", full)
    with pytest.raises(coframe.CourseError, match="No space left on device"):
        folders.create_folder(tmp_path / "lab", None)
    assert not any((tmp_path / "lab").iterdir())
