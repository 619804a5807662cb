# SPDX-License-Identifier: Apache-2.0
"""Another user for a program that the superuser starts: one who owns nothing, and whose processes the system counts."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["User", "become", "choose_user", "is_counted"]

User = tuple[int, int]  # the numbers of a user and of a group
_SUPERUSER = 0
_FIRST_COUNTED = (5, 14)  # the version of Linux from which on processes are counted for each user namespace
_USERS = "/proc/self/uid_map"


def choose_user(candidates: Iterable[User], paths: Iterable[str]) -> User | None:
    """Return the first user who can read some paths; None if there is none, or if this is not the superuser."""
    paths = list(paths)
    if os.getuid() != _SUPERUSER:
        return None
    return next((user for user in candidates if user[0] != _SUPERUSER and _can_read(user, paths)), None)


def become(user: User) -> None:
    """Become another user for ever.

    Raises:
        OSError: It is not possible, for example in the namespace of an ordinary user, which has no other users.
    """
    number, group = user
    os.setgroups([])
    os.setresgid(group, group, group)
    os.setresuid(number, number, number)


def is_counted() -> bool:
    """Return whether the system counts the processes of this user only in this user namespace."""
    version = tuple(int(part) for part in os.uname().release.split(".")[:2] if part.isdigit())
    with open(_USERS, encoding="ascii") as users:  # noqa: PTH123 - without other imports
        has_namespace = users.read().split() != ["0", "0", "4294967295"]
    return has_namespace and version >= _FIRST_COUNTED


def _can_read(user: User, paths: Iterable[str]) -> bool:
    child = os.fork()
    if child:
        return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0
    code = 1
    try:
        become(user)
        code = 0 if all(os.access(path, os.R_OK | (os.X_OK if os.path.isdir(path) else 0)) for path in paths) else 1  # noqa: PTH112
    finally:
        os._exit(code)
