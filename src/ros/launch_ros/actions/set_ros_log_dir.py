# SPDX-License-Identifier: Apache-2.0
"""The action that sets the folder of the log files of nodes."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from launch.action import Action
from launch.frontend.expose import expose_action
from launch.logging import launch_config
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions

if TYPE_CHECKING:
    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution

__all__ = ["SetROSLogDir"]


@expose_action("set_ros_log_dir")
class SetROSLogDir(Action):
    """Set the environment variable ROS_LOG_DIR for all processes after it in the same group.

    A relative path is relative to the present folder: that of ROS_LOG_DIR, or else that of this launch.
    """

    def __init__(self, new_log_dir: SomeSubstitutionsType, **options: Any) -> None:
        super().__init__(**options)
        self.__log_dir = normalize_to_list_of_substitutions(new_log_dir)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[Action], dict[str, Any]]:
        """Read ``<set_ros_log_dir new_log_dir=...>``."""
        _, options = super().parse(entity, parser)
        return cls, options | {"new_log_dir": parser.parse_substitution(entity.get_attr("new_log_dir"))}

    @property
    def log_dir(self) -> list[Substitution]:
        """The folder."""
        return self.__log_dir

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Set the variable."""
        present = context.environment.get("ROS_LOG_DIR") or launch_config.log_dir
        context.environment["ROS_LOG_DIR"] = str(Path(present) / perform_substitutions(context, self.__log_dir))
        return None
