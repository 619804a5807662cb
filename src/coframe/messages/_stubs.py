# SPDX-License-Identifier: Apache-2.0
"""Stub files (``.pyi``) of interface packages, which describe the fields of each class to editors and type checkers."""

from __future__ import annotations

import keyword
import math
from typing import TYPE_CHECKING

from coframe.messages._fields import number_of
from coframe.messages.compounds import member_messages
from coframe.messages.definition import AbstractNestedType, AbstractType, Array, BasicType, NamespacedType

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from coframe.messages._parser import Constant, Field, MessageStructure

__all__ = ["field_hint", "parameter_hint", "stub", "value_type"]

_PROTOCOL = (
    ("SendGoalService", "{name}_SendGoal"),
    ("GetResultService", "{name}_GetResult"),
    ("FeedbackMessage", "{name}_FeedbackMessage"),
    ("CancelGoalService", "action_msgs.srv.CancelGoal"),
    ("GoalStatusMessage", "action_msgs.msg.GoalStatusArray"),
)


def value_type(type_: AbstractType) -> AbstractType:
    """Return the element type of an array or sequence, and other types unchanged."""
    return type_.value_type if isinstance(type_, AbstractNestedType) else type_


def field_hint(type_: AbstractType, class_name: Callable[[NamespacedType], str]) -> str:
    """Return the type hint of values of a type; for arrays and sequences of numbers, of a list of them."""
    if isinstance(type_, AbstractNestedType):
        return f"list[{field_hint(type_.value_type, class_name)}]"
    if isinstance(type_, NamespacedType):
        return class_name(type_)
    if isinstance(type_, BasicType):
        hints = {"boolean": "bool", "octet": "bytes", "float": "float", "double": "float"}
        return hints.get(type_.typename, "int")
    return "str"


def parameter_hint(type_: AbstractType, class_name: Callable[[NamespacedType], str]) -> str:
    """Return the type hint of a constructor's parameter."""
    if number_of(type_):
        return f"Iterable[{field_hint(value_type(type_), class_name)}]"
    return field_hint(type_, class_name)


def stub(package: str, kind: str, definitions: Mapping[str, Sequence[MessageStructure]]) -> str:
    """Return the stub of a module with all messages, services or actions of a package.

    Args:
        package: The name of the package.
        kind: ``msg``, ``srv`` or ``action``.
        definitions: The structures of each definition, by its name.
    """
    return _Stub(package, kind).text(definitions)


class _Stub:
    """The stub of one module."""

    def __init__(self, package: str, kind: str) -> None:
        self._package = package
        self._kind = kind
        self._modules = {"numpy as np"}

    def text(self, definitions: Mapping[str, Sequence[MessageStructure]]) -> str:
        classes = [line for name, parts in definitions.items() for line in self._definition(name, parts)]
        return "\n".join(
            [
                *(f"import {module}" for module in sorted(self._modules)),
                "from collections.abc import Iterable",
                "from typing import Final, TypeAlias",
                "",
                "from coframe.messages._hints import NumberArray, NumberSequence",
                "from coframe.messages.message import Action, Message, Service",
                "",
                f"__all__ = [{', '.join(map(_quote, definitions))}]",
                "",
                *classes,
                "",
            ]
        )

    def _definition(self, name: str, parts: Sequence[MessageStructure]) -> list[str]:
        lines: list[str] = []
        for message, structure in member_messages(self._package, self._kind, name, parts).items():
            lines += self._message(message, structure)
        if self._kind == "srv":
            lines += _service(name)
        elif self._kind == "action":
            lines += self._action(name)
        return lines

    def _message(self, name: str, structure: MessageStructure) -> list[str]:
        # A field whose name is a keyword of Python can only be used with getattr() and setattr().
        fields = [field for field in structure.fields if not keyword.iskeyword(field.name)]
        parameters = "".join(f", {field.name}: {parameter_hint(field.type, self._name)} = ..." for field in fields)
        star = ", *" if fields else ""
        return [
            f"class {name}(Message):",
            *(f"    {constant.name}: {_constant(constant)}" for constant in structure.constants),
            *(f"    {field.name}: {self._field(field)}" for field in fields),
            f"    def __init__(self{star}{parameters}) -> None: ...",
            "",
        ]

    def _field(self, field: Field) -> str:
        number = number_of(field.type)
        if number is None:
            return field_hint(field.type, self._name)
        if isinstance(field.type, Array):
            return f"NumberArray[np.{number.name}]"
        return f"NumberSequence[{field_hint(value_type(field.type), self._name)}]"

    def _name(self, type_: NamespacedType) -> str:
        if type_.namespaces == (self._package, self._kind):
            return type_.name
        module = ".".join(type_.namespaces)
        self._modules.add(module)
        return f"{module}.{type_.name}"

    def _action(self, name: str) -> list[str]:
        self._modules |= {"action_msgs.msg", "action_msgs.srv"}
        return [
            *_service(f"{name}_SendGoal"),
            *_service(f"{name}_GetResult"),
            f"class {name}(Action):",
            *(f"    {part}: TypeAlias = {name}_{part}" for part in ("Goal", "Result", "Feedback")),
            "    class Impl:",
            *(f"        {part}: TypeAlias = {target.format(name=name)}" for part, target in _PROTOCOL),
            "",
        ]


def _service(name: str) -> list[str]:
    return [
        f"class {name}(Service):",
        f"    Request: TypeAlias = {name}_Request",
        f"    Response: TypeAlias = {name}_Response",
        "",
    ]


def _constant(constant: Constant) -> str:
    if isinstance(constant.value, float) and not math.isfinite(constant.value):
        return "Final[float]"
    return f"Final = {_quote(constant.value) if isinstance(constant.value, str) else repr(constant.value)}"


def _quote(text: str) -> str:
    return f'"{text}"' if text.isidentifier() else repr(text)
