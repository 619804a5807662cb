# SPDX-License-Identifier: Apache-2.0
"""Messages as YAML, CSV and dictionaries, exactly as ``ros2 topic echo`` prints them.

The arguments are the same everywhere. `truncate_length` limits the elements of sequences and the characters of strings;
`...` stands for the rest. `no_arr` and `no_str` replace sequences and strings by a description.
"""

import array
import sys
from collections import OrderedDict
from typing import Any

import numpy as np

from coframe._process.optional_imports import import_optional

__all__ = ["get_message_slot_types", "message_to_csv", "message_to_ordereddict", "message_to_yaml"]

_SEQUENCES = (list, tuple, array.array, np.ndarray)


def message_to_yaml(
    msg: Any,
    *,
    truncate_length: int | None = None,
    no_arr: bool = False,
    no_str: bool = False,
    flow_style: bool = False,
) -> str:
    """Return a message as YAML, in the order of its fields.

    Args:
        msg: The message.
        truncate_length: Limit of the elements of sequences and the characters of strings.
        no_arr: Whether to describe sequences by type and length.
        no_str: Whether to describe strings by length.
        flow_style: Whether to return one line.

    Raises:
        ModuleNotFoundError: PyYAML is not installed.
    """
    yaml = import_optional("yaml", "message_to_yaml", "params")
    content = message_to_ordereddict(msg, truncate_length=truncate_length, no_arr=no_arr, no_str=no_str)
    text: str = yaml.dump(
        content,
        Dumper=_dumper(yaml),
        allow_unicode=True,
        width=sys.maxsize,
        default_flow_style=flow_style,
    )
    return text


def message_to_csv(msg: Any, *, truncate_length: int | None = None, no_arr: bool = False, no_str: bool = False) -> str:
    """Return the values of a message separated by commas, in the order of its fields, without quotes.

    The arguments are the same as for `message_to_yaml`.
    """

    def text(value: Any, type_: Any = None) -> str:
        if isinstance(value, _SEQUENCES):
            described = no_arr and type_ is not None
            more = ["..."] if truncate_length is not None and len(value) > truncate_length else []
            return _describe(value, type_) if described else _join_values([*map(text, value[:truncate_length]), *more])
        if isinstance(value, (str, bytes)):
            if no_str:
                return _described_string(value)
            if isinstance(value, str):
                return _truncate(value, truncate_length)
            long = truncate_length is not None and len(value) > truncate_length
            return str(value[:truncate_length] + b"..." if long else value)
        if isinstance(value, (bool, int, float, np.number)):
            return str(value)
        return message_to_csv(value, truncate_length=truncate_length, no_arr=no_arr, no_str=no_str)

    slots = zip(msg.__slots__, msg.SLOT_TYPES, strict=False)
    return _join_values([text(getattr(msg, slot), type_) for slot, type_ in slots])


def message_to_ordereddict(
    msg: Any, *, truncate_length: int | None = None, no_arr: bool = False, no_str: bool = False
) -> OrderedDict[str, Any]:
    """Return a message as a dictionary of dictionaries, lists, strings and numbers, in the order of its fields.

    The arguments are the same as for `message_to_yaml`.
    """
    options: dict[str, Any] = {"truncate_length": truncate_length, "no_arr": no_arr, "no_str": no_str}
    # Jazzy's messages have one more slot than types.
    slots = zip(msg.__slots__, msg.SLOT_TYPES, strict=False)
    return OrderedDict((slot[1:], _as_plain_value(getattr(msg, slot), type_, **options)) for slot, type_ in slots)


def get_message_slot_types(msg: Any) -> OrderedDict[str, Any]:
    """Return the type of each field of a message, in order.

    Args:
        msg: A message or its class.
    """
    return OrderedDict((slot[1:], type_) for slot, type_ in zip(msg.__slots__, msg.SLOT_TYPES, strict=False))


def _as_plain_value(
    value: Any, type_: Any = None, *, truncate_length: int | None = None, no_arr: bool = False, no_str: bool = False
) -> Any:
    """Return a value of a field as YAML can represent it."""
    options: dict[str, Any] = {"truncate_length": truncate_length, "no_arr": no_arr, "no_str": no_str}
    if isinstance(value, bytes):
        return _truncate("".join(map(chr, value)), truncate_length)
    if isinstance(value, str):
        return _described_string(value) if no_str else _truncate(value, truncate_length)
    if isinstance(value, _SEQUENCES):
        return _describe(value, type_) if no_arr and type_ is not None else _items(value, options)
    if isinstance(value, (bool, int, float, np.generic)):
        return value.item() if isinstance(value, np.generic) else value
    return message_to_ordereddict(value, **options)


def _items(sequence: Any, options: dict[str, Any]) -> list[Any]:
    limit = options["truncate_length"]
    shown = sequence[:limit]
    numbers = isinstance(shown, (array.array, np.ndarray))
    items: list[Any] = shown.tolist() if numbers else [_as_plain_value(item, **options) for item in shown]
    return items if limit is None or len(sequence) <= limit else [*items, "..."]


def _truncate(text: str, limit: int | None) -> str:
    return text if limit is None or len(text) <= limit else f"{text[:limit]}..."


def _join_values(values: list[str]) -> str:
    """Join values with commas as ROS does, which writes no comma after values that are empty and come first."""
    first = next((index for index, value in enumerate(values) if value), len(values))
    return ",".join(values[first:])


def _described_string(value: str | bytes) -> str:
    return f"<string length: <{len(value)}>>"


def _describe(value: Any, type_: Any) -> str:
    """Return the type and length of a sequence. The types of ROS and of coframe have the same names and attributes."""
    name = _type_name(type_.value_type)
    kind = type(type_).__name__
    if kind == "Array":
        return f"<array type: {name}[{type_.size}]>"
    if kind == "BoundedSequence":
        return f"<sequence type: {name}[{type_.maximum_size}], length: {len(value)}>"
    return f"<sequence type: {name}, length: {len(value)}>"


def _type_name(type_: Any) -> str:
    if hasattr(type_, "namespaced_name"):
        return "/".join(type_.namespaced_name())
    if hasattr(type_, "typename"):
        return str(type_.typename)
    return "wstring" if "WString" in type(type_).__name__ else "string"


_dumpers: dict[Any, Any] = {}


def _dumper(yaml: Any) -> Any:
    """Return a dumper that writes an OrderedDict as a mapping in its own order, without changing PyYAML for others."""
    if yaml not in _dumpers:
        dumper = type("MessageDumper", (yaml.Dumper,), {})
        dumper.add_representer(  # type: ignore[attr-defined]
            OrderedDict, lambda dumper, data: dumper.represent_mapping("tag:yaml.org,2002:map", data.items())
        )
        _dumpers[yaml] = dumper
    return _dumpers[yaml]
