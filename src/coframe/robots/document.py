# SPDX-License-Identifier: Apache-2.0
"""A strict XML parser with line numbers, which rejects entities, internal definitions and deep nesting."""

from __future__ import annotations

import codecs
import contextlib
import math
import re
from typing import TYPE_CHECKING, NoReturn
from xml.parsers import expat

from coframe.errors import RobotDescriptionError

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["Element", "decoded", "parse"]

MAX_BYTES = 64 << 20  # a hundred times the largest known robot description
MAX_DEPTH = 64
_DECLARATION = re.compile(r"""\A(\s*<\?xml\s[^>]*?)\sencoding\s*=\s*["']([\w.:-]+)["']""", re.ASCII)
_LONGEST_DECLARATION = 200  # bytes
# The supported encodings by their Python names. Some other codecs of Python do not give text or are very slow.
_ENCODINGS = {"ascii", "cp1252", "iso8859-1", "iso8859-15", "utf-8"}
# float() would also accept nan, 1_000 and the digits of all scripts.
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?", re.ASCII)


class Element:
    """An XML element: its attributes, its child elements, and the line on which it begins."""

    __slots__ = ("attributes", "children", "line", "tag")

    def __init__(self, tag: str, attributes: dict[str, str], line: int) -> None:
        self.tag = tag
        self.attributes = attributes
        self.line = line
        self.children: list[Element] = []

    def all(self, tag: str) -> Iterator[Element]:
        """Return the child elements with a tag."""
        return (child for child in self.children if child.tag == tag)

    def one(self, tag: str) -> Element | None:
        """Return the only child element with a tag; None if there is none.

        Raises:
            RobotDescriptionError: There are several.
        """
        found = list(self.all(tag))
        if len(found) > 1:
            found[1].fail(f"there is a second <{tag}> in one <{self.tag}>", hint=f"Remove one <{tag}>.")
        return found[0] if found else None

    def need(self, tag: str) -> Element:
        """Return the only child element with a tag.

        Raises:
            RobotDescriptionError: There is none, or there are several.
        """
        return self.one(tag) or self.fail(f"<{self.tag}> has no <{tag}>")

    def text(self, name: str) -> str:
        """Return the value of a required attribute.

        Raises:
            RobotDescriptionError: The attribute is missing or empty.
        """
        value = self.attributes.get(name, "").strip()
        return value or self.fail(f"<{self.tag}> needs the attribute {name}")

    def number(self, name: str, default: float | None = None) -> float:
        """Return the value of an attribute as a number.

        Raises:
            RobotDescriptionError: The value is not a finite number, or it is missing and there is no default.
        """
        return self.numbers(name, 1, None if default is None else (default,))[0]

    def numbers(self, name: str, count: int, default: tuple[float, ...] | None = None) -> tuple[float, ...]:
        """Return the value of an attribute as `count` numbers separated by spaces.

        Raises:
            RobotDescriptionError: The value is not `count` finite numbers, or it is missing and there is no default.
        """
        written = self.attributes.get(name)
        if written is None and default is not None:
            return default
        words = self.text(name).split()
        if len(words) != count:
            expected = "one number" if count == 1 else f"{count} numbers separated by spaces"
            self.fail(f'<{self.tag} {name}="{_short(" ".join(words))}">: expected {expected}')
        return tuple(self._number(name, word) for word in words)

    def _number(self, name: str, word: str) -> float:
        if not _NUMBER.fullmatch(word) or not math.isfinite(float(word)):
            self.fail(f'<{self.tag} {name}="...">: {_short(word)!r} is not a finite number')
        return float(word)

    def fail(self, text: str, hint: str = "") -> NoReturn:
        """Raise a RobotDescriptionError with the line of this element."""
        raise RobotDescriptionError(text, line=self.line, hint=hint)


class _Builder:
    """Builds the tree of elements from the events of expat."""

    def __init__(self, parser: expat.XMLParserType) -> None:
        self.parser = parser
        self.root: Element | None = None
        self.open: list[Element] = []
        parser.StartElementHandler = self.start
        parser.EndElementHandler = self.end
        parser.StartDoctypeDeclHandler = self.doctype
        parser.EntityDeclHandler = self.entity

    def start(self, tag: str, attributes: dict[str, str]) -> None:
        element = Element(tag, attributes, self.parser.CurrentLineNumber)
        if len(self.open) >= MAX_DEPTH:
            element.fail(f"<{tag}> is nested more than {MAX_DEPTH} elements deep")
        if self.open:
            self.open[-1].children.append(element)
        else:
            self.root = element
        self.open.append(element)

    def end(self, _tag: str) -> None:
        self.open.pop()

    def doctype(self, _name: str, _system: str | None, _public: str | None, has_definitions: int) -> None:
        if has_definitions:
            self.fail_on_entities()

    def entity(self, *_: object) -> None:
        self.fail_on_entities()

    def fail_on_entities(self) -> None:
        raise RobotDescriptionError(
            "the document defines entities, which are not allowed because they can expand without limit",
            line=self.parser.CurrentLineNumber,
            hint="Remove the <!DOCTYPE ...>. A robot description does not need it.",
        )


def decoded(text: str | bytes) -> str:
    """Return the text of a document. The declaration of an encoding other than UTF-8 is removed.

    Raises:
        RobotDescriptionError: The document is larger than 64 MiB, its encoding is not supported, or it cannot be
            decoded.
    """
    if len(text) > MAX_BYTES:
        raise RobotDescriptionError(f"the robot description has {len(text)} bytes. The limit is {MAX_BYTES} bytes")
    if isinstance(text, str):
        return text
    encoding = _encoding(text)
    try:
        plain = text.decode(encoding)
    except UnicodeError as error:
        raise RobotDescriptionError(f"the text cannot be decoded: {error}", hint="Save it as UTF-8.") from None
    return plain if encoding == "utf-8" else _DECLARATION.sub(r"\1", plain, count=1)


def _encoding(text: bytes) -> str:
    if text.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        return "utf-16"
    declaration = _DECLARATION.match(text[:_LONGEST_DECLARATION].decode("ascii", "replace"))
    if declaration is None:
        return "utf-8"
    with contextlib.suppress(LookupError):
        if (encoding := codecs.lookup(declaration[2]).name) in _ENCODINGS:
            return encoding
    raise RobotDescriptionError(f"unknown encoding {declaration[2]!r}", line=1, hint="Save it as UTF-8.")


def parse(text: str) -> Element:
    """Parse an XML document and return its root element.

    Raises:
        RobotDescriptionError: The document is not well-formed, defines entities, or is nested more than 64 levels deep.
    """
    parser = expat.ParserCreate()
    builder = _Builder(parser)
    try:
        parser.Parse(text, True)
    except expat.ExpatError as error:
        raise RobotDescriptionError(
            f"not well-formed XML: {expat.errors.messages[error.code]}", line=error.lineno, hint=_xml_hint(text)
        ) from None
    except UnicodeError as error:  # lone surrogates
        raise RobotDescriptionError(f"the text cannot be decoded: {error}") from None
    if builder.root is None:
        raise RobotDescriptionError("the document is empty")
    return builder.root


def _short(text: str) -> str:
    return text if len(text) <= 40 else f"{text[:40]}..."


def _xml_hint(text: str) -> str:
    return "The document is empty." if not text.strip() else "Check for unclosed tags, and that the file is XML."
