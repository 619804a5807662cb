"""What a tab may ask for: each kind of message checked and turned into a deed."""

from __future__ import annotations

import json
import math
from typing import TYPE_CHECKING, Any

from coframe.doctor.codes import codes, page
from coframe.errors import CoframeError, ViewerError, WireError
from coframe.viewer.displays import Options
from coframe.viewer.replay.displays import ReplayDisplay
from coframe.viewer.replay.page import MOST_DISPLAYS, ReplayLooks
from coframe.viewer.rviz.config import RvizConfig
from coframe.viewer.scene.relations import relate
from coframe.viewer.scene.timeline import MOST_BINS, edge_rows, next_stamp

if TYPE_CHECKING:
    from collections.abc import Awaitable, Callable

    from coframe.viewer.clients.client import Client

__all__ = ["READY", "BadRequestError", "Request", "parse"]

# That the last tick is drawn: the one message that is no question.
READY = "ready"

_FARTHEST = 2.0**62  # nanoseconds from the origin
_LARGEST_ID = 2**32 - 1


class BadRequestError(CoframeError, ValueError):
    """A message that is not what the protocol allows.

    Attributes:
        hint: What to do.
    """

    def __init__(self, text: str, hint: str = "") -> None:
        super().__init__(text)
        self._hint = hint


class Request:
    """A message from a tab, as the fields of its JSON object."""

    def __init__(self, kind: str, fields: dict[str, Any]) -> None:
        self.kind = kind
        self._fields = fields

    async def run(self, client: Client) -> None:
        """Does what is asked for.

        Raises:
            BadRequestError: It is no message of the protocol.
        """
        deed = _DEEDS.get(self.kind)
        if deed is None:
            raise BadRequestError(f"the server knows no message of the type {_shown(self.kind)}", "Reload the page.")
        await deed(client, self)

    def text(self, name: str) -> str:
        """A field that holds text."""
        value = self._fields.get(name)
        if not isinstance(value, str):
            raise self._wrong(name, "text")
        return value

    def number(self, name: str, default: float | None = None) -> float:
        """A field that holds a finite number."""
        value = self._fields.get(name, default)
        if isinstance(value, bool) or not isinstance(value, int | float) or not _is_finite(value):
            raise self._wrong(name, "a number")
        return float(value)

    def integer(self, name: str, least: int, most: int) -> int:
        """A field that holds a whole number in a range."""
        value = self.number(name)
        if value != int(value) or not least <= value <= most:
            raise self._wrong(name, f"a whole number from {least} to {most}")
        return int(value)

    def flag(self, name: str) -> bool:
        """A field that holds true or false, or is left out."""
        value = self._fields.get(name, False)
        if not isinstance(value, bool):
            raise self._wrong(name, "true or false")
        return value

    def mapping(self, name: str) -> dict[str, Any]:
        """A field that holds an object, or is left out."""
        value = self._fields.get(name, {})
        if not isinstance(value, dict):
            raise self._wrong(name, "an object")
        return value

    def sequence(self, name: str) -> list[Any]:
        """A field that holds an array."""
        value = self._fields.get(name)
        if not isinstance(value, list):
            raise self._wrong(name, "an array")
        return value

    def time(self, name: str, origin: int) -> int:
        """A field that holds a time: nanoseconds."""
        return _nanoseconds(self.number(name), origin, self._wrong(name, "a time"))

    def span(self, name: str, origin: int) -> tuple[int, int] | None:
        """A field that holds two times, or null."""
        value = self._fields.get(name)
        if value is None:
            return None
        wrong = self._wrong(name, "two times")
        if not isinstance(value, list) or len(value) != 2 or not all(isinstance(end, int | float) for end in value):
            raise wrong
        first, last = (_nanoseconds(end, origin, wrong) for end in value)
        return first, last

    def _wrong(self, name: str, wanted: str) -> BadRequestError:
        value = _shown(self._fields.get(name))
        return BadRequestError(f"{name} of a message {self.kind!r} must be {wanted}, not {value}")


def parse(message: str | bytes) -> Request:
    """A tab's message.

    Raises:
        BadRequestError: It is no JSON object with a type.
    """
    if isinstance(message, bytes):
        raise BadRequestError("the server takes text messages only")
    try:
        fields = json.loads(message)
    except (ValueError, RecursionError) as error:
        raise BadRequestError(f"a message is no JSON: {error}") from None
    if not isinstance(fields, dict) or not isinstance(fields.get("type"), str):
        raise BadRequestError("a message must be a JSON object with a type")
    return Request(fields["type"], fields)


def _is_finite(value: float) -> bool:
    try:
        return math.isfinite(value)
    except OverflowError:  # an int beyond all floats
        return False


def _nanoseconds(value: float, origin: int, wrong: BadRequestError) -> int:
    if not _is_finite(value) or abs(value) > _FARTHEST:
        raise wrong
    return round(value) + origin


def _shown(value: object) -> str:
    text = repr(value)
    return text if len(text) <= 60 else f"{text[:57]}..."


async def _fixed(client: Client, request: Request) -> None:
    client.wanted_fixed = request.text("frame")


async def _time(client: Client, request: Request) -> None:
    mode = request.text("mode")
    if mode == "live":
        client.playhead.go_live()
    elif mode == "at":
        origin = client.origin
        client.playhead.move(
            request.time("at", origin),
            playing=request.flag("playing"),
            speed=request.number("speed", 1.0),
            loop=request.span("loop", origin),
        )
    else:
        raise BadRequestError(f"the mode of a message 'time' is 'live' or 'at', not {_shown(mode)}")


