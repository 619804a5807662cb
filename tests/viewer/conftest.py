# SPDX-License-Identifier: Apache-2.0
"""Viewers on loopback, and tabs: real WebSocket clients without a browser."""

import json
import struct
import time
from collections.abc import Callable, Iterator
from types import SimpleNamespace
from typing import get_args

import numpy as np
import pytest

pytest.importorskip("websockets", reason="the viewer needs websockets")

from websockets.sync.client import connect

import coframe
from coframe.viewer.displays.rows import DISPLAYS
from coframe.viewer.protocol import binary_messages, client_messages, server_messages
from coframe.viewer.protocol._layout import Layout
from coframe.viewer.protocol.schema import record

TIMEOUT = 20.0  # Seconds; the machine may be busy.
SECOND = 1_000_000_000


def by_literal(types, field):
    """Return the record of each TypedDict by the literal value of a field."""
    records = [record(one) for one in types]
    return {value: one for one in records for part in one.fields if part.name == field for value in part.type.values}


SERVER_MESSAGES = by_literal(get_args(server_messages.ServerMessage), "type")
SHAPES_BY_KIND = by_literal([shape for row in DISPLAYS.values() for shape in row.shapes], "kind")
CLIENT_FIELDS = {
    one.type: {part.name for part in record(one).fields} for one in get_args(client_messages.ClientMessage)
}


class Tab:
    """A browser tab without a browser: draws nothing, remembers the last message of each kind.

    All messages in both directions are checked against the definition of the protocol.
    """

    def __init__(self, url, **options):
        address = url.replace("http://", "ws://") + "ws"
        self._connection = connect(address, max_size=None, compression=None, **options)
        self.socket = self._connection.__enter__()  # close() exits it.
        self.last = {}
        self.received = []
        self.curves = {}  # Times and values, (2, N), by the id of the curve.
        self.statuses = {}  # The last status of each curve.
        self.drawings = {}  # Decoded binary messages by display and sequence.

    def send(self, kind, **fields):
        assert fields.keys() <= CLIENT_FIELDS[kind], "the protocol has no such field"
        self.socket.send(json.dumps({"type": kind, **fields}))

    def read(self):
        """Return the next message, decoded; confirm frame updates immediately."""
        message = self.socket.recv(TIMEOUT)
        if isinstance(message, str):
            content = json.loads(message)
            kind = content["type"]
            record = SERVER_MESSAGES[kind]
            record.check(content, kind)
            assert content.keys() <= {field.name for field in record.fields}, "the protocol has no such field"
            if kind == "curve":
                self.statuses[content["id"]] = content
        else:
            kind, content = decode(message)
            if kind == "frames":
                self.send("ready", drawn=None if np.isnan(content.time) else content.time)
            elif kind == "curves":
                self._add_points(content)
            elif kind == "geometry":
                pass
            else:
                self.drawings[content.display, content.sequence] = content
        self.last[kind] = content
        self.received.append(kind)
        return kind, content

    def wait(self, kind, condition=lambda _message: True):
        """Return the next message of a kind that meets a condition."""
        deadline = time.monotonic() + TIMEOUT
        while time.monotonic() < deadline:
            kind_read, content = self.read()
            if kind_read == kind and condition(content):
                return content
        raise AssertionError(f"no {kind} arrived; the last messages: {self.last}")

    def has(self, kind):
        """Return the last message of a kind, or wait for the first one."""
        return self.last.get(kind) or self.wait(kind)

    def ask(self, answer, kind, **fields):
        self.send(kind, **fields)
        return self.wait(answer)

    def frame_update(self, condition=lambda _update: True):
        return self.wait("frames", condition)

    def _add_points(self, curves):
        for number, reset, points in curves:
            before = np.empty((2, 0)) if reset else self.curves[number]
            self.curves[number] = np.concatenate([before, points], axis=1)

    def until_curve(self, number, condition=lambda points: points.size):
        """Read until the points of a curve meet a condition, and return its times in nanoseconds and its values."""
        while not (number in self.curves and condition(self.curves[number])):
            self.wait("curves")
        times, values = self.curves[number]
        return times.astype(np.int64) + int(self.has("hello")["origin"]), values

    def until_status(self, number, text):
        """Read until the status of a curve contains a text, and return its state."""
        while text not in self.statuses.get(number, {}).get("text", ""):
            self.wait("curve")
        return self.statuses[number]["state"]

    def world(self, update, name):
        """Return a frame's pose in the fixed frame, (7,) float64."""
        index = next(i for i, frame in enumerate(self.last["tree"]["frames"]) if frame["name"] == name)
        pose = update.poses[index].astype(np.float64)
        pose[:3] += update.origin
        return pose

    def state(self, update, name):
        return update.states[[frame["name"] for frame in self.last["tree"]["frames"]].index(name)]

    def close(self):
        self._connection.__exit__(None, None, None)


FRAMES, ENTRY = Layout(binary_messages.FramesHeader), Layout(binary_messages.EntryRecord)
CLOUD, GRID = Layout(binary_messages.CloudHeader), Layout(binary_messages.GridHeader)
CURVES, CURVE = Layout(binary_messages.CurvesHeader), Layout(binary_messages.CurveRecord)
NODE = Layout(binary_messages.NodeHeader)
SHAPES, IMAGE = Layout(binary_messages.ShapesHeader), Layout(binary_messages.ImageHeader)


