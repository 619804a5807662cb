# SPDX-License-Identifier: Apache-2.0
"""Launch descriptions from XML and YAML files."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.frontend.parser import InvalidFrontendLaunchFileError, Parser
from launch.launch_description_source import LaunchDescriptionSource

if TYPE_CHECKING:
    from launch.launch_description import LaunchDescription
    from launch.some_substitutions_type import SomeSubstitutionsType

__all__ = ["FrontendLaunchDescriptionSource", "get_launch_description_from_frontend_launch_file"]


class FrontendLaunchDescriptionSource(LaunchDescriptionSource):
    """An XML or YAML launch file."""

    def __init__(
        self,
        launch_file_path: SomeSubstitutionsType,
        *,
        method: str = "interpreted frontend launch file",
        parser: type[Parser] = Parser,
    ) -> None:
        super().__init__(None, launch_file_path, method)
        self.__parser = parser

    def _get_launch_description(self, location: str) -> LaunchDescription:
        return get_launch_description_from_frontend_launch_file(location, parser=self.__parser)


def get_launch_description_from_frontend_launch_file(
    frontend_launch_file_path: str, *, parser: type[Parser] = Parser
) -> LaunchDescription:
    """Return the launch description of an XML or YAML launch file.

    Raises:
        InvalidFrontendLaunchFileError: The file is not valid; the text names it.
    """
    try:
        root, file_parser = parser.load(frontend_launch_file_path)
        return file_parser.parse_description(root)
    except InvalidFrontendLaunchFileError:
        raise
    except (RuntimeError, ValueError, TypeError) as error:
        failure = InvalidFrontendLaunchFileError("")
        failure.args = (f"{frontend_launch_file_path}: {error}",)
        raise failure from error
