"""Viewers on loopback, and tabs: real WebSocket clients that read the protocol by themselves."""

import json
import struct
import time
from collections.abc import Callable, Iterator
from types import SimpleNamespace

import numpy as np
import pytest

pytest.importorskip("websockets", reason="the viewer needs websockets")

from websockets.sync.client import connect

import coframe

_PATIENCE = 20.0  # seconds; two cores that others use too
SECOND = 1_000_000_000


class Tab:
    """A browser tab without a browser: draws nothing, remembers the last of each kind."""

    def __init__(self, url, **options):
        address = url.replace("http://", "ws://") + "ws"
        self._connection = connect(address, max_size=None, compression=None, **options)
        self.socket = self._connection.__enter__()  # closed by close()
        self.last = {}
        self.heard = []
        self.drawings = {}  # (display, sequence) -> decoded binary message

    def send(self, kind, **fields):
        self.socket.send(json.dumps({"type": kind, **fields}))

    def read(self):
        """The next message, decoded; a tick is said to be drawn at once."""
        message = self.socket.recv(_PATIENCE)
        if isinstance(message, str):
            told = json.loads(message)
            kind = told["type"]
        else:
            kind, told = decode(message)
            if kind == "tick":
                self.send("ready", drawn=told.time)
            else:
                self.drawings[told.display, told.sequence] = told
        self.last[kind] = told
        self.heard.append(kind)
        return kind, told

    def wait(self, kind, condition=lambda _message: True):
        """The next message of a kind that meets a condition."""
        deadline = time.monotonic() + _PATIENCE
        while time.monotonic() < deadline:
            heard, told = self.read()
            if heard == kind and condition(told):
                return told
        raise AssertionError(f"waited in vain for {kind}; the last: {self.last}")

    def has(self, kind):
        """The last message of a kind, if need be the first one that comes."""
        return self.last.get(kind) or self.wait(kind)

    def ask(self, answer, kind, **fields):
        self.send(kind, **fields)
        return self.wait(answer)

    def tick(self, condition=lambda _tick: True):
        return self.wait("tick", condition)

    def world(self, tick, name):
        """A frame's pose in the fixed frame, (7,) float64."""
        index = next(i for i, frame in enumerate(self.last["tree"]["frames"]) if frame["name"] == name)
        pose = tick.poses[index].astype(np.float64)
        pose[:3] += tick.origin
        return pose

    def state(self, tick, name):
        return tick.states[[frame["name"] for frame in self.last["tree"]["frames"]].index(name)]

    def close(self):
        self._connection.__exit__(None, None, None)


def decode(data):
    """A binary message by the protocol's documentation."""
    (kind,) = struct.unpack_from("<I", data)
    if kind == 1:
        _, revision, moment, x, y, z, frames, entries = struct.unpack_from("<IId3dII", data)
        poses = np.frombuffer(data, "<f4", frames * 7, 48).reshape(-1, 7)
        states = np.frombuffer(data, np.uint8, frames, 48 + frames * 28)
        at = 48 + frames * 28 + (frames + 3) // 4 * 4
        shown = [struct.unpack_from("<II7fI", data, at + 40 * i) for i in range(entries)]
        assert len(data) == at + 40 * entries
        displays = {(one[0], one[1]): np.array(one[2:9]) if one[9] == 0 else None for one in shown}
        tick = {"revision": revision, "time": moment, "origin": np.array([x, y, z]), "poses": poses, "states": states}
        return "tick", SimpleNamespace(**tick, displays=displays)
    display, sequence = struct.unpack_from("<II", data, 4)
    told = SimpleNamespace(display=display, sequence=sequence, size=len(data))
    if kind == 2:
        count, flags, told.stamp, *told.range = struct.unpack_from("<IIdff", data, 12)
        told.points = np.frombuffer(data, "<f4", count * 3, 36).reshape(-1, 3)
        at = 36 + 12 * count
        told.step = flags >> 8
        told.scalars = np.frombuffer(data, "<f4", count, at) if flags & 1 else None
        told.colours = np.frombuffer(data, np.uint8, count * 4, at).reshape(-1, 4) if flags & 2 else None
        return "cloud", told
    if kind == 3:
        width, height, told.resolution, *told.corner = struct.unpack_from("<II8f", data, 12)
        told.cells = np.frombuffer(data, np.int8, width * height, 52).reshape(height, width)
        return "grid", told
    if kind == 5:
        told.width, told.height, flags, told.stamp = struct.unpack_from("<IIId", data, 12)
        told.format, told.step = flags & 255, flags >> 8
        told.data = np.frombuffer(data, np.uint8, offset=32)
        return "image", told
    assert kind == 4
    (length,) = struct.unpack_from("<I", data, 12)
    told.head = json.loads(data[16 : 16 + length])
    told.payload = np.frombuffer(data, "<f4", offset=16 + length)
    return "shapes", told


@pytest.fixture
def view() -> Iterator[Callable[..., object]]:
    """Shows something on a port of its own."""
    viewers = []

    def start(source, **options):
        viewers.append(coframe.show(source, port=0, **options))
        return viewers[-1]

    yield start
    for viewer in viewers:
        viewer.close()


@pytest.fixture
def open_tab() -> Iterator[Callable[..., Tab]]:
    """Opens a tab of a viewer."""
    tabs = []

    def start(viewer, **options):
        tabs.append(Tab(viewer.url, **options))
        return tabs[-1]

    yield start
    for tab in tabs:
        tab.close()


@pytest.fixture
def decoded() -> Callable[[bytes], SimpleNamespace]:
    """Reads a binary message by the protocol's documentation."""
    return lambda data: decode(bytes(data))[1]