def decode(data):
    """Return the kind and the content of a binary message."""
    (kind,) = struct.unpack_from("<I", data)
    if kind == binary_messages.BinaryKind.FRAMES:
        return "frames", decode_frames(data)
    if kind in {binary_messages.BinaryKind.CURVES, binary_messages.BinaryKind.NODE}:
        is_curves = kind == binary_messages.BinaryKind.CURVES
        return ("curves", decode_curves(data)) if is_curves else ("geometry", decode_geometry(data))
    display, sequence = struct.unpack_from("<II", data, 4)
    content = SimpleNamespace(display=display, sequence=sequence, size=len(data))
    if kind == binary_messages.BinaryKind.CLOUD:
        head = CLOUD.unpack(data)
        content.stamp, content.range, content.step = head.stamp, list(head.range), head.flags >> 8
        content.points = np.frombuffer(data, "<f4", head.points * 3, CLOUD.size).reshape(-1, 3)
        at = CLOUD.size + content.points.nbytes
        has_scalars, has_colors = (
            head.flags & binary_messages.CloudFlag.SCALARS,
            head.flags & binary_messages.CloudFlag.COLORS,
        )
        content.scalars = np.frombuffer(data, "<f4", head.points, at) if has_scalars else None
        content.colors = np.frombuffer(data, np.uint8, head.points * 4, at).reshape(-1, 4) if has_colors else None
        return "cloud", content
    if kind == binary_messages.BinaryKind.GRID:
        head = GRID.unpack(data)
        content.resolution, content.corner = head.resolution, list(head.corner)
        cells = np.frombuffer(data, np.int8, head.width * head.height, GRID.size)
        content.cells = cells.reshape(head.height, head.width)
        return "grid", content
    if kind == binary_messages.BinaryKind.IMAGE:
        head = IMAGE.unpack(data)
        content.width, content.height, content.stamp = head.width, head.height, head.stamp
        content.format, content.step = head.format & 255, head.format >> 8
        content.data = np.frombuffer(data, np.uint8, offset=IMAGE.size)
        return "image", content
    assert kind == binary_messages.BinaryKind.SHAPES
    length = SHAPES.unpack(data).length
    content.head = json.loads(data[SHAPES.size : SHAPES.size + length])
    SHAPES_BY_KIND[content.head["kind"]].check(content.head, "shapes")
    content.payload = np.frombuffer(data, "<f4", offset=SHAPES.size + length)
    return "shapes", content


def decode_geometry(data):
    """Return the geometry of a node."""
    head = NODE.unpack(data)
    vertices = np.frombuffer(data, "<f4", head.vertices * 3, NODE.size).reshape(-1, 3)
    at = NODE.size + vertices.nbytes
    indices = np.frombuffer(data, "<u4", head.indices, at)
    colors = np.frombuffer(data, np.uint8, head.colors * 4, at + indices.nbytes).reshape(-1, 4)
    assert len(data) == at + indices.nbytes + colors.nbytes
    return SimpleNamespace(
        node=head.node, vertices=vertices, indices=indices, colors=colors, width=head.width, offset=head.offset
    )


def decode_curves(data):
    """Return the id, the reset flag and the points, (2, N), of each curve."""
    count = CURVES.unpack(data).curves
    records = [CURVE.unpack(data, CURVES.size + CURVE.size * i) for i in range(count)]
    at, found = CURVES.size + CURVE.size * count, []
    for one in records:
        points = np.frombuffer(data, "<f8", 2 * one.points, at).reshape(2, -1)
        found.append((one.curve, bool(one.reset), points))
        at += points.nbytes
    assert len(data) == at
    return found


def decode_frames(data):
    """Return a frame update."""
    head = FRAMES.unpack(data)
    poses = np.frombuffer(data, "<f4", head.frames * 7, FRAMES.size).reshape(-1, 7)
    states = np.frombuffer(data, np.uint8, head.frames, FRAMES.size + poses.nbytes)
    at = FRAMES.size + poses.nbytes + (head.frames + 3) // 4 * 4
    entries = [ENTRY.unpack(data, at + ENTRY.size * i) for i in range(head.entries)]
    assert len(data) == at + ENTRY.size * head.entries
    displays = {(one.display, one.sequence): None if one.missing else np.array(one.pose) for one in entries}
    return SimpleNamespace(
        revision=head.revision,
        time=head.time,
        origin=np.array(head.origin),
        poses=poses,
        states=states,
        displays=displays,
    )


@pytest.fixture
def view() -> Iterator[Callable[..., object]]:
    """Start a viewer on a free port."""
    viewers = []

    def start(source, **options):
        viewers.append(coframe.show(source, port=0, **options))
        return viewers[-1]

    yield start
    for viewer in viewers:
        viewer.close()


@pytest.fixture
def open_tab() -> Iterator[Callable[..., Tab]]:
    """Open a tab of a viewer."""
    tabs = []

    def start(viewer, **options):
        tabs.append(Tab(viewer.url, **options))
        return tabs[-1]

    yield start
    for tab in tabs:
        tab.close()


@pytest.fixture
def decoded() -> Callable[[bytes], SimpleNamespace]:
    """Decode a binary message."""
    return lambda data: decode(bytes(data))[1]
