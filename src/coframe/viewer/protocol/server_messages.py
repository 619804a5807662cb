# SPDX-License-Identifier: Apache-2.0
"""Text messages from the server to the page: TypedDicts, so that building one costs no more than a dict."""

from __future__ import annotations

from typing import Literal, TypeAlias, TypedDict

from coframe.viewer.protocol.common import (
    ClockState,
    DisplayState,
    FindingsState,
    FrameActivity,
    JointKind,
    NodeKind,
    Pose,
    Quaternion,
    RvizDisplay,
    RvizGroup,
    RvizTool,
    RvizView,
    Severity,
    ShapeKind,
    Span,
    UploadState,
    Vector,
    ViewerMode,
    WidgetKind,
)
from coframe.viewer.protocol.panel_messages import (
    Completions,
    CurveStatus,
    FieldStates,
    Inspection,
    LogEntries,
    NodeGraph,
    TopicTable,
)


class DisplayTopic(TypedDict):
    """A topic with the class of its display, or "" if it has none, and whether it is displayed automatically."""

    topic: str
    type: str
    display: str
    automatic: bool


class RvizGlobalOptions(TypedDict):
    """Global options of an RViz configuration, or None for those that are not set."""

    fixed_frame: str | None
    background: list[int] | None
    frame_rate: float | None


UnknownRvizPart = TypedDict("UnknownRvizPart", {"path": str, "class": str, "name": str})
"""A part of an RViz configuration that the viewer cannot show."""


class IgnoredRvizPart(TypedDict):
    """An option, a tool or a panel of an RViz configuration that has no effect; ``path`` is what contains it."""

    path: str
    name: str
    value: str


class SavedRvizView(TypedDict):
    """A view that an RViz configuration contains in addition to the current one."""

    name: str
    view: RvizView


RvizConfiguration = TypedDict(
    "RvizConfiguration",
    {
        "displays": list[RvizDisplay],
        "groups": list[RvizGroup],
        "global": RvizGlobalOptions,
        "view": RvizView | None,
        "saved_views": list[SavedRvizView],
        "tools": list[RvizTool],
        "unknown": list[UnknownRvizPart],
        "ignored": list[IgnoredRvizPart],
    },
)
"""The supported parts of an RViz configuration, and the others: ``unknown`` displays and ``ignored`` options."""


class RecentSource(TypedDict):
    """A source that the viewer has shown, and whether it is shown now."""

    id: int
    name: str
    is_shown: bool


class Hello(TypedDict):
    """The first message. It is sent again when the source or the origin changes. The page then starts from scratch.

    The page compares ``version`` with its own. ``mode`` is "replay" only inside replay files. ``fixed_is_given`` is
    true if an option or the .rviz file names the fixed frame, so that the page does not use the one of its last
    session. With ``can_open``, the page may open files. ``restart`` is the reason if everything starts again without
    the data received so far, such as a jump back in time.
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
    topics: list[DisplayTopic]
    can_publish: bool
    can_open: bool
    can_control: bool
    recent: list[RecentSource]
    restart: str | None


class Pulse(TypedDict):
    """Sent once per second, so that a page notices a stopped server or an interrupted network.

    ``silence`` is the number of seconds since the last transform or displayed message arrived, or None if nothing
    arrives regularly. ``clock`` is "simulated" if the time is that of /clock, and "paused" while it does not advance.
    """

    type: Literal["pulse"]
    silence: float | None
    clock: ClockState


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
    """Statistics of one frame, or None for values that do not apply.

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


class DisplayTopics(TypedDict):
    """The topics, the most useful ones first; sent when they change."""

    type: Literal["topics"]
    topics: list[DisplayTopic]


class RobotShape(TypedDict):
    """A visual or collision shape of a link.

    ``size`` has the lengths of a box along x, y and z, the radius of a sphere, the radius and the length along z of a
    cylinder or of the cylinder of a capsule, or the scale factors of a mesh. ``pose`` is relative to the link. ``mesh``
    and ``texture`` are references, whose URLs are in the table of the robot.
    """

    kind: ShapeKind
    size: list[float]
    pose: Pose
    mesh: str | None
    color: tuple[float, float, float, float] | None
    texture: str | None


class RobotLink(TypedDict):
    """A link with its shapes."""

    name: str
    visuals: list[RobotShape]
    collisions: list[RobotShape]


class JointMimic(TypedDict):
    """The rule by which a joint follows another joint: multiplier * position + offset."""

    joint: str
    multiplier: float
    offset: float


class RobotJoint(TypedDict):
    """A joint; ``origin`` is the pose of its child link relative to its parent link at position 0.

    ``effort`` is the limit in newtons or newton meters. ``value`` is the default position, in radians or meters, of a
    joint that a slider can move; None for other joints.
    """

    name: str
    type: JointKind
    parent: str
    child: str
    origin: Pose
    axis: Vector
    mimic: JointMimic | None
    lower: float | None
    upper: float | None
    effort: float | None
    value: float | None


class RobotModel(TypedDict):
    """A robot, as `coframe.robots` reads its description: ``joints`` lists parents before children.

    ``meshes`` maps the reference of each mesh and texture to its URL, ``problems`` lists what cannot be drawn, and
    ``warnings`` lists the faults of the description. ``description_topic`` is None for a robot from a file.
    """

    type: Literal["robot"]
    id: int
    name: str
    source: str
    root: str
    links: list[RobotLink]
    joints: list[RobotJoint]
    meshes: dict[str, str]
    problems: list[str]
    warnings: list[str]
    description_topic: str | None


