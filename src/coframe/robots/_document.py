# SPDX-License-Identifier: Apache-2.0
"""XML with line numbers and warnings, without entities, internal definitions and deep nesting."""

from __future__ import annotations

import codecs
import contextlib
import math
import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, NoReturn, TypeVar
from xml.parsers import expat

from coframe._files.other_files import BEGINNING_SIZE, describe_other_kind
from coframe.errors import RobotDescriptionError
from coframe.robots._well_formed import repair_xml

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

__all__ = ["Document", "Element", "read"]

T = TypeVar("T")

MAX_BYTES = 64 << 20  # a hundred times the largest known robot description
MAX_DEPTH = 500  # as in TinyXML-2, the parser of ROS
_DECLARATION = re.compile(r"""\A(\s*<\?xml\s[^>]*?)\sencoding\s*=\s*["']([\w.:-]+)["']""", re.ASCII)
_MAX_DECLARATION_BYTES = 200  # bytes
# The supported encodings by Python name. Some other Python codecs do not produce text or are very slow.
_ENCODINGS = {
    *(
        "big5",
        "cp1252",
        "euc_jp",
        "euc_kr",
        "gb18030",
        "gb2312",
        "gbk",
        "iso8859-1",
        "iso8859-15",
        "shift_jis",
        "utf-8",
    ),
}
_FALLBACK_ENCODING = "iso8859-1"  # every byte is a character
# float() would also accept nan, 1_000 and non-ASCII digits.
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?", re.ASCII)


