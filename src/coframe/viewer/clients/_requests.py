# SPDX-License-Identifier: Apache-2.0
"""The requests of clients: one handler per type of message."""

from __future__ import annotations

import asyncio
from typing import TYPE_CHECKING, Any, TypeVar

from coframe.doctor.codes import codes, page
from coframe.errors import ViewerError, WireError
from coframe.viewer.clients._control_requests import CONTROL_HANDLERS
from coframe.viewer.clients._panel_requests import PANEL_HANDLERS
from coframe.viewer.clients._upload_requests import UPLOAD_HANDLERS, UploadedPart, receive_part
from coframe.viewer.displays import Options
from coframe.viewer.displays.part_values import part_values
from coframe.viewer.protocol import client_messages
from coframe.viewer.protocol.requests import BadRequestError
from coframe.viewer.protocol.schema import shorten
from coframe.viewer.protocol.server_messages import (
    CodePage,
    PartDetails,
    PickedField,
    PublishResult,
    ReplayPrepared,
    Rviz,
    RvizSaved,
    Timeline,
)
from coframe.viewer.replay.displays import ReplayDisplay
from coframe.viewer.replay.page import MAX_DISPLAYS, ReplaySettings
from coframe.viewer.rviz.config import RvizConfig
from coframe.viewer.scene.relations import relate
from coframe.viewer.scene.timeline import edge_rows, next_stamp

if TYPE_CHECKING:
    from collections.abc import Awaitable, Callable

    from coframe.viewer.clients._state import ClientState
    from coframe.viewer.protocol.client_messages import ClientMessage
    from coframe.viewer.protocol.server_messages import Relation, ServerMessage
    from coframe.viewer.tools.publisher import ToolPublisher

__all__ = ["handle"]

T = TypeVar("T")


async def handle(client: ClientState, request: ClientMessage | UploadedPart) -> ServerMessage | None:
    """Execute a request, and return the answer, or None if the request has none.

    Raises:
        BadRequestError: The request cannot be fulfilled.
    """
    if isinstance(request, UploadedPart):
        return await receive_part(client, request)
    return await _HANDLERS[type(request)](client, request)


async def _set_fixed_frame(client: ClientState, request: client_messages.SetFixedFrame) -> None:
    client.requested_fixed = request.frame


async def _set_time(client: ClientState, request: client_messages.SetTime) -> None:
    if request.mode == "live":
        client.clock.go_live()
        return
    if request.at is None:
        raise BadRequestError("a message 'time' with the mode 'at' must have a field 'at'")
    origin = client.origin
    loop = None if request.loop is None else (round(request.loop[0]) + origin, round(request.loop[1]) + origin)
    client.clock.move(round(request.at) + origin, playing=request.playing, speed=request.speed, loop=loop)


async def _set_frame_timeout(client: ClientState, request: client_messages.SetFrameTimeout) -> None:
    client.frame_timeout = request.seconds


async def _set_frame_rate(client: ClientState, request: client_messages.SetFrameRate) -> None:
    client.requested_rate = request.hertz


async def _subscribe(client: ClientState, request: client_messages.Subscribe) -> None:
    client.subscribe(request.id, request.topic, Options.from_message(request.options, client.origin))


async def _unsubscribe(client: ClientState, request: client_messages.Unsubscribe) -> None:
    client.unsubscribe(request.id)


async def _pick(client: ClientState, request: client_messages.PickPart) -> PartDetails | None:
    subscription = client.subscriptions.get(request.id)
    display = None if subscription is None else subscription.display
    found = None if display is None else display.picked(request.sequence)
    if subscription is None or display is None or found is None:
        return None  # A newer message has replaced it.
    drawing, message = found
    topic, ros_type = subscription.topic, display.messages.type
    values = await _in_background(client, part_values, message, ros_type, topic, drawing.offset, request.local)
    return PartDetails(
        type="picked",
        id=request.id,
        sequence=request.sequence,
        topic=topic,
        message_type=ros_type,
        frame=display.messages.frame(drawing.frame),
        stamp=drawing.stamp - client.origin if drawing.stamp else None,
        fields=[PickedField(name=name, text=text) for name, text in values.fields],
        curves=values.curves,
    )


