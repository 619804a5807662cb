# SPDX-License-Identifier: Apache-2.0
"""Store the definitions of an interface package in a single text.

Each definition begins with a line such as ``=msg/Pose``; the lines after it are those of its file without comments.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.messages._parser import without_comment

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = ["pack", "unpack"]

_HEADER = "="


def pack(definitions: Mapping[str, str]) -> str:
    """Return the archive of definitions, whose keys are names such as ``msg/Pose``."""
    text = ""
    for name, definition in definitions.items():
        lines = filter(None, map(without_comment, definition.splitlines()))
        text += "\n".join([f"{_HEADER}{name}", *lines]) + "\n"
    return text


def unpack(text: str) -> dict[str, str]:
    """Return the definitions of an archive by name."""
    pieces = f"\n{text}".split(f"\n{_HEADER}")[1:]
    return {name: definition for name, _, definition in (piece.partition("\n") for piece in pieces)}
