# SPDX-License-Identifier: Apache-2.0
"""Run programs for another processor in a root of their own, next to programs of this machine in the same network.

A user namespace has its own mounts, its own loopback and, since Linux 6.7, its own list of interpreters for foreign
programs, in which QEMU is entered. So no root rights are needed, and nothing changes for the rest of the machine.
"""

from __future__ import annotations

import shutil
import subprocess
from typing import TYPE_CHECKING

from scripts.arm.debian import UnavailableError, last_line

if TYPE_CHECKING:
    from pathlib import Path

# The first bytes of a 64-bit ARM program, and which of their bits count (not the name of the system, for example).
MAGIC = "7f454c460201010000000000000000000200b700"
MASK = "ffffffffffffff00fffffffffffffffffeffffff"
ENTER = """
set -e
ip link set lo up
ip link set lo multicast on
mount -t binfmt_misc none /proc/sys/fs/binfmt_misc
# F: QEMU is opened now, so that every root has it. O, C: also for unreadable programs. P: it gets the name as typed.
printf '%s' ":arm:M::$1:$2:$3:OCPF" > /proc/sys/fs/binfmt_misc/register
shift 3
root=$1
shift
mount --rbind /proc "$root/proc"
mount --rbind /dev "$root/dev"
while [ "$1" != -- ]; do
    mkdir -p "$root$2"
    mount --bind "$1" "$root$2"
    shift 2
done
shift
exec "$@"
"""
VARIABLES = (
    "PATH=/environment/bin:/usr/bin:/bin:/usr/sbin:/sbin",
    "HOME=/root",
    "LC_ALL=C.UTF-8",
    "PYTHONPYCACHEPREFIX=/tmp/pycache",
    "ROS_AUTOMATIC_DISCOVERY_RANGE=LOCALHOST",
)
TOOLS = ("unshare", "ip", "mount", "chroot")


class Namespace:
    """What is mounted where.

    Args:
        root: The folder with the programs for the other processor.
        qemu: The program that runs them.
        mounts: Folders of this machine by their paths in the root.
    """

    def __init__(self, root: Path, qemu: Path, mounts: dict[str, Path]) -> None:
        self._root = root
        self._qemu = qemu
        self._mounts = mounts

    def command(self, *words: object) -> list[str]:
        """Return a command that runs a command of this machine in the namespace."""
        mounts = [str(word) for path, folder in self._mounts.items() for word in (folder, path)]
        patterns = [re_escaped(MAGIC), re_escaped(MASK)]
        enter = ["unshare", "--user", "--map-root-user", "--mount", "--net", "--kill-child", "sh", "-c", ENTER, "sh"]
        return [*enter, *patterns, str(self._qemu), str(self._root), *mounts, "--", *map(str, words)]

    def in_root(self, *words: object) -> list[str]:
        """Return a command for `command` that runs a command of the root, with VARIABLES only."""
        return ["chroot", str(self._root), "/usr/bin/env", "-i", *VARIABLES, *map(str, words)]

    def check(self) -> None:
        """Run a program of the root.

        Raises:
            UnavailableError: This machine cannot do that.
        """
        for name in TOOLS:
            if shutil.which(name) is None:
                raise UnavailableError(f"the program {name} is missing")
        done = subprocess.run(self.command(*self.in_root("uname", "-m")), capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise UnavailableError(
                "this machine does not let a user namespace run programs for 64-bit ARM, which needs Linux 6.7 or "
                f"newer: {last_line(done.stderr)}"
            )


def re_escaped(digits: str) -> str:
    """Return bytes in the form that the kernel reads."""
    return "".join(rf"\x{digits[i : i + 2]}" for i in range(0, len(digits), 2))
