# SPDX-License-Identifier: Apache-2.0
"""Store the definitions of an interface package in a single string.

Each definition begins with a line such as ``=msg/Pose``; the lines after it are those of its file without comments.
The definition of another distribution begins with a line such as ``=msg/Range humble``.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.distributions import follows
from coframe.messages._parser import without_comment

if TYPE_CHECKING:
    from collections.abc import Mapping

__all__ = ["pack", "unpack"]

_HEADER = "="


def pack(definitions: Mapping[str, str]) -> str:
    """Return the archive of definitions, whose keys are names such as ``msg/Pose`` or ``msg/Range humble``."""
    text = ""
    for name, definition in definitions.items():
        lines = filter(None, map(without_comment, definition.splitlines()))
        text += "\n".join([f"{_HEADER}{name}", *lines]) + "\n"
    return text


def unpack(text: str) -> dict[str, str]:
    """Return the definitions of an archive by name, in the form of the distribution that this process follows."""
    definitions: dict[str, str] = {}
    for piece in f"\n{text}".split(f"\n{_HEADER}")[1:]:
        key, _, definition = piece.partition("\n")
        name, _, variant = key.partition(" ")
        if not variant or follows(variant):
            definitions[name] = definition
    return definitions
