# SPDX-License-Identifier: Apache-2.0
"""The executable ``xacro`` of the package ``xacro``: the program of the distribution of the same name."""

from __future__ import annotations

import sys

# xacro uses this module and does not import it: with a missing file it ends with an AttributeError otherwise.
import xml.parsers.expat  # noqa: F401 - the user's own files

from coframe._process.optional_imports import pip_install

__all__ = ["main"]


def main() -> None:
    """Run xacro on the arguments of the process."""
    try:
        import xacro  # noqa: PLC0415 - optional
    except ModuleNotFoundError:
        sys.exit(f"xacro: the Python package xacro is not installed. Install it: {pip_install('robots')}")
    xacro.main()
