# SPDX-License-Identifier: Apache-2.0
"""The server: access, invalid and stuck clients, start and end."""

import contextlib
import gzip
import http.client
import json
import signal
import socket
import subprocess
import sys
import threading
import time
from pathlib import Path
from urllib.parse import urlsplit

import numpy as np
import pytest
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import connect

import coframe
from coframe.viewer._state import ViewerState
from coframe.viewer.server._http import AccessPolicy
from coframe.viewer.server.server import ViewerServer
from coframe.viewer.sources.source import BufferSource

SECOND = 1_000_000_000


def small_buffer():
    buffer = coframe.Buffer(None)
    for second in range(100):
        buffer.set("map", "base", coframe.Transform([second, 0.0, 0.0]), second * SECOND)
    return buffer


def get(url, path="/", **headers):
    """Return status, headers and body, without normalizing the path as a browser does."""
    address = urlsplit(url)
    connection = http.client.HTTPConnection(address.hostname, address.port, timeout=20)
    connection.putrequest("GET", path, skip_host="Host" in headers)
    for name, value in headers.items():
        connection.putheader(name.replace("_", "-"), value)
    connection.endheaders()
    answer = connection.getresponse()
    body = answer.read()
    connection.close()
    return answer.status, answer.headers, body


@pytest.fixture
def page(tmp_path):
    """A server with a small page, next to a file that must not be served."""
    folder = tmp_path / "static"
    (folder / "assets").mkdir(parents=True)
    (folder / "index.html").write_text("<title>page</title>")
    (folder / "assets" / "viewer.js").write_text("1")
    (folder / "assets" / "packed.js.gz").write_bytes(gzip.compress(b"large"))
    (folder / "assets" / "link.js").symlink_to(tmp_path / "secret.js")
    (tmp_path / "secret.js").write_text("secret")
    with ViewerServer(ViewerState(BufferSource(small_buffer())), port=0, static=folder) as server:
        yield server.url


def test_the_page_has_security_headers(page):
    status, headers, body = get(page)
    assert (status, body) == (200, b"<title>page</title>")
    policy = headers["Content-Security-Policy"]
    assert "default-src 'none'; script-src 'self';" in policy
    assert "unsafe-eval" not in policy
    assert "http://127.0.0.1:*" in policy.partition("frame-ancestors")[2], "Jupyter displays it in a frame"
    assert headers["X-Content-Type-Options"] == "nosniff"
    status, headers, body = get(page, "/assets/viewer.js")
    assert (status, headers["Content-Type"], body) == (200, "text/javascript; charset=utf-8", b"1")
    assert get(page, "/assets/viewer.js", If_None_Match=headers["ETag"])[0] == 304


def test_a_file_that_is_stored_compressed(page):
    status, headers, body = get(page, "/assets/packed.js", Accept_Encoding="gzip, deflate, br")
    assert (status, headers["Content-Type"]) == (200, "text/javascript; charset=utf-8")
    assert (headers["Content-Encoding"], gzip.decompress(body)) == ("gzip", b"large")
    tag = headers["ETag"]
    assert get(page, "/assets/packed.js", Accept_Encoding="gzip", If_None_Match=tag)[0] == 304
    for encodings in ("identity", "br, gzip;q=0"):
        status, headers, body = get(page, "/assets/packed.js", Accept_Encoding=encodings, If_None_Match=tag)
        assert (status, body, headers["Content-Encoding"]) == (200, b"large", None)


@pytest.mark.parametrize(
    "path",
    [
        "/../secret.js",
        "/assets/../../secret.js",
        "/assets/%2e%2e/%2e%2e/secret.js",
        "/assets/link.js",
        "//etc/passwd",
        "/%00",
        "/" + "a" * 5000,
        "/assets",
        "/nothing",
        "/mesh/",
        "/mesh/x/../../secret.js",
        "/rviz",
    ],
)
def test_other_files_cannot_be_fetched(page, path):
    status, _, body = get(page, path)
    assert status == 404
    assert b"secret" not in body
    assert b"root:" not in body


@pytest.mark.parametrize(
    "host", ["evil.example", "evil.example:{port}", "127.0.0.1:1", "", "localhost.evil.example:{port}"]
)
def test_other_host_names_are_rejected(page, host):
    port = urlsplit(page).port
    assert get(page, Host=host.format(port=port))[0] == 403
    assert get(page, Host=f"localhost:{port}")[0] == 200


