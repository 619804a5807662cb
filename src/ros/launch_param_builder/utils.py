# SPDX-License-Identifier: Apache-2.0
"""Reads files with parameters."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

from coframe._files.bounded_yaml import MAX_BYTES, read_yaml
from coframe._files.regular_files import read_regular_text
from coframe._process.optional_imports import pip_install
from coframe.robots.files import expand_xacro

if TYPE_CHECKING:
    import os
    from collections.abc import Mapping

__all__ = [
    "ParameterBuilderFileNotFoundError",
    "load_file",
    "load_xacro",
    "load_yaml",
    "raise_if_file_not_found",
]


class ParameterBuilderFileNotFoundError(KeyError):
    """A file with parameters does not exist."""

    def __str__(self) -> str:
        return str(self.args[0]) if self.args else ""


def raise_if_file_not_found(file_path: str | os.PathLike[str]) -> None:
    """Check that a file exists.

    Raises:
        ParameterBuilderFileNotFoundError: It does not exist.
    """
    if not Path(file_path).exists():
        raise ParameterBuilderFileNotFoundError(f"File {file_path} doesn't exist")


def load_file(file_path: str | os.PathLike[str]) -> str:
    """Return the text of a file.

    Raises:
        ParameterBuilderFileNotFoundError: The file does not exist.
        OSError: It cannot be read.
    """
    raise_if_file_not_found(file_path)
    return read_regular_text(Path(file_path), MAX_BYTES)


def load_yaml(file_path: str | os.PathLike[str]) -> Any:
    """Return the value of a YAML file, in which ``!degrees 90`` and ``!radians 1.57`` are angles in radians.

    Raises:
        ParameterBuilderFileNotFoundError: The file does not exist.
        ValueError: It is not YAML.
        ModuleNotFoundError: PyYAML is not installed.
    """
    text = load_file(file_path)
    try:
        return read_yaml(text, constructors={"!radians": _radians, "!degrees": _degrees})
    except ValueError as error:
        raise ValueError(f"{file_path} is not valid YAML: {error}") from None
    except ModuleNotFoundError:
        raise ModuleNotFoundError(f"YAML files need PyYAML: {pip_install('params')}", name="yaml") from None


def load_xacro(file_path: str | os.PathLike[str], mappings: Mapping[str, str] | None = None) -> str:
    """Return the XML of a xacro file.

    Args:
        file_path: The file.
        mappings: The values of its arguments.

    Raises:
        ParameterBuilderFileNotFoundError: The file does not exist.
        RobotDescriptionError: xacro fails, or is not installed.
    """
    raise_if_file_not_found(file_path)
    return expand_xacro(Path(file_path), mappings)


def _radians(loader: Any, node: Any) -> float:
    return float(loader.construct_scalar(node))


def _degrees(loader: Any, node: Any) -> float:
    return math.radians(_radians(loader, node))
