# SPDX-License-Identifier: Apache-2.0
"""The files of the repository, for the scripts that check them."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

__all__ = ["chosen", "tracked"]

ROOT = Path(__file__).resolve().parents[1]


def chosen(names: list[str]) -> list[str]:
    """Return the named files, or all tracked ones without a name. End the script if a name is not that of a file."""
    missing = [name for name in names if not (ROOT / name).is_file()]
    if missing:
        sys.exit(f"{', '.join(missing)}: no such file; paths start in {ROOT}")
    return names or tracked()


def tracked() -> list[str]:
    """Return the paths of the repository's files, without deleted ones. -z keeps git from quoting names."""
    names = subprocess.check_output(["git", "ls-files", "-z"], cwd=ROOT).decode(errors="surrogateescape")
    return [name for name in names.split("\0") if (ROOT / name).is_file()]
