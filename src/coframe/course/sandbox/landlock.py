# SPDX-License-Identifier: Apache-2.0
"""Restrict file access of a process with Landlock (Linux 5.13 or newer), which needs no privileges."""

from __future__ import annotations

import os
import struct
import sys
from contextlib import suppress
from typing import TYPE_CHECKING, Final

from .kernel import system_call

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["landlock_version", "restrict_files", "scopes_signals"]

# Kernel interface of Landlock from linux/landlock.h; the system call numbers are the same on all architectures.
_CREATE_RULESET, _ADD_RULE, _RESTRICT_SELF = 444, 445, 446
_VERSION_FLAG, _PATH_BENEATH = 1, 1
_RIGHTS: Final = {
    1: 0x1FFF,
    2: 0x3FFF,
    3: 0x7FFF,
    5: 0xFFFF,
}  # all file access rights, by the version that introduced them
_EXECUTE, _WRITE_FILE, _READ_FILE, _LIST_FOLDER = 0x1, 0x2, 0x4, 0x8
_SCOPES: Final = 0x1 | 0x2  # abstract sockets, and signals to processes outside, from version 6 on
_FIRST_WITH_SCOPES = 6


def landlock_version() -> int:
    """Return the Landlock version of the kernel, or 0 if it is not supported."""
    if not sys.platform.startswith("linux"):
        return 0
    try:
        return system_call(_CREATE_RULESET, None, 0, _VERSION_FLAG)
    except OSError:
        return 0


def scopes_signals() -> bool:
    """Return whether Landlock blocks signals to outside processes."""
    return landlock_version() >= _FIRST_WITH_SCOPES


def restrict_files(
    readable: Iterable[str], hidden_paths: Iterable[str], home: str, *, visible_paths: Iterable[str] = ()
) -> None:
    """Restrict this process and its children so that they can write only in the home folder.

    Args:
        readable: Folders and files that can be read and executed.
        hidden_paths: Paths below these folders that cannot be read; only their names can be listed.
        home: The home folder.
        visible_paths: The hidden folders that are replaced by something else.
    """
    version = landlock_version()
    rights = _RIGHTS[max(first for first in _RIGHTS if first <= version)]
    content = struct.pack("QQQ", rights, 0, _SCOPES if version >= _FIRST_WITH_SCOPES else 0)
    ruleset = system_call(_CREATE_RULESET, content, len(content), 0)
    hidden_paths = frozenset(hidden_paths)
    above_hidden = {folder for path in hidden_paths for folder in _folders_above(path)}
    for path in readable:
        _allow_reading(ruleset, path, hidden_paths, above_hidden)
    for path in visible_paths:
        _allow(ruleset, path, _READ_FILE | _LIST_FOLDER)
    _allow(ruleset, home, rights)
    _allow(ruleset, os.devnull, _READ_FILE | _WRITE_FILE)
    system_call(_RESTRICT_SELF, ruleset, 0)
    os.close(ruleset)


def _folders_above(path: str) -> Iterable[str]:
    while (above := path.rpartition("/")[0]) and above != path:
        yield above
        path = above


def _allow_reading(ruleset: int, path: str, hidden_paths: frozenset[str], above_hidden: set[str]) -> None:
    """Allow reading a file, or everything below a folder except hidden paths.

    Landlock has no deny rules, so a folder above hidden files is replaced by its entries.
    """
    if path in hidden_paths:
        return
    if path not in above_hidden:
        is_folder = os.path.isdir(path)  # noqa: PTH112 - without other imports
        _allow(ruleset, path, _EXECUTE | _READ_FILE | (_LIST_FOLDER if is_folder else 0))
        return
    _allow(ruleset, path, _LIST_FOLDER)
    with suppress(OSError), os.scandir(path) as entries:
        for entry in entries:
            if not entry.is_symlink():  # Its target has its own rules.
                _allow_reading(ruleset, entry.path, hidden_paths, above_hidden)


def _allow(ruleset: int, path: str, rights: int) -> None:
    """Grant rights on a file, or on everything below a folder. Do nothing if it does not exist."""
    with suppress(OSError):
        file = os.open(path, os.O_PATH | os.O_CLOEXEC)
        try:
            system_call(_ADD_RULE, ruleset, _PATH_BENEATH, struct.pack("=Qi", rights, file), 0)
        finally:
            os.close(file)
