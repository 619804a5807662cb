# SPDX-License-Identifier: Apache-2.0
"""Whether folders and files belong to the user: in a folder that all may write, such as ``/tmp``, others put theirs."""

from __future__ import annotations

import os
from contextlib import suppress
from typing import TYPE_CHECKING

from coframe.interfaces.problems import report

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["is_own"]


def is_own(path: Path) -> bool:
    """Return whether a folder or file, and what a link leads to, belongs to the user or to root; report it if not.

    As Git does, accept the files of the user who has become root with sudo. Windows has no such owners.
    """
    if os.name != "posix":
        return True
    try:
        owners = {path.lstat().st_uid, path.stat().st_uid}
    except OSError:
        return False
    strangers = owners - _users()
    if strangers:
        report(
            f"{path} is skipped in the search for interface packages because it belongs to {_name(min(strangers))}. "
            "If you trust its definitions, run: coframe interface add FOLDER"
        )
    return not strangers


def _users() -> set[int]:
    users = {0, os.geteuid()}
    if os.geteuid() == 0:
        with suppress(KeyError, ValueError):
            users.add(int(os.environ["SUDO_UID"]))
    return users


def _name(user: int) -> str:
    import pwd  # noqa: PLC0415 - only POSIX has it

    try:
        return f"the user {pwd.getpwuid(user).pw_name}"
    except KeyError:
        return f"the user with the number {user}"
