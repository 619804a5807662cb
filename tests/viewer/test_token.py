# SPDX-License-Identifier: Apache-2.0
"""A viewer that other machines can reach answers only requests with the token in its address."""

import contextlib
import http.client
import socket
from urllib.parse import urlsplit

import pytest
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect

import coframe
from coframe.viewer.server import _connections as connections
from coframe.viewer.server._http import AccessPolicy


@pytest.fixture
def viewer():
    with coframe.show(coframe.Buffer(), host="0.0.0.0", port=0) as viewer:
        yield viewer


def get(viewer, path, **headers):
    address = urlsplit(viewer.url)
    connection = http.client.HTTPConnection(address.hostname, address.port, timeout=20)
    connection.request("GET", path, headers=headers)
    answer = connection.getresponse()
    body = answer.read()
    connection.close()
    return answer.status, answer.headers, body


def cookie_of(viewer):
    _, headers, _ = get(viewer, "/?" + urlsplit(viewer.url).query)
    return headers["Set-Cookie"].partition(";")[0]


def ended(connection):
    try:
        return connection.recv(1) == b""
    except ConnectionResetError:
        return True


def test_nothing_is_answered_without_the_token(viewer):
    token = urlsplit(viewer.url).query.removeprefix("token=")
    assert len(token) == 32
    port = urlsplit(viewer.url).port
    wrong = [
        ("/", {}),
        ("/assets/viewer.js", {}),
        ("/curves.csv", {}),
        ("/mesh/0/a.stl", {}),
        ("/?token=", {}),
        (f"/?token={token[:-1]}", {}),
        (f"/?token={token}x", {}),
        ("/?token=%ff%00", {}),
        ("/", {"Cookie": f"coframe_{port}={token[:-1]}"}),
        ("/", {"Cookie": f"coframe_{port}="}),
        ("/", {"Cookie": f"other={token}"}),
        ("/", {"Cookie": "coframe_1=\xff;;;=;[" + "x" * 1000}),
        ("/ws", {"Upgrade": "websocket"}),
    ]
    for path, headers in wrong:
        status, answer, body = get(viewer, path, **headers)
        assert (status, "Set-Cookie" in answer) == (403, False), (path, headers)
        assert b"Open the complete address that coframe printed" in body
        assert token.encode() not in body


def test_the_address_with_the_token_gives_a_cookie_and_an_address_without_it(viewer):
    query = urlsplit(viewer.url).query
    status, headers, body = get(viewer, f"/?a=b&{query}")
    assert (status, headers["Location"], body) == (303, "/?a=b", b"")
    assert headers["Referrer-Policy"] == "no-referrer"
    cookie, *attributes = headers["Set-Cookie"].split("; ")
    assert set(attributes) == {"Path=/", "HttpOnly", "SameSite=Lax"}
    status, _, body = get(viewer, "/", Cookie=f"other=1; {cookie}")
    assert (status, b"<html" in body) == (200, True)
    for path in ("//evil.example/", "/\\evil.example/", "/%2f/evil.example"):
        location = get(viewer, f"{path}?{query}")[1]["Location"]
        assert location.startswith("/")
        assert not location.startswith(("//", "/\\")), "the redirection stays on this server"


def test_websockets_need_the_token_and_the_origin(viewer):
    address, query = viewer.url.partition("?")[0].replace("http", "ws") + "ws", urlsplit(viewer.url).query
    cookie = {"Cookie": cookie_of(viewer)}
    for where, options in (
        (address, {}),
        (f"{address}?token=x", {}),
        (address, {"origin": "http://evil.example", "additional_headers": cookie}),
        (f"{address}?{query}", {"origin": "http://evil.example"}),
    ):
        with pytest.raises(InvalidStatus) as refused, connect(where, **options):
            pass
        assert refused.value.response.status_code == 403
    for where, options in ((address, {"additional_headers": cookie}), (f"{address}?{query}", {})):
        with connect(where, **options) as tab:
            assert '"hello"' in tab.recv(20)


def test_the_host_is_checked_before_the_token(viewer):
    status, headers, _ = get(viewer, "/?" + urlsplit(viewer.url).query, Host="evil.example")
    assert (status, "Set-Cookie" in headers) == (403, False), "a name that was pointed at this server (DNS rebinding)"


def test_only_loopback_needs_no_token():
    for host in ("127.0.0.1", "127.1.2.3", "localhost", "::1"):
        assert not AccessPolicy(host, 7676).token
    tokens = {AccessPolicy(host, 7676).token for host in ("0.0.0.0", "::", "192.168.1.5", "robot.local", "localhost.x")}
    assert len(tokens) == 5
    assert min(map(len, tokens)) == 32


def test_the_address_for_other_machines(viewer):
    assert viewer.url.startswith("http://127.0.0.1:")
    assert viewer.remote_url == viewer.url.replace("127.0.0.1", socket.gethostname())
    with coframe.show(coframe.Buffer(), port=0) as local:
        assert (local.remote_url, urlsplit(local.url).query) == ("", "")


def test_connections_have_a_limit(monkeypatch, caplog):
    monkeypatch.setattr(connections, "MAX_CONNECTIONS", 3)
    with coframe.show(coframe.Buffer(), port=0) as viewer:
        address = (urlsplit(viewer.url).hostname, urlsplit(viewer.url).port)
        held = [socket.create_connection(address, timeout=20) for _ in range(3)]
        with socket.create_connection(address, timeout=20) as fourth:
            assert ended(fourth)
        assert "the maximum of 3 connections" in caplog.text
        held.pop().close()
        assert get(viewer, "/")[0] == 200
        for one in held:
            one.close()


def test_few_descriptors_leave_some_for_the_viewer_itself(monkeypatch, caplog):
    resource = pytest.importorskip("resource")
    monkeypatch.setattr(resource, "getrlimit", lambda _: (48, 48))
    with coframe.show(coframe.Buffer(), port=0) as viewer, contextlib.ExitStack() as held:
        address = (urlsplit(viewer.url).hostname, urlsplit(viewer.url).port)
        for _ in range(8):
            held.enter_context(socket.create_connection(address, timeout=20))
        with socket.create_connection(address, timeout=20) as another:
            assert ended(another)
        assert caplog.text.count("the maximum of 8 connections") == 1
        held.close()
        assert get(viewer, "/")[0] == 200
