# SPDX-License-Identifier: Apache-2.0
"""Recordings on web servers: only what is needed is read, and each failure of a server is one sentence."""

import contextlib
import io
import pickle
import socket
import threading
import time

import numpy as np
import pytest
from file_server import FileServer, dripping, packed
from mcap.writer import CompressionType
from recordings import (
    COUNT,
    SECOND,
    START,
    assert_same,
    cdr,
    messages,
    write_mcap,
    write_rosbag1,
    write_rosbag2,
    write_sqlite,
)
from rosbags.rosbag2 import StoragePlugin

import coframe
from coframe._sources import _http

IMU, TEXT = "sensor_msgs/msg/Imu", "std_msgs/msg/String"
MINUTE = 60 * SECOND


@pytest.fixture
def run(tmp_path):
    return write_mcap(tmp_path / "run.mcap").read_bytes()


@pytest.fixture
def impatient(monkeypatch):
    monkeypatch.setattr(_http, "MAX_WAIT", 0.4)
    monkeypatch.setattr(_http, "_RETRY_DELAYS", (0.01, 0.01))


def large(path, minutes=20):
    """Write a recording with a chunk of 100 kB each second; /rare is only in one of them."""
    noise = np.random.default_rng(1).integers(0, 256, 100_000, dtype=np.uint8).tobytes()
    drive = coframe.Transform([1.0, 2.0, 3.0])
    rows = [("/tf_static", START, cdr("base", "lidar", coframe.Transform([0, 0, 1]), START))]
    for second in range(minutes * 60):
        at = START + second * SECOND
        rows.append(("/tf", at, cdr("odom", "base", drive, at)))
        rows.append(("/noise", at + 1, b"\0\1\0\0" + len(noise).to_bytes(4, "little") + noise))
        if second == 30:
            rows.append(("/rare", at + 2, b"\0\1\0\0\3\0\0\0hi\0"))
    types = dict.fromkeys(("/noise", "/rare"), (TEXT, "ros2msg", b"string data\n", "cdr"))
    return write_mcap(path, CompressionType.NONE, rows=rows, types=types)


def failure(url, **options):
    with pytest.raises(coframe.RecordingError) as error:
        coframe.open_bag(url, **options)
    text = str(error.value)
    assert "\n" not in text
    assert len(text) < 700
    return text


# What is read


@pytest.mark.parametrize("compression", list(CompressionType))
def test_an_mcap_file_is_read_like_a_local_one(tmp_path, compression):
    path = write_mcap(tmp_path / "run.mcap", compression)
    with (
        FileServer({"/run.mcap": path.read_bytes()}) as server,
        coframe.open_bag(path) as local,
        coframe.open_bag(server.url()) as bag,
    ):
        assert_same(bag.buffer)
        assert {name: topic.messages for name, topic in bag.topics.items()} == {"/tf": COUNT, "/tf_static": 1}
        assert bag.topics["/tf"].rate == pytest.approx(20)
        assert (bag.received_start, bag.received_end) == (local.received_start, local.received_end)
        assert bag.span == local.span
        assert bag.compression == local.compression
        assert not bag.problems
        for topic in ("/tf", "/tf_static"):
            pairs = zip(bag.messages(topic), local.messages(topic), strict=True)
            assert all(ours.data == theirs.data and ours.stamp == theirs.stamp for ours, theirs in pairs)
        assert [each[1:] for each in bag.in_order()] == [each[1:] for each in local.in_order()]


def test_opening_reads_only_the_index(tmp_path):
    path = large(tmp_path / "run.mcap")
    with FileServer({"/run.mcap": path.read_bytes()}) as server, coframe.open_bag(server.url()) as bag:
        assert path.stat().st_size > 100_000_000
        assert bag.topics["/noise"].messages == 1200
        assert bag.duration == pytest.approx(1199 * SECOND, abs=SECOND)
        assert server.sent < 1_000_000
        assert len(server.requests) <= 5
        (message,) = bag.messages("/rare")
        assert message.message.data == "hi"
        assert server.sent < 2_000_000
        assert bag.first_frame("/noise") == ""
        assert server.sent < 2_000_000