@pytest.mark.parametrize(
    ("lines", "status"),
    [
        *[(f"{method} / HTTP/1.1\r\nHost: {{host}}", 405) for method in ("POST", "PUT", "DELETE", "OPTIONS", "HEAD")],
        ("GET / HTTP/1.1\r\nHost: {host}\r\nHost: {host}", 400),
        ("GET / HTTP/1.1\r\nHost: {host}\r\nHost: evil.example", 400),
        ("GET /ws HTTP/1.1\r\nHost: {host}\r\nUpgrade: websocket\r\nUpgrade: websocket", 400),
        ("GET / HTTP/1.1\r\nHost: {host}\r\nIf-None-Match: a\r\nIf-None-Match: b", 400),
        ("GET //[ HTTP/1.1\r\nHost: {host}", 400),
        ("GET / HTTP/1.1\r\nHost: {host}", 200),
    ],
)
def test_unusual_requests_are_refused_without_a_traceback(page, capfd, caplog, lines, status):
    address = urlsplit(page)
    with socket.create_connection((address.hostname, address.port), timeout=20) as connection:
        connection.sendall(f"{lines.format(host=address.netloc)}\r\n\r\n".encode())
        assert connection.makefile("rb").readline().split()[1] == str(status).encode()
    assert not capfd.readouterr().err
    assert not caplog.records


@pytest.mark.parametrize("origin", ["http://evil.example", "https://127.0.0.1:{port}", "http://127.0.0.1:1", "null"])
def test_pages_of_other_sites_cannot_connect(page, origin):
    port = urlsplit(page).port
    address = page.replace("http", "ws") + "ws"
    with pytest.raises(InvalidStatus) as refused, connect(address, origin=origin.format(port=port)):
        pass
    assert refused.value.response.status_code == 403
    with connect(address, origin=f"http://127.0.0.1:{port}") as own:
        assert json.loads(own.recv(20))["type"] == "hello"
    assert get(page, "/ws")[0] == 426


def test_a_server_on_all_addresses_accepts_addresses_but_no_other_names():
    access = AccessPolicy("0.0.0.0", 7676)
    assert access.allows_host("192.168.1.5:7676")
    assert access.allows_host("[::1]:7676")
    assert not access.allows_host("evil.example:7676")
    assert not AccessPolicy("127.0.0.1", 7676).allows_host("192.168.1.5:7676")


GARBAGE = [
    "",
    "nonsense",
    "[]",
    "{}",
    '{"type": 3}',
    '{"type": "launch"}',
    '{"type": "fixed"}',
    '{"type": "fixed", "frame": ["map"]}',
    '{"type": "time", "mode": "backwards"}',
    '{"type": "time", "mode": "at", "at": 1e400}',
    '{"type": "time", "mode": "at", "at": NaN}',
    '{"type": "time", "mode": "at", "at": 0, "speed": "fast"}',
    '{"type": "time", "mode": "at", "at": 0, "loop": [1, null]}',
    '{"type": "time", "mode": "at", "at": ' + "9" * 400 + "}",
    '{"type": "step"}',
    '{"type": "subscribe", "id": -1, "topic": "/scan"}',
    '{"type": "subscribe", "id": 1.5, "topic": "/scan"}',
    '{"type": "subscribe", "id": 1, "topic": 7, "options": []}',
    '{"type": "unsubscribe", "id": "one"}',
    '{"type": "relate", "id": 1, "target": "map"}',
    '{"type": "timeline", "from": 0, "to": 0, "bins": 10}',
    '{"type": "timeline", "from": 0, "to": 1, "bins": 1e9}',
    '{"type": "joints", "robot": 0, "positions": {"a": 1}, "publish": true}',
    '{"type": "load_rviz", "text": "a: [b"}',
    '{"type": "save_rviz", "displays": {}}',
    "[" * 100_000,
    b"\x00\x01\x02\x03",
]


def test_invalid_messages_are_answered(view, open_tab):
    viewer = view(small_buffer())
    tab = open_tab(viewer)
    for garbage in GARBAGE:
        tab.socket.send(garbage)
        assert tab.wait("problem")["text"], garbage
    tab.send("subscribe", id=1, topic="/no_such_topic")
    assert tab.wait("display") == {
        "type": "display",
        "id": 1,
        "state": "waiting",
        "text": "no node publishes /no_such_topic",
    }
    assert tab.frame_update().time is not None
    tab.socket.send("x" * (2 << 20))
    with pytest.raises(ConnectionClosed):
        read_forever(tab)
    assert open_tab(viewer).frame_update().revision == 1


def test_long_and_fragmented_messages_arrive_complete(view, open_tab):
    """Messages are fragmented in both directions, with a ping in between."""
    buffer = coframe.Buffer(None)
    names = [f"{'long' * 40}_{frame}" for frame in range(3000)]
    for name in names:
        buffer.set("map", name, coframe.Transform(), static=True)
    tab = open_tab(view(buffer))
    assert {frame["name"] for frame in tab.wait("tree")["frames"]} == {"map", *names}
    tab.socket.ping()
    question = json.dumps({"type": "relate", "id": 7, "target": "map", "source": names[0]})
    tab.socket.send([question[:10], "", question[10:30], question[30:]])
    assert tab.wait("relation")["id"] == 7


