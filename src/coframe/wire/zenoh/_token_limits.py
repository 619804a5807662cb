# SPDX-License-Identifier: Apache-2.0
"""Limits for the graph, which any process on the network can fill with tokens."""

from __future__ import annotations

import logging
from typing import Final

from coframe._output.escaping import display_name

MAX_TOKENS: Final = 100_000  # nodes, endpoints and their user data, of other processes
MAX_TOKEN_BYTES: Final = 64 << 20  # of tokens, which include the names

_logger = logging.getLogger("coframe.wire")


class TokenLimits:
    """Limits the number and bytes of stored tokens. Tokens of this process do not count."""

    def __init__(self) -> None:
        self._own_tokens: set[str] = set()
        self._stored_tokens: set[str] = set()
        self._bytes = 0
        self._warned_tokens: set[str] = set()

    def add_own(self, text: str, *, declared: bool) -> None:
        """Record that this process declares or undeclares a token."""
        if declared:
            self._own_tokens.add(text)
        else:
            self._own_tokens.discard(text)

    def add(self, text: str) -> bool:
        """Return whether a token may be stored. It counts until it is removed."""
        if text in self._own_tokens or text in self._stored_tokens:
            return True
        if len(self._stored_tokens) >= MAX_TOKENS or self._bytes + len(text) > MAX_TOKEN_BYTES:
            self._warn(
                "full",
                f"More than {MAX_TOKENS} nodes and endpoints, or {MAX_TOKEN_BYTES >> 20} MiB of their names, are on "
                f"the graph. The others are not listed. Find out which process creates them.",
            )
            return False
        self._stored_tokens.add(text)
        self._bytes += len(text)
        return True

    def remove(self, text: str) -> None:
        """Stop counting a token, which has left."""
        if text in self._stored_tokens:
            self._stored_tokens.remove(text)
            self._bytes -= len(text)

    def warn_of_invalid_token(self, text: str) -> None:
        """Warn once that a token is ignored."""
        self._warn(
            "invalid",
            f"A node or an endpoint is not listed, because its liveliness token is not valid or contains too long a "
            f"name: {display_name(text)}. More tokens like it are not reported.",
        )

    def _warn(self, key: str, text: str) -> None:
        if key not in self._warned_tokens:
            self._warned_tokens.add(key)
            _logger.warning("%s", text)
