# SPDX-License-Identifier: Apache-2.0
"""A web server for files with ranges, which counts the bytes that it sends and can misbehave in many ways."""

import contextlib
import gzip
import http.server
import re
import threading
import time


class FileServer:
    """A server on the loopback interface; its files are bytes by name.

    Attributes:
        files: The content by path, such as ``/run.mcap``.
        behavior: Called with the handler before each answer; it may answer itself and then returns True.
        requests: The path and the range of each request.
        sent: The number of bytes of bodies.
        headers: The headers of the last request.
    """

    def __init__(self, files=None, behavior=None):
        self.files = dict(files or {})
        self.behavior = behavior or (lambda _handler: False)
        self.requests, self.sent, self.headers, self.etag = [], 0, {}, '"1"'
        self.ranged = True

    def url(self, path="/run.mcap", user=""):
        return f"http://{user}127.0.0.1:{self.port}{path}"

    def __enter__(self):
        self._server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), _handler(self))
        self._server.daemon_threads = True
        self.port = self._server.server_address[1]
        self._thread = threading.Thread(target=self._server.serve_forever, args=(0.02,), daemon=True)
        self._thread.start()
        return self

    def __exit__(self, *_):
        self._server.shutdown()
        self._server.server_close()
        self._thread.join()


def _handler(server):
    class Handler(http.server.BaseHTTPRequestHandler):
        protocol_version = "HTTP/1.1"

        def log_message(self, *_):
            pass

        def do_GET(self):
            path = self.path.partition("?")[0]
            server.requests.append((path, self.headers.get("Range")))
            server.headers = dict(self.headers)
            with contextlib.suppress(ConnectionError):
                if not server.behavior(self):
                    self.answer(server.files.get(path))

        def handle_one_request(self):
            with contextlib.suppress(ConnectionError):
                super().handle_one_request()

        def answer(self, data):
            if data is None:
                self.reply(404, b"not found")
                return
            asked = re.fullmatch(r"bytes=(\d+)-(\d+)", self.headers.get("Range") or "")
            if asked is None or not server.ranged:
                self.reply(200, data)
                return
            start, end = int(asked[1]), min(int(asked[2]) + 1, len(data))
            if start >= len(data):
                self.reply(416, b"", {"Content-Range": f"bytes */{len(data)}"})
                return
            self.reply(206, data[start:end], {"Content-Range": f"bytes {start}-{end - 1}/{len(data)}"})

        def reply(self, status, body, headers=None):
            self.send_response(status)
            for name, value in {"Content-Length": len(body), "ETag": server.etag, **(headers or {})}.items():
                if value is not None:
                    self.send_header(name, str(value))
            self.end_headers()
            self.send(body)

        def send(self, body):
            self.wfile.write(body)
            self.wfile.flush()
            server.sent += len(body)

    return Handler


def packed(data):
    """Return a behavior that sends data with gzip."""

    def answer(handler):
        handler.reply(200, gzip.compress(data), {"Content-Encoding": "gzip"})
        return True

    return answer


def dripping(data, pause=0.05):
    """Return a behavior that sends one byte at a time."""

    def answer(handler):
        handler.send_response(206)
        handler.send_header("Content-Length", str(len(data)))
        handler.send_header("Content-Range", f"bytes 0-{len(data) - 1}/{len(data)}")
        handler.end_headers()
        for byte in data:
            handler.send(bytes([byte]))
            time.sleep(pause)
        return True

    return answer
