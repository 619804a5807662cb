# SPDX-License-Identifier: Apache-2.0
"""Repair of documents that are not well-formed XML, but that ROS reads: its parser, TinyXML-2, is tolerant."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["repair_xml"]

_NAME_CHARACTER = r"[\w:.\-\x80-\U0010ffff]"
_NAME = rf"[A-Za-z_:\x80-\U0010ffff]{_NAME_CHARACTER}*"
_ATTRIBUTE = re.compile(rf"""(\s*)({_NAME})(\s*)=(\s*)("[^"]*"|'[^']*')""", re.ASCII)
_ATTRIBUTES = _ATTRIBUTE.pattern.replace("(", "(?:")
# Each alternative can match in one way only, so that the time is linear.
_TOKEN = re.compile(
    rf"""(?P<nothing><!--.*?-->|<\?.*?\?>|<!(?!--|\[CDATA\[)[^>]*>)
    |(?P<data><!\[CDATA\[.*?\]\]>)
    |<(?P<before>\s*)(?P<slash>/?)(?P<tag>{_NAME})(?!{_NAME_CHARACTER})
        (?P<attributes>(?:{_ATTRIBUTES})*)(?P<after>\s*)(?P<empty>/?)>
    |(?P<text>[^<]+)""",
    re.ASCII | re.DOTALL | re.VERBOSE,
)
_NOT_A_CHARACTER = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ufffe\uffff]")
_REFERENCE = re.compile(r"&(?:(amp|lt|gt|quot|apos);|#(\d{1,7});|#x([0-9a-fA-F]{1,6});)?")


def repair_xml(text: str) -> str | None:
    """Return the first <robot> of a document as well-formed XML with the same line numbers.

    The following are repaired: ``--`` in comments, ``&`` and ``<`` in values, attributes without a space between them,
    control characters, and anything before or after the <robot>, such as a second declaration.

    Returns:
        The repaired document, or None if the faults are others, such as tags without an end.
    """
    kept: list[str] = []
    depth = 0
    is_inside = is_complete = False
    for piece in _pieces(_NOT_A_CHARACTER.sub("\ufffd", text.partition("\0")[0].lstrip("\ufeff"))):
        if piece is None or (depth == 0 and (piece["text"] or "").strip()):
            return None  # TinyXML-2 refuses text outside of elements as well
        is_inside = is_inside or (depth == 0 and not is_complete and piece["tag"] == "robot")
        kept.append(_well_formed(piece) if is_inside else "\n" * piece[0].count("\n"))
        depth += _levels(piece)
        if depth <= 0 and is_inside:
            is_inside, is_complete = False, True
    return "".join(kept) if is_complete and depth == 0 else None


def _pieces(text: str) -> Iterator[re.Match[str] | None]:
    position = 0
    while position < len(text):
        piece = _TOKEN.match(text, position)
        yield piece
        if piece is None:
            return
        position = piece.end()


def _levels(piece: re.Match[str]) -> int:
    if piece["tag"] is None:
        return 0
    return -1 if piece["slash"] else 0 if piece["empty"] else 1


def _well_formed(piece: re.Match[str]) -> str:
    if piece["nothing"] is not None:
        return "\n" * piece[0].count("\n")
    if piece["data"] is not None:
        return piece[0]
    if piece["text"] is not None:
        return _escape(piece["text"])
    attributes = "" if piece["slash"] else _ATTRIBUTE.sub(_attribute, piece["attributes"])
    lines = "\n" * (piece["before"].count("\n") + piece["slash"].count("/") * piece["attributes"].count("\n"))
    return f"<{piece['slash']}{piece['tag']}{attributes}{lines}{piece['after']}{piece['empty']}>"


def _attribute(found: re.Match[str]) -> str:
    space, name, before, after, value = found.groups()
    return f"{space or ' '}{name}{before}={after}{_escape(value)}"


def _escape(text: str) -> str:
    return _REFERENCE.sub(_reference, text).replace("<", "&lt;").replace("]]>", "]]&gt;")


def _reference(found: re.Match[str]) -> str:
    named, decimal, hexadecimal = found.groups()
    if named:
        return found[0]
    code = int(decimal or hexadecimal or "0", 16 if hexadecimal else 10)
    is_character = code in {9, 10, 13} or 0x20 <= code < 0xD800 or 0xE000 <= code < 0xFFFE or 0xFFFF < code < 0x110000
    return found[0] if is_character else f"&amp;{found[0][1:]}"