async def _restart(client: ClientState, _request: client_messages.Restart) -> None:
    client.viewer.restart("Reset")


async def _step(client: ClientState, request: client_messages.Step) -> None:
    viewer = client.viewer
    span = viewer.span
    at = client.at or (span[1] if span is not None else 0)
    topics = [display.messages for display in client.displays()]
    infos = list(viewer.scene.infos)
    found = await _in_background(client, next_stamp, viewer.source.buffer, infos, topics, at, request.direction)
    client.clock.move(at if found is None else found)


async def _answer_relation(client: ClientState, request: client_messages.RequestRelation) -> Relation:
    buffer = client.viewer.source.buffer
    return relate(buffer, request.target, request.source, client.at, client.origin, request.id)


async def _timeline(client: ClientState, request: client_messages.RequestTimeline) -> Timeline:
    viewer, origin, bins = client.viewer, client.origin, request.bins
    first, last = round(request.from_) + origin, round(request.to) + origin
    if last <= first:
        raise BadRequestError("a timeline must end after it begins")
    revision = viewer.scene.revision
    infos = list(viewer.scene.infos)
    edges = await _in_background(client, edge_rows, viewer.source.buffer, infos, first, last, bins, origin)
    return Timeline(
        {
            "type": "timeline",
            "revision": revision,
            "bins": bins,
            "from": first - origin,
            "to": last - origin,
            "edges": edges,
        }
    )


async def _set_joints(client: ClientState, request: client_messages.SetJoints) -> None:
    if not request.publish:
        client.stop_joints(request.robot)
        return
    try:
        client.set_joints(request.robot, request.positions)
    except (ViewerError, WireError) as error:
        raise BadRequestError(f"joint states cannot be published: {error}", error.hint) from None
    except (ValueError, TypeError) as error:
        raise BadRequestError(f"joint states cannot be published: {error}") from None


async def _publish_point(client: ClientState, request: client_messages.PublishPoint) -> PublishResult:
    _check_fixed_frame(client, request.frame)
    return await _publish(
        client, request.topic, lambda tools: tools.publish_point(request.topic, request.frame, request.point)
    )


async def _publish_pose(client: ClientState, request: client_messages.PublishPose) -> PublishResult:
    _check_fixed_frame(client, request.frame)
    return await _publish(
        client,
        request.topic,
        lambda tools: tools.publish_pose(
            request.topic, request.frame, request.position, request.yaw, request.covariance
        ),
    )


async def _publish_static(client: ClientState, request: client_messages.PublishStatic) -> PublishResult:
    known = client.viewer.scene.structure
    child = known.indices.get(request.child, -1)
    parent = known.parents[child] if child >= 0 else -1
    if parent < 0 or known.names[parent] != request.parent or not known.static[child]:
        raise BadRequestError(
            f"there is no static transform from {shorten(request.parent)} to {shorten(request.child)}",
            "Select a frame whose transform to its parent is static.",
        )
    return await _publish(
        client,
        "",
        lambda tools: tools.publish_static(request.parent, request.child, request.translation, request.quaternion),
    )


async def _use_control(client: ClientState, request: client_messages.UseControl) -> None:
    subscription = client.subscriptions.get(request.id)
    if subscription is None:
        raise BadRequestError("nothing was published: the display of the interactive marker was removed")
    topic = f"{subscription.topic.rpartition('/')[0]}/feedback"
    try:
        tools = client.viewer.tool_publisher()
        await _in_background(client, tools.publish_feedback, topic, request)
    except (ViewerError, WireError) as error:
        raise BadRequestError(f"the feedback was not published: {error}", error.hint) from None


def _check_fixed_frame(client: ClientState, frame: str) -> None:
    if frame != client.fixed:
        raise BadRequestError(
            f"nothing was published: the fixed frame is {shorten(client.fixed)}, no longer {shorten(frame)}",
            "Use the tool again.",
        )