def test_a_window_reads_only_its_chunks(tmp_path):
    path = large(tmp_path / "run.mcap")
    with (
        FileServer({"/run.mcap": path.read_bytes()}) as server,
        coframe.open_bag(server.url(), start="5min", stop="10min") as bag,
    ):
        assert bag.topics["/noise"].messages == 300
        assert bag.topics["/rare"].messages == 0
        assert bag.received_start == START + 5 * MINUTE
        assert bag.buffer.lookup("odom", "lidar", START + 7 * MINUTE).translation.tolist() == [1, 2, 4]
        assert 30_000_000 < server.sent < 1.15 * 320 * 100_300 + 1_000_000
        before = server.sent
        assert len(list(bag.messages("/noise"))) == 300
        assert bag.buffer.span("odom", "base")[0] == START + 5 * MINUTE - 10 * SECOND
        assert server.sent == before, "everything was read when the window was opened"


def test_a_table_of_an_interval_reads_only_its_chunks(tmp_path):
    path = large(tmp_path / "run.mcap")
    with FileServer({"/run.mcap": path.read_bytes()}) as server, coframe.open_bag(server.url()) as bag:
        table = bag.table("odom:lidar", at="/tf", start="5min", stop="7min", validity=False)
        assert table.stamps.tolist() == [START + second * SECOND for second in range(300, 421)]
        assert table["odom:lidar.z"].tolist() == [4.0] * 121
        assert 12_000_000 < server.sent < 1.1 * 142 * 100_300 + 1_000_000
        before = server.sent
        given = bag.table("odom:lidar", at=START + np.array([330, 360]) * SECOND)
        assert given["odom:lidar.x"].tolist() == [1.0, 1.0]
        assert server.sent < before + 1_000_000


def test_a_table_of_another_clock_reads_everything(tmp_path):
    rows = [(topic, at + 1000 * SECOND, data) for topic, at, data in messages()]
    path = write_mcap(tmp_path / "run.mcap", rows=rows)
    with FileServer({"/run.mcap": path.read_bytes()}) as server, coframe.open_bag(server.url()) as bag:
        table = bag.table("odom:lidar", at="/tf", start=START + SECOND, stop=START + 2 * SECOND)
        assert len(table) == 20


def test_messages_are_received_once(tmp_path):
    path = large(tmp_path / "run.mcap", minutes=3)
    with FileServer({"/run.mcap": path.read_bytes()}) as server, coframe.open_bag(server.url()) as bag:
        assert bag.buffer.can_transform("odom", "lidar")
        assert len(list(bag.messages("/noise"))) == 180
        assert server.sent < 1.05 * path.stat().st_size


def test_a_ros1_bag_is_read_in_parts(tmp_path):
    rows = [*messages_ros1_with_noise()]
    path = write_rosbag1(tmp_path / "run.bag", rows=rows, types={"/noise": TEXT})
    with (
        FileServer({"/run.bag": path.read_bytes()}) as server,
        coframe.open_bag(path) as local,
        coframe.open_bag(server.url("/run.bag")) as bag,
    ):
        assert server.sent < 0.2 * path.stat().st_size
        assert {name: topic.messages for name, topic in bag.topics.items()} == {
            name: topic.messages for name, topic in local.topics.items()
        }
        assert_same(bag.buffer)
        assert (bag.received_start, bag.received_end) == (local.received_start, local.received_end)
        assert not bag.problems


def messages_ros1_with_noise():
    from recordings import ros1

    yield from messages(ros1)
    noise = np.random.default_rng(1).integers(0, 256, 100_000, dtype=np.uint8).tobytes()
    for number in range(20):
        yield "/noise", START + number * SECOND // 10, len(noise).to_bytes(4, "little") + noise


@pytest.mark.parametrize("version", [1, 4])
def test_a_database_is_copied(tmp_path, version):
    path = write_sqlite(tmp_path / "run" / "run.db3", version)
    done = []
    with FileServer({"/run.db3": path.read_bytes()}) as server:
        with coframe.open_bag(server.url("/run.db3"), progress=lambda *amounts: done.append(amounts)) as bag:
            assert_same(bag.buffer)
        assert (path.stat().st_size,) * 2 in done


