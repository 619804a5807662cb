# SPDX-License-Identifier: Apache-2.0
"""A page whose protocol differs from the server's reloads once, and then explains the problem."""

import json

import pytest

import coframe
from coframe.viewer.protocol.version import PROTOCOL_VERSION

SECOND = 1_000_000_000


@pytest.fixture
def viewer(view):
    buffer = coframe.Buffer(None)
    buffer.set("map", "base", coframe.Transform([1.0, 0.0, 0.0]), SECOND)
    return view(buffer, fixed="map")


def with_version(connections, version_of):
    """Return a relay that replaces the version in `hello`; `version_of` takes the number of the connection."""

    def relay(socket):
        connections.append(socket)
        version = version_of(len(connections))
        server = socket.connect_to_server()

        def forward(message):
            if isinstance(message, str) and json.loads(message)["type"] == "hello":
                message = json.dumps({**json.loads(message), "version": version})
            socket.send(message)

        server.on_message(forward)

    return relay


def test_a_stale_page_reloads_itself_once(viewer, open_page):
    connections = []
    relay = with_version(connections, lambda number: "newer" if number == 1 else PROTOCOL_VERSION)
    page = open_page(viewer.url, relay=relay)
    page.wait(lambda: len(connections) == 2, "a second connection")
    page.raw.wait_for_load_state()
    page.drawn()
    assert len(connections) == 2, "the page was reloaded only once"
    assert page.evaluate("sessionStorage.getItem('coframe.reloaded')") is None


@pytest.mark.slow
def test_a_page_that_still_differs_after_a_reload_explains_the_problem(viewer, open_page):
    connections = []
    page = open_page(viewer.url, relay=with_version(connections, lambda _number: "newer"))
    page.wait(lambda: len(connections) == 2, "a second connection")
    page.raw.wait_for_load_state()
    page.wait(lambda: page.raw.locator("#overlay [role=alert]").count() > 0, "a message")
    text = page.text("#overlay [role=alert]")
    assert "This page does not match its server" in text
    assert f"The page uses protocol {PROTOCOL_VERSION}, the server newer." in text
    page.raw.wait_for_timeout(1000)
    assert len(connections) == 2, "neither another reload nor another connection"
