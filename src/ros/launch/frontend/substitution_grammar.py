# SPDX-License-Identifier: Apache-2.0
"""The grammar of text with substitutions: ``text $(name argument "quoted argument" $(nested x))``."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from coframe._output.formatting import did_you_mean
from launch.frontend.expose import substitution_parse_methods

if TYPE_CHECKING:
    from launch.substitution import Substitution

__all__ = ["parse_text"]

_NAME = re.compile(r"\s*([A-Za-z_][\w-]*)", re.ASCII)
_ESCAPED = "\\\"'$"
_MAX_DEPTH = 50


def parse_text(text: str) -> list[Substitution]:
    """Parse a string into its parts.

    Raises:
        ValueError: A substitution is unknown or not complete.
    """
    reader = _Reader(text)
    parts = reader.parts(end="", depth=0)
    if reader.position < len(text):
        raise ValueError(f"cannot read {text!r} from position {reader.position}")
    return parts


class _Reader:
    """A position in the parsed string."""

    def __init__(self, text: str) -> None:
        self.text = text
        self.position = 0

    def parts(self, *, end: str, depth: int) -> list[Substitution]:
        """Read text and substitutions up to one of the characters of `end`, or to the end."""
        from launch.substitutions import TextSubstitution  # noqa: PLC0415 - substitutions need this package

        found: list[Substitution] = []
        literal = ""
        while self.position < len(self.text) and self.text[self.position] not in end:
            character = self.text[self.position]
            if self.text.startswith("$(", self.position):
                if literal:
                    found.append(TextSubstitution(text=literal))
                    literal = ""
                found.append(self._substitution(depth + 1))
                continue
            following = self.text[self.position + 1 : self.position + 2]
            if character == "\\" and following and following in _ESCAPED:
                literal += following
                self.position += 2
                continue
            literal += character
            self.position += 1
        if literal or not found:
            found.append(TextSubstitution(text=literal))
        return found

    def _substitution(self, depth: int) -> Substitution:
        start = self.position
        match = _NAME.match(self.text, start + 2)
        if match is None or depth > _MAX_DEPTH:
            raise ValueError(f"expected the name of a substitution after '$(' in {self.text!r}")
        self.position = match.end()
        arguments: list[list[Substitution]] = []
        while True:
            self._skip_spaces()
            if self.position >= len(self.text):
                raise ValueError(f"a ')' is missing after {self.text[start : start + 30]!r}")
            character = self.text[self.position]
            if character == ")":
                self.position += 1
                return _make(match[1], arguments)
            if character in "\"'":
                arguments.append(self._parse_quoted(character, depth))
            else:
                arguments.append(self.parts(end=" \t\r\n)", depth=depth))

    def _parse_quoted(self, quote: str, depth: int) -> list[Substitution]:
        self.position += 1
        parts = self.parts(end=quote, depth=depth)
        if self.position >= len(self.text):
            raise ValueError(f"a closing {quote} is missing in {self.text!r}")
        self.position += 1
        return parts

    def _skip_spaces(self) -> None:
        while self.position < len(self.text) and self.text[self.position].isspace():
            self.position += 1


def _make(name: str, arguments: list[list[Substitution]]) -> Substitution:
    if name not in substitution_parse_methods:
        guess = did_you_mean(name, substitution_parse_methods, limit=2)
        raise ValueError(f"Unknown substitution: $({name} ...). {guess}".rstrip())
    kind, options = substitution_parse_methods[name](arguments)
    positional = options.pop("args", ())
    made: Substitution = kind(*positional, **options)
    return made