def test_a_compressed_file_is_copied(tmp_path):
    import zstandard

    data = zstandard.compress(write_mcap(tmp_path / "run.mcap").read_bytes())
    with FileServer({"/run.mcap.zstd": data}) as server, coframe.open_bag(server.url("/run.mcap.zstd")) as bag:
        assert_same(bag.buffer)


@pytest.mark.parametrize("end", ["/run/", "/run/metadata.yaml"])
def test_a_folder_is_read_through_its_metadata(tmp_path, end):
    folder = write_rosbag2(tmp_path / "run", StoragePlugin.MCAP)
    files = {f"/run/{file.name}": file.read_bytes() for file in folder.iterdir()}
    with FileServer(files) as server, coframe.open_bag(server.url(end)) as bag:
        assert_same(bag.buffer)
        assert [path.name for path, _ in bag.files] == ["run.mcap"]


def test_a_folder_without_metadata():
    with FileServer() as server:
        assert "there is no metadata.yaml" in failure(server.url("/run/"))


def test_a_recording_without_an_index_is_read_completely(tmp_path):
    data = write_mcap(tmp_path / "run.mcap", finish=False).read_bytes()
    with FileServer({"/run.mcap": data}) as server, coframe.open_bag(server.url()) as bag:
        assert bag.buffer.can_transform("odom", "base")
        assert "truncated" in bag.problems[0]


@pytest.mark.parametrize("where", [0.2, 0.5, 0.9, 0.999])
def test_truncated_files_are_read_like_local_ones(tmp_path, run, where):
    path = tmp_path / "cut.mcap"
    path.write_bytes(run[: int(len(run) * where)])
    with (
        FileServer({"/run.mcap": path.read_bytes()}) as server,
        coframe.open_bag(path) as local,
        coframe.open_bag(server.url()) as bag,
    ):
        assert bag.problems == [text.replace("cut.mcap", "run.mcap") for text in local.problems]
        assert bag.buffer.edges() == local.buffer.edges()


def test_bytes_and_file_objects(tmp_path, run):
    path = tmp_path / "run.mcap"
    path.write_bytes(run)
    for given in (run, bytearray(run), memoryview(run), io.BytesIO(run), Unseekable(run)):
        with coframe.open_bag(given) as bag:
            assert_same(bag.buffer)
    with path.open("rb") as file:
        file.seek(100)
        with coframe.open_bag(file) as bag:
            assert_same(bag.buffer)
            assert str(bag.path) == str(path)
        assert not file.closed


def test_a_file_object_of_a_database(tmp_path):
    path = write_sqlite(tmp_path / "run" / "run.db3", 4)
    with path.open("rb") as file, coframe.open_bag(file) as bag:
        assert_same(bag.buffer)


def test_a_file_object_for_text(tmp_path):
    path = tmp_path / "run.mcap"
    path.write_text("text")
    with path.open() as file, pytest.raises(TypeError, match="mode 'rb'"):
        coframe.open_bag(file)
    with pytest.raises(TypeError, match="expected a path, a URL, bytes or a file object, not int"):
        coframe.open_bag(3)


def test_a_file_object_that_fails(run):
    class Failing(io.BytesIO):
        def fileno(self):
            raise OSError("none")

        def read(self, size=-1):
            if size > 1:
                raise RuntimeError("the tape is torn")
            return super().read(size)

    assert "the tape is torn" in failure(Failing(run))


class Unseekable(io.RawIOBase):
    def __init__(self, data):
        self._stream = io.BytesIO(data)

    def readable(self):
        return True

    def readinto(self, target):
        return self._stream.readinto(target)


