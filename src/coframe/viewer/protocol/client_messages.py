# SPDX-License-Identifier: Apache-2.0
"""Messages from the page to the server: frozen dataclasses; fields with a default may be omitted.

A field named like a Python keyword has a trailing underscore here, but not in the message.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Annotated, ClassVar, Literal, TypeAlias, TypedDict

from coframe.viewer.protocol._limits import Clamp, Range
from coframe.viewer.protocol.common import (
    AxisName,
    ColorBy,
    CompletionKind,
    ControlKind,
    ControlStep,
    Durability,
    Id,
    JsonObject,
    Nanoseconds,
    Position,
    Radians,
    Reliability,
    RvizDisplay,
    RvizGroup,
    RvizTool,
    RvizView,
    Unit,
    Variances,
)

MAX_BINS = 2000
MAX_KEPT_MESSAGES = 1000
MAX_POINTS = 4_000_000
MAX_DECAY = 3600.0
"""Seconds."""
MAX_QUEUE_DEPTH = 1000
MAX_CURVE_POINTS = 20_000
MAX_TABLE_ROWS = 500
MAX_IMAGE_PIXELS = 1 << 25
DEFAULT_IMAGE_PIXELS = 640 * 480


@dataclass(frozen=True)
class DisplayOptions:
    """The options with which the server prepares a display. Numbers beyond a limit are clamped.

    Attributes:
        display: The class of the display, which draws the messages; "" selects the display of the message type.
        color_by: The value shown by a point's color; None selects the best available one.
        channel: The field of a cloud for ``color_by="intensity"``.
        axis: The coordinate for ``color_by="axis"``.
        decay: How long messages stay visible, in seconds.
        history: The number of messages that stay visible, regardless of their age.
        keep: The number of poses in the trail of an Odometry display.
        position_tolerance: The distance in meters from which a pose of the trail differs from the one before.
        angle_tolerance: The angle in radians from which a pose of the trail differs from the one before.
        max_points: The maximum number of points of a cloud; larger clouds are thinned.
        max_pixels: The maximum number of pixels of an image; larger images are thinned.
        second_topic: Another topic that the display needs: the updates of a map, or the colors of a depth image.
        frame: The frame in which positions without a frame are drawn; "" is the fixed frame.
        use_stamp: Whether a map is placed at the stamp of its message, and not at the displayed time.
        reliability: The reliability to request from publishers; "automatic" follows what they offer.
        durability: The durability to request from publishers; "automatic" follows what they offer.
        depth: The number of messages that wait until they are taken.
    """

    display: str = ""
    color_by: ColorBy | None = None
    channel: str = "intensity"
    axis: AxisName = "z"
    decay: Annotated[float, Clamp(0.0, MAX_DECAY)] = 0.0
    history: Annotated[int, Clamp(1, MAX_KEPT_MESSAGES)] = 1
    keep: Annotated[int, Clamp(1, MAX_KEPT_MESSAGES)] = 1
    position_tolerance: Annotated[float, Clamp(0.0, 1e6)] = 0.0
    angle_tolerance: Annotated[float, Clamp(0.0, 10.0)] = 0.0
    max_points: Annotated[int, Clamp(1, MAX_POINTS)] = MAX_POINTS
    max_pixels: Annotated[int, Clamp(1, MAX_IMAGE_PIXELS)] = DEFAULT_IMAGE_PIXELS
    second_topic: str = ""
    frame: str = ""
    use_stamp: bool = False
    reliability: Reliability = "automatic"
    durability: Durability = "automatic"
    depth: Annotated[int, Clamp(1, MAX_QUEUE_DEPTH)] = 10


@dataclass(frozen=True)
class SetFixedFrame:
    """Expresses everything in another frame; "" selects the root of the largest tree."""

    type: ClassVar[str] = "fixed"
    frame: str


@dataclass(frozen=True)
class SetTime:
    """Shows the newest data (mode "live"), or the time ``at``, from which playback may start."""

    type: ClassVar[str] = "time"
    mode: Literal["live", "at"]
    at: Nanoseconds | None = None
    playing: bool = False
    speed: Annotated[float, Clamp(0.01, 100.0)] = 1.0
    loop: tuple[Nanoseconds, Nanoseconds] | None = None


@dataclass(frozen=True)
class Restart:
    """Starts again without the data received so far, like the button Reset of RViz."""

    type: ClassVar[str] = "restart"


@dataclass(frozen=True)
class Step:
    """Moves to the next or previous stamp of a transform or a displayed message."""

    type: ClassVar[str] = "step"
    direction: Literal[-1, 1]


@dataclass(frozen=True)
class Subscribe:
    """Displays a topic under an id of the page's choice; replaces the display that has the id."""

    type: ClassVar[str] = "subscribe"
    id: Id
    topic: str
    options: DisplayOptions = field(default_factory=DisplayOptions)


