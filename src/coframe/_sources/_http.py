# SPDX-License-Identifier: Apache-2.0
"""A file on a web server, read by requests for ranges.

Python's standard library is enough for this, so that http and https need no extra; fsspec's implementation needs
aiohttp and believes the lengths that servers state.
"""

from __future__ import annotations

import base64
import errno
import http.client
import os
import re
import socket
import ssl
import threading
import time
import urllib.request
import zlib
from contextlib import suppress
from functools import partial
from typing import TYPE_CHECKING, Any, Final, NamedTuple, NoReturn
from urllib.parse import SplitResult, quote, unquote, urljoin, urlsplit

from coframe._base_error import CoframeError
from coframe._sources.block_cache import BLOCK_SIZE
from coframe._sources.remote_error import RemoteFileError
from coframe._sources.urls import HTTP, remove_credentials

if TYPE_CHECKING:
    from collections.abc import Callable

    from typing_extensions import Self

__all__ = ["HttpRanges"]

MAX_WAIT: Final = 30.0  # seconds without any byte from the server
MIN_SPEED: Final = 20_000  # bytes per second; a slower response is given up
MAX_REDIRECTS: Final = 10
MAX_TRIES: Final = 3
MAX_URL: Final = 8000  # characters
_READ_BYTES: Final = 256 << 10
_RETRY_DELAYS: Final = (0.2, 1.0)  # seconds before the second and third try
_CONTENT_RANGE: Final = re.compile(r"bytes (\d{1,19})-(\d{1,19})/(\d{1,19})", re.ASCII)
_UNSATISFIED_RANGE: Final = re.compile(r"bytes \*/(\d{1,19})", re.ASCII)
_MAX_SIZE: Final = 1 << 62
_UNQUOTED_CHARACTERS: Final = "%/:=&?~#+!$,;'@()*[]|"  # characters of a URL that stay as they are
_NETWORK_ERRORS: Final = (OSError, http.client.HTTPException, ValueError)
_RETRY_STATUSES: Final = {408, 425, 429, 500, 502, 503, 504}
_STATUS_REASONS: Final = {
    401: ("the server requires a user name and a password", "Write https://USER:PASSWORD@HOST/..."),
    403: ("the server refuses access", "Check your permission; a signed URL may have expired."),
    404: ("there is no such file on the server", "Check the URL."),
    410: ("the file no longer exists on the server", "Check the URL."),
    407: ("the proxy requires a user name and a password", "Set them in the environment variable https_proxy."),
    429: ("the server receives too many requests", "Try again later."),
}


class _RangeResponse(NamedTuple):
    """A response whose body has not been read."""

    response: http.client.HTTPResponse
    status: int
    start: int  # of the range in the body
    end: int
    total: int | None  # bytes of the file; None if the server does not state it
    encoding: str  # of the body; "" for the plain bytes
    version: tuple[str, ...]  # the headers that change with the file


class _InterruptedError(CoframeError):
    """A response that ended too early or is invalid; the request may be repeated."""