async def _publish(client: ClientState, topic: str, publish: Callable[[ToolPublisher], int]) -> PublishResult:
    try:
        tools = client.viewer.tool_publisher()
        subscribers = await _in_background(client, publish, tools)
    except (ViewerError, WireError) as error:
        raise BadRequestError(f"nothing was published: {error}", error.hint) from None
    if topic:  # The displays of the page also subscribe, but do not act on the message.
        subscribers = min(subscribers, client.viewer.source.other_subscriptions(topic))
    return PublishResult(type="published", topic=topic or client.viewer.static_topic, subscribers=subscribers)


async def _explain(_client: ClientState, request: client_messages.RequestCodePage) -> CodePage:
    try:
        found = page(request.code)
    except KeyError:
        known = ", ".join(codes())
        raise BadRequestError(f"there is no page for {shorten(request.code)}", f"Known codes: {known}.") from None
    return CodePage(type="page", code=found.code, title=found.title, text=found.text)


async def _load_rviz(client: ClientState, request: client_messages.LoadRviz) -> Rviz | None:
    try:
        config = await _in_background(client, RvizConfig.parse, request.text)
    except ViewerError as error:
        raise BadRequestError(str(error), error.hint) from None
    client.rviz, client.requested_rate = config, config.frame_rate
    if config.fixed_frame and not request.restore:
        client.requested_fixed = config.fixed_frame
    return None if request.restore else Rviz({"type": "rviz", **config.description()})


async def _save_rviz(client: ClientState, request: client_messages.SaveRviz) -> RvizSaved:
    config = client.rviz or RvizConfig()
    options = request.global_
    if client.requested_rate is not None:
        options = {**options, "frame_rate": client.requested_rate}
    try:
        merged = config.merged(request.displays, options, request.view, request.tools, request.groups)
        text = await _in_background(client, merged.text)
    except (ViewerError, RecursionError) as error:
        raise BadRequestError(f"the configuration cannot be written: {error}") from None
    client.viewer.saved_rviz = text
    return RvizSaved(type="saved", text=text)


async def _prepare_replay(client: ClientState, request: client_messages.PrepareReplay) -> ReplayPrepared:
    if len(request.displays) > MAX_DISPLAYS:
        raise BadRequestError(f"a replay has at most {MAX_DISPLAYS} displays", "Hide some displays.")
    displays = [
        ReplayDisplay(display.topic, Options.from_message(display.options, client.origin))
        for display in request.displays
    ]
    settings = ReplaySettings(tuple(displays), request.rviz)
    return ReplayPrepared(type="replay", settings=client.viewer.prepare_replay(settings))


async def _click(client: ClientState, request: client_messages.ClickNode) -> None:
    client.viewer.nodes.clicked(request)


async def _use_widget(client: ClientState, request: client_messages.UseWidget) -> None:
    problem = client.viewer.widgets.used(request)
    if problem:
        raise BadRequestError(problem)


async def _in_background(client: ClientState, function: Callable[..., T], *args: Any) -> T:
    """Run a slow function in another thread."""
    return await asyncio.get_running_loop().run_in_executor(client.viewer.executor, function, *args)


_HANDLERS: dict[type, Callable[[ClientState, Any], Awaitable[ServerMessage | None]]] = {
    client_messages.ClickNode: _click,
    client_messages.RequestCodePage: _explain,
    client_messages.LoadRviz: _load_rviz,
    client_messages.PickPart: _pick,
    client_messages.PrepareReplay: _prepare_replay,
    client_messages.PublishPoint: _publish_point,
    client_messages.PublishPose: _publish_pose,
    client_messages.PublishStatic: _publish_static,
    client_messages.RequestRelation: _answer_relation,
    client_messages.RequestTimeline: _timeline,
    client_messages.Restart: _restart,
    client_messages.SaveRviz: _save_rviz,
    client_messages.SetFixedFrame: _set_fixed_frame,
    client_messages.SetFrameRate: _set_frame_rate,
    client_messages.SetFrameTimeout: _set_frame_timeout,
    client_messages.SetJoints: _set_joints,
    client_messages.SetTime: _set_time,
    client_messages.Step: _step,
    client_messages.Subscribe: _subscribe,
    client_messages.Unsubscribe: _unsubscribe,
    client_messages.UseControl: _use_control,
    client_messages.UseWidget: _use_widget,
    **CONTROL_HANDLERS,
    **PANEL_HANDLERS,
    **UPLOAD_HANDLERS,
}
