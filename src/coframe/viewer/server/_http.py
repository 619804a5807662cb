# SPDX-License-Identifier: Apache-2.0
"""HTTP responses: the page and its files, with access checks."""

from __future__ import annotations

import contextlib
import gzip
import hashlib
import hmac
import ipaddress
import secrets
import socket
from http import HTTPStatus
from http.cookies import CookieError, SimpleCookie
from typing import TYPE_CHECKING

from websockets.datastructures import Headers
from websockets.http11 import Response

from coframe.viewer._page_files import find

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping
    from pathlib import Path

__all__ = ["AccessPolicy", "file_response", "page_file", "response", "text_response"]

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
_CONTENT_SECURITY_POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; "
    "font-src 'self' data:; connect-src 'self' blob: data: {sockets}; worker-src 'self' blob:; manifest-src 'self'; "
    "base-uri 'none'; form-action 'none'; frame-ancestors 'self' http://localhost:* http://127.0.0.1:*"
)
_TOKEN_BYTES = 24
_LOOPBACK = ("127.0.0.1", "localhost", "[::1]")


class AccessPolicy:
    """Decides which requests are answered; otherwise pages of other sites could reach the server through the browser.

    Args:
        host: The address on which the server listens.
        port: The TCP port on which the server listens.

    Attributes:
        content_security: The Content-Security-Policy of all responses.
        token: The token that requests from other machines must contain, or "" if only this machine can connect.
    """

    def __init__(self, host: str, port: int) -> None:
        self.token = "" if _is_loopback(host) else secrets.token_urlsafe(_TOKEN_BYTES)
        names = {*_LOOPBACK, f"[{host}]" if ":" in host else host}
        self._all_addresses = host in {"0.0.0.0", "::"}  # noqa: S104 - the user's own choice
        if self._all_addresses:
            names.add(socket.gethostname())
        self._port = port
        self._hosts = {f"{name.lower()}:{port}" for name in names} | ({*names} if port == 80 else set())
        # Chromium does not accept addresses in brackets here, and does not need them.
        sockets = [f"ws://{host}" for host in sorted(self._hosts) if "[" not in host]
        self.content_security = _CONTENT_SECURITY_POLICY.format(sockets=" ".join(sockets))

    def allows_host(self, host: str | None) -> bool:
        """Return whether a Host header names this server. Other names that resolve to it are rejected."""
        if host is None:
            return False
        return host.lower() in self._hosts or (self._all_addresses and self._is_address(host))

    def allows_origin(self, origin: str | None) -> bool:
        """Return whether an Origin header names this server's page; programs other than browsers send none."""
        return origin is None or (origin.startswith("http://") and self.allows_host(origin.removeprefix("http://")))

    def is_token(self, given: str) -> bool:
        """Return whether a string is the token, in constant time."""
        return hmac.compare_digest(given.encode(errors="replace"), self.token.encode())

    def has_cookie(self, cookies: Iterable[str]) -> bool:
        """Return whether Cookie headers contain the token."""
        for header in cookies:
            with contextlib.suppress(CookieError):
                cookie = SimpleCookie(header).get(self._cookie)
                if cookie is not None and self.is_token(cookie.value):
                    return True
        return False

    def redirection(self, path: str) -> Response:
        """Return the response to a page request with the token: the address without it, and the token as a cookie.

        Scripts cannot read the cookie. Pages of other sites can only follow links with it (Lax); they cannot connect.
        """
        cookie = f"{self._cookie}={self.token}; Path=/; HttpOnly; SameSite=Lax"
        return response(
            HTTPStatus.SEE_OTHER, b"", "text/plain", self.content_security, {"Location": path, "Set-Cookie": cookie}
        )

    @property
    def _cookie(self) -> str:
        return f"coframe_{self._port}"  # Browsers send the cookies of one port to all ports of a machine.

    def _is_address(self, host: str) -> bool:
        address, _, port = host.rpartition(":")
        try:
            ipaddress.ip_address(address.strip("[]"))
        except ValueError:
            return False
        return port == str(self._port)


def _is_loopback(host: str) -> bool:
    if host == "localhost":
        return True
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return False


def response(
    status: HTTPStatus, body: bytes, content_type: str, policy: str, extra: Mapping[str, str] | None = None
) -> Response:
    """Return a response with security headers.

    Args:
        status: The HTTP status of the response.
        body: The content of the response.
        content_type: The media type of the content, such as ``text/html``.
        policy: The Content-Security-Policy.
        extra: Additional headers.
    """
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


def text_response(status: HTTPStatus, text: str, policy: str) -> Response:
    """Return a response with a line of text."""
    return response(status, f"{text}\n".encode(), "text/plain; charset=utf-8", policy)


def page_file(path: str, folder: Path) -> Path | None:
    """Return the file of the page for a URL path, or its compressed form; None if there is no such file."""
    root = folder.resolve()
    try:
        file = (root / path.lstrip("/")).resolve()
        return find(file) if root in file.parents else None
    except (OSError, ValueError):  # A NUL, or a name that is too long.
        return None


def file_response(file: Path, policy: str, known_tag: str | None, encodings: str = "") -> Response:
    """Return a file of the page, or "not modified" if the browser has the file with this ETag.

    Args:
        file: The file; one whose name ends with .gz is compressed.
        policy: The Content-Security-Policy.
        known_tag: The If-None-Match header.
        encodings: The Accept-Encoding header.
    """
    body, headers = file.read_bytes(), {}
    name = file
    if file.suffix == ".gz":
        name, headers["Vary"] = file.with_suffix(""), "Accept-Encoding"
        if "gzip" in {encoding.strip() for encoding in encodings.split(",")}:
            headers["Content-Encoding"] = "gzip"
        else:
            body = gzip.decompress(body)
    kind = _TYPES.get(name.suffix.lower(), "application/octet-stream")
    headers["ETag"] = f'"{hashlib.sha256(body).hexdigest()[:32]}"'
    if headers["ETag"] == known_tag:
        return response(HTTPStatus.NOT_MODIFIED, b"", kind, policy, headers)
    return response(HTTPStatus.OK, body, kind, policy, headers)
