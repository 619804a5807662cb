# SPDX-License-Identifier: Apache-2.0
"""The actions that log a message."""

from __future__ import annotations

import logging
from typing import TYPE_CHECKING, Any

import launch.logging
from launch.action import Action
from launch.frontend.expose import expose_action
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution

__all__ = ["Log", "LogDebug", "LogError", "LogInfo", "LogWarning"]

_LEVELS = {name: getattr(logging, name) for name in ("DEBUG", "INFO", "WARNING", "ERROR", "CRITICAL")}
_ALIASES = {"WARN": "WARNING", "FATAL": "CRITICAL"}


@expose_action("log")
class Log(Action):
    """Log a message.

    Args:
        msg: The message.
        level: Name of its level, such as ``WARNING``.
        condition: Log it only if this condition holds.
    """

    def __init__(self, *, msg: SomeSubstitutionsType, level: SomeSubstitutionsType, **options: Any) -> None:
        super().__init__(**options)
        self.__msg = normalize_to_list_of_substitutions(msg)
        self.__level = normalize_to_list_of_substitutions(level)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[Action], dict[str, Any]]:
        """Read ``<log message=... level=...>``; as before Lyrical, the level may be omitted and is INFO."""
        _, options = super().parse(entity, parser)
        level = entity.get_attr("level", optional=True)
        options["level"] = parser.parse_substitution("INFO" if level is None else level)
        return cls, options | {"msg": parser.parse_substitution(entity.get_attr("message"))}

    @property
    def msg(self) -> list[Substitution]:
        """The message."""
        return self.__msg

    @property
    def level(self) -> list[Substitution]:
        """The name of the level."""
        return self.__level

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Log the message.

        Raises:
            KeyError: There is no such level.
        """
        name = perform_substitutions(context, self.__level).upper()
        level = _LEVELS.get(_ALIASES.get(name, name))
        if level is None:
            raise KeyError(f"Invalid log level '{name}', expected: {', '.join(_LEVELS)}")
        launch.logging.get_logger("launch.user").log(level, perform_substitutions(context, self.__msg))
        return None


class _LogAtLevel(Log):
    """Base class: log a message at the level of the class."""

    _level: str

    def __init__(self, *, msg: SomeSubstitutionsType, **options: Any) -> None:
        super().__init__(msg=msg, level=self._level, **options)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[Action], dict[str, Any]]:
        """Read an element such as ``<log_info message=...>``."""
        _, options = Action.parse(entity, parser)
        return cls, options | {"msg": parser.parse_substitution(entity.get_attr("message"))}


@expose_action("log_debug")
class LogDebug(_LogAtLevel):
    """Log a message at the level DEBUG."""

    _level = "DEBUG"


@expose_action("log_info")
class LogInfo(_LogAtLevel):
    """Log a message at the level INFO."""

    _level = "INFO"


@expose_action("log_warning")
class LogWarning(_LogAtLevel):
    """Log a message at the level WARNING."""

    _level = "WARNING"


@expose_action("log_error")
class LogError(_LogAtLevel):
    """Log a message at the level ERROR."""

    _level = "ERROR"