def test_a_recording_is_pickled_by_its_url(run):
    with FileServer({"/run.mcap": run}) as server:
        with coframe.open_bag(server.url(), start="0s", prefix="r/") as bag:
            again = pickle.loads(pickle.dumps(bag))
        with again:
            assert again.buffer.can_transform("r/odom", "r/lidar")
        data = pickle.dumps(again)
        server.files.clear()
        with pytest.raises(coframe.RecordingError, match="no such file on the server"):
            pickle.loads(data)


def test_a_recording_is_pickled_by_its_path(tmp_path, run, monkeypatch):
    (tmp_path / "run.mcap").write_bytes(run)
    monkeypatch.chdir(tmp_path)
    data = pickle.dumps(coframe.open_bag("run.mcap"))
    monkeypatch.chdir("/")
    with pickle.loads(data) as bag:
        assert_same(bag.buffer)
    (tmp_path / "run.mcap").unlink()
    with pytest.raises(coframe.RecordingError, match=r"run.mcap cannot be read: No such file"):
        pickle.loads(data)


def test_bytes_are_pickled_and_file_objects_are_not(run):
    with pickle.loads(pickle.dumps(coframe.open_bag(run))) as bag:
        assert_same(bag.buffer)
    with pytest.raises(coframe.CoframeError, match="cannot be opened by another process"):
        pickle.dumps(coframe.open_bag(io.BytesIO(run)))


@pytest.mark.parametrize("name", ["run.mcap", "run.bag", "run.db3"])
def test_a_window_of_any_format(tmp_path, name):
    write = {"run.mcap": write_mcap, "run.bag": write_rosbag1, "run.db3": lambda path: write_sqlite(path, 4)}[name]
    with coframe.open_bag(write(tmp_path / name), start="1s", stop=START + 2 * SECOND) as bag:
        assert bag.topics["/tf"].messages == 20
        assert bag.topics["/tf_static"].messages == 0
        assert_same(bag.buffer)  # 10 s before and after the window
        received = bag.received("/tf")
        assert received[0] >= START + SECOND
        assert received[-1] < START + 2 * SECOND


@pytest.mark.parametrize(("start", "stop"), [("2s", "1s"), ("soon", None), (5, 5)])
def test_invalid_windows(run, start, stop):
    with pytest.raises(ValueError, match=r"stop must be after start|not a point in time"):
        coframe.open_bag(run, start=start, stop=stop)


# How servers answer


def test_a_server_without_ranges(run):
    with FileServer({"/run.mcap": run}) as server:
        server.ranged = False
        with coframe.open_bag(server.url()) as bag:
            assert_same(bag.buffer)
            assert len(list(bag.messages("/tf"))) == COUNT


def test_a_packed_response(run):
    with FileServer(behavior=packed(run)) as server, coframe.open_bag(server.url()) as bag:
        assert_same(bag.buffer)


def test_an_unknown_packing(run):
    def answer(handler):
        handler.reply(200, run, {"Content-Encoding": "br"})
        return True

    with FileServer(behavior=answer) as server:
        assert "compressed with 'br'" in failure(server.url())


def test_chunked_transfer(run):
    def answer(handler):
        handler.send_response(200)
        handler.send_header("Transfer-Encoding", "chunked")
        handler.end_headers()
        for start in range(0, len(run), 1000):
            part = run[start : start + 1000]
            handler.send(b"%x\r\n%s\r\n" % (len(part), part))
        handler.send(b"0\r\n\r\n")
        return True

    with FileServer(behavior=answer) as server, coframe.open_bag(server.url()) as bag:
        assert_same(bag.buffer)


def test_redirects(run):
    def redirect(handler):
        number = int(handler.path.strip("/") or 99) if handler.path.strip("/").isdigit() else 0
        if number:
            handler.reply(302, b"", {"Location": f"/{number - 1}" if number > 1 else "/run.mcap"})
        return bool(number)

    with FileServer({"/run.mcap": run}, redirect) as server:
        with coframe.open_bag(server.url("/5")) as bag:
            assert_same(bag.buffer)
        assert "more than 10 times" in failure(server.url("/50"))


