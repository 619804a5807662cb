# SPDX-License-Identifier: Apache-2.0
"""Base class of the parsers of launch files, and the choice of a parser for a file."""

from __future__ import annotations

import importlib
from io import IOBase
from pathlib import Path
from typing import TYPE_CHECKING, Any

from coframe._output.formatting import did_you_mean
from launch.frontend.expose import action_parse_methods
from launch.frontend.substitution_grammar import parse_text
from launch.invalid_launch_file_error import InvalidLaunchFileError

if TYPE_CHECKING:
    from launch.action import Action
    from launch.frontend.entity import Entity
    from launch.launch_description import LaunchDescription
    from launch.substitution import Substitution

__all__ = ["InvalidFrontendLaunchFileError", "Parser"]

# The parser of each extension, and the packages whose actions launch files may use.
_PARSERS = {"xml": "launch_xml", "yaml": "launch_yaml", "yml": "launch_yaml"}
_EXTENSIONS = ("launch.actions", "launch.substitutions", "launch_ros.actions", "launch_ros.substitutions")


class InvalidFrontendLaunchFileError(InvalidLaunchFileError):
    """A launch file that its parser cannot read."""


class Parser:
    """A parser of launch files of one format."""

    @classmethod
    def load_launch_extensions(cls) -> None:
        """Import the packages whose actions and substitutions launch files may use."""
        for name in _EXTENSIONS:
            importlib.import_module(name)

    @classmethod
    def load_parser_implementations(cls) -> None:
        """Do nothing: the parsers are imported when they are needed."""

    @classmethod
    def get_available_extensions(cls) -> list[str]:
        """Return the extensions of launch files that can be parsed."""
        return list(_PARSERS)

    @classmethod
    def is_extension_valid(cls, extension: str) -> bool:
        """Return whether there is a parser for an extension."""
        return extension in _PARSERS

    @classmethod
    def is_filename_valid(cls, filename: str) -> bool:
        """Return whether there is a parser for a file, by its extension."""
        return cls.is_extension_valid(Path(filename).suffix.lstrip("."))

    @classmethod
    def get_file_extensions(cls) -> set[str]:
        """Return the extensions of the files of this parser."""
        return set()

    @classmethod
    def load(cls, file: str | Any) -> tuple[Entity, Parser]:
        """Read a file, and return its root and its parser.

        Raises:
            InvalidFrontendLaunchFileError: The file cannot be read by any parser.
        """
        name = str(getattr(file, "name", file))
        extension = Path(name).suffix.lstrip(".")
        errors: list[BaseException] = []
        for package in [_PARSERS[extension]] if extension in _PARSERS else dict.fromkeys(_PARSERS.values()):
            parser: type[Parser] = importlib.import_module(package).Parser
            try:
                if isinstance(file, IOBase) and file.seekable():
                    file.seek(0)  # The parser before may have read it.
                return parser.load(file)
            except (ValueError, TypeError, OSError, RuntimeError) as error:
                errors.append(error)
        raise InvalidFrontendLaunchFileError(extension, likely_errors=errors)

    def parse_substitution(self, value: Any) -> list[Substitution]:
        """Parse a string into substitutions."""
        return parse_text(str(value))

    def parse_if_substitutions(self, value: Any) -> Any:
        """Return the substitutions of a string or list of strings, and return other values unchanged."""
        if isinstance(value, str):
            return self.parse_substitution(value)
        if isinstance(value, list) and value and all(isinstance(item, str) for item in value):
            return [self.parse_substitution(item) for item in value]
        return value

    def escape_characters(self, value: str) -> str:
        """Return a string without its escapes. It must not contain substitutions."""
        return str(value).replace("\\$", "$")

    def parse_action(self, entity: Entity) -> Action:
        """Return the action of an element.

        Raises:
            RuntimeError: The element is unknown, or its attributes are wrong.
        """
        self.load_launch_extensions()
        name = entity.type_name
        if name not in action_parse_methods:
            guess = did_you_mean(name, action_parse_methods, limit=2)
            raise RuntimeError(f"Unrecognized entity of the type: {name}. {guess}".rstrip())
        try:
            kind, options = action_parse_methods[name](entity, self)
            entity.assert_entity_completely_parsed()
            action: Action = kind(**options)
        except (AttributeError, TypeError, ValueError) as error:
            raise RuntimeError(f"<{name}>: {error}") from error
        return action

    def parse_description(self, entity: Entity) -> LaunchDescription:
        """Return the launch description of a file.

        Raises:
            RuntimeError: The root is not ``launch``, or an element is wrong.
        """
        from launch.launch_description import LaunchDescription  # noqa: PLC0415 - a cycle

        if entity.type_name != "launch":
            raise RuntimeError(f"Expected 'launch' as root of the launch file, found '{entity.type_name}'")
        entity.get_attr("version", optional=True, data_type=None)
        reason = entity.get_attr("deprecated", optional=True)
        actions = [self.parse_action(child) for child in entity.children]
        entity.assert_entity_completely_parsed()
        return LaunchDescription(actions, deprecated_reason=reason)