class HttpRanges:
    """A file on a web server; see :class:`coframe._sources.block_cache.ByteRanges`. Not thread-safe.

    Args:
        url: Its address; credentials in it are sent to this server only.

    Attributes:
        name: The address without credentials.
        size: Bytes of the file, or 0 if `is_ranged` is False.
        is_ranged: Whether the server sends ranges; otherwise, only `download` reads the file.
        beginning: The first bytes of the file, if ranges are sent.
        version: The headers that change with the file: ETag and Last-Modified.
    """

    def __init__(self, url: str) -> None:
        self.name = remove_credentials(url)
        self._connection: http.client.HTTPConnection | None = None
        self._response: http.client.HTTPResponse | None = None  # keeps the socket open
        self._socket: socket.socket | None = None
        self._process = os.getpid()
        self._origin = self._parse(url)
        self._url = self._origin
        self.version: tuple[str, ...] = ("", "")
        self.size = 0
        self.is_ranged = True
        self.beginning = b""
        self._open()

    def _open(self) -> None:
        answer, data = self._try_request(self._start_response)
        self.is_ranged = answer.status == 206 and not answer.encoding and answer.total is not None
        if answer.status == 416:
            self.is_ranged = True
        elif self.is_ranged:
            self.size, self.beginning = answer.total or 0, data
        self.version = answer.version

    def _start_response(self) -> tuple[_RangeResponse, bytes]:
        answer = self._request(0, BLOCK_SIZE)
        if answer.status != 206 or answer.encoding or answer.total is None:
            self.close()
            return answer, b""
        if answer.start:
            raise _InterruptedError(f"the server sent the bytes from {answer.start} on instead of from the beginning")
        return answer, self._body(answer, BLOCK_SIZE)

    def read_range(self, start: int, end: int) -> bytes:
        """Return the bytes from ``start`` to ``end``; servers may divide a range."""
        if start == 0 and 0 < end <= len(self.beginning):
            return self.beginning[:end]
        parts: list[bytes] = []
        while start < end:
            data: bytes = self._try_request(partial(self._read_part, start, end))
            parts.append(data)
            start += len(data)
        return parts[0] if len(parts) == 1 else b"".join(parts)

    def _read_part(self, start: int, end: int) -> bytes:
        answer = self._request(start, end)
        if answer.status != 206 or answer.encoding:
            self._fail("the server no longer sends ranges, which it did before")
        if answer.version != self.version or answer.total != self.size:
            self._fail("it has changed on the server since it was opened", "Open it again.", errno.ESTALE)
        if answer.start != start or not start < answer.end <= max(end, start + 1):
            raise _InterruptedError(f"the server sent bytes {answer.start} to {answer.end} instead of {start} to {end}")
        return self._body(answer, answer.end - start)

    def download(
        self, write: Callable[[bytes], object], max_bytes: int, progress: Callable[[int, int], object]
    ) -> None:
        """Read the complete file, possibly compressed with gzip, from a server that does not support ranges.

        Args:
            write: Receives the bytes.
            max_bytes: The maximum number of bytes.
            progress: Called with the number of bytes so far, and the total or 0.

        Raises:
            RemoteFileError: The file cannot be read completely, or is too large.
        """
        answer = self._try_request(partial(self._request, None, None))
        if answer.status != 200:
            self._fail(f"the server answered with the status {answer.status}")
        limit = f"it is larger than the maximum of {max_bytes >> 30} GiB for a server that does not send ranges"
        if answer.total is not None and answer.total > max_bytes:
            self._fail(limit, "Download it with another program, and open the file.", errno.EFBIG)
        unpack = _unpacker(answer.encoding)
        if unpack is None:
            self._fail(
                f"the server sends it compressed with {answer.encoding[:30]!r}", "Download it, and open the file."
            )
        received = written = 0
        try:
            for piece in self._read_pieces(answer, answer.total):
                received += len(piece)
                for data in unpack(piece):
                    written += len(data)
                    if written > max_bytes:
                        self._fail(limit, "Download it with another program, and open the file.", errno.EFBIG)
                    write(data)
                progress(received, answer.total or 0)
        except (_InterruptedError, zlib.error) as error:
            self._fail(f"the download failed: {error}", "Try again.")
        except RemoteFileError:
            raise
        except _NETWORK_ERRORS as error:
            self._fail(f"the download failed after {received} bytes: {_reason(error)}", "Try again.")
        finally:
            self.close()

    def close(self) -> None:
        """Close the connection; a read opens it again."""
        opened = self._response, self._connection
        self._response = self._connection = None
        for each in opened if self._process == os.getpid() else ():
            if each is not None:
                each.close()

    def _try_request(self, function: Callable[[], Any]) -> Any:
        """Call a function; repeat it after errors that may be temporary."""
        for attempt in range(MAX_TRIES):
            try:
                return function()
            except RemoteFileError as error:
                self.close()
                is_redirected = self._url is not self._origin and attempt == 0  # to an address that may have expired
                if not (is_redirected or error.errno == errno.EAGAIN) or attempt == MAX_TRIES - 1:
                    raise
            except (_InterruptedError, *_NETWORK_ERRORS) as error:
                self.close()
                is_final = attempt == MAX_TRIES - 1 or isinstance(error, ssl.SSLError | socket.gaierror | TimeoutError)
                if is_final or isinstance(error, UnicodeError | http.client.InvalidURL):
                    self._fail(_reason(error), _hint(error))
            self._url = self._origin  # a redirection may be the problem
            time.sleep(_RETRY_DELAYS[attempt])
        raise AssertionError  # not reached

    def _request(self, start: int | None, end: int | None) -> _RangeResponse:
        """Send a request, and follow redirects. If ``start`` is None, request the complete file."""
        for _ in range(MAX_REDIRECTS + 1):
            headers = {"Accept-Encoding": "identity", "User-Agent": "coframe", "Accept": "*/*"}
            if start is not None and end is not None:
                headers["Range"] = f"bytes={start}-{end - 1}"
            response = self._send(headers)
            status = response.status
            if status not in {301, 302, 303, 307, 308}:
                return self._check_response(response)
            self._redirect(response.getheader("Location") or "")
        return self._fail(f"the server redirects more than {MAX_REDIRECTS} times")

    def _redirect(self, location: str) -> None:
        self.close()
        if not location:
            self._fail("the server redirects without an address")
        target = self._parse(urljoin(self._url.geturl(), location))
        if self._url.scheme == "https" and target.scheme != "https":
            self._fail("the server redirects from https to http, which is not encrypted")
        if (target.hostname, target.port, target.scheme) == (self._url.hostname, self._url.port, self._url.scheme):
            user, at, _ = self._url.netloc.rpartition("@")
            target = target._replace(netloc=f"{user}{at}{target.netloc.rpartition('@')[2]}")
        self._url = target

    def _check_response(self, response: http.client.HTTPResponse) -> _RangeResponse:
        status, encoding = response.status, (response.getheader("Content-Encoding") or "").strip().lower()
        version = (response.getheader("ETag") or "", response.getheader("Last-Modified") or "")
        encoding = "" if encoding == "identity" else encoding
        content_range = response.getheader("Content-Range") or ""
        if status == 206:
            match = _CONTENT_RANGE.fullmatch(content_range.strip())
            if match is None and "/*" not in content_range:
                raise _InterruptedError(f"the server answered with an invalid range, {content_range[:60]!r}")
            if match is None:
                return _RangeResponse(response, status, 0, 0, None, encoding, version)
            start, last, total = map(int, match.groups())
            if not start <= last < total <= _MAX_SIZE:
                raise _InterruptedError(f"the server answered with an invalid range, {content_range[:60]!r}")
            return _RangeResponse(response, status, start, last + 1, total, encoding, version)
        if status == 416 and (match := _UNSATISFIED_RANGE.fullmatch(content_range.strip())) and int(match[1]) == 0:
            self.close()
            return _RangeResponse(response, status, 0, 0, 0, "", version)
        if status == 200:
            length = response.getheader("Content-Length") or ""
            size = int(length) if length.isascii() and length.isdigit() and len(length) < 19 else None
            return _RangeResponse(response, status, 0, size or 0, size, encoding, version)
        self.close()
        reason, hint = _STATUS_REASONS.get(status, (f"the server answered with the status {status}", ""))
        number = errno.EAGAIN if status in _RETRY_STATUSES else errno.ENOENT if status in {404, 410} else errno.EACCES
        if status == 416:
            reason = "the server does not have the bytes that it should have by its own account"
        raise RemoteFileError.because(self.name, reason, hint, number)

    def _body(self, answer: _RangeResponse, limit: int) -> bytes:
        """Return the body of a response, at most ``limit`` bytes of it."""
        size = min(answer.end - answer.start, limit)
        data = b"".join(self._read_pieces(answer, size))
        if answer.end - answer.start > size or not answer.response.isclosed():
            self.close()  # The rest is not needed.
        return data

    def _read_pieces(self, answer: _RangeResponse, size: int | None) -> Any:
        """Yield the body in pieces: exactly ``size`` bytes, or all if it is None."""
        left = size
        with _Deadline(self._socket, size) as deadline:
            while left is None or left > 0:
                piece = answer.response.read1(_READ_BYTES if left is None else min(left, _READ_BYTES))
                if not piece and deadline.has_passed:
                    raise TimeoutError  # The deadline has ended the connection, not the server.
                if not piece:
                    break
                deadline.add(len(piece))
                left = None if left is None else left - len(piece)
                yield piece
        if left:
            raise _InterruptedError(f"the server closed the connection after {(size or 0) - left} of {size} bytes")
        if left == 0 and answer.response.length == 0:
            answer.response.read()  # lets the connection be used again

    def _send(self, headers: dict[str, str]) -> http.client.HTTPResponse:
        if self._process != os.getpid():  # A child process must not use the connection of its parent.
            self._response = self._connection = None
            self._process = os.getpid()
        url = self._url
        proxy = _find_proxy(url)
        if user := _authorization(url):
            headers["Authorization"] = user
        target = quote(f"{url.path or '/'}{'?' if url.query else ''}{url.query}", safe=_UNQUOTED_CHARACTERS)
        if proxy is not None and url.scheme == "http":
            target = f"http://{url.netloc.rpartition('@')[2]}{target}"
            if user := _authorization(proxy):
                headers["Proxy-Authorization"] = user
        if self._connection is None:
            self._connection = _connect(url, proxy)
        connection = self._connection
        if connection.sock is None:
            connection.connect()
        self._socket = connection.sock  # The connection forgets it if the server closes it after the response.
        with _Deadline(self._socket, 0):
            connection.request("GET", target, headers=headers)
            self._response = connection.getresponse()
            return self._response

    def _parse(self, url: str) -> SplitResult:
        """Return the parts of a URL."""
        url = url.strip()
        reason = ""
        try:
            parts = urlsplit(url)
            host, _ = parts.hostname, parts.port
            if host:
                host.encode("idna")
        except (ValueError, UnicodeError) as error:
            self._fail(f"the URL is not valid: {remove_credentials(str(error))}")
        if len(url) > MAX_URL:
            reason = f"the URL has more than {MAX_URL} characters"
        elif parts.scheme.lower() not in HTTP:
            reason = f"the server redirects to a URL with the scheme {parts.scheme[:20]!r}"
        elif not host:
            reason = "the URL has no host"
        elif any(ord(each) < 32 or ord(each) == 127 for each in url) or " " in parts.netloc:
            reason = "the URL contains control characters or spaces"
        if reason:
            self._fail(reason)
        return parts._replace(scheme=parts.scheme.lower(), fragment="")

    def _fail(self, reason: str, hint: str = "", number: int = errno.EIO) -> NoReturn:
        self.close()
        raise RemoteFileError.because(self.name, reason, hint, number) from None


