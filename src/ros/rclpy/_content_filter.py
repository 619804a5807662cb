# SPDX-License-Identifier: Apache-2.0
"""Content filters: conditions on the fields of messages in the language of DDS (annex B of its specification).

A condition is compiled to nested functions. Grammar::

    condition  = term {OR term}
    term       = factor {AND factor}
    factor     = NOT factor | "(" condition ")" | comparison
    comparison = value operator value | value [NOT] BETWEEN value AND value | value [NOT] LIKE value
    value      = field | literal | %N
"""

from __future__ import annotations

import functools
import operator
import re
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from coframe.messages.definition import AbstractNestedType, Array, NamespacedType
from coframe.messages.registry import class_of
from rclpy.exceptions import RCLError

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    Condition = Callable[[Any], bool]
    Value = Callable[[Any], Any]

__all__ = ["ContentFilter"]

MAX_EXPRESSION: Final = 10_000  # characters
MAX_PARAMETERS: Final = 100  # as in DDS
_MAX_DEPTH: Final = 50  # of parentheses
_MAX_SHOWN: Final = 100  # characters of an expression in an error message
_MAX_DIGITS: Final = 100  # characters of a number

_TOKEN = re.compile(
    r"""\s*(?:
    (?P<number>[-+]?(?:0[xX][0-9a-fA-F]+|(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?))
    |(?P<text>'[^']*')
    |(?P<parameter>%\d{1,2})
    |(?P<operator><=|>=|<>|!=|=|<|>|\(|\))
    |(?P<word>[A-Za-z_][A-Za-z0-9_.\[\]]*)
    )""",
    re.VERBOSE,
)
_INDEX = re.compile(r"(\w+)((?:\[\d{1,10}\])*)")
_OPERATORS: Final = {
    "=": operator.eq,
    "<>": operator.ne,
    "!=": operator.ne,
    "<": operator.lt,
    "<=": operator.le,
    ">": operator.gt,
    ">=": operator.ge,
}
_WORDS: Final = {"AND", "OR", "NOT", "BETWEEN", "LIKE", "TRUE", "FALSE"}


class _Token(NamedTuple):
    kind: str
    text: str


class ContentFilter:
    """A compiled condition.

    Args:
        message_class: Class of the messages.
        expression: The condition; "" lets all messages through.
        parameters: The values of ``%0``, ``%1`` and so on, as literals.

    Raises:
        RCLError: The condition is invalid, or refers to a field that does not exist.
        TypeError: The expression or a parameter is not a string.
    """

    def __init__(self, message_class: type[Any], expression: str, parameters: Sequence[str]) -> None:
        self.expression = expression
        self.parameters = list(parameters)
        for text in (expression, *self.parameters):
            if not isinstance(text, str):
                raise TypeError(
                    f"The expression and the parameters of a content filter must be strings, got {text!r:.60}."
                )
        if len(self.parameters) > MAX_PARAMETERS or max(map(len, (expression, *self.parameters))) > MAX_EXPRESSION:
            limits = f"{MAX_PARAMETERS} parameters, or it or a parameter has more than {MAX_EXPRESSION} characters"
            raise _error(expression, f"has more than {limits}")
        self._accepts = _Parser(message_class, expression, self.parameters).parse() if expression else None

    def accepts(self, message: Any) -> bool:
        """Return whether a message is let through."""
        if self._accepts is None:
            return True
        try:
            return self._accepts(message)
        except (IndexError, TypeError):  # A sequence is too short, or values of different types are compared.
            return False


