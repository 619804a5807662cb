# SPDX-License-Identifier: Apache-2.0
"""Store the definitions of an interface package in a single string.

Each definition begins with a line such as ``=msg/Pose``; the lines after it are those of its file without comments.
The definition of another distribution begins with a line such as ``=msg/Range humble``.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.distributions import follows
from coframe.messages._parser import remove_comment

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

__all__ = ["other_forms", "pack", "unpack"]

_HEADER = "="


def pack(definitions: Mapping[str, str]) -> str:
    """Return the archive of definitions, whose keys are names such as ``msg/Pose`` or ``msg/Range humble``."""
    text = ""
    for name, definition in definitions.items():
        lines = filter(None, map(remove_comment, definition.splitlines()))
        text += "\n".join([f"{_HEADER}{name}", *lines]) + "\n"
    return text


def unpack(text: str) -> dict[str, str]:
    """Return the definitions of an archive by name, in the form of the distribution that this process follows."""
    pieces = _split_definitions(text)
    return {name: definition for name, variant, definition in pieces if not variant or follows(variant)}


def other_forms(text: str) -> dict[str, str]:
    """Return the definitions that differ between distributions, in the form that this process does not follow."""
    pieces = list(_split_definitions(text))
    return {
        name: next(text for other, variant, text in pieces if other == name and not variant)
        if follows(distribution)
        else definition
        for name, distribution, definition in pieces
        if distribution
    }


def _split_definitions(text: str) -> Iterator[tuple[str, str, str]]:
    """Yield the name, the distribution ("" for the default) and the text of each definition."""
    for piece in f"\n{text}".split(f"\n{_HEADER}")[1:]:
        key, _, definition = piece.partition("\n")
        name, _, variant = key.partition(" ")
        yield name, variant, definition
