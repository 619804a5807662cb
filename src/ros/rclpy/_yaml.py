# SPDX-License-Identifier: Apache-2.0
"""Parser of parameter values on the command line and in parameter files, with ROS's typing rules."""

from __future__ import annotations

import math
import re
from typing import TYPE_CHECKING, Any, Final

from coframe.bounded_yaml import MAX_BYTES, compose_yaml
from coframe.optional_imports import pip_install
from coframe.regular_files import read_regular

if TYPE_CHECKING:
    from collections.abc import Iterator

_TRUE: Final = {"y", "yes", "true", "on"}
_FALSE: Final = {"n", "no", "false", "off"}
_SPECIAL_FLOATS: Final = {".nan": "nan", ".inf": "inf", "+.inf": "inf", "-.inf": "-inf"}
_NOT_FINITE: Final = {"nan", "inf", "infinity"}
_INTEGER: Final = re.compile(r"[-+]?(0[xX][0-9a-fA-F]+|0[0-7]*|[1-9]\d*)")
_FLOAT: Final = re.compile(r"[-+]?((\d+\.?\d*|\.\d+)([eE][-+]?\d+)?|nan|inf|infinity)", re.IGNORECASE)
_MAX_DIGITS: Final = 30  # of an integer with 64 bits, in any form
_ITEM: Final = re.compile(r"""\s*("(?:[^"\\]|\\.)*"|'(?:[^']|'')*'|[^,\]]*?)\s*(,|$)""")


def parse_scalar(text: str) -> bool | int | float | str:
    """Return the typed value of an unquoted word."""
    lower = text.lower()
    if lower in _TRUE | _FALSE:
        return lower in _TRUE
    if lower in _SPECIAL_FLOATS:
        return float(_SPECIAL_FLOATS[lower])
    if _INTEGER.fullmatch(text) and (number := _integer(lower)) is not None:
        return number
    if _FLOAT.fullmatch(text):
        value = float(text)
        is_in_range = math.isfinite(value) or lower.lstrip("+-") in _NOT_FINITE
        return value if is_in_range else text
    return text


def _integer(text: str) -> int | None:
    """Return an integer as C's strtol reads it, also in hexadecimal or octal form; None above 64 bits."""
    digits = text.lstrip("+-")
    base = 16 if digits.startswith("0x") else 8 if digits.startswith("0") else 10
    number = int(text, base) if len(text) <= _MAX_DIGITS else 2**63
    return number if -(2**63) <= number < 2**63 else None


def parse_value(text: str) -> Any:
    """Return the typed value of the text after `name:=`: a word, a quoted string, or a list in square brackets."""
    text = text.strip()
    if text.startswith("[") and text.endswith("]"):
        return _checked_list(list(_parse_items(text[1:-1])))
    return _parse_word(text)


def _checked_list(values: list[Any]) -> list[Any]:
    """Return the list if its values have one type.

    Raises:
        ValueError: They have several types.
    """
    for value in values:
        if type(value) is not type(values[0]):
            kind = {bool: "bool", int: "integer", float: "double", str: "string"}[type(value)]
            raise ValueError(f"Sequence should be of same type. Value type '{kind}' do not belong at line_num 1")
    return values


def _parse_items(text: str) -> Iterator[Any]:
    position = 0
    while position < len(text):
        item = _ITEM.match(text, position)
        if item is None or item.end() == position:
            raise ValueError(f"[{text}] is not a list of values")
        if item[1]:
            yield _parse_word(item[1])
        position = item.end()


def _parse_word(text: str) -> bool | int | float | str:
    if len(text) >= 2 and text[0] == text[-1] == "'":
        return text[1:-1].replace("''", "'")
    if len(text) >= 2 and text[0] == text[-1] == '"':
        return re.sub(r"\\(.)", r"\1", text[1:-1])
    return parse_scalar(text)


def load_parameters(path: str) -> Iterator[tuple[str, str, Any]]:
    """Read a parameter file.

    Yields:
        Tuples (pattern of node names, name of the parameter, value).

    Raises:
        OSError: The file cannot be read.
        ValueError: It is not a parameter file, exceeds a limit, or PyYAML is not installed.
    """
    try:
        root = compose_yaml(read_regular(path, MAX_BYTES))
    except ImportError:
        raise ValueError(f"reading it needs the package PyYAML: {pip_install('params')}") from None
    yield from _nodes(_python_of(root), "")


class _Mapping(list[tuple[str, Any]]):
    """The names and values of a YAML mapping. A name may occur several times: ROS 2 reads all blocks of a node."""


def _python_of(node: Any) -> Any:
    """Return a YAML node as Python values. PyYAML's own typing differs from ROS's (1e5, .5, ...)."""
    if node is None:
        return _Mapping()
    if node.id == "mapping":
        return _Mapping((_name(key), _python_of(value)) for key, value in node.value)
    if node.id == "sequence":
        return [_python_of(value) for value in node.value]
    return node.value if node.style else parse_scalar(node.value)


def _name(node: Any) -> str:
    if not isinstance(node.value, str):
        raise ValueError(f"expected a name on line {node.start_mark.line + 1}, found a list or a mapping")  # noqa: TRY004
    return node.value


def _nodes(tree: Any, prefix: str) -> Iterator[tuple[str, str, Any]]:
    if not isinstance(tree, _Mapping):
        raise ValueError(f"expected node names with `ros__parameters:` below them, found {tree!r}")  # noqa: TRY004
    for key, value in tree:
        if key == "ros__parameters":
            for name, parameter in _flatten(value, ""):
                yield prefix or "/**", name, parameter
        else:
            yield from _nodes(value, f"{prefix}/{key.strip('/')}")


def _flatten(tree: Any, prefix: str) -> Iterator[tuple[str, Any]]:
    if not isinstance(tree, _Mapping) and tree not in (None, ""):
        raise ValueError(f"expected names and values below `ros__parameters:`, found {tree!r}")
    for key, value in tree or ():
        if isinstance(value, _Mapping):
            yield from _flatten(value, f"{prefix}{key}.")
        else:
            yield f"{prefix}{key}", value
