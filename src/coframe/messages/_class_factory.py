# SPDX-License-Identifier: Apache-2.0
"""Create message, service and action classes from definitions at run time.

The classes behave like the generated ones. Each class is created on first use, together with the others of its
definition: a service with its request and response, an action with its goal, result, feedback and protocol.
"""

from __future__ import annotations

import threading
from array import array
from typing import TYPE_CHECKING, Any

import coframe.lazy_numpy as np
from coframe.errors import CoframeError, InterfaceError
from coframe.messages._class_limits import check_limits
from coframe.messages._constructors import default_assignments
from coframe.messages.compounds import member_messages
from coframe.messages.definition import AbstractNestedType, AbstractType, NamespacedType
from coframe.messages.limits import MAX_DEPTH
from coframe.messages.message import Action, Message, MessageType, Service, set_fields
from coframe.messages.registry import classes, find

if TYPE_CHECKING:
    from collections.abc import Sequence

    from coframe.messages._parser import Field, MessageStructure

__all__ = ["FieldError", "class_name", "create_classes", "new_message_class"]

_lock = threading.RLock()
_in_progress: list[str] = []


class FieldError(CoframeError, ValueError):
    """A field that cannot be created.

    Attributes:
        field: The name of the field.
        problem: A description of the problem.
        missing: The name of a type that does not exist, or "" if the problem is another one.
    """

    def __init__(self, field: str, problem: str, missing: str = "") -> None:
        super().__init__(f"field {field!r}: {problem}")
        self.field = field
        self.problem = problem
        self.missing = missing


def create_classes(package: str, kind: str, name: str, parts: Sequence[MessageStructure]) -> None:
    """Create the classes of one definition and register them.

    Args:
        package: The package of the definition.
        kind: ``msg``, ``srv`` or ``action``.
        name: The name of the message, service or action.
        parts: The structures of the definition: 1 for a message, 2 for a service, 3 for an action.

    Raises:
        FieldError: The type of a field does not exist, contains the message itself, or is too large.
    """
    with _lock:
        if f"{package}/{kind}/{name}" in classes:
            return  # Another thread has already created it.
        for message, structure in member_messages(package, kind, name, parts).items():
            _create_message(f"{package}/{kind}/{message}", structure)
        if kind == "srv":
            _create_service(package, kind, name)
        elif kind == "action":
            _create_action(package, kind, name)


def _create_message(ros_type: str, structure: MessageStructure) -> None:
    _in_progress.append(ros_type)
    try:
        inner = _inner_classes(structure.fields)
    finally:
        _in_progress.pop()
    new_message_class(ros_type, structure, inner)


def new_message_class(
    ros_type: str, structure: MessageStructure, inner: dict[str, type], *, is_recorded: bool = False
) -> type[Message]:
    """Return a new message class.

    Args:
        ros_type: The name of the type.
        structure: Its fields and constants.
        inner: The classes of the messages in its fields, by the names that :func:`class_name` returns.
        is_recorded: Whether the class comes from a definition in a recording, and is not registered.
    """
    cls: Any = MessageType(
        ros_type.rpartition("/")[2],
        (Message,),
        {
            "__doc__": structure.comment or f"Message {ros_type}.",
            "__recorded__": is_recorded,
            "ROS_TYPE": ros_type,
            "SLOT_TYPES": tuple(field.type for field in structure.fields),
            "__slots__": [f"_{field.name}" for field in structure.fields],
            "__init__": _constructor(ros_type, structure.fields, inner),
            **{constant.name: constant.value for constant in structure.constants},
            **{f"{f.name.upper()}__DEFAULT": f.default for f in structure.fields if f.default is not None},
        },
    )
    return cls  # type: ignore[no-any-return]


def _inner_classes(fields: list[Field]) -> dict[str, type]:
    """Return the classes of the messages in a message, by the names that its constructor uses for them."""
    inner: dict[str, type] = {}
    for field in fields:
        type_: Any = _value_type(field.type)
        try:
            if isinstance(type_, NamespacedType):
                inner[class_name(type_)] = _find_inner(_ros_type(type_))
            check_limits([field.type])
        except InterfaceError:
            raise  # The error is about the inner message, and contains its file name.
        except LookupError as error:
            raise FieldError(field.name, str(error), _ros_type(type_)) from None
        except ValueError as error:
            raise FieldError(field.name, str(error)) from None
    try:
        check_limits([field.type for field in fields])
    except ValueError as error:
        raise FieldError(fields[-1].name, str(error)) from None
    return inner


def _find_inner(ros_type: str) -> Any:
    if ros_type in _in_progress:
        chain = " > ".join([*_in_progress[_in_progress.index(ros_type) :], ros_type])
        raise ValueError(f"a message cannot contain itself: {chain}")
    if len(_in_progress) > MAX_DEPTH:
        raise ValueError(f"messages are nested more than {MAX_DEPTH} levels deep")
    return find(ros_type)


def _ros_type(type_: NamespacedType) -> str:
    return "/".join(type_.namespaced_name())


def class_name(type_: NamespacedType) -> str:
    """Return the name by which the constructor of a message uses the class of a message inside it."""
    return "__".join(type_.namespaced_name())


def _constructor(ros_type: str, fields: list[Field], inner: dict[str, type]) -> Any:
    names: dict[str, Any] = {"array": array, "np": np, "set_fields": set_fields, **inner}
    lines = [*default_assignments(fields, class_name), "if fields:", "    set_fields(self, fields)"]
    source = "\n    ".join(["def __init__(self, **fields):", *lines])
    exec(compile(source, f"<constructor of {ros_type}>", "exec"), names)  # noqa: S102 - names are checked by the parser
    return names["__init__"]


def _value_type(type_: AbstractType) -> AbstractType:
    return type_.value_type if isinstance(type_, AbstractNestedType) else type_


def _create_service(package: str, kind: str, name: str) -> type:
    ros_type = f"{package}/{kind}/{name}"
    return type(
        name,
        (Service,),
        {
            "__doc__": f"Service {ros_type}.",
            "ROS_TYPE": ros_type,
            "Request": classes[f"{ros_type}_Request"],
            "Response": classes[f"{ros_type}_Response"],
        },
    )


def _create_action(package: str, kind: str, name: str) -> None:
    ros_type = f"{package}/{kind}/{name}"
    protocol = {
        "__doc__": "The services and messages of the action protocol.",
        "SendGoalService": _create_service(package, kind, f"{name}_SendGoal"),
        "GetResultService": _create_service(package, kind, f"{name}_GetResult"),
        "FeedbackMessage": classes[f"{ros_type}_FeedbackMessage"],
        "CancelGoalService": find("action_msgs/srv/CancelGoal"),
        "GoalStatusMessage": find("action_msgs/msg/GoalStatusArray"),
    }
    parts = {part: classes[f"{ros_type}_{part}"] for part in ("Goal", "Result", "Feedback")}
    documentation = {"__doc__": f"Action {ros_type}.", "ROS_TYPE": ros_type}
    type(name, (Action,), {**documentation, **parts, "Impl": type("Impl", (), protocol)})
