# SPDX-License-Identifier: Apache-2.0
"""The descendants of this process, on systems that list them in ``/proc``; elsewhere none are found."""

from __future__ import annotations

import contextlib
import ctypes
import os
import signal
import sys
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from coframe.time import SECOND

if TYPE_CHECKING:
    from collections.abc import Container, Iterable

__all__ = [
    "Process",
    "adopt_orphans",
    "children",
    "descendants",
    "kill",
    "kill_group",
    "own_memory",
    "shared_memory",
    "waiting_time",
]

_PROC = Path("/proc")
_SHARED_WITHOUT_FILE = ("/dev/zero", "/memfd:", "/SYSV", "/dev/shm")  # noqa: S108 - names in lists of mappings
_SET_CHILD_SUBREAPER = 36  # in linux/prctl.h


class Process(NamedTuple):
    """A process that has not ended, and its resident memory in bytes."""

    pid: int
    memory: int


class _Entry(NamedTuple):
    pid: int
    parent: int
    state: str
    memory: int


def adopt_orphans() -> None:
    """Become the parent of all descendants whose parents end, so that they remain descendants (Linux)."""
    if sys.platform.startswith("linux"):
        ctypes.CDLL(None).prctl(_SET_CHILD_SUBREAPER, 1, 0, 0, 0)


def children(of: int | None = None) -> list[int]:
    """Return the child processes of a process, the oldest first, or None for this process."""
    parent = os.getpid() if of is None else of
    return sorted(each.pid for each in _entries() if each.parent == parent)


def descendants(of: int | None = None, without: Container[int] = ()) -> list[Process]:
    """Return all descendants of a process, in any session and process group, the oldest generation first.

    Args:
        of: The process. None for this one.
        without: Processes to exclude, with all their descendants.
    """
    below: dict[int, list[_Entry]] = {}
    for entry in _entries():
        below.setdefault(entry.parent, []).append(entry)
    found, parents = [], [os.getpid() if of is None else of]
    while parents:
        for entry in below.get(parents.pop(0), []):
            if entry.pid in without:
                continue
            parents.append(entry.pid)
            if entry.state != "Z":
                found.append(Process(entry.pid, entry.memory))
    return found


def waiting_time(pid: int) -> float:
    """Return how long a process has waited for a processor, in seconds: the maximum of its threads.

    It is 0 if the system does not measure it.
    """
    longest = 0
    with contextlib.suppress(OSError, ValueError, IndexError):  # The process or one of its threads has ended.
        for file in (_PROC / str(pid) / "task").glob("*/schedstat"):
            longest = max(longest, int(file.read_text().split()[1]))
    return longest / SECOND


def shared_memory(processes: Iterable[Process]) -> int:
    """Return the sizes of anonymous shared memory of processes, each once, in bytes.

    Unused parts are not included in their resident memory, but exist as long as a process can use them.
    """
    sizes: dict[str, int] = {}
    for each in processes:
        with contextlib.suppress(OSError, ValueError):  # The process has ended.
            for line in (_PROC / str(each.pid) / "maps").read_text(errors="replace").splitlines():
                fields = line.split(None, 5)
                if fields[1].endswith("s") and fields[5:] and fields[5].startswith(_SHARED_WITHOUT_FILE):
                    first, last = (int(number, 16) for number in fields[0].split("-"))
                    size = int(fields[2], 16) + last - first  # the mapping may start in the middle
                    sizes[fields[4]] = max(size, sizes.get(fields[4], 0))
    return sum(sizes.values())


def own_memory() -> int:
    """Return the resident memory of this process in bytes, or 0 if the system does not list it."""
    return next((each.memory for each in _entries() if each.pid == os.getpid()), 0)


def kill(pid: int) -> None:
    """Kill a process that may have ended; reap it if it was adopted."""
    with contextlib.suppress(OSError):
        os.kill(pid, signal.SIGKILL if os.name == "posix" else signal.SIGTERM)
    if os.name == "posix":
        with contextlib.suppress(ChildProcessError):
            os.waitpid(pid, os.WNOHANG)


def kill_group(group: int) -> None:
    """Kill a process group that may have ended."""
    if os.name == "posix":
        with contextlib.suppress(OSError):
            os.killpg(group, signal.SIGKILL)


def _entries() -> list[_Entry]:
    """Return all processes that are listed."""
    if not _PROC.is_dir():
        return []
    page = os.sysconf("SC_PAGE_SIZE")
    found = []
    for folder in _PROC.iterdir():
        if not folder.name.isdecimal():
            continue
        try:
            # The command name in parentheses may contain spaces and parentheses.
            fields = (folder / "stat").read_text(errors="replace").rpartition(")")[2].split()
        except OSError:  # The process has ended.
            continue
        found.append(_Entry(int(folder.name), int(fields[1]), fields[0], int(fields[21]) * page))
    return found
