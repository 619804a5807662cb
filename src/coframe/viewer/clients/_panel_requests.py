# SPDX-License-Identifier: Apache-2.0
"""The requests of the panels next to the scene."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING, Any

from coframe.viewer.protocol import client_messages
from coframe.viewer.protocol.panel_messages import Completions
from coframe.viewer.protocol.requests import BadRequestError

if TYPE_CHECKING:
    from collections.abc import Awaitable, Callable

    from coframe.viewer.clients._state import ClientState
    from coframe.viewer.protocol.server_messages import ServerMessage

__all__ = ["PANEL_HANDLERS"]


async def _set_curves(client: ClientState, request: client_messages.SetCurves) -> None:
    from coframe.viewer.panels.curve import CurveSpan  # noqa: PLC0415 - only curves need it

    first, last = (None, None) if request.span is None else (round(at) + client.origin for at in request.span)
    client.panels.set_curves(request.curves, CurveSpan(first, last, request.points))


async def _inspect(client: ClientState, request: client_messages.InspectTopic) -> None:
    client.panels.inspect(request.topic)


async def _show_table(client: ClientState, request: client_messages.ShowTable) -> None:
    client.panels.show_table(request.topic, request.rows)


async def _show_states(client: ClientState, request: client_messages.ShowStates) -> None:
    client.panels.set_states(request.fields)


async def _show_log(client: ClientState, request: client_messages.ShowLog) -> None:
    client.panels.show_log(shown=request.shown)


async def _show_graph(client: ClientState, request: client_messages.ShowGraph) -> None:
    client.panels.show_graph(shown=request.shown)


async def _complete(client: ClientState, request: client_messages.RequestCompletions) -> Completions:
    from coframe.viewer.panels.completion import (  # noqa: PLC0415 - see above
        MAX_TEXT,
        complete_expression,
        complete_topic,
    )

    if len(request.text) > MAX_TEXT:
        raise BadRequestError(f"the text to complete has at most {MAX_TEXT} characters")
    complete = complete_expression if request.subject == "expression" else complete_topic
    viewer = client.viewer
    loop = asyncio.get_running_loop()
    items = await loop.run_in_executor(viewer.executor, complete, viewer.source, request.text)
    return Completions(type="completions", id=request.id, items=items)


PANEL_HANDLERS: dict[type, Callable[[ClientState, Any], Awaitable[ServerMessage | None]]] = {
    client_messages.RequestCompletions: _complete,
    client_messages.InspectTopic: _inspect,
    client_messages.SetCurves: _set_curves,
    client_messages.ShowGraph: _show_graph,
    client_messages.ShowLog: _show_log,
    client_messages.ShowStates: _show_states,
    client_messages.ShowTable: _show_table,
}
