# SPDX-License-Identifier: Apache-2.0
"""Packages with solutions of the lab, which programs that are graded cannot import."""

from __future__ import annotations

import os
import sys

__all__ = ["GRADED", "SOLUTIONS", "refusal", "refuse_graded"]

GRADED = "COFRAME_GRADED"  # a variable that is set for programs that are graded
SOLUTIONS = ("coframe.lab", "coframe.course")


def refusal(package: str) -> str:
    """Return the sentence about a program that imports one of these packages."""
    return f"{package} contains solutions of the lab, so a program that is graded cannot import it."


def refuse_graded(package: str) -> None:
    """Refuse the import of a package, if this process is a program that is graded.

    The sentence is also printed, so that the grade contains it if the program catches the exception.

    Raises:
        ImportError: It is.
    """
    if GRADED in os.environ:
        print(refusal(package), file=sys.stderr, flush=True)  # noqa: T201 - the output of the program is its protocol
        raise ImportError(refusal(package), name=package)
