# SPDX-License-Identifier: Apache-2.0
"""Whether a file or folder exists and where it is, for the folders that environment variables list.

What the user is not permitted to read counts as absent, as in Python's own search for modules. The methods of
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
    """Return the absolute path without links. For a link to itself, `Path.resolve` can raise RuntimeError; it stays."""
    return Path(os.path.realpath(path))
