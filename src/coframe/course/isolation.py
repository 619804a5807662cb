# SPDX-License-Identifier: Apache-2.0
"""Isolate a grade with its own network, process list and disk if the system supports them, else a ROS domain."""

from __future__ import annotations

import functools
import os
import shutil
import site
import socket
import struct
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Final

from coframe._files.temporary_folders import temporary_folder
from coframe._process.python_children import python_environment
from coframe.course._confinement import Confinement, passed_variables, protection_problem
from coframe.course.sandbox.kernel import c_function

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = [
    "bring_loopback_up",
    "is_isolated",
    "isolated_command",
    "isolated_environment",
    "isolation_problem",
    "limit_disk",
]

_VARIABLE: Final = "COFRAME_ISOLATED"  # set in processes that have their own network
# Domains for grades without their own network. The ports of domains above 101 may be used by other sockets.
_MIN_DOMAIN, _DOMAINS = 51, 50
_SIOCGIFFLAGS, _SIOCSIFFLAGS = 0x8913, 0x8914
_UP_AND_MULTICAST = 0x1 | 0x1000
_DISK_OPTIONS = b"size=256m,nr_inodes=20k"
_FLAGS = ("--net", "--ipc", "--pid", "--fork", "--kill-child", "--mount-proc")


def isolated_command(command: list[str]) -> list[str]:
    """Return a command that runs in new namespaces, or the command itself if namespaces are not available.

    When the first process of the namespaces ends, the system ends all others in them.
    """
    return [*_unshare(), *command]


def isolated_environment(number: int, home: Path) -> dict[str, str]:
    """Return the environment of a grade.

    Args:
        number: Number of the grade among those that run at the same time.
        home: The home folder of the grade.
    """
    environment = passed_variables()
    # Packages of `pip install --user` are usually in the home folder, which is replaced.
    environment["PYTHONUSERBASE"] = site.getuserbase()
    environment |= {"HOME": str(home), "TMPDIR": str(home), "ROS_LOG_DIR": str(home)}
    environment |= {"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST", "PYTHONDONTWRITEBYTECODE": "1"}
    if _unshare():
        environment[_VARIABLE] = "1"
    else:
        environment["ROS_DOMAIN_ID"] = str(_MIN_DOMAIN + (os.getpid() + number) % _DOMAINS)
    return python_environment(environment)


def isolation_problem() -> str:
    """Describe the protection that the system lacks against graded programs, or "" if protection is complete."""
    return protection_problem(has_namespaces=bool(_unshare()))


def is_isolated() -> bool:
    """Return whether this process is a grade in its own namespaces."""
    return _VARIABLE in os.environ


def bring_loopback_up() -> None:
    """Enable loopback and multicast in a newly created network namespace. Do nothing elsewhere."""
    if not is_isolated():
        return
    import fcntl  # noqa: PLC0415 - not on Windows

    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sock:
        request = struct.pack("16sh14x", b"lo", 0)
        flags = struct.unpack("16sh14x", fcntl.ioctl(sock, _SIOCGIFFLAGS, request))[1]
        fcntl.ioctl(sock, _SIOCSIFFLAGS, struct.pack("16sh14x", b"lo", flags | _UP_AND_MULTICAST))


def limit_disk(folder: Path) -> None:
    """Mount a small memory disk on a folder in newly created namespaces. Do nothing elsewhere."""
    if is_isolated():
        c_function("mount", b"coframe", os.fsencode(folder), b"tmpfs", 0, _DISK_OPTIONS)


@functools.cache
def _unshare() -> tuple[str, ...]:
    """Return the command prefix that creates namespaces; empty if that is not possible."""
    program = shutil.which("unshare", path=passed_variables().get("PATH", ""))
    if program is None or not sys.platform.startswith("linux"):
        return ()
    rights: tuple[tuple[str, ...], ...] = ((), ("--user", "--map-root-user"))
    return next((words for each in rights if _is_possible(words := (program, *each, *_FLAGS))), ())


def _is_possible(words: Sequence[str]) -> bool:
    """Return whether a process in these namespaces can start a confined program, which creates more of them."""
    with temporary_folder("coframe-check-") as name:
        folder, home = Path(name, "folder"), Path(name, "home")
        for each in (folder, home):
            each.mkdir()
        with Confinement(folder, Path(name), (), has_namespaces=True) as confinement:
            command = [*words, *confinement.command(home, "-I", "-S", "-c", "")]
            environment = confinement.environment(home)
            result = subprocess.run(  # noqa: S603 - a tool of the system, and this Python
                command, cwd=folder, env=environment, stdin=subprocess.DEVNULL, capture_output=True, check=False
            )
    return result.returncode == 0
