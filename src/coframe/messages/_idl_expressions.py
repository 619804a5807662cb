# SPDX-License-Identifier: Apache-2.0
"""Values in IDL files: literals, names of constants, and expressions of them such as ``(1 << 4) + SIZE``.

Numbers have at most 64 bits and parentheses a limited depth, so that a short text cannot take long.
"""

from __future__ import annotations

import math
import operator
import re
from typing import TYPE_CHECKING, Any

from coframe.messages.limits import MAX_NESTING, check_digits

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.messages._idl_tokens import Token, Tokens

__all__ = ["evaluate"]

_BITS = 64
# From the weakest to the strongest; shifts are two tokens each.
_LEVELS = ({"|"}, {"^"}, {"&"}, {"<", ">"}, {"+", "-"}, {"*", "/", "%"})
_SHIFTS = 3
_SIGNS: dict[str, Callable[[Any], Any]] = {"-": operator.neg, "+": operator.pos, "~": operator.invert}
_FUNCTIONS: dict[str, Callable[[Any, Any], Any]] = {
    "|": operator.or_,
    "^": operator.xor,
    "&": operator.and_,
    "<": operator.lshift,
    ">": operator.rshift,
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
}


def evaluate(tokens: Tokens, constant: Callable[[Token], Any], *, in_brackets: bool = False) -> Any:
    """Take an expression and return its value: a number, a boolean or a string.

    Args:
        tokens: The tokens, of which the expression is taken.
        constant: Returns the value of a constant. Raises an error if the token is not the name of one.
        in_brackets: Whether a ``>`` ends the expression, as in ``sequence<octet, 4>``.

    Raises:
        InterfaceError: There is no expression.
        ValueError: It has no value: a number is too large, or an operator is applied to a string.
    """
    return _Expression(tokens, constant, in_brackets=in_brackets).binary(0, 0)


class _Expression:
    def __init__(self, tokens: Tokens, constant: Callable[[Token], Any], *, in_brackets: bool) -> None:
        self._tokens = tokens
        self._constant = constant
        self._in_brackets = in_brackets

    def binary(self, level: int, depth: int) -> Any:
        """Take operands, joined by operators of a level and stronger ones."""
        if level == len(_LEVELS):
            return self._unary(depth)
        value = self.binary(level + 1, depth)
        while (symbol := self._operator(level)) is not None:
            value = _apply(symbol, value, self.binary(level + 1, depth))
        return value

    def _operator(self, level: int) -> str | None:
        symbol = self._tokens.peek().text
        if symbol not in _LEVELS[level] or self._tokens.peek().kind != "mark" or (symbol == ">" and self._in_brackets):
            return None
        self._tokens.take()
        if level == _SHIFTS:
            self._tokens.expect(symbol)
        return symbol

    def _unary(self, depth: int) -> Any:
        if depth > MAX_NESTING:
            raise self._tokens.error(f"parentheses or signs are nested more than {MAX_NESTING} levels deep")
        token = self._tokens.peek()
        if token.kind == "string":
            return self._tokens.strings()
        self._tokens.take()
        if token.kind == "number":
            return _number(token.text)
        if token.kind == "mark" and token.text in _SIGNS:
            value = _require_number(self._unary(depth + 1), token.text)
            return _check_bits(_SIGNS[token.text](value))
        if token.kind == "mark" and token.text == "(":
            in_brackets, self._in_brackets = self._in_brackets, False
            value = self.binary(0, depth + 1)
            self._in_brackets = in_brackets
            self._tokens.expect(")")
            return value
        if token.text in {"TRUE", "FALSE"}:
            return token.text == "TRUE"
        return self._constant(token)


def _apply(symbol: str, left: Any, right: Any) -> Any:
    _require_number(left, symbol)
    _require_number(right, symbol)
    if symbol in {"<", ">"} and not 0 <= right < _BITS:
        raise ValueError(f"a value is shifted by {right} bits; the number of bits must be from 0 to {_BITS - 1}")
    if symbol in {"/", "%"}:
        return _divide_checked(symbol, left, right)
    return _check_bits(_FUNCTIONS[symbol](left, right))


def _divide_checked(symbol: str, left: Any, right: Any) -> Any:
    if right == 0:
        raise ValueError("a division by zero")
    if isinstance(left, float) or isinstance(right, float):
        return left / right if symbol == "/" else math.fmod(left, right)
    quotient = abs(left) // abs(right) * (1 if (left < 0) == (right < 0) else -1)  # as in C, towards zero
    return _check_bits(quotient if symbol == "/" else left - quotient * right)


def _require_number(value: Any, symbol: str) -> Any:
    is_integer = isinstance(value, int) and not isinstance(value, bool)
    if not is_integer and (not isinstance(value, float) or symbol not in {"+", "-", "*", "/", "%"}):
        raise ValueError(f"the operator {symbol} cannot be applied to {value!r}")
    return value


def _check_bits(value: Any) -> Any:
    if isinstance(value, int) and value.bit_length() > _BITS:
        raise ValueError(f"a value has {value.bit_length()} bits; the maximum is {_BITS}")
    return value


def _number(text: str) -> int | float:
    check_digits(text)
    if re.fullmatch(r"0[0-7]+", text):
        return int(text, 8)
    return int(_check_bits(int(text, 0))) if re.fullmatch(r"0[xX].*|0|[1-9]\d*", text) else float(text)