class _DisplayStatus(TypedDict):
    type: Literal["display"]
    id: int
    state: DisplayState
    text: str


class DisplayStatus(_DisplayStatus, total=False):
    """The status of a subscribed display; ``note`` describes what is omitted, and is missing if nothing is."""

    note: str


class PickedField(TypedDict):
    """A value of the selected part of a message, such as the intensity of a point."""

    name: str
    text: str


class PartDetails(TypedDict):
    """The answer to ``pick``: the message of a drawing, and its values at the selected part.

    ``stamp`` is None for drawings without a stamp. ``curves`` are expressions of the part that can be plotted.
    """

    type: Literal["picked"]
    id: int
    sequence: int
    topic: str
    message_type: str
    frame: str
    stamp: float | None
    fields: list[PickedField]
    curves: list[str]


class Rviz(RvizConfiguration):
    """The answer to ``load_rviz``."""

    type: Literal["rviz"]


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


class FindingEntry(TypedDict):
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
    explains: list[FindingEntry]


class FindingEntries(TypedDict):
    """The findings of the doctor; sent when they change. ``text`` gives the reason if findings are not available."""

    type: Literal["findings"]
    state: FindingsState
    text: str
    findings: list[FindingEntry]


class CodePage(TypedDict):
    """The answer to ``explain``: the page of a code, as Markdown."""

    type: Literal["page"]
    code: str
    title: str
    text: str


class RvizSaved(TypedDict):
    """The answer to ``save_rviz``: the text of the .rviz file."""

    type: Literal["saved"]
    text: str


class UploadProgress(TypedDict):
    """The answer to ``open_files`` and to each part of the files; ``text`` is the reason if it has failed."""

    type: Literal["upload"]
    state: UploadState
    received: int
    total: int
    text: str
    hint: str


class ReplayPrepared(TypedDict):
    """The answer to ``replay``: ``/replay?settings=TOKEN&from=&to=&rate=&fixed=`` returns the file."""

    type: Literal["replay"]
    settings: str


class PublishResult(TypedDict):
    """The answer to requests that publish a message; ``subscribers`` is the number of matched subscriptions."""

    type: Literal["published"]
    topic: str
    subscribers: int


class ControlledField(TypedDict):
    """A name with its type, or a field with its path, type and value as JSON."""

    path: str
    type: str
    value: str


class Controlled(TypedDict):
    """The answer to ``control``. ``text`` says what has happened, or why it has failed."""

    type: Literal["controlled"]
    id: int
    ok: bool
    text: str
    hint: str
    ros_type: str
    fields: list[ControlledField]


class SceneNode(TypedDict):
    """A node that a program has added to the scene. Its `NodeHeader` message follows if the node has a geometry.

    ``frame`` is the frame in which ``pose`` is expressed: a frame of the tree, "" for the fixed frame, or None for the
    nearest node above this one by their names, which are paths (the fixed frame if there is none). ``color`` is None
    for the default of the page. ``size`` is the length of axes, the diameter of points, or the height of a line of text
    in meters, or the width of lines in pixels. Of several nodes with the same name and a ``time``, the last one at the
    displayed time is shown. ``problem`` names the part that is not drawn, and the reason.
    """

    type: Literal["node"]
    id: int
    name: str
    kind: NodeKind
    frame: str | None
    pose: Pose
    time: float | None
    visible: bool
    clickable: bool
    color: Vector | None
    opacity: float
    size: float
    text: str
    wireframe: bool
    problem: str


class RemovedNodes(TypedDict):
    """The ids of nodes that no longer exist."""

    type: Literal["nodes_removed"]
    ids: list[int]


class Widget(TypedDict):
    """A widget that a program has added to the page.

    Widgets are shown in the order of their ids, inside the folder ``parent`` if it is not None. Sliders and numbers
    have a ``number`` from ``lower`` to ``upper``, None for no limit; drop-downs and text fields have a ``text``;
    checkboxes have ``flag``. An open folder has the ``flag`` true. ``content`` is the data URL of an image, or
    the curves of a plot as JSON.
    """

    type: Literal["widget"]
    id: int
    kind: WidgetKind
    label: str
    parent: int | None
    number: float | None
    text: str | None
    flag: bool | None
    lower: float | None
    upper: float | None
    step: float | None
    options: list[str]
    hint: str
    disabled: bool
    visible: bool
    content: str


class RemovedWidgets(TypedDict):
    """The ids of widgets that no longer exist."""

    type: Literal["widgets_removed"]
    ids: list[int]


class ProblemReport(TypedDict):
    """A request that failed, or a problem with the source."""

    type: Literal["problem"]
    text: str
    hint: str


ServerMessage: TypeAlias = (
    Hello
    | Pulse
    | Tree
    | Stats
    | DisplayTopics
    | RobotModel
    | DisplayStatus
    | PartDetails
    | Rviz
    | Relation
    | Timeline
    | FindingEntries
    | CodePage
    | CurveStatus
    | Inspection
    | TopicTable
    | FieldStates
    | LogEntries
    | NodeGraph
    | Completions
    | RvizSaved
    | UploadProgress
    | ReplayPrepared
    | PublishResult
    | Controlled
    | SceneNode
    | RemovedNodes
    | Widget
    | RemovedWidgets
    | ProblemReport
)
