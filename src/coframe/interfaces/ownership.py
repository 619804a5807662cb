# SPDX-License-Identifier: Apache-2.0
"""Check whether files belong to the user: others can create files in world-writable folders such as ``/tmp``."""

from __future__ import annotations

import os
from contextlib import suppress
from typing import TYPE_CHECKING

from coframe.interfaces.problems import report

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["is_own"]


def is_own(path: Path) -> bool:
    """Return whether a file or folder, and the target of a link, belongs to the user or to root; report it if not.

    As in Git, files of the user who invoked sudo are accepted. Windows has no such owners.
    """
    if os.name != "posix":
        return True
    try:
        owners = {path.lstat().st_uid, path.stat().st_uid}
    except OSError:
        return False
    strangers = owners - _trusted_users()
    if strangers:
        report(
            f"{path} is skipped in the search for interface packages because it belongs to {_name(min(strangers))}. "
            "If you trust its definitions, run: coframe interface add FOLDER"
        )
    return not strangers


def _trusted_users() -> set[int]:
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
