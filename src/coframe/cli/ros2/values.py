# SPDX-License-Identifier: Apache-2.0
"""Parse values of messages, requests and parameters given as YAML on the command line."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

from coframe._files.bounded_yaml import error_position, read_yaml
from coframe._files.regular_files import read_regular, reading_hint
from coframe.cli.output import fail

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

__all__ = ["read_documents", "read_values", "yaml_value"]

MAX_FILE = 16 << 20  # bytes of a file with messages
_MAX_EXCERPT = 60  # characters of an invalid text in an error message
_MAX_EXAMPLE_LENGTH = 150
# Error messages of the YAML parsers (C and Python), and what they mean for the user.
_REASONS = {
    "found unexpected ':'": "a space is missing after the colon",
    "',' or '}'": "a comma or } is missing, or a string with special characters has no quotes",
    "',' or ']'": "a comma or ] is missing, or a string with special characters has no quotes",
    "mapping values are not allowed": "the line contains a second colon; a string that contains a colon and a space "
    "needs "
    "quotes",
    "unexpected end of stream": "a quote is missing",
    "cannot start any token": "a string that begins with this character needs quotes",
    "expected node content": "a value or a closing bracket is missing",
    "undefined alias": "a string that begins with * needs quotes",
    "<document start>": "text follows the end of the values",
}


def yaml_value(text: str, what: str, hint: str = "") -> Any:
    """Return the value of a YAML document, or end the command if it is not valid YAML.

    Args:
        text: The YAML text, as given on the command line.
        what: Its name in error messages, such as "VALUES".
        hint: Advice for the user.
    """
    try:
        return read_yaml(text)
    except ValueError as error:
        position = error_position(error)
        if position is None:
            fail(f"{what} is not valid YAML: {error}", hint, code=2)
        lines = text.splitlines() or [""]
        # A missing end is reported after the last line.
        row, column = position if position[0] < len(lines) else (len(lines) - 1, len(lines[-1]))
        reason = next((ours for theirs, ours in _REASONS.items() if theirs in str(error)), str(error))
        where = f"line {row + 1}, character {column + 1}" if len(lines) > 1 else f"character {column + 1}"
        start = max(0, column - _MAX_EXCERPT // 2)
        shown = lines[row][start : start + _MAX_EXCERPT]
        pointer = f"    {shown}\n    {' ' * (column - start)}^"
        fail(f"{what} is not valid YAML at {where}: {reason}", hint, code=2, details=pointer)


def read_documents(path: Path) -> list[str]:
    """Return the YAML documents of a file, which lines of three hyphens separate; end the command if there are none."""
    try:
        text = read_regular(path, MAX_FILE).decode()
    except UnicodeDecodeError:
        fail(f"{path} is not a text file in UTF-8.")
    except OSError as error:
        fail(f"{path} cannot be read: {error.strerror or error}", reading_hint(error))
    documents = [each for each in re.split(r"^---[ \t]*$", text, flags=re.MULTILINE) if each.strip()]
    if not documents:
        fail(f"{path} contains no message.", "It has the format of the output of coframe topic echo.")
    return documents


def read_values(message: Any, text: str) -> Callable[[Any], None]:
    """Set the fields of a message from YAML.

    Args:
        message: The message, or request or goal.
        text: A YAML dictionary of fields.

    Returns:
        A function that sets the stamps which are written as "now" or "auto" to a time message.
    """
    example = f"Example for {_name(message)}: '{_example(message)}'"
    values = yaml_value(text or "{}", "VALUES", example)
    if values is None:
        values = {}
    if not isinstance(values, dict):
        fail(f"The passed value needs to be a dictionary in YAML format, not {text[:_MAX_EXCERPT]!r}", example, code=2)
    for field in values:
        if isinstance(field, str) and ":" in field and values[field] is None:
            fail(f"VALUES: {field!r} is not a field: a space is missing after the colon", example, code=2)
    from rosidl_runtime_py import set_message_fields  # noqa: PLC0415 - slow import

    try:
        stamps = set_message_fields(message, values, expand_header_auto=True, expand_time_now=True) or []
    except Exception as error:  # noqa: BLE001 - any value that a field does not accept
        fail(
            f"Failed to populate field: {error}",
            f"coframe interface show lists the fields of {_name(message)}.",
            code=2,
        )

    def fill(now: Any) -> None:
        for setter in stamps:
            setter(now)

    return fill


def _example(message: Any) -> str:
    """Return values for the first fields of a message, without the quotes of a shell."""
    fields: list[str] = []
    for field in message.get_fields_and_field_types():
        if value := _example_value(getattr(message, field)):
            fields.append(f"{field}: {value}")
        if sum(map(len, fields)) > _MAX_EXAMPLE_LENGTH:
            break
    return f"{{{', '.join(fields)}}}"


def _example_value(value: Any) -> str:
    """Return a value as YAML, or "" for arrays, which an example can omit."""
    if hasattr(value, "get_fields_and_field_types"):
        return _example(value)
    if isinstance(value, str):
        return "hello"
    return str(value).lower() if isinstance(value, bool | int | float) else ""


def _name(message: Any) -> str:
    module = type(message).__module__.split(".")
    return f"{module[0]}/{module[1] if len(module) > 1 else 'msg'}/{type(message).__name__}"
