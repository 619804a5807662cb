# SPDX-License-Identifier: Apache-2.0
"""Confine the programs of one grading run: build the command and the environment of each program."""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from coframe._process.graded_programs import GRADED_VARIABLE, SOLUTIONS, refusal
from coframe._process.python_children import python_environment
from coframe.course._solutions import Decoys, entry_files, solution_folders, solution_problem
from coframe.course._view import view_of
from coframe.course.running import EXACT_FIELDS
from coframe.course.sandbox.landlock import landlock_version, scopes_signals
from coframe.course.sandbox.seccomp import can_filter

if TYPE_CHECKING:
    from collections.abc import Iterable

    from typing_extensions import Self

__all__ = ["DECOYS", "MAX_CPU", "MAX_MEMORY", "MAX_OUTPUT", "Confinement", "passed_variables", "protection_problem"]

MAX_MEMORY = 1 << 30  # bytes of all processes of a program
MAX_OUTPUT = 10 << 20  # bytes of the output, and of each file that a program writes
MAX_CPU = 120  # seconds of processor time
_ADDRESS_SPACE = 8 * MAX_MEMORY  # threads and libraries reserve more than they use

# Environment variables of the user that are visible to the grade. All others may contain secrets.
PASSED_VARIABLES: Final = (
    "AMENT_PREFIX_PATH",
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
FOLDER_LISTS: Final = frozenset({"AMENT_PREFIX_PATH", "DYLD_LIBRARY_PATH", "LD_LIBRARY_PATH", "PATH"})
DECOYS: Final = "decoys"  # the folder with decoys that programs find instead of solutions
_FIRST_USER, _USERS = 64_000, 1000  # IDs of users without an account, for programs run by root
_START: Final = "import sys; sys.path.append({!r}); from sandbox.start import main; main()"


def passed_variables() -> dict[str, str]:
    """Return the environment variables of this process that are visible to a grade.

    Empty or relative elements in lists of folders are removed, because they would refer to a folder of the student,
    from which libraries and programs would be loaded.
    """
    environment = {name: os.environ[name] for name in PASSED_VARIABLES if name in os.environ}
    for name in environment.keys() & FOLDER_LISTS:
        environment[name] = os.pathsep.join(filter(os.path.isabs, environment[name].split(os.pathsep)))
    return environment


class Confinement:
    """Restricts the programs of one grading run.

    Attributes:
        has_namespaces: Whether each program has its own file system and process list.
        working_folder: The working folder of the processes that start the programs; empty, because they are not
            confined.
    """

    def __init__(
        self, folder: Path, scratch: Path, private_folders: Iterable[str], *, has_namespaces: bool, number: int = 0
    ) -> None:
        """Prepare the programs of a folder.

        Args:
            folder: The student's folder.
            scratch: An empty folder.
            private_folders: Folders that they cannot read; see `private_folders`.
            has_namespaces: Whether this process can create namespaces.
            number: Index of this grade among those that run concurrently.
        """
        self.has_namespaces = has_namespaces
        self._number = number
        self._folder = folder.resolve()
        self._decoys = Decoys(scratch / DECOYS) if has_namespaces else None
        root = scratch / "root"
        root.mkdir()
        self.working_folder = root if os.name == "posix" else self._folder  # if no process is started in between
        self._solutions = solution_folders()
        self._entries, self._links = view_of(folder, private_folders, self._solutions)
        if self._decoys is None:
            self._entries += [(file, True) for file in entry_files(self._solutions)]

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        if self._decoys is not None:
            self._decoys.close()

    def command(self, home: Path, *words: str) -> list[str]:
        """Return a command that runs Python confined; without limits on Windows, which does not support them.

        Args:
            home: The only folder in which it can write.
            words: The words after ``python``.
        """
        if os.name != "posix":
            return [sys.executable, *words]
        plan: dict[str, Any] = {
            "namespaces": self.has_namespaces,
            "root": str(self.working_folder),
            "folder": str(self._folder),
            "home": os.path.realpath(home),
            "entries": self._entries,
            "links": self._links,
            "decoys": {} if self._decoys is None else self._decoys.folders,
            "user": _FIRST_USER + self._number % _USERS,
            "limits": {"AS": _ADDRESS_SPACE, "FSIZE": MAX_OUTPUT, "CPU": MAX_CPU},
        }
        start = _START.format(str(Path(__file__).parent))
        # Isolated (-I): ignores Python's variables and the current folder; without the module site (-S).
        return [sys.executable, "-I", "-S", "-c", start, json.dumps(plan), sys.executable, *words]

    def environment(self, home: Path) -> dict[str, str]:
        """Return the environment of a program with this home folder."""
        environment = passed_variables()
        environment |= {"HOME": str(home), "TMPDIR": str(home), "ROS_LOG_DIR": str(home)}
        environment |= {"PYTHONUNBUFFERED": "1", "PYTHONDONTWRITEBYTECODE": "1", GRADED_VARIABLE: "1"}
        environment |= {"USER": "student", "LOGNAME": "student"}  # if the user has no account
        environment |= EXACT_FIELDS
        return python_environment(environment)

    def attempt(self, output: bytes) -> str:
        """Return a message if the program has tried to use solutions of the lab since the last call, or "".

        Args:
            output: Its output, which is the only evidence if programs have no file system of their own.
        """
        opened = "" if self._decoys is None else self._decoys.opened()
        printed = (package for package in SOLUTIONS if refusal(package).encode() in output)
        read = (folder for folder in self._solutions if f"denied: '{folder}/".encode() in output)
        used = opened or next(printed, "") or next((f"coframe.{Path(folder).name}" for folder in read), "")
        return solution_problem(used) if used else ""


def protection_problem(*, has_namespaces: bool) -> str:
    """Describe the protection that this system lacks against a program, or "" if protection is complete."""
    sentences = []
    if not has_namespaces:
        sentences.append(
            "This system does not allow separate namespaces for the programs (unshare), so they run in a separate ROS "
            "domain but could reach the network and list running processes."
        )
        if not landlock_version():
            sentences.append(
                "It does not restrict files either (Landlock), so they could read and modify your files, and import "
                "the solutions in coframe.lab."
            )
        if not (scopes_signals() or can_filter()):
            sentences.append("They could send signals to your processes.")
    if not can_filter():
        sentences.append(
            "This system has no filter for system calls (seccomp), so the programs could use Unix sockets and "
            "uncounted memory."
        )
    return " ".join(sentences)