class _Deadline:
    """Ends a connection whose server sends too slowly, even if it sends an occasional byte."""

    def __init__(self, sock: socket.socket | None, size: int | None) -> None:
        self.has_passed = False
        self._socket = sock
        self._start_response = time.monotonic()
        self._received_bytes = 0
        self._has_unknown_size = size is None
        self._timer = threading.Timer(MAX_WAIT + (size or 0) / MIN_SPEED, self._mark_passed)
        self._timer.daemon = True
        self._timer.start()

    def add(self, received: int) -> None:
        """Count bytes; more of them permit more time."""
        self._received_bytes += received
        if time.monotonic() - self._start_response > MAX_WAIT + self._received_bytes / MIN_SPEED:
            self.has_passed = True
            raise TimeoutError
        if self._has_unknown_size:
            self._timer.cancel()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, _kind: object, error: BaseException | None, _traceback: object) -> None:
        """End the measurement; a network error after the deadline is a TimeoutError."""
        self._timer.cancel()
        if self.has_passed and isinstance(error, _NETWORK_ERRORS):
            raise TimeoutError from error

    def _mark_passed(self) -> None:
        self.has_passed = True
        if self._socket is not None:
            with suppress(OSError):  # It has been closed in the meantime.
                socket.socket.shutdown(self._socket, socket.SHUT_RDWR)


