# SPDX-License-Identifier: Apache-2.0
"""The messages between the viewer's server and its page: the single source of the protocol.

``scripts/generate_protocol.py`` generates the TypeScript types and the checks of the page from the classes below, and
a version that changes with them. The server checks what clients send against the same classes
(:mod:`coframe.viewer.protocol.requests`).

One WebSocket carries all messages. Text messages are JSON objects with a ``type``. Binary messages are little-endian
and begin with their kind (`BinaryKind`) as a uint32; their headers are the ``...Header`` classes below.

Conventions:
    Times are nanoseconds relative to ``Hello.origin``, which is the decimal text of an int64. This keeps them exact in
    a float64. Poses are x, y, z in metres followed by a quaternion x, y, z, w; NaN means that there is no pose. Frame
    names, topics and robot descriptions are data and must never be interpreted as HTML.

Messages from the server are TypedDicts, so that building one costs no more than a dict. Messages from the client are
frozen dataclasses; fields with a default may be omitted. A field whose name is a Python keyword has a trailing
underscore here and none in the message.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import IntEnum
from typing import Annotated, Any, ClassVar, Literal, NamedTuple, TypeAlias, TypedDict

from coframe.viewer.protocol.limits import Clamp, Range

JsonObject: TypeAlias = dict[str, Any]
Vector: TypeAlias = tuple[float, float, float]
Quaternion: TypeAlias = tuple[float, float, float, float]
Span: TypeAlias = tuple[float, float]

Id: TypeAlias = Annotated[int, Range(0, 2**32 - 1)]
Metres: TypeAlias = Annotated[float, Range(-1e9, 1e9)]
Radians: TypeAlias = Annotated[float, Range(-100.0, 100.0)]
Unit: TypeAlias = Annotated[float, Range(-1.01, 1.01)]
Variance: TypeAlias = Annotated[float, Range(0.0, 1e18)]
Position: TypeAlias = tuple[Metres, Metres, Metres]
Variances: TypeAlias = tuple[Variance, Variance, Variance]
Nanoseconds: TypeAlias = Annotated[float, Range(-(2.0**62), 2.0**62)]

NO_FRAME = 2**32 - 1
MAX_BINS = 2000
MAX_KEPT_MESSAGES = 1000
MAX_POINTS = 4_000_000
MAX_DECAY = 3600.0
"""Seconds."""
MAX_CURVE_POINTS = 20_000

ViewerMode: TypeAlias = Literal["live", "recording", "buffer", "replay"]
FrameActivity: TypeAlias = Literal["static", "fresh", "stale", "gone"]
DisplayState: TypeAlias = Literal["ok", "waiting", "error"]
Severity: TypeAlias = Literal["error", "warning", "note"]
FindingsState: TypeAlias = Literal["none", "waiting", "ready", "failed"]
LogLevel: TypeAlias = Literal["debug", "info", "warning", "error", "fatal"]
CompletionKind: TypeAlias = Literal["expression", "topic"]
ColorBy: TypeAlias = Literal["axis", "intensity", "rgb", "distance", "flat"]
AxisName: TypeAlias = Literal["x", "y", "z"]


# Parts of messages in both directions.

RvizDisplay = TypedDict(
    "RvizDisplay",
    {"class": str, "name": str, "enabled": bool, "topic": str | None, "options": JsonObject},
)
"""A display of an RViz configuration; ``class`` has no package prefix."""

RvizView = TypedDict("RvizView", {"class": str, "options": JsonObject})
"""The current view of an RViz configuration."""

RvizTool = TypedDict("RvizTool", {"class": str, "topic": str | None, "options": JsonObject})
"""A tool of an RViz configuration that publishes; ``class`` has no package prefix."""


# Server to client, text.


class Topic(TypedDict):
    """A topic that can be displayed."""

    topic: str
    type: str
    display: str


class RvizGlobalOptions(TypedDict):
    """Global options of an RViz configuration; None for those that are not set."""

    fixed_frame: str | None
    background: list[int] | None
    frame_rate: float | None


UnknownRvizPart = TypedDict("UnknownRvizPart", {"path": str, "class": str, "name": str})
"""A part of an RViz configuration that the viewer cannot show."""

RvizConfiguration = TypedDict(
    "RvizConfiguration",
    {
        "displays": list[RvizDisplay],
        "global": RvizGlobalOptions,
        "view": RvizView | None,
        "tools": list[RvizTool],
        "unknown": list[UnknownRvizPart],
    },
)
"""What the viewer understands of an RViz configuration."""


class Hello(TypedDict):
    """The first message. Sent again when the source or the origin changes: the page then starts from scratch.

    The page compares ``version`` with its own. ``mode`` is "replay" only inside replay files. ``fixed_is_given`` is
    true if an option or the .rviz file names the fixed frame, so that the page does not use that of its last session.
    """

    type: Literal["hello"]
    version: str
    mode: ViewerMode
    title: str
    origin: str
    span: Span | None
    fixed: str
    fixed_is_given: bool
    rviz: RvizConfiguration | None
    topics: list[Topic]
    can_publish: bool


class TreeFrame(TypedDict):
    """A frame; ``parent`` is an index into the frames, -1 for a root, and ``component`` the index of its tree."""

    name: str
    parent: int
    static: bool
    component: int


class TreeComponent(TypedDict):
    """A connected tree of frames."""

    root: str
    size: int


class Tree(TypedDict):
    """The tree structure; sent when it or the fixed frame changes.

    Frame updates and statistics list the frames in this order and carry the same revision.
    """

    type: Literal["tree"]
    revision: int
    fixed: str
    frames: list[TreeFrame]
    components: list[TreeComponent]


class FrameStats(TypedDict):
    """Statistics of one frame; None for values that do not apply.

    ``rate`` is in Hz, ``age`` and ``longest_gap`` in seconds. The state of a root is "static".
    """

    rate: float | None
    age: float | None
    last: float | None
    publisher: str | None
    samples: int
    longest_gap: float | None
    state: FrameActivity


class Stats(TypedDict):
    """Statistics of all frames; sent once per second, less often for large trees."""

    type: Literal["stats"]
    revision: int
    span: Span | None
    frames: list[FrameStats]


class Topics(TypedDict):
    """The topics that can be displayed; sent when they change."""

    type: Literal["topics"]
    topics: list[Topic]


class RobotJoint(TypedDict):
    """A joint that a slider can move, in radians or metres."""

    name: str
    type: str
    lower: float | None
    upper: float | None
    value: float


class Robot(TypedDict):
    """A robot description.

    ``meshes`` maps each mesh reference of the URDF to its URL, ``problems`` lists what cannot be drawn, and
    ``warnings`` what is unusual about the description. ``description_topic`` is None for a robot from a file.
    """

    type: Literal["robot"]
    id: int
    name: str
    source: str
    urdf: str
    meshes: dict[str, str]
    problems: list[str]
    warnings: list[str]
    joints: list[RobotJoint]
    description_topic: str | None


class _DisplayStatus(TypedDict):
    type: Literal["display"]
    id: int
    state: DisplayState
    text: str


class DisplayStatus(_DisplayStatus, total=False):
    """The status of a subscribed display; ``note`` exists only in replays and describes what was omitted."""

    note: str


Rviz = TypedDict(
    "Rviz",
    {
        "type": Literal["rviz"],
        "displays": list[RvizDisplay],
        "global": RvizGlobalOptions,
        "view": RvizView | None,
        "tools": list[RvizTool],
        "unknown": list[UnknownRvizPart],
    },
)
"""The answer to ``load_rviz``."""


class Relation(TypedDict):
    """The answer to ``relate``: the pose of ``source`` relative to ``target``, or the reason why there is none.

    ``matrix`` has 16 numbers in row-major order. ``chain`` lists the frames from the source to the target; if the
    lookup failed, ``broken_at`` is the frame where the chain ends.
    """

    type: Literal["relation"]
    id: int
    ok: bool
    target: str
    source: str
    stamp: float | None
    translation: Vector | None
    quaternion: Quaternion | None
    rpy_deg: Vector | None
    matrix: list[float] | None
    static_command: str | None
    chain: list[str]
    error: str | None
    hint: str | None
    broken_at: str | None


class TimelineEdge(TypedDict):
    """The samples of one edge: ``counts`` is base64 text of one uint16 per bin, ``gaps`` the spans without samples."""

    frame: int
    counts: str
    gaps: list[Span]


Timeline = TypedDict(
    "Timeline",
    {
        "type": Literal["timeline"],
        "revision": int,
        "bins": int,
        "from": float,
        "to": float,
        "edges": list[TimelineEdge],
    },
)
"""The answer to ``timeline``: the number of samples of each dynamic edge over time."""


class Finding(TypedDict):
    """A finding of the doctor.

    ``frames`` are the frames whose rows are marked, ``first`` is the time of the first occurrence, and ``explains``
    lists the findings that this one causes.
    """

    code: str
    severity: Severity
    title: str
    subject: str
    frames: list[str]
    text: str
    why: str
    fix: str
    publishers: list[str]
    first: float | None
    namespace: str
    explains: list[Finding]


class Findings(TypedDict):
    """The findings of the doctor; sent when they change. ``text`` gives the reason if there can be none."""

    type: Literal["findings"]
    state: FindingsState
    text: str
    findings: list[Finding]


class CodePage(TypedDict):
    """The answer to ``explain``: the page of a code, as Markdown."""

    type: Literal["page"]
    code: str
    title: str
    text: str


class CurveStatus(TypedDict):
    """The status of a curve. ``axis`` is the title of its axis: curves with the same title share a plot.

    ``points`` is the number of points that exist; fewer are sent if they are thinned.
    """

    type: Literal["curve"]
    id: int
    state: DisplayState
    text: str
    hint: str
    axis: str
    points: int


class InspectedField(TypedDict):
    """A field of an inspected message, in the order in which it is shown.

    ``path`` begins with the topic; it is an expression for a curve if ``is_number``. ``depth`` is 0 for the fields of
    the message itself.
    """

    path: str
    depth: int
    name: str
    type: str
    text: str
    is_number: bool


class Inspection(TypedDict):
    """The newest message of the inspected topic at the displayed time; sent when it changes.

    ``rate`` is in Hz. ``publishers`` are the names of their nodes, which recordings do not contain.
    """

    type: Literal["inspection"]
    topic: str
    message_type: str
    state: DisplayState
    text: str
    stamp: float | None
    rate: float | None
    publishers: list[str]
    fields: list[InspectedField]


class LogEntry(TypedDict):
    """A log message; ``place`` is the file, the function and the line that logged it."""

    stamp: float
    level: LogLevel
    node: str
    text: str
    place: str


class LogEntries(TypedDict):
    """New log messages. ``reset`` discards earlier ones; ``omitted`` counts those that were not sent."""

    type: Literal["log"]
    reset: bool
    text: str
    omitted: int
    entries: list[LogEntry]


class GraphNode(TypedDict):
    """A node; ``infrastructure`` nodes are hidden by default."""

    name: str
    infrastructure: bool


class GraphTopic(TypedDict):
    """A topic and its message types; ``infrastructure`` topics are hidden by default."""

    topic: str
    types: list[str]
    infrastructure: bool


class GraphLink(TypedDict):
    """A publisher or a subscription: indices into the nodes and the topics, and why it does not match others, or ""."""

    node: int
    topic: int
    publishes: bool
    qos: str
    problem: str


class NodeGraph(TypedDict):
    """The nodes and topics; sent when they change. ``text`` gives the reason if there are none."""

    type: Literal["graph"]
    text: str
    nodes: list[GraphNode]
    topics: list[GraphTopic]
    links: list[GraphLink]


class Completions(TypedDict):
    """The answer to ``complete``: texts with which the text can continue."""

    type: Literal["completions"]
    id: int
    items: list[str]


class Saved(TypedDict):
    """The answer to ``save_rviz``: the text of the .rviz file."""

    type: Literal["saved"]
    text: str


class ReplayPrepared(TypedDict):
    """The answer to ``replay``: ``/replay?settings=TOKEN&from=&to=&rate=&fixed=`` returns the file."""

    type: Literal["replay"]
    settings: str


class Published(TypedDict):
    """The answer to requests that publish a message; ``subscribers`` is the number of matched subscriptions."""

    type: Literal["published"]
    topic: str
    subscribers: int


class Problem(TypedDict):
    """A request that failed, or a problem with the source."""

    type: Literal["problem"]
    text: str
    hint: str


ServerMessage: TypeAlias = (
    Hello
    | Tree
    | Stats
    | Topics
    | Robot
    | DisplayStatus
    | Rviz
    | Relation
    | Timeline
    | Findings
    | CodePage
    | CurveStatus
    | Inspection
    | LogEntries
    | NodeGraph
    | Completions
    | Saved
    | ReplayPrepared
    | Published
    | Problem
)


# Client to server, text.


@dataclass(frozen=True)
class DisplayOptions:
    """How the server prepares a display; numbers beyond the limits are set to the limit.

    Attributes:
        color_by: The value that a point's colour shows; None selects the best one that the message contains.
        axis: The coordinate for ``color_by="axis"``.
        decay: How long messages stay visible, in seconds.
        keep: How many poses the trail of an Odometry display has.
        most_points: The largest number of points of a cloud; larger clouds are thinned.
    """

    color_by: ColorBy | None = None
    axis: AxisName = "z"
    decay: Annotated[float, Clamp(0.0, MAX_DECAY)] = 0.0
    keep: Annotated[int, Clamp(1, MAX_KEPT_MESSAGES)] = 1
    most_points: Annotated[int, Clamp(1, MAX_POINTS)] = MAX_POINTS


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
class Relate:
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
    """Starts or stops publishing joint positions of a robot, in radians or metres."""

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
    """Publishes another pose for an existing static transform; the quaternion x, y, z, w must be normalized."""

    type: ClassVar[str] = "publish_static"
    parent: str
    child: str
    translation: Position
    quaternion: tuple[Unit, Unit, Unit, Unit]


@dataclass(frozen=True)
class LoadRviz:
    """Reads an .rviz file."""

    type: ClassVar[str] = "load_rviz"
    text: str


@dataclass(frozen=True)
class SaveRviz:
    """Requests an .rviz file of what the page shows; other parts of the loaded configuration are preserved."""

    type: ClassVar[str] = "save_rviz"
    displays: list[RvizDisplay]
    global_: JsonObject = field(default_factory=dict)
    view: JsonObject = field(default_factory=dict)
    tools: list[RvizTool] = field(default_factory=list)


@dataclass(frozen=True)
class ReplayDisplayRequest:
    """A display to be recorded in a replay."""

    topic: str
    options: DisplayOptions = field(default_factory=DisplayOptions)


ReplayRviz = TypedDict("ReplayRviz", {"displays": list[RvizDisplay], "global": JsonObject, "view": RvizView | None})
"""How a replay looks when it is opened."""


@dataclass(frozen=True)
class PrepareReplay:
    """Defines which displays a replay contains and how it looks."""

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
    """Sets the number of frame updates per second, as "Frame Rate" of an .rviz file; the server sends at most 60."""

    type: ClassVar[str] = "frame_rate"
    hertz: Annotated[float, Clamp(1.0, 1e6)]


@dataclass(frozen=True)
class Explain:
    """Requests the page of a doctor code."""

    type: ClassVar[str] = "explain"
    code: str


@dataclass(frozen=True)
class CurveRequest:
    """A curve under an id of the page's choice; the expression is one of ``coframe plot``."""

    id: Id
    expression: str


