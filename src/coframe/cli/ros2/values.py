# SPDX-License-Identifier: Apache-2.0
"""Values of messages, requests and parameters that are written as YAML on the command line."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from coframe.bounded_yaml import read_yaml
from coframe.cli.output import fail

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["read_values", "yaml_value"]


def yaml_value(text: str, what: str) -> Any:
    """Return the value of a YAML text; end the command if it is not valid YAML.

    Args:
        text: The text.
        what: What it is, for the error: "VALUES".
    """
    try:
        return read_yaml(text)
    except ValueError as error:
        fail(f"{what}: {text[:60]!r} is not valid YAML: {str(error).splitlines()[0]}", code=2)


def read_values(message: Any, text: str) -> Callable[[Any], None]:
    """Set the fields of a message from YAML.

    Args:
        message: The message, or request or goal.
        text: A YAML dictionary of fields.

    Returns:
        A function that sets the stamps which are written as "now" or "auto" to a time message.
    """
    values = yaml_value(text or "{}", "VALUES")
    if values is None:
        values = {}
    if not isinstance(values, dict):
        fail("The passed value needs to be a dictionary in YAML format", "Example: '{data: hello}'", code=2)
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


def _name(message: Any) -> str:
    module = type(message).__module__.split(".")
    return f"{module[0]}/{module[1] if len(module) > 1 else 'msg'}/{type(message).__name__}"
