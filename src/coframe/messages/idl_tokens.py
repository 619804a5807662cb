# SPDX-License-Identifier: Apache-2.0
"""Tokens of IDL files: names, numbers, strings and punctuation, each with its line."""

from __future__ import annotations

import ast
import re
from typing import NamedTuple

from coframe.errors import InterfaceError
from coframe.messages.parser import shortened

__all__ = ["Token", "Tokens"]

_TOKEN = re.compile(
    r"""
    (?P<space>\s+ | //[^\n]* | /\*.*?\*/ | \#[^\n]*)
    | (?P<name>(?:::)?[A-Za-z_]\w*(?:::[A-Za-z_]\w*)*)
    | (?P<number>0[xX][0-9a-fA-F]+ | (?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)
    | (?P<string>"(?:[^"\\\n]|\\.)*")
    | (?P<mark>[][{}()<>;,=@+-])
    """,
    re.VERBOSE | re.DOTALL | re.ASCII,
)


class Token(NamedTuple):
    """One token: its kind is ``name``, ``number``, ``string``, ``mark`` or ``end``."""

    kind: str
    text: str
    line: int


class Tokens:
    """The tokens of a file, read one after the other."""

    def __init__(self, text: str, file: str | None) -> None:
        self._file = file
        self._tokens = self._split(text)
        self._next = 0

    def _split(self, text: str) -> list[Token]:
        tokens, line, position = [], 1, 0
        while position < len(text):
            match = _TOKEN.match(text, position)
            if match is None:
                raise self.error(f"unexpected character {text[position]!r}", line)
            if match.lastgroup != "space":
                tokens.append(Token(str(match.lastgroup), match.group(), line))
            line += match.group().count("\n")
            position = match.end()
        return [*tokens, Token("end", "the end of the file", line)]

    def error(self, text: str, line: int | None = None) -> InterfaceError:
        """Return an error at a line, by default the line of the next token."""
        return InterfaceError(shortened(text), line=self.peek().line if line is None else line, file=self._file)

    def peek(self) -> Token:
        """Return the next token without taking it."""
        return self._tokens[self._next]

    def take(self, kind: str = "") -> Token:
        """Take the next token, which must be of the kind if one is given."""
        token = self.peek()
        if kind and token.kind != kind:
            raise self.error(f"expected a {kind}, found {token.text}")
        self._next = min(self._next + 1, len(self._tokens) - 1)
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