def test_invalid_utf8_closes_only_that_connection(view, open_tab):
    viewer = view(small_buffer())
    tab = open_tab(viewer)
    tab.socket.send(b"\xff\xfe", text=True)
    with pytest.raises(ConnectionClosed) as ended:
        read_forever(tab)
    assert ended.value.rcvd.code == 1007
    assert open_tab(viewer).frame_update().revision == 1


def test_the_size_limit_applies_to_all_fragments_together(view, open_tab):
    viewer = view(small_buffer())
    tab = open_tab(viewer)

    def send_requests():
        tab.socket.send("x" * 1000 for _ in range(5000))
        read_forever(tab)

    with pytest.raises(ConnectionClosed) as ended:
        send_requests()
    assert ended.value.rcvd is None or ended.value.rcvd.code == 1009
    assert open_tab(viewer).frame_update().revision == 1


def test_other_protocols_on_the_port_do_no_harm(view, open_tab):
    viewer = view(small_buffer())
    address = urlsplit(viewer.url)
    for data in (
        b"",
        b"\x00" * 1000,
        b"GET / HTTP/1.1\r\n" * 3000,
        b"POST / HTTP/1.1\r\nContent-Length: 9999999999\r\n\r\n",
    ):
        with socket.create_connection((address.hostname, address.port), timeout=20) as connection:
            connection.sendall(data)
    assert open_tab(viewer).frame_update().revision == 1


def test_a_stuck_tab_takes_no_memory_and_does_not_delay_others(view, open_tab):
    """One tab neither reads nor draws, one sends requests and confirmations but reads nothing, and one works."""
    buffer = coframe.Buffer(None)
    for frame in range(1000):
        buffer.set("map", f"f{frame}", coframe.Transform([frame, 0.0, 0.0]), SECOND)
        buffer.set("map", f"f{frame}", coframe.Transform([frame, 1.0, 0.0]), 100 * SECOND)
    viewer = view(buffer)
    stuck = open_tab(viewer)
    stuck.socket.recv(20)
    asking = open_tab(viewer)
    relate = json.dumps({"type": "relate", "id": 1, "target": "f1", "source": "x" * 2000})
    ended = threading.Event()

    def send_requests():
        try:
            while not ended.wait(0.005):
                for _ in range(20):
                    asking.socket.send(relate)
                asking.send("ready")
        except (ConnectionClosed, OSError):
            pass

    requester = threading.Thread(target=send_requests, daemon=True)
    requester.start()
    good = open_tab(viewer)
    good.frame_update()
    good.send("time", mode="at", at=2 * SECOND - int(good.last["hello"]["origin"]), playing=True, speed=1.0)
    memory = []
    for _ in range(4):
        for _ in range(8):
            good.frame_update()
        memory.append(resident_bytes())
    ended.set()
    for tab in (asking, stuck):  # A closing handshake would time out.
        tab.socket.socket.shutdown(socket.SHUT_RDWR)
    requester.join(20)
    # An update has 28 kB and an answer 8 kB: unread messages would soon take tens of megabytes.
    assert memory[-1] - memory[0] < 5_000_000


@pytest.mark.skipif(sys.platform != "linux", reason="measures memory as Linux reports it")
def test_a_client_that_only_sends_pings_takes_no_memory(view, open_tab):
    viewer = view(small_buffer())
    address = urlsplit(viewer.url)
    opening = (
        f"GET /ws HTTP/1.1\r\nHost: {address.netloc}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
        "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n"
    )
    ping = b"\x89\xfd" + bytes(4 + 125)  # 125 bytes, with a mask of zeros
    before, sent = resident_bytes(), 0
    with socket.create_connection((address.hostname, address.port), timeout=2.0) as flooding:
        flooding.sendall(opening.encode())
        assert b"101" in flooding.recv(1000)
        with contextlib.suppress(TimeoutError):
            while sent < 100_000_000:
                sent += flooding.send(ping * 8)
        assert resident_bytes() - before < 20_000_000
        open_tab(viewer).frame_update()


def test_text_that_is_not_unicode_is_refused_without_a_traceback(view, open_tab, caplog):
    tab = open_tab(view(small_buffer()))
    tab.send("relate", id=1, target="\ud800", source="b")
    assert "must be text" in tab.wait("problem")["text"]
    assert "Traceback" not in caplog.text


