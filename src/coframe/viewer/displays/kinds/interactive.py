# SPDX-License-Identifier: Apache-2.0
"""Interactive markers: a set that a server maintains, whose controls the user drags, clicks and opens menus of."""

from __future__ import annotations

from time import monotonic
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypedDict

import numpy as np

from coframe.errors import WireError
from coframe.time import stamp_ns
from coframe.viewer.displays._drawing import CannotDrawError, Drawing, Options, finite, finite_all, pose_row
from coframe.viewer.displays._row import DisplayRow, FlagOption
from coframe.viewer.displays.kinds.markers import MarkerItem, marker_item
from coframe.viewer.protocol.encoding import encode_shapes
from coframe.viewer.sources.service_call import call_service

if TYPE_CHECKING:
    from coframe.viewer.displays.resources import Resources
    from coframe.viewer.sources.topic_messages import StampedMessage, TopicMessages

__all__ = ["INTERACTIVE_MARKERS", "ControlItem", "InteractiveShape", "MenuItem"]

MAX_INTERACTIVE_MARKERS = 1000
MAX_CONTROLS = 100
MAX_MENU_ENTRIES = 500
MAX_TITLE_LENGTH = 200
# How long the first drawing waits for the markers of the server, and when it asks again, in seconds.
_TIMEOUT, _RETRY = 1.0, 3.0
_SERVICE = "visualization_msgs/srv/GetInteractiveMarkers"
_FEEDBACK = 0  # of MenuEntry: the command is published


class MenuItem(TypedDict):
    """An entry of a menu, below the entry ``parent`` or at the top (0). ``command`` is not executed."""

    id: int
    parent: int
    title: str
    command: str


class ControlItem(TypedDict):
    """A part that the user can move; the numbers are those of visualization_msgs/InteractiveMarkerControl."""

    name: str
    description: str
    orientation: list[float | None]
    orientation_mode: int
    interaction_mode: int
    always_visible: bool
    independent: bool
    markers: list[MarkerItem]


class InteractiveShape(TypedDict):
    """An interactive marker; ``pose`` is expressed in its frame."""

    kind: Literal["interactive"]
    frame: str
    stamp: float
    name: str
    description: str
    scale: float | None
    pose: list[float | None]
    menu: list[MenuItem]
    controls: list[ControlItem]


class _Shown(NamedTuple):
    marker: Any
    header: Any
    pose: Any


