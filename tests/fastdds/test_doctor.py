# SPDX-License-Identifier: Apache-2.0
"""What `coframe doctor --system` says about Fast DDS: the libraries, the used one, and what killed processes left."""

import fcntl
from pathlib import Path

from coframe_fastdds import _fastdds as native
from coframe_fastdds import _leftovers, _libraries

from coframe.wire import selection


def test_the_used_library_and_the_reason_are_named() -> None:
    first, *others = selection.row_of("fastdds").load().describe()
    minor = ".".join(native.VERSION.split(".")[:2])
    used = Path(native.library()).resolve()
    assert first == f"Fast DDS {native.VERSION}: {used}, because coframe-fastdds was compiled for version {minor}"
    assert [str(used.parent) in line for line in others if line.endswith(": used")] == [True]


def test_libraries_are_listed_in_the_order_of_the_search(tmp_path: Path) -> None:
    for prefix, name in (("ros", "libfastrtps.so.2.14.5"), ("own", "libfastdds.so.3.6.0")):
        (tmp_path / prefix / "lib").mkdir(parents=True)
        (tmp_path / prefix / "lib" / name).touch()
        (tmp_path / prefix / "lib" / name.partition(".so")[0]).with_suffix(".so").symlink_to(name)
    environment = {"COFRAME_FASTDDS": str(tmp_path / "own"), "AMENT_PREFIX_PATH": str(tmp_path / "ros")}
    found = _libraries.libraries(environment)[:2]
    assert [(library.place, library.version) for library in found] == [
        ("COFRAME_FASTDDS", "3.6.0"),
        ("the sourced ROS 2", "2.14.5"),
    ]
    text = _libraries.lines(found[0].path, "3.6.0", environment)
    assert text[1].endswith("version 3.6.0: used")
    assert text[2].endswith("version 2.14.5: not used")


def test_files_that_killed_processes_left_are_counted(tmp_path: Path) -> None:
    abandoned, used = "fastdds_00112233445566aa", "fastdds_00112233445566bb"
    for name in (abandoned, used):
        (tmp_path / name).write_bytes(bytes(1 << 20))
        (tmp_path / f"{name}_el").touch()
    (tmp_path / "fastdds_other_el").touch()
    assert _leftovers.leftovers(tmp_path / "missing") == (0, 0)
    with (tmp_path / f"{used}_el").open() as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        assert _leftovers.leftovers(tmp_path) == (2, 1 << 20)
        assert _leftovers.line(tmp_path).startswith(f"2 files of Fast DDS in {tmp_path} (1.0 MiB) were left by")
    assert _leftovers.leftovers(tmp_path)[0] == 4