@dataclass(frozen=True)
class Unsubscribe:
    """Removes a display, if it exists."""

    type: ClassVar[str] = "unsubscribe"
    id: Id


@dataclass(frozen=True)
class PickPart:
    """Requests what a message contains at a part of its drawing that the user has selected.

    Attributes:
        id: The display.
        sequence: The drawing.
        local: The position of the part in the coordinates of the drawing.
    """

    type: ClassVar[str] = "pick"
    id: Id
    sequence: Id
    local: Position


@dataclass(frozen=True)
class RequestRelation:
    """Requests the pose of ``source`` relative to ``target`` at the displayed time."""

    type: ClassVar[str] = "relate"
    id: Id
    target: str
    source: str


@dataclass(frozen=True)
class RequestTimeline:
    """Requests the number of samples of each edge over time."""

    type: ClassVar[str] = "timeline"
    from_: Nanoseconds
    to: Nanoseconds
    bins: Annotated[int, Range(1, MAX_BINS)]


@dataclass(frozen=True)
class SetJoints:
    """Starts or stops publishing joint positions of a robot, in radians or meters."""

    type: ClassVar[str] = "joints"
    robot: Id
    positions: dict[str, float] = field(default_factory=dict)
    publish: bool = False


@dataclass(frozen=True)
class PublishPoint:
    """Publishes a PointStamped with the current time of the graph; ``frame`` must be the fixed frame."""

    type: ClassVar[str] = "publish_point"
    topic: str
    frame: str
    point: Position


@dataclass(frozen=True)
class PublishPose:
    """Publishes a pose with the current time of the graph; ``frame`` must be the fixed frame.

    It is a PoseWithCovarianceStamped if ``covariance`` has the variances of x, y and yaw, otherwise a PoseStamped.
    ``yaw`` is in radians.
    """

    type: ClassVar[str] = "publish_pose"
    topic: str
    frame: str
    position: Position
    yaw: Radians
    covariance: Variances | None = None


@dataclass(frozen=True)
class PublishStatic:
    """Publishes another pose for an existing static transform. The quaternion x, y, z, w must be normalized."""

    type: ClassVar[str] = "publish_static"
    parent: str
    child: str
    translation: Position
    quaternion: tuple[Unit, Unit, Unit, Unit]


@dataclass(frozen=True)
class UseControl:
    """Reports that the user uses a control of an interactive marker, which is published as its feedback.

    Attributes:
        id: The display.
        marker: The name of the marker.
        control: The name of the control.
        event: What happens.
        frame: The frame of the marker.
        position: The position of the marker in its frame.
        quaternion: The orientation of the marker in its frame, normalized.
        menu: The id of the menu entry for ``event="menu"``.
        point: The point under the pointer in the frame of the marker, or None if it is unknown.
    """

    type: ClassVar[str] = "use_control"
    id: Id
    marker: str
    control: str
    event: Literal["pose", "menu", "button", "down", "up"]
    frame: str
    position: Position
    quaternion: tuple[Unit, Unit, Unit, Unit]
    menu: Id = 0
    point: Position | None = None


