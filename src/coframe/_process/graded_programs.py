# SPDX-License-Identifier: Apache-2.0
"""Programs that are being graded, and the packages with solutions of the lab, which they cannot import."""

from __future__ import annotations

import os
import sys

__all__ = ["GRADED_VARIABLE", "SOLUTIONS", "forbid_graded_program", "is_graded", "refusal"]

GRADED_VARIABLE = "COFRAME_GRADED"  # environment variable that is set for graded programs
SOLUTIONS = ("coframe.lab", "coframe.course")


def is_graded() -> bool:
    """Return whether this process is a program that is being graded."""
    return GRADED_VARIABLE in os.environ


def refusal(package: str) -> str:
    """Return the error message for a program that imports one of these packages."""
    return f"{package} contains solutions of the lab, so a graded program cannot import it."


def forbid_graded_program(package: str) -> None:
    """Raise ImportError if this process is a graded program that imports the package.

    The message is also printed, so that the report contains it even if the program catches the exception.

    Raises:
        ImportError: This process is a graded program.
    """
    if is_graded():
        print(refusal(package), file=sys.stderr, flush=True)  # noqa: T201 - the output of the program is its protocol
        raise ImportError(refusal(package), name=package)