async def _frame_timeout(client: Client, request: Request) -> None:
    client.frame_timeout = min(max(request.number("seconds"), 0.0), 1e6)


async def _frame_rate(client: Client, request: Request) -> None:
    client.wanted_rate = max(request.number("hertz"), 1.0)


async def _subscribe(client: Client, request: Request) -> None:
    options = Options.of(request.mapping("options"), client.origin)
    client.subscribe(request.integer("id", 0, _LARGEST_ID), request.text("topic"), options)


async def _unsubscribe(client: Client, request: Request) -> None:
    client.unsubscribe(request.integer("id", 0, _LARGEST_ID))


async def _step(client: Client, request: Request) -> None:
    direction = -1 if request.number("direction") < 0 else 1
    stage = client.stage
    span = stage.span
    at = client.at or (span[1] if span is not None else 0)
    topics = [display.messages for display in client.displays()]
    found = await client.work(next_stamp, stage.source.buffer, list(stage.scene.infos), topics, at, direction)
    client.playhead.move(at if found is None else found)


async def _relate(client: Client, request: Request) -> None:
    number = request.integer("id", 0, _LARGEST_ID)
    target, source = request.text("target"), request.text("source")
    fields = relate(client.stage.source.buffer, target, source, client.at, client.origin)
    await client.answer("relation", id=number, **fields)


async def _timeline(client: Client, request: Request) -> None:
    stage, origin = client.stage, client.origin
    first, last = request.time("from", origin), request.time("to", origin)
    bins = request.integer("bins", 1, MOST_BINS)
    if last <= first:
        raise BadRequestError("a timeline must end after it begins")
    revision = stage.scene.revision
    edges = await client.work(edge_rows, stage.source.buffer, list(stage.scene.infos), first, last, bins, origin)
    span = {"from": first - origin, "to": last - origin}
    await client.answer("timeline", revision=revision, bins=bins, edges=edges, **span)


async def _joints(client: Client, request: Request) -> None:
    number = request.integer("robot", 0, _LARGEST_ID)
    if not request.flag("publish"):
        client.stop_joints(number)
        return
    try:
        client.publish_joints(number, request.mapping("positions"))
    except (ValueError, TypeError) as error:
        raise BadRequestError(f"joint states cannot be sent: {error}") from None
    except (ViewerError, WireError) as error:
        raise BadRequestError(f"joint states cannot be sent: {error}", error.hint) from None


async def _explain(client: Client, request: Request) -> None:
    code = request.text("code")
    try:
        found = page(code)
    except KeyError:
        raise BadRequestError(f"there is no page for {_shown(code)}", f"There are {', '.join(codes())}.") from None
    await client.answer("page", code=found.code, title=found.title, text=found.text)


async def _load_rviz(client: Client, request: Request) -> None:
    try:
        config = await client.work(RvizConfig.parse, request.text("text"))
    except ViewerError as error:
        raise BadRequestError(str(error), error.hint) from None
    client.rviz, client.wanted_rate = config, config.frame_rate
    if config.fixed_frame:
        client.wanted_fixed = config.fixed_frame
    await client.answer("rviz", **config.description())


async def _replay(client: Client, request: Request) -> None:
    displays = []
    for told in request.sequence("displays"):
        if not isinstance(told, dict) or not isinstance(told.get("topic"), str):
            raise BadRequestError("each display of a message 'replay' is an object with a topic")
        options = told.get("options")
        drawn = Options.of(options if isinstance(options, dict) else {}, client.origin)
        displays.append(ReplayDisplay(told["topic"], drawn))
    if len(displays) > MOST_DISPLAYS:
        raise BadRequestError(f"a replay has {MOST_DISPLAYS} displays at most", "Hide some.")
    rviz = request.mapping("rviz")
    try:
        json.dumps(rviz, allow_nan=False)
    except (ValueError, RecursionError) as error:
        raise BadRequestError(f"rviz of a message 'replay' is no JSON: {error}") from None
    looks = ReplayLooks(tuple(displays), rviz)
    await client.answer("replay", looks=client.stage.announce_replay(looks))


async def _save_rviz(client: Client, request: Request) -> None:
    config = client.rviz or RvizConfig()
    displays, options, view = request.sequence("displays"), request.mapping("global"), request.mapping("view")
    if client.wanted_rate is not None:
        options = {**options, "frame_rate": client.wanted_rate}
    try:
        merged = config.merged(displays, options, view)
        text = await client.work(merged.text)
    except (ViewerError, RecursionError) as error:
        raise BadRequestError(f"the configuration cannot be written: {error}") from None
    client.rviz = merged
    client.stage.saved_rviz = text
    await client.answer("saved", text=text)


_DEEDS: dict[str, Callable[[Client, Request], Awaitable[None]]] = {
    "explain": _explain,
    "fixed": _fixed,
    "frame_rate": _frame_rate,
    "frame_timeout": _frame_timeout,
    "joints": _joints,
    "load_rviz": _load_rviz,
    "relate": _relate,
    "replay": _replay,
    "save_rviz": _save_rviz,
    "step": _step,
    "subscribe": _subscribe,
    "time": _time,
    "timeline": _timeline,
    "unsubscribe": _unsubscribe,
}