@dataclass(frozen=True)
class LoadRviz:
    """Reads an .rviz file.

    Attributes:
        text: The content of the file.
        restore: Whether the page shows the file already, and only the server needs it again after a reconnection.
    """

    type: ClassVar[str] = "load_rviz"
    text: str
    restore: bool = False


@dataclass(frozen=True)
class SaveRviz:
    """Requests an .rviz file with the contents of the page. Other parts of the loaded configuration are preserved."""

    type: ClassVar[str] = "save_rviz"
    displays: list[RvizDisplay]
    global_: JsonObject = field(default_factory=dict)
    view: JsonObject = field(default_factory=dict)
    tools: list[RvizTool] = field(default_factory=list)
    groups: list[RvizGroup] = field(default_factory=list)


@dataclass(frozen=True)
class ReplayDisplayRequest:
    """A display to be recorded in a replay."""

    topic: str
    options: DisplayOptions = field(default_factory=DisplayOptions)


ReplayRviz = TypedDict("ReplayRviz", {"displays": list[RvizDisplay], "global": JsonObject, "view": RvizView | None})
"""The initial view of a replay."""


@dataclass(frozen=True)
class FileToOpen:
    """The name and the size in bytes of a file."""

    name: str
    size: Annotated[int, Range(0, 2**53)]


@dataclass(frozen=True)
class OpenFiles:
    """Begins to send files; their bytes follow as binary messages, each after the answer to the previous one.

    Attributes:
        files: The files, in the order of their bytes.
        together: Whether several recordings begin at the same time; otherwise they keep their times.
    """

    type: ClassVar[str] = "open_files"
    files: list[FileToOpen]
    together: bool = False


@dataclass(frozen=True)
class OpenRecent:
    """Shows a source again that this viewer has shown before."""

    type: ClassVar[str] = "open_recent"
    id: Id


@dataclass(frozen=True)
class PrepareReplay:
    """Defines the displays and the initial view of a replay."""

    type: ClassVar[str] = "replay"
    displays: list[ReplayDisplayRequest]
    rviz: ReplayRviz | None = None


@dataclass(frozen=True)
class SetFrameTimeout:
    """Sets how many seconds a frame stays visible after its last sample."""

    type: ClassVar[str] = "frame_timeout"
    seconds: Annotated[float, Clamp(0.0, 1e6)]


@dataclass(frozen=True)
class SetFrameRate:
    """Sets the number of frame updates per second, as "Frame Rate" of an .rviz file. The server sends at most 60."""

    type: ClassVar[str] = "frame_rate"
    hertz: Annotated[float, Clamp(1.0, 1e6)]


@dataclass(frozen=True)
class RequestCodePage:
    """Requests the page of a doctor code."""

    type: ClassVar[str] = "explain"
    code: str


@dataclass(frozen=True)
class CurveRequest:
    """A curve under an id of the page's choice. The expression is one of ``coframe plot``."""

    id: Id
    expression: str


@dataclass(frozen=True)
class SetCurves:
    """Sets the curves that the page shows; curves that are no longer listed are removed.

    Attributes:
        curves: The curves to show, in the order of the page.
        span: The part of a recording that the page shows, or None for all of it.
        points: The maximum number of points of a curve; thinning preserves minima and maxima.
    """

    type: ClassVar[str] = "curves"
    curves: list[CurveRequest]
    span: tuple[Nanoseconds, Nanoseconds] | None = None
    points: Annotated[int, Clamp(100, MAX_CURVE_POINTS)] = 4000


@dataclass(frozen=True)
class InspectTopic:
    """Inspects the messages on a topic instead of the previous one; "" stops the inspection."""

    type: ClassVar[str] = "inspect"
    topic: str


