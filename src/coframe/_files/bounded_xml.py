# SPDX-License-Identifier: Apache-2.0
"""Parse XML from untrusted files as ElementTree, with limits on size and depth, and without entities."""

from __future__ import annotations

from typing import IO, TYPE_CHECKING, Any
from xml.etree import ElementTree as ET

from coframe._files.regular_files import read_regular

if TYPE_CHECKING:
    import os

__all__ = ["MAX_BYTES", "read_xml"]

MAX_BYTES = 16 << 20
MAX_DEPTH = 100


def read_xml(file: str | os.PathLike[str] | IO[Any]) -> ET.Element:
    """Return the root element of an XML file.

    Args:
        file: A path, or an open file.

    Raises:
        ValueError: It is not XML, defines entities, or exceeds a limit.
        OSError: The file cannot be read, is not a regular file, or exceeds the size limit.
    """
    if hasattr(file, "read"):
        text = file.read(MAX_BYTES + 1)
        if len(text) > MAX_BYTES:
            raise ValueError(f"the document is larger than the maximum of {MAX_BYTES >> 20} MiB")
    else:
        text = read_regular(file, MAX_BYTES)
    if ("<!ENTITY" if isinstance(text, str) else b"<!ENTITY") in text:
        raise ValueError("the document defines entities, which are not allowed because they can expand without limit")
    parser = ET.XMLParser(target=_Builder())  # noqa: S314 - entities are refused above
    try:
        parser.feed(text)
        root: ET.Element = parser.close()
    except (ET.ParseError, LookupError) as error:  # LookupError: an unknown encoding
        raise ValueError(f"not valid XML: {error}") from None
    return root


class _Builder(ET.TreeBuilder):
    """Builds the elements and rejects deep nesting, because programs traverse the tree recursively."""

    def __init__(self) -> None:
        super().__init__()
        self._depth = 0

    def start(self, tag: Any, attrs: Any, /) -> ET.Element:
        self._depth += 1
        if self._depth > MAX_DEPTH:
            raise ValueError(f"the document is nested more than {MAX_DEPTH} levels deep")
        return super().start(tag, attrs)

    def end(self, tag: Any, /) -> ET.Element:
        self._depth -= 1
        return super().end(tag)