@dataclass(frozen=True)
class SetCurves:
    """Sets the curves that the page shows; curves that are not listed any more are removed.

    Attributes:
        curves: The curves.
        span: The part of a recording that the page shows; None for all of it.
        points: The largest number of points of a curve; the smallest and largest values of longer curves are kept.
    """

    type: ClassVar[str] = "curves"
    curves: list[CurveRequest]
    span: tuple[Nanoseconds, Nanoseconds] | None = None
    points: Annotated[int, Clamp(100, MAX_CURVE_POINTS)] = 4000


@dataclass(frozen=True)
class Inspect:
    """Inspects the messages of a topic instead of those of the previous one; "" ends it."""

    type: ClassVar[str] = "inspect"
    topic: str


@dataclass(frozen=True)
class ShowLog:
    """Requests the log messages and all further ones, or ends this."""

    type: ClassVar[str] = "log"
    shown: bool


@dataclass(frozen=True)
class ShowGraph:
    """Requests the graph of nodes and topics and its changes, or ends this."""

    type: ClassVar[str] = "graph"
    shown: bool


@dataclass(frozen=True)
class Complete:
    """Requests texts with which the beginning of an expression or of a topic's name can continue."""

    type: ClassVar[str] = "complete"
    id: Id
    subject: CompletionKind
    text: str