class InteractiveRenderer:
    """Maintains the markers of a server: those that it has when it is asked, and the updates since then."""

    def __init__(self, messages: TopicMessages, options: Options, resources: Resources) -> None:
        self._messages = messages
        self._options = options
        self._resources = resources
        self._namespace = resources.topic.rpartition("/")[0]
        self._shown_markers: dict[str, _Shown] = {}
        self._drawings: dict[str, tuple[_Shown, Drawing]] = {}
        self._applied = 0
        self._sequence = -1  # Updates up to this number are contained in the response of the server.
        self._can_request = resources.connection is not None
        self._due = 0.0

    def draw(self, message: StampedMessage, time: int, at: int) -> list[Drawing]:
        """Return one drawing per marker; unchanged markers return the same drawing as before."""
        del time, at
        if self._can_request and monotonic() >= self._due:
            self._ask()
        if 0 < message.key < self._applied:
            self._shown_markers.clear()
            self._applied = 0
        for one in self._messages.after(self._applied, message.key):
            self._apply(one.read())
            self._applied = one.key
        drawn = {}
        for name, shown in self._shown_markers.items():
            known = self._drawings.get(name)
            same = known is not None and all(map(_is, known[0], shown))
            drawn[name] = known if known is not None and same else (shown, self._draw(shown))
        self._drawings = drawn
        return [drawing for _, drawing in drawn.values()]

    def has_changed(self, time: int, at: int) -> bool:
        """Return whether the server has to be asked again."""
        del time, at
        return self._can_request and monotonic() >= self._due

    def _ask(self) -> None:
        """Ask the server for its markers, because it publishes only changes."""
        from coframe.messages import find  # noqa: PLC0415 - Only message displays need the message classes.

        self._due = monotonic() + _RETRY
        connection = self._resources.connection
        if connection is None:
            return
        service_type = find(_SERVICE)
        service = f"{self._namespace}/get_interactive_markers"
        try:
            response = call_service(connection, service, service_type, service_type.Request(), _TIMEOUT)
        except WireError as error:
            raise CannotDrawError(f"{service} cannot be called: {error}") from None
        if response is None:
            return
        self._can_request = False
        self._sequence = response.sequence_number
        self._shown_markers.clear()
        for marker in response.markers:
            self._add(marker)

    def _apply(self, message: Any) -> None:
        if not hasattr(message, "type"):  # All markers, as servers of ROS 1 publish them.
            self._shown_markers.clear()
        elif message.seq_num <= self._sequence:
            return
        for marker in message.markers:
            self._add(marker)
        for update in getattr(message, "poses", ()):
            if update.name in self._shown_markers:
                self._shown_markers[update.name] = _Shown(
                    self._shown_markers[update.name].marker, update.header, update.pose
                )
        for name in getattr(message, "erases", ()):
            self._shown_markers.pop(name, None)

    def _add(self, marker: Any) -> None:
        if marker.name not in self._shown_markers and len(self._shown_markers) >= MAX_INTERACTIVE_MARKERS:
            raise CannotDrawError(f"too many interactive markers: the viewer draws at most {MAX_INTERACTIVE_MARKERS}")
        self._shown_markers[marker.name] = _Shown(marker, marker.header, marker.pose)

    def _draw(self, shown: _Shown) -> Drawing:
        marker, header, pose = shown
        numbers: list[Any] = []
        controls = [self._control(control, header.frame_id, numbers) for control in marker.controls[:MAX_CONTROLS]]
        stamp = stamp_ns(header.stamp)
        description = InteractiveShape(
            kind="interactive",
            frame=header.frame_id,
            stamp=float(stamp - self._options.origin),
            name=marker.name,
            description=marker.description[:MAX_TITLE_LENGTH],
            scale=finite(marker.scale),
            pose=finite_all(pose_row(pose)),
            menu=[
                MenuItem(
                    id=entry.id,
                    parent=entry.parent_id,
                    title=entry.title[:MAX_TITLE_LENGTH],
                    command="" if entry.command_type == _FEEDBACK else entry.command[:MAX_TITLE_LENGTH],
                )
                for entry in marker.menu_entries[:MAX_MENU_ENTRIES]
            ],
            controls=controls,
        )
        with np.errstate(over="ignore"):  # Values that are too large for float32 become infinite.
            payload = np.concatenate(numbers).astype(np.float32) if numbers else np.zeros(0, np.float32)
        # Without a stamp, a marker moves with its frame.
        return Drawing(header.frame_id, stamp, encode_shapes(description, payload), locked=stamp == 0)

    def _control(self, control: Any, frame: str, numbers: list[Any]) -> ControlItem:
        orientation = control.orientation
        markers = []
        for marker in control.markers:
            item = marker_item(marker, numbers, self._resources.mesh_url)
            # A marker in another frame does not move with the control, and is not drawn.
            if marker.header.frame_id in {"", frame}:
                markers.append(item)
        return ControlItem(
            name=control.name,
            description=control.description[:MAX_TITLE_LENGTH],
            orientation=finite_all((orientation.x, orientation.y, orientation.z, orientation.w)),
            orientation_mode=control.orientation_mode,
            interaction_mode=control.interaction_mode,
            always_visible=bool(control.always_visible),
            independent=bool(control.independent_marker_orientation),
            markers=markers,
        )


def _is(one: object, other: object) -> bool:
    return one is other


INTERACTIVE_MARKERS = DisplayRow(
    name="InteractiveMarkers",
    has_quality=False,
    messages={
        "visualization_msgs/msg/InteractiveMarkerInit": InteractiveRenderer,
        "visualization_msgs/msg/InteractiveMarkerUpdate": InteractiveRenderer,
    },
    options=(
        FlagOption("Show Descriptions", True),
        FlagOption("Show Axes", False),
        FlagOption("Show Visual Aids", False),
        FlagOption("Enable Transparency", True),
    ),
    shapes=(InteractiveShape,),
    draws_without_messages=True,
    guide=(
        "InteractiveMarkerUpdate and InteractiveMarkerInit: controls of all modes are dragged, buttons clicked and "
        "menus opened with the left or right button; InteractiveMarkerFeedback is published"
    ),
)
