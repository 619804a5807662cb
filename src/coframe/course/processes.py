# SPDX-License-Identifier: Apache-2.0
"""The processes of a session, where the system lists them in ``/proc``; elsewhere none are found."""

from __future__ import annotations

import contextlib
import os
import signal
from pathlib import Path
from typing import NamedTuple

__all__ = ["Process", "in_session", "kill", "kill_group"]

_PROC = Path("/proc")


class Process(NamedTuple):
    """A process, and its resident memory in bytes."""

    pid: int
    memory: int


def in_session(session: int) -> list[Process]:
    """Return the processes of a session, also those whose parents have ended."""
    if not _PROC.is_dir():
        return []
    page = os.sysconf("SC_PAGE_SIZE")
    found = []
    for folder in _PROC.iterdir():
        if not folder.name.isdecimal():
            continue
        try:
            # The name of the command, in parentheses, may itself contain spaces and parentheses.
            fields = (folder / "stat").read_text(errors="replace").rpartition(")")[2].split()
        except OSError:  # The process has ended.
            continue
        state, session_id, pages = fields[0], int(fields[3]), int(fields[21])
        if session_id == session and state != "Z":
            found.append(Process(int(folder.name), pages * page))
    return found


def kill(pid: int) -> None:
    """Kill a process that may have ended."""
    with contextlib.suppress(OSError):
        os.kill(pid, signal.SIGKILL if os.name == "posix" else signal.SIGTERM)


def kill_group(group: int) -> None:
    """Kill a process group that may have ended."""
    if os.name == "posix":
        with contextlib.suppress(OSError):
            os.killpg(group, signal.SIGKILL)
