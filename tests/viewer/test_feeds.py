# SPDX-License-Identifier: Apache-2.0
"""What a client is sent: the newest message of each subject, and only what has changed."""

import json

import pytest

pytest.importorskip("websockets", reason="the viewer needs websockets")

import coframe
from coframe.viewer._state import ViewerState
from coframe.viewer.clients.client import Client
from coframe.viewer.sources.source import BufferSource

SECOND = 1_000_000_000
READY = '{"type":"ready"}'


class RecordingSocket:
    """A connection that stores the messages by their type."""

    def __init__(self):
        self.is_clear = True
        self._sent = []

    def send(self, message):
        self._sent.append(json.loads(message)["type"] if isinstance(message, str) else "frames")

    def take(self):
        """Return the types of the messages since the last call."""
        sent, self._sent = self._sent, []
        return sent


@pytest.fixture
def buffer():
    buffer = coframe.Buffer(None)
    buffer.set("map", "base", coframe.Transform(), SECOND)
    return buffer


@pytest.fixture
def viewer(buffer, monkeypatch):
    monkeypatch.setattr("coframe.viewer._state.STRUCTURE_PERIOD", 0.0)
    monkeypatch.setattr("coframe.viewer._state.STRUCTURE_SHARE", 1e9)
    state = ViewerState(BufferSource(buffer), fixed="map")
    yield state
    state.close()


@pytest.fixture
def socket():
    return RecordingSocket()


@pytest.fixture
def client(socket, viewer):
    client = Client(socket, viewer)
    client.update(100.0)
    return client


def test_the_first_update_contains_everything_in_order(client, socket):
    del client
    assert socket.take() == ["hello", "tree", "stats", "findings", "frames"]


def test_nothing_is_sent_until_the_client_has_drawn_the_last_update(client, socket, buffer):
    socket.take()
    for update in range(10):
        buffer.set("map", f"new_{update}", coframe.Transform(), SECOND)
        client.update(100.1 + update)
    assert socket.take() == []
    client.receive(READY)
    client.update(111.0)
    assert socket.take() == ["tree", "stats", "frames"], "one message for all changes"


def test_nothing_is_sent_while_the_connection_is_behind(client, socket, buffer):
    socket.take()
    client.receive(READY)
    socket.is_clear = False
    buffer.set("map", "second", coframe.Transform(), SECOND)
    client.update(100.1)
    assert socket.take() == []
    socket.is_clear = True
    client.update(100.2)
    assert socket.take() == ["tree", "frames"]


def test_unchanged_frames_are_sent_once_per_second(client, socket):
    socket.take()
    client.receive(READY)
    for hundredths in range(1, 99):
        client.update(100.0 + hundredths / 100)
    assert socket.take() == []
    client.update(101.0)
    assert socket.take() == ["stats", "frames"]


def test_a_new_title_starts_the_page_from_scratch(client, socket, viewer):
    socket.take()
    client.receive(READY)
    viewer.set_title("another")
    client.update(100.1)
    assert socket.take() == ["hello", "tree", "stats", "findings", "frames"]


def test_the_state_of_an_unpublished_topic_is_sent_once(client, socket):
    socket.take()
    client.receive(READY)
    client.state.subscribe(1, "/scan", None)
    client.update(100.1)
    client.update(100.4)
    assert socket.take() == ["display"]
    client.state.subscribe(1, "/scan", None)
    client.update(100.5)
    assert socket.take() == ["display"], "a new subscription has its own state"
