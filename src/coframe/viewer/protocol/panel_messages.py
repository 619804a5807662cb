# SPDX-License-Identifier: Apache-2.0
"""Text messages from the server to the panels next to the scene: plots, tables, states, the log and the graph."""

from __future__ import annotations

from typing import Literal, TypedDict

from coframe.viewer.protocol.common import DisplayState, LogLevel  # noqa: TC001 - the protocol evaluates annotations


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


class TableColumn(TypedDict):
    """A field that has a value of its own; ``path`` is relative to the message."""

    path: str
    type: str


class TableRow(TypedDict):
    """A message; ``key`` increases from message to message, and there is one cell per column at that time.

    ``problem`` is why the message cannot be read, or "".
    """

    key: int
    stamp: float
    cells: list[str]
    problem: str


class TopicTable(TypedDict):
    """The last messages of a topic at the displayed time: new rows, and the ``first`` and ``last`` key of all rows.

    ``columns`` are added at the end when a message has other fields.
    """

    type: Literal["table"]
    topic: str
    message_type: str
    state: DisplayState
    text: str
    columns: list[TableColumn]
    first: int
    last: int
    rows: list[TableRow]


class StateChange(TypedDict):
    """The value of a field from a time on, until the next change."""

    stamp: float
    text: str


class FieldStates(TypedDict):
    """New changes of a field. ``reset`` discards earlier ones; ``until`` is the time of the last message."""

    type: Literal["states"]
    id: int
    state: DisplayState
    text: str
    reset: bool
    until: float | None
    changes: list[StateChange]


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
    """The nodes and topics; sent when they change. ``text`` gives the reason if there are none, or not all."""

    type: Literal["graph"]
    text: str
    nodes: list[GraphNode]
    topics: list[GraphTopic]
    links: list[GraphLink]


class Completions(TypedDict):
    """The answer to ``complete``: possible completions of the text."""

    type: Literal["completions"]
    id: int
    items: list[str]
