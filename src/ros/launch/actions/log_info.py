# SPDX-License-Identifier: Apache-2.0
"""The action that logs a message."""

from __future__ import annotations

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

__all__ = ["LogInfo"]


@expose_action("log")
class LogInfo(Action):
    """Log a message at the level INFO."""

    def __init__(self, *, msg: SomeSubstitutionsType, **options: Any) -> None:
        super().__init__(**options)
        self.__msg = normalize_to_list_of_substitutions(msg)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[Action], dict[str, Any]]:
        """Read ``<log message=...>``."""
        _, options = super().parse(entity, parser)
        entity.get_attr("level", optional=True)
        return cls, options | {"msg": parser.parse_substitution(entity.get_attr("message"))}

    @property
    def msg(self) -> list[Substitution]:
        """The message."""
        return self.__msg

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Log the message."""
        launch.logging.get_logger("launch.user").info(perform_substitutions(context, self.__msg))
        return None
