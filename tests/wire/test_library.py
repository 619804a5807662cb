# SPDX-License-Identifier: Apache-2.0
"""Where the DDS library is searched, which one is used, and what is said about those that cannot be."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import coframe._core
from coframe.wire.dds import library

LOAD = """
from coframe.errors import WireError
from coframe.wire.dds import library
try:
    found = library.load()
    print(found.place.source, "|", found.place.path, "|", *found.rejected)
except WireError as error:
    print(error, error.hint)
"""


def load_in_a_process(code: str = "", **environment: str) -> str:
    """Load the library in a new process, after `code`; return its source, its path and rejected ones, or the error."""
    clean = {name: value for name, value in os.environ.items() if name != library.VARIABLE}
    command = [sys.executable, "-c", code + LOAD]
    return subprocess.run(command, capture_output=True, text=True, check=True, env={**clean, **environment}).stdout


@pytest.fixture
def usable() -> Path:
    return library.load().place.path


def test_the_variable_comes_first(usable, tmp_path):
    copy = tmp_path / "libddsc.so"
    copy.symlink_to(usable)
    assert load_in_a_process(COFRAME_DDS_LIBRARY=str(copy)).startswith(f"COFRAME_DDS_LIBRARY | {copy} |")
    assert load_in_a_process(COFRAME_DDS_LIBRARY=str(tmp_path)).startswith(f"COFRAME_DDS_LIBRARY | {copy} |")


def test_the_order_of_the_places(tmp_path, monkeypatch):
    ros = tmp_path / "ros" / "lib"
    bundled = tmp_path / "bundled"
    for folder in (ros, bundled):
        folder.mkdir(parents=True)
        (folder / "libddsc.so.0.10.5").touch()
    monkeypatch.setattr(library, "BUNDLED", bundled)
    found = list(library.places({"AMENT_PREFIX_PATH": str(ros.parent)}))
    assert [place.source for place in found] == [
        "the cyclonedds package",
        "coframe's own wheel",
        "the sourced ROS 2",
        "the system",
    ]
    if sys.platform == "linux":
        assert [place.path for place in found[1:3]] == [bundled / "libddsc.so.0.10.5", ros / "libddsc.so.0.10.5"]
        assert found[2].version == "0.10.5"


@pytest.mark.skipif(sys.platform != "linux", reason="file names of Linux")
def test_the_newest_version_in_a_folder(tmp_path):
    for name in ("libddsc.so.0.9.1", "libddsc.so.0.10.2", "libddsc.so.0.10.10", "libdds_security_ac.so"):
        (tmp_path / name).touch()
    (tmp_path / "libddsc.so.0debian").symlink_to("libddsc.so.0.10.2")
    [place] = library.places({library.VARIABLE: str(tmp_path)})
    assert (place.path, place.version) == (tmp_path / "libddsc.so.0.10.10", "0.10.10")


@pytest.mark.parametrize(
    ("name", "version"),
    [
        ("libddsc.so.0.10.2", "0.10.2"),
        ("libddsc-ad12c33a.so.11.0.1", "11.0.1"),
        ("libddsc.so", ""),
        ("libddsc.11.0.1.dylib", "11.0.1"),
        ("libddsc.dylib", ""),
        ("ddsc-9f8e.dll", ""),
    ],
)
def test_versions_in_file_names(name, version):
    assert library.file_version(Path(name)) == version


def test_a_missing_file():
    text = load_in_a_process(COFRAME_DDS_LIBRARY="/absent/libddsc.so")
    assert text.startswith("The DDS library /absent/libddsc.so in COFRAME_DDS_LIBRARY does not exist.")
    assert "Unset COFRAME_DDS_LIBRARY to search the usual places." in text


def test_a_library_of_another_release(tmp_path, usable):
    shutil.copy(usable.resolve(), tmp_path / "libddsc.so.12.1.0")
    [place] = library.places({library.VARIABLE: str(tmp_path / "libddsc.so.12.1.0")})
    assert place.version == "12.1.0"
    text = load_in_a_process(COFRAME_DDS_LIBRARY=str(tmp_path / "libddsc.so.12.1.0"))
    assert f"The DDS library {tmp_path}/libddsc.so.12.1.0 (version 12.1.0, from COFRAME_DDS_LIBRARY)" in text
    assert (
        "cannot be used because it has an incompatible binary interface. coframe supports Cyclone DDS 0.10 and 11."
        in text
    )


def test_a_library_without_the_functions(tmp_path):
    other = tmp_path / "libddsc.so"
    shutil.copy(coframe._core.__file__, other)
    text = load_in_a_process(COFRAME_DDS_LIBRARY=str(other))
    assert f"The DDS library {other} (from COFRAME_DDS_LIBRARY) cannot be used because it has no function dds_" in text


def test_a_file_that_is_not_a_library_is_passed_over(tmp_path, usable):
    """The next place is used, and the rejected library is remembered for `coframe doctor --system`."""
    (tmp_path / "libddsc.so").write_text("not a library")
    (tmp_path / "ddsc.dll").write_text("not a library")
    (tmp_path / "libddsc.dylib").write_text("not a library")
    code = (
        "from pathlib import Path; from coframe.wire.dds import library\n"
        "library._of_package = lambda: library.Place('the cyclonedds package', 'not installed', None)\n"
        f"library.BUNDLED = Path({str(tmp_path)!r})\n"
        f"library._system_folders = lambda environment: [Path({str(usable.parent)!r})]\n"
    )
    text = load_in_a_process(code)
    assert text.startswith("the system | ")
    assert "from coframe's own wheel) cannot be used because it cannot be loaded (" in text


def test_without_any_library():
    """Everything that needs no network still works."""
    code = (
        "import coframe; from coframe.wire.dds import library\n"
        "library._of_package = lambda: library.Place('the cyclonedds package', 'not installed', None)\n"
        "library._system_folders = lambda environment: []\n"
        "tree = coframe.Buffer(); tree.set('a', 'b', coframe.Transform(), static=True); tree.lookup('a', 'b')\n"
    )
    text = load_in_a_process(code)
    assert "Joining the ROS graph requires the DDS library libddsc, which is not installed." in text
    assert "Use one of these options: " in text
    assert ("pip install 'coframe[dds]'" in text) == library._package_has_wheels()
    assert ("apt-get install libddsc0" in text) == (sys.platform == "linux")