def test_a_password_is_not_sent_to_another_server(run):
    with FileServer({"/run.mcap": run}) as other:

        def redirect(handler):
            handler.reply(307, b"", {"Location": other.url()})
            return True

        with FileServer(behavior=redirect) as server:
            with coframe.open_bag(server.url(user="me:secret@")) as bag:
                assert_same(bag.buffer)
            assert server.headers["Authorization"] == "Basic bWU6c2VjcmV0"
            assert "Authorization" not in other.headers


@pytest.mark.usefixtures("impatient")
@pytest.mark.parametrize(
    ("status", "sentence"),
    [
        (401, "requires a user name"),
        (403, "refuses access"),
        (404, "no such file on the server"),
        (410, "no longer exists"),
        (204, "status 204"),
        (418, "status 418"),
        (500, "status 500"),
        (503, "status 503"),
        (429, "too many requests"),
    ],
)
def test_statuses(status, sentence):
    def answer(handler):
        handler.reply(status, b"")
        return True

    with FileServer(behavior=answer) as server:
        text = failure(server.url("/a/run.mcap?X-Signature=secret", user="me:secret@"))
    assert sentence in text
    assert "secret" not in text


@pytest.mark.usefixtures("impatient")
def test_temporary_failures_are_repeated(run):
    fails = iter([True, True])

    def answer(handler):
        if next(fails, False):
            handler.reply(503, b"")
            return True
        return False

    with FileServer({"/run.mcap": run}, answer) as server, coframe.open_bag(server.url()) as bag:
        assert_same(bag.buffer)


@pytest.mark.usefixtures("impatient")
def test_closed_connections_are_opened_again(run):
    count = iter(range(1000))

    def answer(handler):
        if next(count) % 2:
            handler.close_connection = True
            handler.connection.shutdown(socket.SHUT_RDWR)
            return True
        return False

    with FileServer({"/run.mcap": run}, answer) as server, coframe.open_bag(server.url()) as bag:
        assert_same(bag.buffer)


@pytest.mark.usefixtures("impatient")
def test_a_body_that_ends_early(run):
    def answer(handler):
        handler.send_response(206)
        handler.send_header("Content-Range", f"bytes 0-{len(run) - 1}/{len(run)}")
        handler.send_header("Content-Length", str(len(run)))
        handler.end_headers()
        handler.send(run[:100])
        handler.close_connection = True
        return True

    with FileServer(behavior=answer) as server:
        assert "closed the connection" in failure(server.url())


def test_a_changed_file(tmp_path):
    path = large(tmp_path / "run.mcap", minutes=1)
    with FileServer({"/run.mcap": path.read_bytes()}) as server, coframe.open_bag(server.url()) as bag:
        server.etag = '"2"'
        with pytest.raises(coframe.RecordingError, match="has changed on the server since it was opened"):
            bag.buffer  # noqa: B018
        with pytest.raises(coframe.RecordingError, match="has changed on the server"):
            list(bag.messages("/noise"))


def test_a_file_that_is_gone(tmp_path):
    path = large(tmp_path / "run.mcap", minutes=1)
    with FileServer({"/run.mcap": path.read_bytes()}) as server, coframe.open_bag(server.url()) as bag:
        server.files.clear()
        with pytest.raises(coframe.RecordingError, match="no such file on the server"):
            list(bag.messages("/noise"))


@pytest.mark.usefixtures("impatient")
@pytest.mark.parametrize(
    "stated",
    [
        "bytes 0-99/0",
        "bytes 5-65535/100000",
        "bytes 0-65535/99999999999999999999",
        "bytes 0-65535/9223372036854775807",
        "bytes 65535-0/100000",
        "bytes -1-5/10",
        "items 0-10/20",
        "",
        "bytes 0-10/10",
    ],
)
def test_wrong_ranges(run, stated):
    def answer(handler):
        handler.reply(206, run[:65536], {"Content-Range": stated})
        return True

    with FileServer(behavior=answer) as server:
        failure(server.url())


