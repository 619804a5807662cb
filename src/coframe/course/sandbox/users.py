# SPDX-License-Identifier: Apache-2.0
"""Choose another user for a program started by root: one that owns nothing, and whose processes are counted."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["User", "become", "choose_user", "is_counted"]

User = tuple[int, int]  # user ID and group ID
_SUPERUSER = 0
_FIRST_COUNTED = (5, 14)  # the first Linux version that counts processes per user namespace
_USERS = "/proc/self/uid_map"


def choose_user(candidates: Iterable[User], readable: Iterable[str], searchable: str) -> User | None:
    """Return the first user with the rights that a program needs.

    Args:
        candidates: The users.
        readable: Files and folders that the user must be able to read.
        searchable: A folder that the user must be able to traverse.

    Returns:
        The user, or None if there is none, or if this process does not run as root and therefore cannot switch users.
    """
    readable = list(readable)
    if os.getuid() != _SUPERUSER:
        return None
    others = (user for user in candidates if user[0] != _SUPERUSER)
    return next((user for user in others if _has_rights(user, readable, searchable)), None)


def become(user: User) -> None:
    """Permanently switch to another user.

    Raises:
        OSError: This is not possible, for example in an unprivileged user namespace, which has no other users.
    """
    number, group = user
    os.setgroups([])
    os.setresgid(group, group, group)
    os.setresuid(number, number, number)


def is_counted() -> bool:
    """Return whether the system counts processes of this user per user namespace."""
    version = tuple(int(part) for part in os.uname().release.split(".")[:2] if part.isdigit())
    with open(_USERS, encoding="ascii") as users:  # noqa: PTH123 - without other imports
        has_namespace = users.read().split() != ["0", "0", "4294967295"]
    return has_namespace and version >= _FIRST_COUNTED


def _has_rights(user: User, readable: Iterable[str], searchable: str) -> bool:
    child = os.fork()
    if child:
        return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0
    code = 1
    try:
        become(user)
        has_rights = os.access(searchable, os.X_OK) and all(os.access(path, _required_mode(path)) for path in readable)
        code = 0 if has_rights else 1
    finally:
        os._exit(code)


def _required_mode(path: str) -> int:
    return os.R_OK | os.X_OK if os.path.isdir(path) else os.R_OK  # noqa: PTH112 - without other imports
