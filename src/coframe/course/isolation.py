# SPDX-License-Identifier: Apache-2.0
"""A network, a process list and a disk of its own for a grade, where the system can give them; else a ROS domain."""

from __future__ import annotations

import ctypes
import functools
import os
import shutil
import site
import socket
import struct
import subprocess
import sys
from typing import TYPE_CHECKING, Final

from coframe.course.limits import landlock_version

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["PASSED", "bring_loopback_up", "isolated_command", "isolated_environment", "isolation_problem", "limit_disk"]

# Variables of the teacher that a grade may see. All others may contain secrets.
PASSED: Final = (
    "AMENT_PREFIX_PATH",
    "COFRAME_ISOLATED",
    "CYCLONEDDS_URI",
    "DYLD_LIBRARY_PATH",
    "LANG",
    "LD_LIBRARY_PATH",
    "PATH",
    "PATHEXT",
    "PYTHONPATH",
    "PYTHONUSERBASE",
    "RMW_IMPLEMENTATION",
    "ROS_AUTOMATIC_DISCOVERY_RANGE",
    "ROS_DISTRO",
    "ROS_DOMAIN_ID",
    "ROS_LOCALHOST_ONLY",
    "SYSTEMROOT",
    "TEMP",
    "TMP",
    "USERPROFILE",
    "VIRTUAL_ENV",
)

_VARIABLE: Final = "COFRAME_ISOLATED"  # set in processes that have a network of their own
# Domains for grades without a network of their own. The ports of those above 101 may be in use by other sockets.
_LOWEST_DOMAIN, _DOMAINS = 51, 50
_SIOCGIFFLAGS, _SIOCSIFFLAGS = 0x8913, 0x8914
_UP_AND_MULTICAST = 0x1 | 0x1000
_DISK = b"size=256m,nr_inodes=20k"
_FLAGS = ("--net", "--pid", "--fork", "--kill-child", "--mount-proc")


def isolated_command(command: list[str]) -> list[str]:
    """Return a command that runs in namespaces of its own; the command itself where there are none.

    When the first process of the namespaces ends, the system ends all others in them.
    """
    return [*_unshare(), *command]


def isolated_environment(number: int, home: Path) -> dict[str, str]:
    """Return the environment of a grade.

    Args:
        number: Number of the grade among those that run at the same time.
        home: The home folder of the grade.
    """
    environment = {name: os.environ[name] for name in PASSED if name in os.environ}
    # The packages of `pip install --user` are usually below the home folder, which is another one.
    environment["PYTHONUSERBASE"] = site.getuserbase()
    environment |= {"HOME": str(home), "TMPDIR": str(home), "ROS_LOG_DIR": str(home)}
    environment |= {"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST", "PYTHONDONTWRITEBYTECODE": "1"}
    if _unshare():
        environment[_VARIABLE] = "1"
    else:
        environment["ROS_DOMAIN_ID"] = str(_LOWEST_DOMAIN + (os.getpid() + number) % _DOMAINS)
    return environment


def isolation_problem() -> str:
    """Return sentences about what the system does not isolate; "" if it isolates the network and the files."""
    sentences = []
    if not _unshare():
        sentences.append(
            "This system does not allow a network namespace (unshare --net), so the nodes run in a ROS domain of their "
            "own but could reach the network."
        )
    if not landlock_version():
        sentences.append("This system does not restrict files (Landlock), so the nodes could read and change yours.")
    return " ".join(sentences)


def bring_loopback_up() -> None:
    """Enable loopback and its multicast in a network namespace that was just made; do nothing elsewhere."""
    if _VARIABLE not in os.environ:
        return
    import fcntl  # noqa: PLC0415 - not on Windows

    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sock:
        request = struct.pack("16sh14x", b"lo", 0)
        flags = struct.unpack("16sh14x", fcntl.ioctl(sock, _SIOCGIFFLAGS, request))[1]
        fcntl.ioctl(sock, _SIOCSIFFLAGS, struct.pack("16sh14x", b"lo", flags | _UP_AND_MULTICAST))


def limit_disk(folder: Path) -> None:
    """Give a folder a small disk of its own in memory, in namespaces that were just made; do nothing elsewhere."""
    if _VARIABLE in os.environ:
        ctypes.CDLL(None).mount(b"coframe", os.fsencode(folder), b"tmpfs", ctypes.c_ulong(0), _DISK)


@functools.cache
def _unshare() -> tuple[str, ...]:
    """Return the words in front of a command that give it namespaces of its own; none if that is not possible."""
    program = shutil.which("unshare")
    if program is None or not sys.platform.startswith("linux"):
        return ()
    for rights in ((), ("--user", "--map-root-user")):
        words = (program, *rights, *_FLAGS)
        tried = subprocess.run([*words, "true"], capture_output=True, check=False)  # noqa: S603 - a tool of the system
        if tried.returncode == 0:
            return words
    return ()
