# SPDX-License-Identifier: Apache-2.0
"""The actions that repeat entities: for a number of times, or for each of several sets of values."""

from __future__ import annotations

import inspect
from typing import TYPE_CHECKING, Any

from launch.action import Action
from launch.actions.opaque_function import OpaqueFunction
from launch.frontend.expose import expose_action
from launch.utilities import normalize_to_list_of_entities, normalize_to_list_of_substitutions, perform_substitutions
from launch.utilities.yaml_loading import load_yaml

if TYPE_CHECKING:
    from collections.abc import Callable

    from launch.frontend import Entity, Parser
    from launch.launch_context import LaunchContext
    from launch.launch_description_entity import LaunchDescriptionEntity
    from launch.some_entities_type import SomeEntitiesType
    from launch.some_substitutions_type import SomeSubstitutionsType
    from launch.substitution import Substitution

__all__ = ["ForEach", "ForLoop"]

SEPARATOR = ";"
MAX_REPETITIONS = 10_000  # of a loop; each makes entities, which stay in memory until they have been visited


@expose_action("for_each")
class ForEach(Action):
    """Call a function for each set of values, and visit the entities that it returns.

    Args:
        input_values: Sets of values as YAML, separated by semicolons: ``{name: 'a', id: 1};{name: 'b', id: 2}``.
        function: Function with an argument for each value, by the same name.
        condition: Do it only if this condition holds.
    """

    SEPARATOR = SEPARATOR

    def __init__(
        self, input_values: SomeSubstitutionsType, *, function: Callable[..., SomeEntitiesType | None], **options: Any
    ) -> None:
        super().__init__(**options)
        self.__input_values = normalize_to_list_of_substitutions(input_values)
        self.__function = function

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[Action], dict[str, Any]]:
        """Read ``<for_each values=...>``, whose actions use ``$(for-var NAME)``."""
        _, options = super().parse(entity, parser)
        options["input_values"] = parser.parse_substitution(entity.get_attr("values"))
        children = entity.children

        def iterate(**values: Any) -> list[LaunchDescriptionEntity]:
            return _with_locals(values, [parser.parse_action(child) for child in children])

        return cls, options | {"function": iterate}

    @property
    def input_values(self) -> list[Substitution]:
        """The sets of values."""
        return self.__input_values

    @property
    def function(self) -> Callable[..., SomeEntitiesType | None]:
        """The function."""
        return self.__function

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Call the function for each set of values."""
        text = perform_substitutions(context, self.__input_values)
        entities: list[LaunchDescriptionEntity] = []
        for part in text.strip().strip(SEPARATOR).split(SEPARATOR) if text.strip() else ():
            values = load_yaml(part)
            if not isinstance(values, dict):
                raise ValueError(f"ForEach needs sets of values such as {{name: 'a', id: 1}}, not {part.strip()!r}")  # noqa: TRY004
            self.__check(values)
            entities += normalize_to_list_of_entities(self.__function(**values))
        return entities

    def __check(self, values: dict[str, Any]) -> None:
        parameters = inspect.signature(self.__function).parameters.values()
        if any(each.kind is each.VAR_KEYWORD for each in parameters):
            return
        names = {each.name for each in parameters}
        missing = {each.name for each in parameters if each.default is each.empty} - values.keys()
        if missing or values.keys() - names:
            raise ValueError(
                f"ForEach: the function has the arguments {sorted(names)}, but the values are {sorted(values)}"
            )


@expose_action("for")
class ForLoop(Action):
    """Call a function for the numbers 0 to `length` - 1, and visit the entities that it returns.

    Args:
        length: The number of repetitions.
        function: Function of the number.
        name: Name of the number in descriptions.
        condition: Do it only if this condition holds.
    """

    def __init__(
        self,
        length: SomeSubstitutionsType,
        *,
        function: Callable[[int], SomeEntitiesType | None],
        name: str = "i",
        **options: Any,
    ) -> None:
        super().__init__(**options)
        self.__length = normalize_to_list_of_substitutions(length)
        self.__function = function
        self.__name = name

    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> tuple[type[Action], dict[str, Any]]:
        """Read ``<for len=... name=...>``, whose actions use ``$(index NAME)``."""
        _, options = super().parse(entity, parser)
        name = parser.escape_characters(entity.get_attr("name"))
        options["length"] = parser.parse_substitution(entity.get_attr("len"))
        children = entity.children

        def iterate(index: int) -> list[LaunchDescriptionEntity]:
            return _with_locals({name: index}, [parser.parse_action(child) for child in children])

        return cls, options | {"function": iterate, "name": name}

    @property
    def length(self) -> list[Substitution]:
        """The number of calls of the function."""
        return self.__length

    @property
    def function(self) -> Callable[[int], SomeEntitiesType | None]:
        """The function."""
        return self.__function

    @property
    def name(self) -> str:
        """The name of the number."""
        return self.__name

    def execute(self, context: LaunchContext) -> list[Any] | None:
        """Call the function for each number."""
        text = perform_substitutions(context, self.__length)
        try:
            length = int(text)
        except ValueError:
            raise ValueError(f"ForLoop needs a whole number as its length, not {text!r}") from None
        if length > MAX_REPETITIONS:
            raise ValueError(f"ForLoop has the length {length}, which exceeds the limit of {MAX_REPETITIONS}")
        found = [entity for index in range(length) for entity in normalize_to_list_of_entities(self.__function(index))]
        return list(found)


def _with_locals(values: dict[str, Any], entities: list[Any]) -> list[LaunchDescriptionEntity]:
    """Return entities between actions that set and restore the loop's values for the substitutions in them."""
    outer: dict[str, Any] = {}

    def enter(context: LaunchContext) -> None:
        outer.update(context.get_locals_as_dict().get("for_values") or {})
        context.extend_locals({"for_values": {**outer, **values}})

    def leave(context: LaunchContext) -> None:
        context.extend_locals({"for_values": dict(outer)})

    return [OpaqueFunction(function=enter), *entities, OpaqueFunction(function=leave)]
