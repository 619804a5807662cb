# SPDX-License-Identifier: Apache-2.0
"""Files of parameters for started nodes, which are removed when this program ends."""

from __future__ import annotations

import atexit
import functools
import itertools
from pathlib import Path
from typing import TYPE_CHECKING, Any

from coframe._files.temporary_folders import temporary_folder
from launch.utilities.yaml_loading import dump_yaml

if TYPE_CHECKING:
    import tempfile

__all__ = ["write_parameters_file", "write_temporary_file"]

_numbers = itertools.count()


@functools.cache
def _folder() -> tempfile.TemporaryDirectory[str]:
    folder = temporary_folder("launch_params_")
    atexit.register(folder.cleanup)
    return folder


def write_temporary_file(text: str, suffix: str = ".yaml") -> Path:
    """Write text to a new file and return its path."""
    path = Path(_folder().name) / f"{next(_numbers)}{suffix}"
    path.write_text(text, encoding="utf-8")
    return path


def write_parameters_file(node: str, parameters: dict[str, Any]) -> Path:
    """Write a file of parameters for the nodes whose names match a pattern."""
    return write_temporary_file(dump_yaml({node: {"ros__parameters": parameters}}))
