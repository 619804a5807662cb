# SPDX-License-Identifier: Apache-2.0
"""The action that leads lifecycle nodes through several transitions."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.action import Action
from launch.actions import EmitEvent, RegisterEventHandler
from launch.event_handler import EventHandler
from launch.frontend.expose import expose_action
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch_ros.events import matches_node_name
from launch_ros.events.lifecycle import ChangeState, StateTransition

if TYPE_CHECKING:
    from collections.abc import Iterable

    from launch.event import Event
    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType

__all__ = ["LifecycleTransition"]


@expose_action("lifecycle_transition")
class LifecycleTransition(Action):
    """Perform transitions of lifecycle nodes, each after the node has finished the previous one.

    Args:
        lifecycle_node_names: Names of the nodes, with their namespaces.
        transition_ids: Numbers or names of the transitions, such as ``configure``.
        condition: Do it only if this condition holds.
    """

    def __init__(
        self,
        *,
        lifecycle_node_names: Iterable[SomeSubstitutionsType],
        transition_ids: Iterable[int | SomeSubstitutionsType],
        **options: Any,
    ) -> None:
        super().__init__(**options)
        self.__names = [normalize_to_list_of_substitutions(name) for name in lifecycle_node_names]
        self.__transitions = [
            normalize_to_list_of_substitutions(str(each) if isinstance(each, int) else each) for each in transition_ids
        ]
        if not self.__names or not self.__transitions:
            raise ValueError("LifecycleTransition needs at least one node name and one transition")

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[Action], dict[str, Any]]:
        """Read ``<lifecycle_transition>`` with its ``<lifecycle_node name=...>`` and ``<transition type=...>``."""
        _, options = super().parse(entity, parser)
        for tag, attribute, keyword in (
            ("lifecycle_node", "name", "lifecycle_node_names"),
            ("transition", "type", "transition_ids"),
        ):
            options[keyword] = [
                parser.parse_substitution(child.get_attr(attribute)) for child in entity.get_attr(tag, data_type=list)
            ]
        return cls, options

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Emit the first event for each node, after the handlers that emit the others."""
        numbers = [_number(perform_substitutions(context, each)) for each in self.__transitions]
        found: list[Any] = []
        for parts in self.__names:
            name = perform_substitutions(context, parts)
            requests = [
                EmitEvent(event=ChangeState(lifecycle_node_matcher=matches_node_name(name), transition_id=number))
                for number in numbers
            ]
            found += [
                RegisterEventHandler(_after(name, number, following))
                for number, following in zip(numbers, requests[1:], strict=False)
            ]
            found.append(requests[0])
        return found


def _after(name: str, number: int, following: EmitEvent) -> EventHandler:
    matches_name = matches_node_name(name)

    def matches(event: Event) -> bool:
        if not isinstance(event, StateTransition) or not matches_name(event.action):
            return False
        # Nodes of some versions of ROS leave the number of the transition at 0.
        label = ChangeState.valid_transitions[number]
        return event.transition_id == number or event.transition == label

    return EventHandler(matcher=matches, entities=following, handle_once=True)


def _number(text: str) -> int:
    names: dict[str, int] = {name: number for number, name in ChangeState.valid_transitions.items()}
    if text.isdecimal() and int(text) in ChangeState.valid_transitions:
        return int(text)
    if text not in names:
        raise ValueError(f"'{text}' is not a transition. Known transitions: {', '.join(names)}")
    return names[text]
