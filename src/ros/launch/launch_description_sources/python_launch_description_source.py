# SPDX-License-Identifier: Apache-2.0
"""Launch descriptions from Python files."""

from __future__ import annotations

from importlib.machinery import SourceFileLoader
from importlib.util import module_from_spec, spec_from_loader
from typing import TYPE_CHECKING

from coframe._files.regular_files import read_regular
from launch.invalid_launch_file_error import InvalidLaunchFileError
from launch.launch_description import LaunchDescription
from launch.launch_description_source import LaunchDescriptionSource

if TYPE_CHECKING:
    from types import ModuleType

    from launch.some_substitutions_type import SomeSubstitutionsType

__all__ = [
    "InvalidPythonLaunchFileError",
    "PythonLaunchDescriptionSource",
    "get_launch_description_from_python_launch_file",
    "load_python_launch_file_as_module",
]

MAX_BYTES = 16 << 20


class InvalidPythonLaunchFileError(InvalidLaunchFileError):
    """A Python file that is not a launch file."""

    def __init__(self, text: str = "") -> None:
        super().__init__("py")
        self.args = (text,)


class PythonLaunchDescriptionSource(LaunchDescriptionSource):
    """A Python launch file, whose function ``generate_launch_description`` returns the description."""

    def __init__(self, launch_file_path: SomeSubstitutionsType) -> None:
        super().__init__(None, launch_file_path, "interpreted python launch file")

    def _get_launch_description(self, location: str) -> LaunchDescription:
        return get_launch_description_from_python_launch_file(location)


class _LaunchFileLoader(SourceFileLoader):
    def get_data(self, path: str) -> bytes:
        return read_regular(path, MAX_BYTES)


def load_python_launch_file_as_module(python_launch_file_path: str) -> ModuleType:
    """Run a Python launch file and return its module."""
    loader = _LaunchFileLoader("python_launch_file", python_launch_file_path)
    spec = spec_from_loader(loader.name, loader)
    assert spec is not None
    module = module_from_spec(spec)
    loader.exec_module(module)
    return module


def get_launch_description_from_python_launch_file(python_launch_file_path: str) -> LaunchDescription:
    """Return the launch description of a Python launch file.

    Raises:
        InvalidPythonLaunchFileError: The file has no function ``generate_launch_description``.
    """
    module = load_python_launch_file_as_module(python_launch_file_path)
    function = getattr(module, "generate_launch_description", None)
    if function is None:
        raise InvalidPythonLaunchFileError(
            f"launch file at '{python_launch_file_path}' does not contain the required function "
            "'generate_launch_description()'"
        )
    description = function()
    if not isinstance(description, LaunchDescription):
        raise InvalidPythonLaunchFileError(
            f"generate_launch_description() of '{python_launch_file_path}' must return a LaunchDescription, not "
            f"{type(description).__name__}"
        )
    return description