@dataclass(frozen=True)
class ShowTable:
    """Shows the last messages of a topic as a table instead of the previous one; "" closes the table."""

    type: ClassVar[str] = "table"
    topic: str
    rows: Annotated[int, Clamp(1, MAX_TABLE_ROWS)] = 100


@dataclass(frozen=True)
class StateRequest:
    """A field whose states the page shows, under an id of its choice. The expression is one of ``coframe plot``."""

    id: Id
    expression: str


@dataclass(frozen=True)
class ShowStates:
    """Sets the fields whose states over time the page shows; fields that are no longer listed are removed."""

    type: ClassVar[str] = "states"
    fields: list[StateRequest]


@dataclass(frozen=True)
class ShowLog:
    """Starts or stops sending log messages."""

    type: ClassVar[str] = "log"
    shown: bool


@dataclass(frozen=True)
class ShowGraph:
    """Starts or stops sending the graph of nodes and topics and its changes."""

    type: ClassVar[str] = "graph"
    shown: bool


@dataclass(frozen=True)
class RequestCompletions:
    """Requests completions for the beginning of an expression or topic name."""

    type: ClassVar[str] = "complete"
    id: Id
    subject: CompletionKind
    text: str


@dataclass(frozen=True)
class ControlGraph:
    """Acts on the graph, which needs a permission.

    Attributes:
        id: The number of the request.
        step: "names" lists what exists, "form" requests the fields, "act" publishes, calls, sends or sets.
        kind: What ``name`` belongs to.
        name: The topic, service, action or node; "" for "names".
        ros_type: Its type, or "" for the type that it has on the graph.
        values: The fields or parameters to set.
    """

    type: ClassVar[str] = "control"
    id: Id
    step: ControlStep
    kind: ControlKind
    name: str = ""
    ros_type: str = ""
    values: JsonObject = field(default_factory=dict)


@dataclass(frozen=True)
class Drive:
    """Publishes a velocity in meters and radians per second; the page repeats it as long as the robot should drive."""

    type: ClassVar[str] = "drive"
    topic: str
    ros_type: str
    linear: tuple[float, float]
    angular: float


@dataclass(frozen=True)
class ClickNode:
    """Reports a click on a node that is clickable.

    Attributes:
        node: The id of the node.
        frame: The fixed frame of the page.
        position: The point on the surface of the node, in the fixed frame.
        local: The same point in the coordinates of the node, as in the arrays of its geometry.
        index: The index of the point, the line or the triangle that was hit, or None for other kinds of nodes.
    """

    type: ClassVar[str] = "click"
    node: Id
    frame: str
    position: Position
    local: Position
    index: Id | None = None


@dataclass(frozen=True)
class UseWidget:
    """Presses a button, or changes the value of another widget. The field depends on its kind."""

    type: ClassVar[str] = "widget"
    id: Id
    number: float | None = None
    text: str | None = None
    flag: bool | None = None


@dataclass(frozen=True)
class FrameDrawn:
    """Confirms that the last frame update was drawn, so that the next one can be sent; ``drawn`` is its time."""

    type: ClassVar[str] = "ready"
    drawn: Nanoseconds | None = None


ClientMessage: TypeAlias = (
    SetFixedFrame
    | SetTime
    | Restart
    | Step
    | Subscribe
    | Unsubscribe
    | PickPart
    | RequestRelation
    | RequestTimeline
    | SetJoints
    | PublishPoint
    | PublishPose
    | PublishStatic
    | UseControl
    | LoadRviz
    | SaveRviz
    | OpenFiles
    | OpenRecent
    | PrepareReplay
    | SetFrameTimeout
    | SetFrameRate
    | RequestCodePage
    | SetCurves
    | InspectTopic
    | ShowTable
    | ShowStates
    | ShowLog
    | ShowGraph
    | RequestCompletions
    | ControlGraph
    | Drive
    | ClickNode
    | UseWidget
    | FrameDrawn
)
