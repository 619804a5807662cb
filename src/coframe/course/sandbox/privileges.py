# SPDX-License-Identifier: Apache-2.0
"""Drop all privileges, so that a program run by root has only the rights of a file owner."""

from __future__ import annotations

import struct
from contextlib import suppress
from typing import TYPE_CHECKING

from .kernel import c_function, control_process
from .users import become

if TYPE_CHECKING:
    from .users import User

__all__ = ["drop_privileges", "forbid_new_privileges", "forbid_tracing"]

# linux/prctl.h, linux/capability.h and linux/securebits.h
_SET_DUMPABLE = 4
_CAPBSET_DROP, _SET_SECUREBITS, _CAP_AMBIENT, _SET_NO_NEW_PRIVS = 24, 28, 47, 38
_CLEAR_ALL = 4
_CAPABILITY_VERSION_3 = 0x20080522
_MAX_CAPABILITY = 63
# User ID 0 grants no capabilities at execve and setuid; no ambient capabilities; all of this is locked.
_SECURE_BITS = 0xEF


def drop_privileges(user: User | None = None) -> None:
    """Drop all capabilities of this process and of the programs it will run.

    Each step fails for ordinary users, who have none to drop.

    Args:
        user: The user to switch to; None keeps the current one.
    """
    with suppress(OSError):
        control_process(_SET_SECUREBITS, _SECURE_BITS)
    with suppress(OSError):  # This capability and all higher ones do not exist.
        for number in range(_MAX_CAPABILITY + 1):
            control_process(_CAPBSET_DROP, number)
    with suppress(OSError):
        control_process(_CAP_AMBIENT, _CLEAR_ALL)
    if user is not None:
        become(user)
    with suppress(OSError):
        c_function("capset", struct.pack("Ii", _CAPABILITY_VERSION_3, 0), bytes(24))


def forbid_tracing() -> None:
    """Prevent other processes of the same user from reading or modifying this process and its forks.

    Raises:
        OSError: This system does not support it.
    """
    control_process(_SET_DUMPABLE, 0)


def forbid_new_privileges() -> None:
    """Disable set-user-ID programs for this process and its children."""
    control_process(_SET_NO_NEW_PRIVS, 1)