@dataclass(frozen=True)
class Ready:
    """Confirms that the last frame update was drawn, so that the next one may follow; ``drawn`` is its time."""

    type: ClassVar[str] = "ready"
    drawn: Nanoseconds | None = None


ClientMessage: TypeAlias = (
    SetFixedFrame
    | SetTime
    | Step
    | Subscribe
    | Unsubscribe
    | Relate
    | RequestTimeline
    | SetJoints
    | PublishPoint
    | PublishPose
    | PublishStatic
    | LoadRviz
    | SaveRviz
    | PrepareReplay
    | SetFrameTimeout
    | SetFrameRate
    | Explain
    | SetCurves
    | Inspect
    | ShowLog
    | ShowGraph
    | Complete
    | Ready
)


# Server to client, binary. The letters are those of the struct module.

UInt32: TypeAlias = Annotated[int, "I"]
Float32: TypeAlias = Annotated[float, "f"]
Float64: TypeAlias = Annotated[float, "d"]
Float64x3: TypeAlias = Annotated[tuple[float, ...], "3d"]
Float32x2: TypeAlias = Annotated[tuple[float, ...], "2f"]
Float32x7: TypeAlias = Annotated[tuple[float, ...], "7f"]


class BinaryKind(IntEnum):
    """The first four bytes of a binary message."""

    FRAMES = 1
    CLOUD = 2
    GRID = 3
    SHAPES = 4
    IMAGE = 5
    CURVES = 6


