# SPDX-License-Identifier: Apache-2.0
"""Launch descriptions from files of any format."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from coframe._files.regular_files import check_regular
from coframe._output.formatting import did_you_mean
from launch.frontend.parser import Parser
from launch.invalid_launch_file_error import InvalidLaunchFileError
from launch.launch_description_source import LaunchDescriptionSource
from launch.launch_description_sources.frontend_launch_description_source import (
    get_launch_description_from_frontend_launch_file,
)
from launch.launch_description_sources.python_launch_description_source import (
    get_launch_description_from_python_launch_file,
)

if TYPE_CHECKING:
    from launch.launch_description import LaunchDescription
    from launch.some_substitutions_type import SomeSubstitutionsType

__all__ = ["AnyLaunchDescriptionSource", "get_launch_description_from_any_launch_file"]


class AnyLaunchDescriptionSource(LaunchDescriptionSource):
    """A launch file in Python, XML or YAML."""

    def __init__(self, launch_file_path: SomeSubstitutionsType) -> None:
        super().__init__(None, launch_file_path, "interpreted launch file")

    def _get_launch_description(self, location: str) -> LaunchDescription:
        return get_launch_description_from_any_launch_file(location)


def get_launch_description_from_any_launch_file(
    launch_file_path: str, *, parser: type[Parser] = Parser
) -> LaunchDescription:
    """Return the launch description of a file.

    Raises:
        FileNotFoundError: There is no such file; the text lists similar names.
        OSError: The file cannot be read, or is not a regular file.
        InvalidLaunchFileError: No parser can read the file.
    """
    path = Path(launch_file_path)
    try:
        check_regular(path)
    except FileNotFoundError:
        siblings = [each.name for each in path.parent.iterdir()] if path.parent.is_dir() else []
        guess = did_you_mean(path.name, siblings, limit=2)
        raise FileNotFoundError(f"No launch file {launch_file_path}. {guess}".rstrip()) from None
    if path.suffix == ".py":
        return get_launch_description_from_python_launch_file(launch_file_path)
    if parser.is_filename_valid(launch_file_path):
        return get_launch_description_from_frontend_launch_file(launch_file_path, parser=parser)
    errors: list[BaseException] = []
    for read in (get_launch_description_from_frontend_launch_file, get_launch_description_from_python_launch_file):
        try:
            return read(launch_file_path)
        except (InvalidLaunchFileError, SyntaxError, ValueError) as error:
            errors.append(error)
    raise InvalidLaunchFileError(path.suffix.lstrip("."), likely_errors=errors)
