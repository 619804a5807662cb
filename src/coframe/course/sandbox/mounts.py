# SPDX-License-Identifier: Apache-2.0
"""A root folder of its own for a program, in which nothing exists but what it may see (Linux 5.12 or newer)."""

from __future__ import annotations

import os
import struct
from contextlib import suppress
from typing import TYPE_CHECKING

from .kernel import c_function, system_call

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

__all__ = ["DEVICES", "enter_own_root"]

DEVICES = ("/dev/full", "/dev/null", "/dev/random", "/dev/urandom", "/dev/zero")
_DEVICE_LINKS = {"fd": "", "stdin": "/0", "stdout": "/1", "stderr": "/2"}
# sys/mount.h and linux/mount.h
_READ_ONLY, _NO_SET_ID, _NO_DEVICES, _NO_PROGRAMS, _BIND, _RECURSIVE, _PRIVATE = 1, 2, 4, 8, 4096, 16384, 1 << 18
_SET_ATTRIBUTES = 442  # mount_setattr, on all processors
_AT_CURRENT, _AT_RECURSIVE = -100, 0x8000
_PIVOT_ROOT = {"x86_64": 155, "aarch64": 41}
_DETACH = 2
_SMALL = b"size=1m,mode=755"


def enter_own_root(
    root: str,
    entries: Iterable[tuple[str, bool]],
    links: Iterable[tuple[str, str]],
    decoys: Mapping[str, str],
    home: str,
) -> None:
    """Make a root folder and go there; this process must have namespaces of its own for mounts and processes.

    Args:
        root: An empty folder.
        entries: Paths, sorted, and whether each can be read; the contents of the others do not exist, except for
            entries below them.
        links: Symbolic links, and their targets.
        decoys: A folder to show in place of one that cannot be read.
        home: The only folder in which files can be changed.

    Raises:
        OSError: The system does not allow it.
    """
    _mount(None, "/", None, _RECURSIVE | _PRIVATE)
    _mount(b"coframe", root, b"tmpfs", 0, _SMALL)
    for path, is_readable in entries:
        if is_readable or path in decoys:
            _bind(path if is_readable else decoys[path], root + path)
        elif os.path.isdir(path):  # noqa: PTH112 - without other imports
            _mount(b"coframe", root + path, b"tmpfs", 0, _SMALL)
        else:
            _bind(os.devnull, root + path)
    for path, target in links:
        with suppress(OSError):  # It exists in one of the folders above.
            os.makedirs(os.path.dirname(root + path), exist_ok=True)  # noqa: PTH103, PTH120
            os.symlink(target, root + path)  # noqa: PTH211
    for device in DEVICES:
        _bind(device, root + device)
    for name, descriptor in _DEVICE_LINKS.items():
        os.symlink(f"/proc/self/fd{descriptor}", f"{root}/dev/{name}")  # noqa: PTH211
    for folder in (home, "/proc"):
        os.makedirs(root + folder, exist_ok=True)  # noqa: PTH103
    _set_attributes(root, _READ_ONLY | _NO_SET_ID)
    _bind(home, root + home)
    _set_attributes(root + home, _NO_SET_ID | _NO_DEVICES)
    _mount(b"proc", root + "/proc", b"proc", _READ_ONLY | _NO_SET_ID | _NO_DEVICES | _NO_PROGRAMS)
    os.chdir(root)
    system_call(_PIVOT_ROOT[os.uname().machine], b".", b".")
    c_function("umount2", b".", _DETACH)
    os.chdir("/")


def _bind(source: str, target: str) -> None:
    """Make a file, or a folder with all that is mounted in it, visible at another place."""
    if os.path.isdir(source):  # noqa: PTH112 - without other imports
        os.makedirs(target, exist_ok=True)  # noqa: PTH103
    elif not os.path.lexists(target):
        os.makedirs(os.path.dirname(target), exist_ok=True)  # noqa: PTH103, PTH120
        os.close(os.open(target, os.O_CREAT | os.O_EXCL | os.O_CLOEXEC, 0o444))
    _mount(os.fsencode(source), target, None, _BIND | _RECURSIVE)


def _mount(source: bytes | None, target: str, kind: bytes | None, flags: int, options: bytes | None = None) -> None:
    c_function("mount", source, os.fsencode(target), kind, flags, options)


def _set_attributes(target: str, attributes: int) -> None:
    content = struct.pack("QQQQ", attributes, 0, 0, 0)
    system_call(_SET_ATTRIBUTES, _AT_CURRENT, os.fsencode(target), _AT_RECURSIVE, content, len(content))
