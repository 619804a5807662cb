# SPDX-License-Identifier: Apache-2.0
"""A network and a process list of its own for a grade, where the system can give them; else a ROS domain of its own."""

from __future__ import annotations

import functools
import os
import shutil
import socket
import struct
import subprocess
import sys
from typing import Final

__all__ = ["bring_loopback_up", "isolated_command", "isolated_environment", "isolation_problem"]

_VARIABLE: Final = "COFRAME_ISOLATED"  # set in processes that have a network of their own
# Domains for grades without a network of their own. The ports of those above 101 may be in use by other sockets.
_LOWEST_DOMAIN, _DOMAINS = 51, 50
_SIOCGIFFLAGS, _SIOCSIFFLAGS = 0x8913, 0x8914
_UP_AND_MULTICAST = 0x1 | 0x1000
_FLAGS = ("--net", "--pid", "--fork", "--kill-child", "--mount-proc")


def isolated_command(command: list[str]) -> list[str]:
    """Return a command that runs in namespaces of its own; the command itself where there are none.

    When the first process of the namespaces ends, the system ends all others in them.
    """
    return [*_unshare(), *command]


def isolated_environment(number: int) -> dict[str, str]:
    """Return the environment of a grade.

    Args:
        number: Number of the grade among those that run at the same time.
    """
    environment = {**os.environ, "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST", "PYTHONDONTWRITEBYTECODE": "1"}
    if _unshare():
        environment[_VARIABLE] = "1"
    else:
        environment["ROS_DOMAIN_ID"] = str(_LOWEST_DOMAIN + (os.getpid() + number) % _DOMAINS)
    return environment


def isolation_problem() -> str:
    """Return a sentence if the system gives a grade no network of its own; "" if it does."""
    if _unshare():
        return ""
    return (
        "This system does not allow a network namespace (unshare --net), so the nodes run in a ROS domain of their own "
        "but could reach the network."
    )


def bring_loopback_up() -> None:
    """Enable loopback and its multicast in a network namespace that was just made; do nothing elsewhere."""
    if _VARIABLE not in os.environ:
        return
    import fcntl  # noqa: PLC0415 - not on Windows

    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sock:
        request = struct.pack("16sh14x", b"lo", 0)
        flags = struct.unpack("16sh14x", fcntl.ioctl(sock, _SIOCGIFFLAGS, request))[1]
        fcntl.ioctl(sock, _SIOCSIFFLAGS, struct.pack("16sh14x", b"lo", flags | _UP_AND_MULTICAST))


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
