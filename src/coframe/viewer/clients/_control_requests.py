# SPDX-License-Identifier: Apache-2.0
"""The requests of a page that acts on the graph, which the viewer must have permitted."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING, Any

from coframe.viewer.protocol import client_messages
from coframe.viewer.protocol.requests import BadRequestError
from coframe.viewer.protocol.server_messages import Controlled, ControlledField
from coframe.viewer.tools.control import ControlError, ControlField

if TYPE_CHECKING:
    from collections.abc import Awaitable, Callable

    from coframe.viewer.clients._state import ClientState
    from coframe.viewer.protocol.server_messages import ServerMessage
    from coframe.viewer.tools.control import GraphControl

__all__ = ["CONTROL_HANDLERS"]

_MAX_NAMES = 1000


async def _control(client: ClientState, request: client_messages.ControlGraph) -> Controlled:
    control = _require_control(client)
    try:
        # Not in the executor of the viewer, because a goal may take minutes.
        text, ros_type, fields = await asyncio.to_thread(_execute, control, request)
    except ControlError as error:
        return _answer(request.id, text=str(error), hint=error.hint)
    return _answer(request.id, ok=True, text=text, ros_type=ros_type, fields=fields)


async def _drive(client: ClientState, request: client_messages.Drive) -> None:
    control = _require_control(client)
    try:
        await asyncio.to_thread(control.drive, request.topic, request.ros_type, request.linear, request.angular)
    except ControlError as error:
        raise BadRequestError(str(error), error.hint) from None


def _execute(control: GraphControl, request: client_messages.ControlGraph) -> tuple[str, str, list[ControlField]]:
    if request.step == "names":
        names = sorted(control.names(request.kind).items())[:_MAX_NAMES]
        return "", "", [ControlField(name, ros_type, "") for name, ros_type in names]
    if request.step == "form":
        return "", *control.form(request.kind, request.name, request.ros_type)
    text, fields = control.act(request.kind, request.name, request.ros_type, request.values)
    return text, request.ros_type, fields


def _require_control(client: ClientState) -> GraphControl:
    control = client.viewer.control
    if control is None:
        raise BadRequestError(
            "this viewer is not allowed to act on the graph", "Start it with `coframe view --control`."
        )
    return control


def _answer(
    number: int,
    *,
    ok: bool = False,
    text: str = "",
    hint: str = "",
    ros_type: str = "",
    fields: list[ControlField] | None = None,
) -> Controlled:
    rows = [ControlledField(path=one.path, type=one.type, value=one.value) for one in fields or []]
    return Controlled(type="controlled", id=number, ok=ok, text=text, hint=hint, ros_type=ros_type, fields=rows)


CONTROL_HANDLERS: dict[type, Callable[[ClientState, Any], Awaitable[ServerMessage | None]]] = {
    client_messages.ControlGraph: _control,
    client_messages.Drive: _drive,
}
