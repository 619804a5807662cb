# SPDX-License-Identifier: Apache-2.0
"""The messages of a service or an action: requests, goals, and the parts of the action protocol."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.messages._parser import Field, MessageStructure
from coframe.messages.definition import BasicType, BoundedSequence, NamespacedType

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["NUMBER_OF_PARTS", "event", "member_messages"]

# The number of parts, separated by "---", in a definition of each kind.
NUMBER_OF_PARTS = {"msg": 1, "srv": 2, "action": 3}

_GOAL_ID = Field("goal_id", NamespacedType(("unique_identifier_msgs", "msg"), "UUID"), None)
_TIME = NamespacedType(("builtin_interfaces", "msg"), "Time")


def member_messages(
    package: str, kind: str, name: str, parts: Sequence[MessageStructure]
) -> dict[str, MessageStructure]:
    """Return the messages of one definition by name: one for a message, two for a service, eight for an action."""
    if kind == "msg":
        return {name: parts[0]}
    if kind == "srv":
        return _service(name, parts[0], parts[1])
    goal, result, feedback = (f"{name}_{part}" for part in ("Goal", "Result", "Feedback"))

    def own(message: str) -> NamespacedType:
        return NamespacedType((package, kind), message)

    return {
        **dict(zip((goal, result, feedback), parts, strict=True)),
        **_service(
            f"{name}_SendGoal",
            _structure(_GOAL_ID, Field("goal", own(goal), None)),
            _structure(Field("accepted", BasicType("boolean"), None), Field("stamp", _TIME, None)),
        ),
        **_service(
            f"{name}_GetResult",
            _structure(_GOAL_ID),
            _structure(Field("status", BasicType("int8"), None), Field("result", own(result), None)),
        ),
        f"{name}_FeedbackMessage": _structure(_GOAL_ID, Field("feedback", own(feedback), None)),
    }


def event(package: str, name: str, kind: str = "srv") -> MessageStructure:
    """Return the message in which a service of ROS 2 Iron and later publishes its requests and responses.

    Args:
        package: The package of the service.
        name: The name of the service.
        kind: ``srv``, or ``action`` for a service of the action protocol.
    """

    def of(part: str) -> BoundedSequence:
        return BoundedSequence(NamespacedType((package, kind), f"{name}_{part}"), 1)

    info = Field("info", NamespacedType(("service_msgs", "msg"), "ServiceEventInfo"), None)
    return _structure(info, Field("request", of("Request"), None), Field("response", of("Response"), None))


def _service(name: str, request: MessageStructure, response: MessageStructure) -> dict[str, MessageStructure]:
    return {f"{name}_Request": request, f"{name}_Response": response}


def _structure(*fields: Field) -> MessageStructure:
    return MessageStructure(list(fields), [], "")