class _Parser:
    def __init__(self, message_class: type[Any], expression: str, parameters: Sequence[str]) -> None:
        self._class = message_class
        self._expression = expression
        self._parameters = parameters
        self._tokens = self._split()
        self._position = 0
        self._depth = 0

    def parse(self) -> Condition:
        condition = self._condition()
        if self._position < len(self._tokens):
            raise _error(self._expression, f"has {self._tokens[self._position].text[:_MAX_SHOWN]!r} after its end")
        return condition

    def _split(self) -> list[_Token]:
        tokens, position, text = [], 0, self._expression.rstrip()
        while position < len(text):
            match = _TOKEN.match(text, position)
            if match is None:
                raise _error(self._expression, f"has an unexpected character at {text[position:].strip()[:10]!r}")
            kind = str(match.lastgroup)
            word = match[kind]
            is_keyword = kind == "word" and word.upper() in _WORDS
            tokens.append(_Token("keyword", word.upper()) if is_keyword else _Token(kind, word))
            position = match.end()
        return tokens

    def _peek(self) -> str:
        return self._tokens[self._position].text if self._position < len(self._tokens) else ""

    def _takes(self, *texts: str) -> bool:
        """Take the next token if it is one of these keywords or operators."""
        if self._position < len(self._tokens):
            token = self._tokens[self._position]
            if token.kind in ("keyword", "operator") and token.text in texts:
                self._position += 1
                return True
        return False

    def _condition(self) -> Condition:
        terms = [self._term()]
        while self._takes("OR"):
            terms.append(self._term())
        return terms[0] if len(terms) == 1 else lambda message: any(term(message) for term in terms)

    def _term(self) -> Condition:
        factors = [self._factor()]
        while self._takes("AND"):
            factors.append(self._factor())
        return factors[0] if len(factors) == 1 else lambda message: all(factor(message) for factor in factors)

    def _factor(self) -> Condition:
        self._depth += 1
        if self._depth > _MAX_DEPTH:
            raise _error(self._expression, f"has more than {_MAX_DEPTH} nested conditions")
        try:
            if self._takes("NOT"):
                negated = self._factor()
                return lambda message: not negated(message)
            if not self._takes("("):
                return self._comparison()
            condition = self._condition()
            if not self._takes(")"):
                raise _error(self._expression, "has no ')' for a '('")
            return condition
        finally:
            self._depth -= 1

    def _comparison(self) -> Condition:
        left = self._value()
        is_negated = self._takes("NOT")
        if self._takes("BETWEEN"):
            low = self._value()
            if not self._takes("AND"):
                raise _error(self._expression, "has no AND after BETWEEN")
            high = self._value()
            return lambda message: (low(message) <= left(message) <= high(message)) != is_negated
        if self._takes("LIKE"):
            pattern = self._value()
            return lambda message: _is_like(left(message), pattern(message)) != is_negated
        symbol = self._peek()
        if is_negated or not self._takes(*_OPERATORS):
            raise _error(self._expression, f"has {symbol[:_MAX_SHOWN]!r} in place of a comparison such as '='")
        compare, right = _OPERATORS[symbol], self._value()
        return lambda message: bool(compare(left(message), right(message)))

    def _value(self) -> Value:
        if self._position >= len(self._tokens):
            raise _error(self._expression, "ends where a value is expected")
        token = self._tokens[self._position]
        self._position += 1
        if token.kind == "parameter":
            return self._parameter(int(token.text[1:]))
        if token.kind == "word":
            return self._field(token.text)
        return self._literal(token)

    def _parameter(self, number: int) -> Value:
        if number >= len(self._parameters):
            raise _error(self._expression, f"has %{number}, but there are {len(self._parameters)} parameters")
        text = self._parameters[number].strip()
        match = _TOKEN.fullmatch(text)
        if match is None or match.lastgroup not in ("number", "text", "word"):
            return lambda _: text
        kind = str(match.lastgroup)
        if kind == "word" and text.upper() not in ("TRUE", "FALSE"):
            return lambda _: text
        return self._literal(_Token("keyword" if kind == "word" else kind, text.upper() if kind == "word" else text))

    def _literal(self, token: _Token) -> Value:
        if token.kind == "text":
            text = token.text[1:-1]
            return lambda _: text
        if token.kind == "number":
            if len(token.text) > _MAX_DIGITS:
                raise _error(self._expression, f"has a number of more than {_MAX_DIGITS} characters")
            is_hexadecimal = "x" in token.text.lower()
            is_whole = token.text.lstrip("+-").isdigit()
            number = int(token.text, 16) if is_hexadecimal else int(token.text) if is_whole else float(token.text)
            return lambda _: number
        if token.text in ("TRUE", "FALSE"):
            is_true = token.text == "TRUE"
            return lambda _: is_true
        raise _error(self._expression, f"has {token.text[:_MAX_SHOWN]!r} where a value is expected")

    def _field(self, path: str) -> Value:
        """Return a function that reads a field such as ``poses[0].position.x``."""
        steps: list[tuple[str, list[int]]] = []
        cls: Any = self._class
        for part in path.split("."):
            match = _INDEX.fullmatch(part)
            types = {} if cls is None else dict(zip(cls.get_fields_and_field_types(), cls.SLOT_TYPES, strict=True))
            if match is None or match[1] not in types:
                raise _error(
                    self._expression, f"refers to {path[:_MAX_SHOWN]!r}, which is not a field of {self._class.ROS_TYPE}"
                )
            type_, indexes = types[match[1]], [int(text) for text in re.findall(r"\d+", match[2])]
            for index in indexes:
                if not isinstance(type_, AbstractNestedType) or (isinstance(type_, Array) and index >= type_.size):
                    raise _error(
                        self._expression, f"refers to {path[:_MAX_SHOWN]!r}, which is not an element of an array"
                    )
                type_ = type_.value_type
            cls = class_of(type_) if isinstance(type_, NamespacedType) else None
            steps.append((match[1], indexes))

        def read(message: Any) -> Any:
            value = message
            for name, indexes in steps:
                value = getattr(value, name)
                for index in indexes:
                    value = value[index]
            return value[0] if isinstance(value, bytes) else value

        return read


def _is_like(text: Any, pattern: Any) -> bool:
    """Return whether a string matches a pattern: `%` and `*` match any string, `_` and `?` one character.

    Each part between two `%` takes the first place where it fits, so that no pattern makes the search go back.
    """
    text = str(text)
    (first, size), *others = _parts_of(str(pattern))
    if not others:
        return first.fullmatch(text) is not None
    if first.match(text) is None:
        return False
    *middle, (last, last_size) = others
    position, end = size, len(text) - last_size
    for part, _ in middle:
        found = part.search(text, position, max(end, position))
        if found is None:
            return False
        position = found.end()
    return position <= end and last.match(text, end) is not None


@functools.lru_cache(maxsize=128)
def _parts_of(pattern: str) -> list[tuple[re.Pattern[str], int]]:
    """Return the parts of a pattern between `%`, and the number of characters that each of them matches."""
    parts = re.split("[%*]", pattern)
    expressions = ("".join("." if each in "_?" else re.escape(each) for each in part) for part in parts)
    return [(re.compile(each, re.DOTALL), len(part)) for each, part in zip(expressions, parts, strict=True)]


def _error(expression: str, problem: str) -> RCLError:
    shown = expression if len(expression) <= _MAX_SHOWN else f"{expression[:_MAX_SHOWN]}..."
    return RCLError(f"the content filter {shown!r} {problem}")
