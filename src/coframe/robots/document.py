"""XML with line numbers, read strictly: no entities, no definitions inside, no abysses."""

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

LARGEST = 64 << 20  # bytes: a hundred times the largest robot we know
DEEPEST = 64
# Not float()'s idea of a number, which takes nan, 1_000 and the digits of every script.
_DECLARATION = re.compile(r"""\A(\s*<\?xml\s[^>]*?)\sencoding\s*=\s*["']([\w.:-]+)["']""", re.ASCII)
_LONGEST_DECLARATION = 200  # bytes
# As Python calls them. Not all that it knows: some are no texts, and some take for ever.
_ENCODINGS = {"ascii", "cp1252", "iso8859-1", "iso8859-15", "utf-8"}
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?", re.ASCII)


class Element:
    """One element: its attributes, the elements inside, and the line that it begins on."""

    __slots__ = ("attributes", "children", "line", "tag")

    def __init__(self, tag: str, attributes: dict[str, str], line: int) -> None:
        self.tag = tag
        self.attributes = attributes
        self.line = line
        self.children: list[Element] = []

    def all(self, tag: str) -> Iterator[Element]:
        """The elements of that name directly inside."""
        return (child for child in self.children if child.tag == tag)

    def one(self, tag: str) -> Element | None:
        """The only element of that name directly inside, or None.

        Raises:
            RobotDescriptionError: There are two.
        """
        found = list(self.all(tag))
        if len(found) > 1:
            found[1].refuse(f"there is a second <{tag}> in one <{self.tag}>", hint="Which one holds? Leave one out.")
        return found[0] if found else None

    def need(self, tag: str) -> Element:
        """The only element of that name.

        Raises:
            RobotDescriptionError: There is none, or there are two.
        """
        return self.one(tag) or self.refuse(f"<{self.tag}> has no <{tag}>")

    def text(self, name: str) -> str:
        """An attribute that must be there and not be empty.

        Raises:
            RobotDescriptionError: It is not.
        """
        value = self.attributes.get(name, "").strip()
        return value or self.refuse(f"<{self.tag}> needs the attribute {name}")

    def number(self, name: str, default: float | None = None) -> float:
        """An attribute that is one number.

        Raises:
            RobotDescriptionError: It is no number, or it is missing and there is no default.
        """
        return self.numbers(name, 1, None if default is None else (default,))[0]

    def numbers(self, name: str, count: int, default: tuple[float, ...] | None = None) -> tuple[float, ...]:
        """An attribute that is so many numbers with blanks between.

        Raises:
            RobotDescriptionError: It is not, or it is missing and there is no default.
        """
        written = self.attributes.get(name)
        if written is None and default is not None:
            return default
        words = self.text(name).split()
        if len(words) != count:
            wanted = "one number" if count == 1 else f"{count} numbers with blanks between"
            self.refuse(f'<{self.tag} {name}="{_short(" ".join(words))}">: that is not {wanted}')
        return tuple(self._number(name, word) for word in words)

    def _number(self, name: str, word: str) -> float:
        if not _NUMBER.fullmatch(word) or not math.isfinite(float(word)):
            self.refuse(f'<{self.tag} {name}="...">: {_short(word)!r} is not a finite number')
        return float(word)

    def refuse(self, text: str, hint: str = "") -> NoReturn:
        """Raises what says that this element is wrong."""
        raise RobotDescriptionError(text, line=self.line, hint=hint)


class _Builder:
    """Puts together what expat finds."""

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
        if len(self.open) >= DEEPEST:
            element.refuse(f"<{tag}> is nested more than {DEEPEST} elements deep: that is no robot")
        if self.open:
            self.open[-1].children.append(element)
        else:
            self.root = element
        self.open.append(element)

    def end(self, _tag: str) -> None:
        self.open.pop()

    def doctype(self, _name: str, _system: str | None, _public: str | None, has_definitions: int) -> None:
        if has_definitions:
            self.refuse()

    def entity(self, *_: object) -> None:
        self.refuse()

    def refuse(self) -> None:
        raise RobotDescriptionError(
            "the document defines entities of its own, which can grow without bound",
            line=self.parser.CurrentLineNumber,
            hint="Leave the <!DOCTYPE ...> out; a robot description needs none.",
        )


def decoded(text: str | bytes) -> str:
    """The text of a document; of one that is no UTF-8 without the declaration's encoding, which is no longer true.

    Raises:
        RobotDescriptionError: It is larger than any robot, or not in its encoding, or that is none of the usual ones.
    """
    if len(text) > LARGEST:
        raise RobotDescriptionError(f"{len(text)} bytes are no robot description: at most {LARGEST} are read")
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
    """The outermost element of an XML document.

    Raises:
        RobotDescriptionError: It is not well formed, defines entities, or is deeper than any robot.
    """
    parser = expat.ParserCreate()
    builder = _Builder(parser)
    try:
        parser.Parse(text, True)
    except expat.ExpatError as error:
        raise RobotDescriptionError(
            f"not well-formed XML: {expat.errors.messages[error.code]}", line=error.lineno, hint=_advice(text)
        ) from None
    except UnicodeError as error:  # lone surrogates
        raise RobotDescriptionError(f"the text cannot be decoded: {error}") from None
    if builder.root is None:
        raise RobotDescriptionError("the document is empty")
    return builder.root


def _short(text: str) -> str:
    return text if len(text) <= 40 else f"{text[:40]}..."


def _advice(text: str) -> str:
    return "It is empty." if not text.strip() else "Is a tag left open, or is it another kind of file?"