class Element:
    """An XML element: its attributes, its child elements, and the line on which it begins.

    `warnings` is the list of the document.
    """

    __slots__ = ("attributes", "children", "line", "tag", "warnings")

    def __init__(self, tag: str, attributes: dict[str, str], line: int, warnings: list[str]) -> None:
        self.tag = tag
        self.attributes = attributes
        self.line = line
        self.warnings = warnings
        self.children: list[Element] = []

    def all(self, tag: str) -> Iterator[Element]:
        """Return the child elements with a tag."""
        return (child for child in self.children if child.tag == tag)

    def one(self, tag: str) -> Element | None:
        """Return the first child element with a tag, or None if there is none. Others cause a warning."""
        found = self.all(tag)
        first = next(found, None)
        if (second := next(found, None)) is not None:
            second.warn(f"<{self.tag}> contains a second <{tag}>; the first one is used")
        return first

    def required_child(self, tag: str) -> Element:
        """Return the first child element with a tag.

        Raises:
            RobotDescriptionError: There is none.
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
            self.fail(f'<{self.tag} {name}="{_shorten(" ".join(words))}">: expected {expected}')
        return tuple(self._number(name, word) for word in words)

    def _number(self, name: str, word: str) -> float:
        if not _NUMBER.fullmatch(word) or not math.isfinite(float(word)):
            self.fail(f'<{self.tag} {name}="...">: {_shorten(word)!r} is not a finite number')
        return float(word)

    def parse_or_warn(self, parse: Callable[[Element], T], ignored: str) -> T | None:
        """Return the result of `parse` for this element, or None if it has a fault, which becomes a warning.

        Args:
            parse: A function that raises RobotDescriptionError.
            ignored: The ignored part, for the warning.
        """
        try:
            return parse(self)
        except RobotDescriptionError as error:
            self.warnings.append(f"{error}; {ignored} is ignored")
            return None

    def warn(self, text: str) -> None:
        """Add a warning with the line of this element."""
        self.warnings.append(f"line {self.line}: {text}")

    def fail(self, text: str, hint: str = "") -> NoReturn:
        """Raise a RobotDescriptionError with the line of this element."""
        raise RobotDescriptionError(text, line=self.line, hint=hint)


@dataclass(frozen=True)
class Document:
    """A robot description: its root element, its text as well-formed XML, and its warnings.

    The warnings of the elements are added to `warnings`.
    """

    root: Element
    text: str
    warnings: list[str]


class _Builder:
    """Builds the element tree from expat events."""

    def __init__(self, parser: expat.XMLParserType, warnings: list[str]) -> None:
        self.parser = parser
        self.warnings = warnings
        self.root: Element | None = None
        self.open: list[Element] = []
        parser.StartElementHandler = self.start
        parser.EndElementHandler = self.end
        parser.StartDoctypeDeclHandler = self.doctype
        parser.EntityDeclHandler = self.entity

    def start(self, tag: str, attributes: dict[str, str]) -> None:
        element = Element(tag, attributes, self.parser.CurrentLineNumber, self.warnings)
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


def read(data: str | bytes) -> Document:
    """Read a document. Malformed XML that ROS reads is repaired, with a warning.

    Raises:
        RobotDescriptionError: The document is larger than 64 MiB, is not XML, defines entities, or is nested more than
            500 levels deep.
    """
    if len(data) > MAX_BYTES:
        raise RobotDescriptionError(f"the robot description has {len(data)} bytes; the maximum is {MAX_BYTES}")
    warnings: list[str] = []
    text = data if isinstance(data, str) else _decode(data, warnings)
    try:
        return Document(_parse(text, warnings), text, warnings)
    except expat.ExpatError as error:
        reason, line = expat.errors.messages[error.code], error.lineno
    repair = repair_xml(text)
    if repair is not None:
        warnings.append(f"line {line}: not well-formed XML: {reason}. The document was repaired")
        with contextlib.suppress(expat.ExpatError):
            return Document(_parse(repair, warnings), repair, warnings)
    beginning = data[:BEGINNING_SIZE].encode() if isinstance(data, str) else data[:BEGINNING_SIZE]
    if data and (what := describe_other_kind(beginning)):
        raise RobotDescriptionError(f"not a robot description: {what}")
    raise RobotDescriptionError(f"not well-formed XML: {reason}", line=line, hint=_xml_hint(text))


def _decode(data: bytes, warnings: list[str]) -> str:
    """Return the text of a document. An encoding declaration other than UTF-8 is removed."""
    encoding = _encoding(data, warnings)
    try:
        text = data.decode(encoding)
    except UnicodeError as error:
        warnings.append(
            f"the text cannot be decoded: {error}. The text is read as {_FALLBACK_ENCODING}; save it as UTF-8"
        )
        text = data.decode(_FALLBACK_ENCODING)
    declaration = _DECLARATION.match(text)
    if declaration is None or declaration[2].lower() in {"utf-8", "utf8"}:
        return text
    return declaration[1] + text[declaration.end() :]


def _encoding(data: bytes, warnings: list[str]) -> str:
    if data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        return "utf-16"
    declaration = _DECLARATION.match(data[:_MAX_DECLARATION_BYTES].decode("ascii", "replace"))
    if declaration is None:
        return "utf-8"
    with contextlib.suppress(LookupError):
        encoding = codecs.lookup(declaration[2]).name
        if encoding == "ascii":  # whatever else is in the file is UTF-8, if it is valid
            return "utf-8"
        if encoding in _ENCODINGS:
            return encoding
    warnings.append(f"line 1: unknown encoding {declaration[2]!r}; the text is read as UTF-8")
    return "utf-8"


def _parse(text: str, warnings: list[str]) -> Element:
    """Parse an XML document and return its root element.

    Raises:
        ExpatError: It is not well-formed.
        RobotDescriptionError: It cannot be decoded, defines entities, or is nested more than 500 levels deep.
    """
    parser = expat.ParserCreate()
    builder = _Builder(parser, warnings)
    try:
        parser.Parse(text, True)
    except UnicodeError as error:  # lone surrogates
        raise RobotDescriptionError(f"the text cannot be decoded: {error}") from None
    if builder.root is None:
        raise RobotDescriptionError("the document is empty")
    return builder.root


def _shorten(text: str) -> str:
    return text if len(text) <= 40 else f"{text[:40]}..."


def _xml_hint(text: str) -> str:
    return "The document is empty." if not text.strip() else "Check for unclosed tags, and that the file is XML."
