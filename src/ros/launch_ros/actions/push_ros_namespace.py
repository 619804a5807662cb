# SPDX-License-Identifier: Apache-2.0
"""The action that sets a namespace for the nodes after it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.action import Action
from launch.frontend.expose import expose_action
from launch.substitutions import SubstitutionFailure
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch_ros.utilities import make_namespace_absolute, prefix_namespace

if TYPE_CHECKING:
    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution

__all__ = ["PushROSNamespace", "PushRosNamespace"]


@expose_action("push_ros_namespace")
@expose_action("push-ros-namespace")
class PushRosNamespace(Action):
    """Set a namespace for the nodes after it in the same group, below the present one."""

    def __init__(self, namespace: SomeSubstitutionsType, **options: Any) -> None:
        super().__init__(**options)
        self.__namespace = normalize_to_list_of_substitutions(namespace)

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[Action], dict[str, Any]]:
        """Read ``<push_ros_namespace namespace=...>``."""
        _, options = super().parse(entity, parser)
        return cls, options | {"namespace": parser.parse_substitution(entity.get_attr("namespace"))}

    @property
    def namespace(self) -> list[Substitution]:
        """The namespace."""
        return self.__namespace

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Set the namespace."""
        from rclpy.validate_namespace import validate_namespace  # noqa: PLC0415 - rclpy is slow to import

        pushed = perform_substitutions(context, self.__namespace)
        previous = context.launch_configurations.get("ros_namespace")
        namespace = make_namespace_absolute(prefix_namespace(previous, pushed)) or "/"
        try:
            validate_namespace(namespace)
        except Exception as error:
            raise SubstitutionFailure(
                f"The resulting namespace is invalid: '{namespace}' (pushed '{pushed}' onto '{previous}'): {error}"
            ) from error
        context.launch_configurations["ros_namespace"] = namespace
        return None


PushROSNamespace = PushRosNamespace