class FrameState(IntEnum):
    """The state of a frame in a frame update.

    A frame of another tree has no transform to the fixed frame; its pose is relative to its own root.
    """

    OK = 0
    STALE = 1
    GONE = 2
    OTHER_TREE = 3


class CloudFlag(IntEnum):
    """Flags of a cloud; the bits above 8 hold the thinning step."""

    SCALARS = 1
    COLORS = 2


class ImageFormat(IntEnum):
    """The lowest eight bits of an image's format; the bits above 8 hold the thinning step."""

    GREY = 0
    RGB = 1
    JPEG = 2
    PNG = 3


class FramesHeader(NamedTuple):
    """A frame update: the poses of all frames and displayed messages at one time.

    Followed by float32[7] per frame, uint8 `FrameState` per frame, padding to four bytes, and one `EntryRecord` per
    displayed message. Positions are relative to ``origin``, which is in metres in the fixed frame. Entries that are not
    listed any more are removed. ``time`` is NaN while there is no data.
    """

    kind: UInt32
    revision: UInt32
    time: Float64
    origin: Float64x3
    frames: UInt32
    entries: UInt32


class EntryRecord(NamedTuple):
    """A displayed message of a frame update: the pose of its frame, and 1 for ``missing`` if there is no transform.

    ``frame`` is the index of its frame in the tree, and `NO_FRAME` if the tree does not contain the frame.
    """

    display: UInt32
    sequence: UInt32
    frame: UInt32
    pose: Float32x7
    missing: UInt32


