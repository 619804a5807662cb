# SPDX-License-Identifier: Apache-2.0
"""Tokens of IDL files: names, numbers, strings and punctuation, each with its line."""

from __future__ import annotations

import ast
import re
from typing import TYPE_CHECKING, NamedTuple

from coframe.errors import InterfaceError
from coframe.messages._parser import truncate
from coframe.messages.limits import MAX_LINE

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["Token", "Tokens"]

_TOKEN = re.compile(
    r"""
    (?P<space>\s+ | //[^\n]* | /\*.*?\*/ | \#[^\n]*)
    | (?P<name>(?:::)?[A-Za-z_]\w*(?:::[A-Za-z_]\w*)*)
    | (?P<number>0[xX][0-9a-fA-F]+ | (?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)
    | (?P<string>"(?:[^"\\\n]|\\.)*")
    | (?P<mark>[][{}()<>;,=@+*/%|^&~-])
    """,
    re.VERBOSE | re.DOTALL | re.ASCII,
)


class Token(NamedTuple):
    """One token: its kind is ``name``, ``number``, ``string``, ``mark`` or ``end``."""

    kind: str
    text: str
    line: int


class Tokens:
    """The tokens of a document, read in order.

    Args:
        text: The text of an IDL file.
        file: The name of the file, for error messages.
        line: The number of the first line.
    """

    def __init__(self, text: str, file: str | None, line: int = 1) -> None:
        self._file = file
        self._tokens = self._split(text, line)
        self._next = Token("end", "the end of the file", line)
        self.take()

    def _split(self, text: str, line: int) -> Iterator[Token]:
        position = 0
        while position < len(text):
            match = _TOKEN.match(text, position)
            if match is None:
                raise self.error(f"unexpected character {text[position]!r}", line)
            if match.lastgroup != "space":
                if len(match.group()) > MAX_LINE:
                    raise self.error(
                        f"a {match.lastgroup} has {len(match.group())} characters; the maximum is {MAX_LINE}", line
                    )
                yield Token(str(match.lastgroup), match.group(), line)
            line += match.group().count("\n")
            position = match.end()
        while True:
            yield Token("end", "the end of the file", line)

    def error(self, text: str, line: int | None = None) -> InterfaceError:
        """Return an error at a line, by default the line of the next token."""
        return InterfaceError(truncate(text), line=self.peek().line if line is None else line, file=self._file)

    def peek(self) -> Token:
        """Return the next token without taking it."""
        return self._next

    def take(self, kind: str = "") -> Token:
        """Take the next token, which must be of the kind if one is given."""
        token = self.peek()
        if kind and token.kind != kind:
            raise self.error(f"expected a {kind}, found {token.text}")
        self._next = next(self._tokens)
        return token

    def accept(self, text: str) -> bool:
        """Take the next token if it is this name or mark."""
        found = self.peek().kind in {"name", "mark"} and self.peek().text == text
        if found:
            self.take()
        return found

    def expect(self, text: str) -> None:
        """Take this name or mark."""
        if not self.accept(text):
            raise self.error(f"expected '{text}', found {self.peek().text}")

    def strings(self) -> str:
        """Take one or more strings, which are joined as in C."""
        parts = [self._string()]
        while self.peek().kind == "string":
            parts.append(self._string())
        return "".join(parts)

    def _string(self) -> str:
        token = self.take("string")
        try:
            return str(ast.literal_eval(token.text))
        except (ValueError, SyntaxError, MemoryError):
            raise self.error(f"{token.text} is not a string", token.line) from None
