# SPDX-License-Identifier: Apache-2.0
"""Start a confined program, as the last step before a student's code runs.

The process that runs `main` imports only the standard library. With namespaces, it has two children: the first process
of the program's own process namespace, and the program.
"""

from __future__ import annotations

import json
import os
import signal
import sys
from contextlib import suppress
from typing import Any, NoReturn

from . import kernel, landlock, mounts, privileges, seccomp, users

__all__ = ["main"]

_MAX_OPEN_FILES = 256
_MAX_TASKS = 1024  # limit on processes and threads of all programs of a user, until the grader ends one with too many
_NEW_MOUNTS, _NEW_COMMUNICATION, _NEW_PROCESSES = 0x20000, 0x08000000, 0x20000000
_SET_PARENT_DEATH_SIGNAL = 1
_SIGNAL_OFFSET = 128  # added to the number of the signal that ended a program, as in shells


def main() -> None:
    """Confine this process by the plan in the first argument, and replace it with the program in the others.

    The plan is JSON, see `Confinement.command`.
    """
    plan, program = json.loads(sys.argv[1]), sys.argv[2:]
    if plan["namespaces"]:
        _run_in_namespaces(plan, program)
    _run(plan, program, visible=_ancestors())


def _run_in_namespaces(plan: dict[str, Any], program: list[str]) -> NoReturn:
    kernel.c_function("unshare", _NEW_MOUNTS | _NEW_COMMUNICATION | _NEW_PROCESSES)
    privileges.forbid_tracing()
    first = os.fork()
    if first:
        os._exit(_exit_code(first))
    kernel.control_process(_SET_PARENT_DEATH_SIGNAL, signal.SIGKILL)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    mounts.enter_own_root(plan["root"], plan["entries"], plan["links"], plan["decoys"], plan["home"])
    child = os.fork()
    if child:
        privileges.drop_privileges()
        os._exit(_exit_code(child))  # The system then ends all other processes of the program.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    os.setsid()
    _run(plan, program, visible=[])


def _exit_code(child: int) -> int:
    """Wait for a child and reap orphans, and return its exit code as reported by shells."""
    while True:
        process, status = os.wait()
        if process == child:
            code = os.waitstatus_to_exitcode(status)
            return code if code >= 0 else _SIGNAL_OFFSET - code


def _run(plan: dict[str, Any], program: list[str], *, visible: list[int]) -> NoReturn:
    """Replace this process with the program.

    Args:
        plan: The restrictions of the program: its folders, users, limits and namespaces.
        program: The program and its arguments.
        visible: The ancestors of this process, unless the program has its own process namespace.
    """
    user = users.choose_user(_users(plan), _needed_files(plan, program), os.path.dirname(plan["home"]))  # noqa: PTH120
    if user is not None:
        os.chown(plan["home"], *user)
    privileges.drop_privileges(user)
    os.chdir(plan["folder"])
    is_counted = user is not None or (plan["namespaces"] and users.is_counted())
    _limit_resources(plan["limits"] | ({"NPROC": _MAX_TASKS} if is_counted else {}))
    with suppress(OSError):  # macOS has no equivalent.
        privileges.forbid_new_privileges()
    if landlock.landlock_version():
        shown = plan["decoys"] if plan["namespaces"] else ()
        hidden = {path for path, is_readable in plan["entries"] if not is_readable}
        readable = [path for path, is_readable in plan["entries"] if is_readable]
        landlock.restrict_files([*readable, *mounts.DEVICES, "/proc"], hidden, plan["home"], visible_paths=shown)
    if seccomp.can_filter():
        seccomp.block_system_calls(visible)
    os.execv(program[0], program)  # noqa: S606 - the purpose of this file


def _users(plan: dict[str, Any]) -> list[users.User]:
    """Return candidate users for a program run by root: one without an account, or the folder's owner.

    Without capabilities, root can read only files that are readable by everyone or owned by root.
    """
    status = os.stat(plan["folder"])  # noqa: PTH116 - without other imports
    return [(plan["user"], plan["user"]), (status.st_uid, status.st_gid)]


def _needed_files(plan: dict[str, Any], program: list[str]) -> list[str]:
    """Return the files that the user must be able to read: Python, packages, and the files of the folder."""
    with os.scandir(plan["folder"]) as entries:
        own = [entry.path for entry in entries if not entry.is_symlink()]
    return [program[0], *own, *(path for path, is_readable in plan["entries"] if is_readable)]


def _limit_resources(limits: dict[str, int]) -> None:
    import resource  # noqa: PLC0415 - not on Windows

    for name, value in {**limits, "NOFILE": _MAX_OPEN_FILES, "CORE": 0}.items():
        with suppress(ValueError, OSError):  # macOS does not limit the address space.
            resource.setrlimit(getattr(resource, f"RLIMIT_{name}"), (value, value))


def _ancestors() -> list[int]:
    """Return the ancestors of this process and their group leaders, which the program must not end.

    A group can outlive its leader, for example if a shell starts a program in the background.
    """
    found, process = {1}, os.getppid()
    with suppress(OSError, ValueError, IndexError):
        while process > 1:
            found.add(process)
            with open(f"/proc/{process}/stat", encoding="utf-8", errors="replace") as file:  # noqa: PTH123
                _, process, group = map(int, ["0", *file.read().rpartition(")")[2].split()[1:3]])
            found.add(group)
    return sorted(found - {0})