class CloudHeader(NamedTuple):
    """A point cloud. Followed by float32[3] per point in the message's frame, then float32 scalars or uint8[4] colours.

    ``range`` holds the smallest and the largest finite scalar.
    """

    kind: UInt32
    display: UInt32
    sequence: UInt32
    points: UInt32
    flags: UInt32
    stamp: Float64
    range: Float32x2


class GridHeader(NamedTuple):
    """An occupancy grid. Followed by int8 cells in row-major order; ``corner`` is the pose of the first cell."""

    kind: UInt32
    display: UInt32
    sequence: UInt32
    width: UInt32
    height: UInt32
    resolution: Float32
    corner: Float32x7


class ShapesHeader(NamedTuple):
    """Shapes. Followed by a `ShapesDescription` as JSON, padded by spaces to four bytes, and a float32 payload."""

    kind: UInt32
    display: UInt32
    sequence: UInt32
    length: UInt32


class ImageHeader(NamedTuple):
    """An image, which is shown next to the scene. Followed by the pixels, or the bytes of a JPEG or PNG file."""

    kind: UInt32
    display: UInt32
    sequence: UInt32
    width: UInt32
    height: UInt32
    format: UInt32
    stamp: Float64


class CurvesHeader(NamedTuple):
    """New points of curves. Followed by one `CurveRecord` per curve, then the points of each curve in this order.

    The points of a curve are float64 times in nanoseconds relative to the origin, then float64 values; NaN is a gap.
    """

    kind: UInt32
    curves: UInt32