@pytest.mark.usefixtures("impatient")
@pytest.mark.parametrize("total", [100, 10**7, 10**15])
def test_a_wrong_size(run, total):
    def answer(handler):
        asked = handler.headers.get("Range") or "bytes=0-0"
        start, end = map(int, asked.removeprefix("bytes=").split("-"))
        part = run[start : end + 1]
        if not part:
            handler.reply(416, b"", {"Content-Range": f"bytes */{len(run)}"})
        else:
            range_ = f"bytes {start}-{start + len(part) - 1}/{max(total, start + len(part))}"
            handler.reply(206, part, {"Content-Range": range_})
        return True

    with FileServer(behavior=answer) as server, contextlib.suppress(coframe.RecordingError):
        coframe.open_bag(server.url()).close()
    if total > 100:
        with FileServer(behavior=answer) as server:
            failure(server.url())


def test_a_server_that_divides_ranges(run):
    def answer(handler):
        start, end = map(int, handler.headers["Range"].removeprefix("bytes=").split("-"))
        part = run[start : min(end, start + 499) + 1]
        handler.reply(206, part, {"Content-Range": f"bytes {start}-{start + len(part) - 1}/{len(run)}"})
        return True

    with FileServer(behavior=answer) as server, coframe.open_bag(server.url()) as bag:
        assert_same(bag.buffer)


def test_an_unknown_size(run):
    def answer(handler):
        if "Range" in handler.headers:
            handler.reply(206, run[:10], {"Content-Range": "bytes 0-9/*"})
            return True
        return False

    with FileServer({"/run.mcap": run}, answer) as server, coframe.open_bag(server.url()) as bag:
        assert_same(bag.buffer)


def test_an_empty_file():
    with FileServer({"/run.mcap": b""}) as server:
        assert "the file is empty (0 bytes)" in failure(server.url())
    assert "the file is empty (0 bytes)" in failure(b"")


def test_a_web_page():
    with FileServer({"/run.mcap": b"<!DOCTYPE html><html>please log in</html>"}) as server:
        assert "web page" in failure(server.url())


@pytest.mark.usefixtures("impatient")
def test_a_silent_server():
    with FileServer(behavior=lambda _handler: time.sleep(5) or True) as server:
        before = time.monotonic()
        assert "does not answer" in failure(server.url())
        assert time.monotonic() - before < 4


@pytest.mark.usefixtures("impatient")
@pytest.mark.parametrize("pause", [0.05, 0.3], ids=["a byte is late", "no byte is late"])
def test_a_slow_server(run, monkeypatch, pause):
    monkeypatch.setattr(_http, "MIN_SPEED", 1_000_000)
    with FileServer(behavior=dripping(run, pause)) as server:
        before = time.monotonic()
        assert "fewer than" in failure(server.url())
        assert time.monotonic() - before < 4


@pytest.mark.usefixtures("impatient")
def test_a_file_of_unknown_size_that_does_not_begin():
    def answer(handler):
        handler.send_response(200)
        handler.end_headers()
        handler.wfile.flush()
        time.sleep(2)
        handler.close_connection = True
        return True

    with FileServer(behavior=answer) as server:
        assert "fewer than" in failure(server.url())


@pytest.mark.usefixtures("impatient")
def test_slow_headers():
    def answer(handler):
        with contextlib.suppress(OSError):
            for byte in b"HTTP/1.1 200 OK\r\n" + b"X: " + 1000 * b"y":
                handler.wfile.write(bytes([byte]))
                handler.wfile.flush()
                time.sleep(0.05)
        return True

    with FileServer(behavior=answer) as server:
        before = time.monotonic()
        failure(server.url())
        assert time.monotonic() - before < 4


@pytest.mark.usefixtures("impatient")
@pytest.mark.parametrize(
    "garbage", [b"", b"SSH-2.0-OpenSSH_9.2\r\n", b"\0" * 100, b"HTTP/1.1 abc\r\n\r\n", b"HTTP/9.9 200\r\n\r\n"]
)
def test_other_protocols(garbage):
    with socket.create_server(("127.0.0.1", 0)) as listener:

        def serve():
            with contextlib.suppress(OSError):
                while True:
                    connection, _ = listener.accept()
                    with connection:
                        connection.recv(10_000)
                        connection.sendall(garbage)

        thread = threading.Thread(target=serve, daemon=True)
        thread.start()
        failure(f"http://127.0.0.1:{listener.getsockname()[1]}/run.mcap")
        listener.close()


