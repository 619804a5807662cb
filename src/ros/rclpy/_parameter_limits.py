# SPDX-License-Identifier: Apache-2.0
"""Limits of the parameters that other nodes set, who could fill the memory of a node with undeclared parameters."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from coframe.messages import codec

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

MAX_PARAMETERS = 10_000
MAX_BYTES = 64 << 20  # of the names and values
MAX_NAME = 256  # bytes of the name of a parameter that the node has not declared


class ParameterLimits:
    """The sizes of the parameters of a node that other nodes have set.

    Args:
        has_parameter: Returns whether the node has a parameter.
    """

    def __init__(self, has_parameter: Callable[[str], bool]) -> None:
        self._has_parameter = has_parameter
        self._sizes: dict[str, int] = {}
        self._bytes = 0

    def forget_deleted(self) -> None:
        """Forget the parameters that the node no longer has. Call this before each request."""
        self._sizes = {name: size for name, size in self._sizes.items() if self._has_parameter(name)}
        self._bytes = sum(self._sizes.values())

    def fault(self, messages: Sequence[Any]) -> str:
        """Return why the parameters of messages cannot be set; empty if they can be."""
        new = [message.name for message in messages if not self._has_parameter(message.name)]
        if any(len(name.encode()) > MAX_NAME for name in new):
            return f"The name of a new parameter is longer than the maximum of {MAX_NAME} bytes."
        sizes = _sizes(messages)
        number = len(self._sizes) + sum(name not in self._sizes for name in sizes)
        if number <= MAX_PARAMETERS and self._bytes + self._growth(sizes) <= MAX_BYTES:
            return ""
        return f"Other nodes can set at most {MAX_PARAMETERS} parameters of a node and {MAX_BYTES >> 20} MiB in total."

    def add(self, messages: Sequence[Any]) -> None:
        """Count the parameters of messages, which were set."""
        sizes = _sizes(messages)
        self._bytes += self._growth(sizes)
        self._sizes.update(sizes)

    def _growth(self, sizes: dict[str, int]) -> int:
        return sum(size - self._sizes.get(name, 0) for name, size in sizes.items())


def _sizes(messages: Sequence[Any]) -> dict[str, int]:
    return {message.name: len(codec.serialize(message)) for message in messages}
