# SPDX-License-Identifier: Apache-2.0
"""A separate root folder for a program, which contains only the files that it may access."""

from __future__ import annotations

import os
from contextlib import suppress
from typing import TYPE_CHECKING

from .kernel import c_function, system_call

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

__all__ = ["DEVICES", "enter_own_root"]

DEVICES = ("/dev/full", "/dev/null", "/dev/random", "/dev/urandom", "/dev/zero")
_DEVICE_LINKS = {"fd": "", "stdin": "/0", "stdout": "/1", "stderr": "/2"}
# sys/mount.h
_READ_ONLY, _NO_SET_ID, _NO_DEVICES, _NO_PROGRAMS = 1, 2, 4, 8
_REMOUNT, _BIND, _RECURSIVE, _PRIVATE = 32, 4096, 16384, 1 << 18
_OPTIONS = {"ro": 1, "nosuid": 2, "nodev": 4, "noexec": 8, "noatime": 1024, "nodiratime": 2048, "relatime": 1 << 21}
_MOUNT_INFO = "/proc/self/mountinfo"
_PIVOT_ROOT = {"x86_64": 155}
_PIVOT_ROOT_ELSEWHERE = 41
_DETACH = 2
_SMALL_DISK = b"size=1m,mode=755"


def enter_own_root(
    root: str,
    entries: Iterable[tuple[str, bool]],
    links: Iterable[tuple[str, str]],
    decoys: Mapping[str, str],
    home: str,
) -> None:
    """Create a root folder and enter it. This process must have its own mount and process namespaces.

    Args:
        root: An empty folder.
        entries: Paths, sorted, and whether each can be read; the contents of the others do not exist, except for
            entries below them.
        links: Symbolic links, and their targets.
        decoys: Replacements for folders that cannot be read.
        home: The only writable folder.

    Raises:
        OSError: The system does not allow it.
    """
    _mount(None, "/", None, _RECURSIVE | _PRIVATE)
    _mount(b"coframe", root, b"tmpfs", 0, _SMALL_DISK)
    for path, is_readable in entries:
        if is_readable or path in decoys:
            _bind(path if is_readable else decoys[path], root + path)
        elif os.path.isdir(path):  # noqa: PTH112 - without other imports
            _mount(b"coframe", root + path, b"tmpfs", 0, _SMALL_DISK)
        else:
            _bind(os.devnull, root + path)
    for path, target in links:
        with suppress(OSError):  # It already exists in one of the folders above.
            os.makedirs(os.path.dirname(root + path), exist_ok=True)  # noqa: PTH103, PTH120
            os.symlink(target, root + path)  # noqa: PTH211
    for device in DEVICES:
        _bind(device, root + device)
    for name, descriptor in _DEVICE_LINKS.items():
        os.symlink(f"/proc/self/fd{descriptor}", f"{root}/dev/{name}")  # noqa: PTH211
    for folder in (home, "/proc"):
        os.makedirs(root + folder, exist_ok=True)  # noqa: PTH103
    _restrict(root, _READ_ONLY | _NO_SET_ID)
    _bind(home, root + home)
    _restrict(root + home, _NO_SET_ID | _NO_DEVICES)
    _mount(b"proc", root + "/proc", b"proc", _READ_ONLY | _NO_SET_ID | _NO_DEVICES | _NO_PROGRAMS)
    os.chdir(root)
    system_call(_PIVOT_ROOT.get(os.uname().machine, _PIVOT_ROOT_ELSEWHERE), b".", b".")
    c_function("umount2", b".", _DETACH)
    os.chdir("/")


def _bind(source: str, target: str) -> None:
    """Bind-mount a file, or a folder with its submounts, at another path."""
    if os.path.isdir(source):  # noqa: PTH112 - without other imports
        os.makedirs(target, exist_ok=True)  # noqa: PTH103
    elif not os.path.lexists(target):
        os.makedirs(os.path.dirname(target), exist_ok=True)  # noqa: PTH103, PTH120
        os.close(os.open(target, os.O_CREAT | os.O_EXCL | os.O_CLOEXEC, 0o444))
    _mount(os.fsencode(source), target, None, _BIND | _RECURSIVE)


def _mount(source: bytes | None, target: str, kind: bytes | None, flags: int, options: bytes | None = None) -> None:
    c_function("mount", source, os.fsencode(target), kind, flags, options)


def _restrict(folder: str, flags: int) -> None:
    """Add flags to all mounts at or below a folder."""
    with open(_MOUNT_INFO, "rb") as mounted:  # noqa: PTH123 - without other imports
        lines = [line.split() for line in mounted]
    for fields in lines:
        path = os.fsdecode(fields[4].decode("unicode_escape").encode("latin-1"))  # spaces are escaped as octal numbers
        if path == folder or path.startswith(folder + "/"):
            # In an unprivileged namespace, flags of outer mounts cannot be removed.
            kept = sum(_OPTIONS.get(option, 0) for option in fields[5].decode().split(","))
            _mount(None, path, None, _REMOUNT | _BIND | kept | flags)