def _connect(url: SplitResult, proxy: SplitResult | None) -> http.client.HTTPConnection:
    there = proxy or url
    host = (there.hostname or "").encode("idna").decode()
    if url.scheme == "http":
        return http.client.HTTPConnection(host, there.port or 80, timeout=MAX_WAIT)
    context = ssl.create_default_context()
    connection = http.client.HTTPSConnection(host, there.port or 443, timeout=MAX_WAIT, context=context)
    if proxy is not None:
        user = _authorization(proxy)
        headers = {"Proxy-Authorization": user} if user else {}
        connection.set_tunnel((url.hostname or "").encode("idna").decode(), url.port or 443, headers)
    return connection


def _find_proxy(url: SplitResult) -> SplitResult | None:
    """Return the proxy that the environment prescribes for a URL, or None if there is none."""
    host = url.netloc.rpartition("@")[2]
    found = urllib.request.getproxies().get(url.scheme)
    if not found or urllib.request.proxy_bypass(host):
        return None
    return urlsplit(found if "://" in found else f"http://{found}")


def _authorization(url: SplitResult) -> str:
    """Return the value of the header with the user name and password of a URL, or "" without them."""
    if url.username is None:
        return ""
    user = f"{unquote(url.username)}:{unquote(url.password or '')}"
    return f"Basic {base64.b64encode(user.encode()).decode()}"


def _unpacker(encoding: str) -> Callable[[bytes], Any] | None:
    """Return a function that yields the unpacked bytes of pieces, or None for an unknown encoding."""
    if not encoding:
        return lambda piece: (piece,)
    if encoding not in {"gzip", "x-gzip", "deflate"}:
        return None
    unpacking = zlib.decompressobj(wbits=47)

    def unpack(piece: bytes) -> Any:
        while piece:
            yield unpacking.decompress(piece, _READ_BYTES)
            piece = unpacking.unconsumed_tail

    return unpack


def _reason(error: Exception) -> str:
    """Return what is wrong with a connection, as the end of a sentence."""
    if isinstance(error, TimeoutError):
        return f"the server does not answer, or sends fewer than {MIN_SPEED // 1000} kB per second"
    if isinstance(error, ssl.SSLCertVerificationError):
        return f"the certificate of the server is not valid: {error.verify_message}"
    if isinstance(error, socket.gaierror):
        return "there is no server with this name"
    if isinstance(error, http.client.RemoteDisconnected | http.client.BadStatusLine):
        return "the server closed the connection, or does not speak HTTP"
    if isinstance(error, http.client.IncompleteRead):
        return "the server closed the connection too early"
    text = (error.strerror if isinstance(error, OSError) else None) or str(error) or type(error).__name__
    return remove_credentials(" ".join(text.split()))[:200]


def _hint(error: Exception) -> str:
    if isinstance(error, ConnectionRefusedError):
        return "Check the host and the port of the URL, and whether the server is running."
    if isinstance(error, socket.gaierror):
        return "Check the host of the URL and the network."
    return ""
