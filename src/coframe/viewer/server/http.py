"""What the server answers to HTTP requests: the page and its files, and nothing to strangers."""

from __future__ import annotations

import hashlib
import ipaddress
import socket
from http import HTTPStatus
from pathlib import Path
from typing import TYPE_CHECKING

from websockets.datastructures import Headers
from websockets.http11 import Response

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = ["STATIC", "Visitors", "file_response", "page_file", "response", "sentence"]

STATIC = Path(__file__).resolve().parents[1] / "static"

_TYPES = {
    ".html": "text/html; charset=utf-8",
    ".js": "text/javascript; charset=utf-8",
    ".mjs": "text/javascript; charset=utf-8",
    ".css": "text/css; charset=utf-8",
    ".json": "application/json",
    ".svg": "image/svg+xml",
    ".png": "image/png",
    ".jpg": "image/jpeg",
    ".jpeg": "image/jpeg",
    ".ico": "image/x-icon",
    ".woff2": "font/woff2",
    ".wasm": "application/wasm",
}
_POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; "
    "font-src 'self' data:; connect-src 'self' blob: data: {sockets}; worker-src 'self' blob:; manifest-src 'self'; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'self' http://localhost:* http://127.0.0.1:*"
)
_LOOPBACK = ("127.0.0.1", "localhost", "[::1]")


class Visitors:
    """Who may come: pages of other sites could otherwise talk to the server through the user's browser.

    Args:
        host: The address that is listened on.
        port: The port.
    """

    def __init__(self, host: str, port: int) -> None:
        names = {*_LOOPBACK, f"[{host}]" if ":" in host else host}
        self._everywhere = host in {"0.0.0.0", "::"}  # noqa: S104 - the user's own choice
        if self._everywhere:
            names.add(socket.gethostname())
        self._port = port
        self._hosts = {f"{name.lower()}:{port}" for name in names} | ({*names} if port == 80 else set())
        # Chromium takes no address in brackets here, and needs none.
        sockets = [f"ws://{host}" for host in sorted(self._hosts) if "[" not in host]
        self.policy = _POLICY.format(sockets=" ".join(sockets))

    def host_is_ours(self, host: str | None) -> bool:
        """Whether a Host header names this server. A name that somebody else made to point here does not."""
        if host is None:
            return False
        return host.lower() in self._hosts or (self._everywhere and self._is_address(host))

    def origin_is_ours(self, origin: str | None) -> bool:
        """Whether an Origin header is that of our page; programs that are no browser send none."""
        return origin is None or (origin.startswith("http://") and self.host_is_ours(origin.removeprefix("http://")))

    def _is_address(self, host: str) -> bool:
        address, _, port = host.rpartition(":")
        try:
            ipaddress.ip_address(address.strip("[]"))
        except ValueError:
            return False
        return port == str(self._port)


def response(
    status: HTTPStatus, body: bytes, content_type: str, policy: str, extra: Mapping[str, str] | None = None
) -> Response:
    """An answer with the headers that keep the browser from doing more with it than is meant."""
    headers = Headers(
        {
            "Content-Type": content_type,
            "Content-Length": str(len(body)),
            "Content-Security-Policy": policy,
            "X-Content-Type-Options": "nosniff",
            "Referrer-Policy": "no-referrer",
            "Cross-Origin-Resource-Policy": "same-origin",
            "Cache-Control": "no-cache",
            "Connection": "close",
            **(extra or {}),
        }
    )
    return Response(status.value, status.phrase, headers, body)


def sentence(status: HTTPStatus, text: str, policy: str) -> Response:
    """An answer that says what is wrong."""
    return response(status, f"{text}\n".encode(), "text/plain; charset=utf-8", policy)


def page_file(path: str, folder: Path) -> Path | None:
    """The file of the page that a path names; None for what is not below the folder."""
    root = folder.resolve()
    try:
        file = (root / path.lstrip("/")).resolve()
        return file if file.is_relative_to(root) and file.is_file() else None
    except (OSError, ValueError):  # a NUL, or too long a name
        return None


def file_response(file: Path, policy: str, known: str | None) -> Response:
    """A file of the page, for a browser that knows the one with an ETag, or none."""
    kind = _TYPES.get(file.suffix.lower(), "application/octet-stream")
    body = file.read_bytes()
    tag = f'"{hashlib.sha256(body).hexdigest()[:32]}"'
    if tag == known:
        return response(HTTPStatus.NOT_MODIFIED, b"", kind, policy, {"ETag": tag})
    return response(HTTPStatus.OK, body, kind, policy, {"ETag": tag})