def resident_bytes():
    return int(Path("/proc/self/statm").read_text().split()[1]) * 4096 if sys.platform == "linux" else 0


def test_updates_wait_until_the_last_one_is_drawn(view, open_tab):
    buffer = small_buffer()
    tab = open_tab(view(buffer))
    tab.frame_update()
    updates = []
    deadline = time.monotonic() + 1.5  # An update is sent every second even if nothing changes.
    while (left := deadline - time.monotonic()) > 0:
        buffer.set("map", "base", coframe.Transform(), 200 * SECOND + len(updates))
        with contextlib.suppress(TimeoutError):
            message = tab.socket.recv(left)
            updates += [message] if isinstance(message, bytes) else []
    assert len(updates) == 1, "only the first update was confirmed"


def read_forever(tab):
    while True:
        tab.read()


@pytest.mark.parametrize("by_signal", [False, True])
def test_a_program_waits_until_its_viewer_is_closed_or_interrupted(by_signal):
    with coframe.show(small_buffer(), port=0) as viewer:
        end = (signal.raise_signal, [signal.SIGINT]) if by_signal else (viewer.close, [])
        timer = threading.Timer(0.1, *end)
        started_at = time.monotonic()
        timer.start()
        viewer.wait()
        assert time.monotonic() - started_at >= 0.1
        timer.join()


def test_closing_ends_all_threads(open_tab):
    before = set(threading.enumerate())
    viewer = coframe.show(small_buffer(), port=0)
    tab = open_tab(viewer)
    tab.frame_update()
    url = viewer.url
    viewer.close()
    viewer.close()
    with pytest.raises(ConnectionClosed):
        read_forever(tab)
    ours = [thread for thread in set(threading.enumerate()) - before if thread.name.startswith("coframe")]
    assert not ours
    with pytest.raises(ConnectionRefusedError):
        get(url)


def test_a_port_in_use_is_an_error_unless_it_is_the_default(view):
    viewer = view(small_buffer())
    port = urlsplit(viewer.url).port
    with pytest.raises(coframe.ViewerError, match=f"cannot listen on 127.0.0.1:{port}") as error:
        coframe.show(small_buffer(), port=port)
    assert "another port" in error.value.hint
    with coframe.show(small_buffer()) as first, coframe.show(small_buffer()) as second:
        assert first.url != second.url
        assert get(second.url)[0] == 200


@pytest.mark.parametrize(
    ("options", "reason"), [({"host": "x" * 70}, "does not have that address"), ({"port": 70_000}, "0-65535")]
)
def test_addresses_that_cannot_exist_are_errors(options, reason):
    with pytest.raises(coframe.ViewerError, match=reason):
        coframe.show(small_buffer(), **options)


def test_the_viewer_is_displayed_in_a_notebook(view):
    viewer = view(small_buffer(), inline="viewer")
    assert f'<iframe src="{viewer.url}"' in viewer._repr_html_()
    with pytest.raises(TypeError, match=r"coframe\.Buffer"):
        coframe.show(3)


def test_a_missing_package_gives_a_message_and_importing_stays_cheap():
    code = """
import sys
class Missing:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in {"websockets", "yaml"}:
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)
sys.meta_path.insert(0, Missing())
import coframe
assert not [name for name in sys.modules if name.startswith(("coframe.viewer", "coframe.robots", "asyncio"))]
for options in ({}, {"rviz": sys.argv[1]}):
    try:
        coframe.show(coframe.Buffer(), **options)
    except coframe.ViewerError as error:
        print(error)
"""
    result = subprocess.run([sys.executable, "-c", code, __file__], capture_output=True, text=True, check=False)
    assert result.stderr == ""
    assert result.stdout.splitlines() == [
        "the viewer needs the package websockets: pip install 'coframe[viewer]'",
        "RViz files need the package PyYAML: pip install 'coframe[viewer]'",
    ]


def test_poses_that_are_not_finite_are_sent(view, open_tab):
    """A missing pose is sent as NaN."""
    buffer = coframe.Buffer(None)
    buffer.set("map", "late", coframe.Transform(), 100 * SECOND)
    buffer.set("map", "huge", coframe.Transform([1e300, 0.0, 0.0]), 100 * SECOND)
    tab = open_tab(view(buffer, fixed="map"))
    update = tab.frame_update()
    assert np.isinf(tab.world(update, "huge")[0]) or tab.world(update, "huge")[0] > 1e290
    tab.send("time", mode="at", at=SECOND - int(tab.last["hello"]["origin"]))
    update = tab.frame_update(lambda update: update.time < 0)
    assert tab.state(update, "late") == 2
    assert np.isnan(tab.world(update, "late")).all()
