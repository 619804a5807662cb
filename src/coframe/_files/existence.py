# SPDX-License-Identifier: Apache-2.0
"""Check whether files and folders exist, and resolve paths, for folders listed in environment variables.

Paths that the user may not read count as absent, as in Python's own module search. The methods of
`pathlib.Path` raise PermissionError instead, before Python 3.14.
"""

from __future__ import annotations

import os
from pathlib import Path

__all__ = ["exists", "is_dir", "is_file", "resolved"]


def exists(path: Path) -> bool:
    """Return whether the path is a file or folder that the user can reach."""
    return os.path.exists(path)  # noqa: PTH110 - see above


def is_file(path: Path) -> bool:
    """Return whether the path is a file that the user can reach."""
    return os.path.isfile(path)  # noqa: PTH113 - see above


def is_dir(path: Path) -> bool:
    """Return whether the path is a folder that the user can reach."""
    return os.path.isdir(path)  # noqa: PTH112 - see above


def resolved(path: str | os.PathLike[str]) -> Path:
    """Return the absolute path with links resolved. Links that form a loop are kept, where `Path.resolve` may raise."""
    return Path(os.path.realpath(path))