class CurveRecord(NamedTuple):
    """The number of points of a curve. They replace all earlier points if ``reset`` is 1, and follow them otherwise."""

    curve: UInt32
    reset: UInt32
    points: UInt32
    reserved: UInt32


BINARY_RECORDS: tuple[type[Any], ...] = (
    FramesHeader,
    EntryRecord,
    CloudHeader,
    GridHeader,
    ShapesHeader,
    ImageHeader,
    CurvesHeader,
    CurveRecord,
)
BINARY_ENUMS: tuple[type[IntEnum], ...] = (BinaryKind, FrameState, CloudFlag, ImageFormat)


# Descriptions of shapes.

Rows: TypeAlias = tuple[int, int]
"""An offset into the payload, in floats, and a number of rows: 7 floats per pose, 3 per point, 4 per colour."""


class PosesShape(TypedDict):
    """Poses of one message; 36 covariances, or none."""

    kind: Literal["poses"]
    frame: str
    stamp: float
    poses: Rows
    covariance: list[float | None] | None


class PathShape(TypedDict):
    """A path."""

    kind: Literal["path"]
    frame: str
    stamp: float
    poses: Rows


class OdometryShape(TypedDict):
    """The trail of an odometry topic, newest pose last."""

    kind: Literal["odometry"]
    frame: str
    child_frame: str
    stamp: float
    poses: Rows
    covariance: list[float | None] | None


class MarkerItem(TypedDict):
    """A marker; ``mesh`` is the URL of its mesh, ``mesh_problem`` the reason why there is none."""

    ns: str
    id: int
    type: int
    pose: list[float | None]
    scale: list[float | None]
    rgba: list[float | None]
    text: str
    use_materials: bool
    mesh: str | None
    mesh_problem: str | None
    points: Rows | None
    colors: Rows | None


class MarkersShape(TypedDict):
    """Markers that share a frame and a stamp."""

    kind: Literal["markers"]
    frame: str
    stamp: float
    items: list[MarkerItem]


class RangeShape(TypedDict):
    """A range measurement."""

    kind: Literal["range"]
    frame: str
    stamp: float
    range: float | None
    min_range: float | None
    max_range: float | None
    field_of_view: float | None
    radiation_type: int


class CameraShape(TypedDict):
    """The intrinsics of a camera: image size in pixels, the 3x3 matrix K and the 3x4 matrix P in row-major order."""

    kind: Literal["camera"]
    frame: str
    stamp: float
    width: int
    height: int
    k: list[float | None]
    p: list[float | None]
    distortion_model: str
    d: list[float | None]


ShapesDescription: TypeAlias = PosesShape | PathShape | OdometryShape | MarkersShape | RangeShape | CameraShape


# The JSON block inside a replay file.


class ReplayDisplayBlock(TypedDict):
    """A recorded display. Arrays are base64 text of little-endian numbers.

    Attributes:
        every: Every n-th time was recorded.
        statuses: The index of the time from which a status applies, with the status.
        drawings: Binary messages by sequence number.
        changes: uint32: the indices of the times at which the listing changes.
        counts: uint32: the number of drawings of each listing.
        sequences: uint32: the drawings of all listings.
        poses: float32[7]: the poses of their frames.
        stamps: float64: the stamps of these poses; NaN for the time of the listing.
    """

    topic: str
    type: str
    display: str
    color_by: ColorBy | None
    every: int
    statuses: list[tuple[int, DisplayState, str]]
    drawings: dict[str, str]
    changes: str
    counts: str
    sequences: str
    poses: str
    stamps: str


ReplayBlock = TypedDict(
    "ReplayBlock",
    {
        "format": Literal["coframe-replay"],
        "version": int,
        "title": str,
        "origin": str,
        "origin_xyz": Vector,
        "from": float,
        "to": float,
        "rate": float,
        "fixed": str,
        "frames": list[TreeFrame],
        "times": str,
        "poses": str,
        "states": str,
        "robots": list[Robot],
        "rviz": ReplayRviz | None,
        "displays": list[ReplayDisplayBlock],
        "stats": list[FrameStats],
        "edges": list[TimelineEdge],
        "bins": int,
    },
)
"""The content of a replay. Arrays are base64 text: float64 times, float32[7] poses and uint8 states of all frames."""