@pytest.mark.usefixtures("impatient")
def test_a_port_without_a_server():
    with socket.create_server(("127.0.0.1", 0)) as listener:
        port = listener.getsockname()[1]
    assert "refused" in failure(f"http://127.0.0.1:{port}/run.mcap").lower()


def test_the_limit_of_a_download(run, monkeypatch):
    from coframe._sources import sources

    monkeypatch.setattr(sources, "MAX_DOWNLOAD", 1000)
    with FileServer({"/run.mcap": run}) as server:
        server.ranged = False
        assert "larger than the maximum" in failure(server.url())


ODD_URLS = [
    "http://", "http:///", "http:///run.mcap", "http://:80/", "http://127.0.0.1:99999/x", "http://127.0.0.1:abc/x",
    "http://127.0.0.1:-1/x", "http://[::1/x", "http://[zz]/x", "http://a b/x", "http://\x00/x", "http://x\r\nY: z/x",
    "http://" + "a" * 300 + "/x", "http://a..b/x", "http://.../x", "http://" + "a" * 9000, "http://h/\r\nX: y",
    "http://127.0.0.1:1/\N{SNOWMAN}", "http://127.0.0.1:1/%", "http://127.0.0.1:1/%zz", "HTTP://127.0.0.1:1/x",
    "http://user@127.0.0.1:1/x", "http://user:@127.0.0.1:1/x", "http://:p@127.0.0.1:1/x", "http://u:p@h@127.0.0.1:1/x",
    "https://127.0.0.1:1/x", "http://127.0.0.1:1", "http://127.0.0.1:1?x", "http://127.0.0.1:1#x", "http://#", "http://?",
    "ftp://host/x", "ssh://host/x", "ros2://x", "javascript://x", "data://x", "zip://x::http://y", "memory://x", "x://",
    "s3+http://x", "github://a/b", "hdfs://x", "dav://x", "file:///nowhere/run.mcap", "file://", "file:///", "gopher://x",
    " http://127.0.0.1:1/x ", "http://127.0.0.1:1/\ud800", "http://\ud800/x", "http://127.0.0.1:1/x y z", "http://xn--/x",
    "http://127.0.0.1:1/../../etc/passwd", "http://127.0.0.1:1//", "http://127.0.0.1:1/a/", "http://127.0.0.1:0/",
]  # fmt: skip


@pytest.mark.usefixtures("impatient")
@pytest.mark.parametrize("url", ODD_URLS, ids=range(len(ODD_URLS)))
def test_odd_urls(url):
    assert failure(url).isprintable()


@pytest.mark.usefixtures("impatient")
def test_credentials_are_never_shown():
    for url in ("http://me:secret@127.0.0.1:1/run.mcap?token=secret#secret", "ftp://me:secret@host/x?secret"):
        with pytest.raises(coframe.RecordingError) as error:
            coframe.open_bag(url)
        assert "secret" not in f"{error.value} {error.value.hint} {error.value!r}"


def test_credentials_are_not_in_the_recording(run):
    with (
        FileServer({"/run.mcap": run}) as server,
        coframe.open_bag(server.url("/run.mcap?token=secret", user="me:secret@")) as bag,
    ):
        assert "secret" not in f"{bag!r} {bag.path} {bag.path!r} {bag._repr_html_()} {bag.files}"


def test_a_proxy_of_the_environment(run, monkeypatch):
    with FileServer({"http://robots.example/run.mcap": run}) as proxy:
        monkeypatch.setenv("http_proxy", f"http://me:secret@127.0.0.1:{proxy.port}")
        monkeypatch.setenv("no_proxy", "")
        with coframe.open_bag("http://robots.example/run.mcap") as bag:
            assert_same(bag.buffer)
        assert proxy.headers["Host"] == "robots.example"
        assert proxy.headers["Proxy-Authorization"].startswith("Basic ")
