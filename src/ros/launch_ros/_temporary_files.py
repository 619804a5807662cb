# SPDX-License-Identifier: Apache-2.0
"""Files of parameters for started nodes, which are removed when this program ends."""

from __future__ import annotations

import atexit
import functools
import itertools
import shutil
import tempfile
from pathlib import Path
from typing import Any

from launch.utilities.yaml_loading import dump_yaml

__all__ = ["write_parameters_file", "write_temporary_file"]

_numbers = itertools.count()


@functools.cache
def _folder() -> Path:
    folder = Path(tempfile.mkdtemp(prefix="launch_params_"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return folder


def write_temporary_file(text: str, suffix: str = ".yaml") -> Path:
    """Write a text to a new file and return its path."""
    path = _folder() / f"{next(_numbers)}{suffix}"
    path.write_text(text, encoding="utf-8")
    return path


def write_parameters_file(node: str, parameters: dict[str, Any]) -> Path:
    """Write a file of parameters for the nodes whose names match a pattern."""
    return write_temporary_file(dump_yaml({node: {"ros__parameters": parameters}}))
