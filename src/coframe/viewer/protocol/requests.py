# SPDX-License-Identifier: Apache-2.0
"""The messages of clients, checked against the classes of the protocol."""

from __future__ import annotations

import json
import math
from typing import Any, cast, get_args

from coframe.errors import CoframeError
from coframe.viewer.protocol import client_messages
from coframe.viewer.protocol.schema import InvalidFieldError, record, shorten

__all__ = ["BadRequestError", "parse_request"]

_RECORDS = {message_type.type: record(message_type) for message_type in get_args(client_messages.ClientMessage)}


class BadRequestError(CoframeError, ValueError):
    """A message that the protocol does not allow, or a request that cannot be fulfilled.

    Attributes:
        hint: Advice for the user.
        display: The id of the display that the request concerns, or None.
    """

    def __init__(self, text: str, hint: str = "", display: int | None = None) -> None:
        super().__init__(text)
        self._hint = hint
        self.display = display


def parse_request(message: str | bytes) -> client_messages.ClientMessage:
    """Return a client's message as an instance of its class.

    Raises:
        BadRequestError: The message is not valid JSON, its type is unknown, or a field is missing, has the wrong type
            or is out of range.
    """
    if isinstance(message, bytes):
        raise BadRequestError("the server accepts only text messages")
    try:
        fields = _DECODER.decode(message)
    except (ValueError, RecursionError) as error:
        raise BadRequestError(f"a message is not valid JSON: {error}") from None
    if not isinstance(fields, dict) or not isinstance(fields.get("type"), str):
        raise BadRequestError("a message must be a JSON object with a type")
    kind = fields["type"]
    found = _RECORDS.get(kind)
    if found is None:
        known = ", ".join(sorted(_RECORDS))
        raise BadRequestError(f"unknown message type {shorten(kind)}. Known types: {known}.", "Reload the page.")
    try:
        return cast("client_messages.ClientMessage", found.build(fields))
    except InvalidFieldError as error:
        text = f"{error.path} of a message {kind!r} must be {error.expected}, not {shorten(error.value)}"
        raise BadRequestError(text, display=_display_of(fields, error.path)) from None


def _display_of(fields: dict[str, Any], path: str) -> int | None:
    """Return the id of the display whose options are invalid, or None if something else is."""
    number = fields.get("id")
    is_id = isinstance(number, int) and not isinstance(number, bool) and 0 <= number < 1 << 32
    return number if is_id and fields["type"] == client_messages.Subscribe.type and "options" in path else None


def _reject_constant(name: str) -> Any:
    raise ValueError(f"JSON has no number {name}")


def _parse_finite(text: str) -> float:
    value = float(text)
    if not math.isfinite(value):
        raise ValueError(f"the number {text[:40]} is out of range")
    return value


_DECODER = json.JSONDecoder(parse_constant=_reject_constant, parse_float=_parse_finite)
