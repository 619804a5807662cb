# SPDX-License-Identifier: Apache-2.0
"""Arrow's arrays of the values of a column."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from coframe.bags.tables._leaves import DTYPES, class_fields
from coframe.messages.definition import AbstractGenericString, AbstractNestedType, Array, BasicType

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from coframe.bags.tables._leaves import Leaf

__all__ = ["arrow_array", "arrow_struct"]

_Value = tuple["Leaf", "NDArray[Any]", "NDArray[np.bool_]"]


def arrow_array(pyarrow: Any, leaf: Leaf, array: NDArray[Any], known: NDArray[np.bool_]) -> Any:
    """Return the values as an array of Arrow, in which those that are not known are null."""
    type_ = arrow_type(pyarrow, leaf, array.dtype)
    if array.ndim == 2:
        flat_array = pyarrow.array(np.ascontiguousarray(array).reshape(-1))
        return pyarrow.FixedSizeListArray.from_arrays(flat_array, type=type_, mask=pyarrow.array(~known))
    if leaf.kind == "list":
        values = [_to_plain_data(value) if is_known else None for value, is_known in zip(array, known, strict=True)]
        return pyarrow.array(values, type=type_)
    return pyarrow.array(array, type=type_, mask=~known)


def arrow_struct(pyarrow: Any, values: Sequence[_Value], valid: NDArray[np.bool_]) -> Any:
    """Return the values of a column as one array: a struct that is nested like its message."""
    if len(values) == 1 and not values[0][0].steps:
        return arrow_array(pyarrow, *values[0])
    return _nested_array(pyarrow, list(values), 0, valid)


def _nested_array(pyarrow: Any, values: list[_Value], depth: int, valid: NDArray[np.bool_] | None) -> Any:
    groups: dict[str, list[_Value]] = {}
    for value in values:
        groups.setdefault(value[0].steps[depth], []).append(value)
    children = [
        arrow_array(pyarrow, *group[0])
        if len(group) == 1 and len(group[0][0].steps) == depth + 1
        else _nested_array(pyarrow, group, depth + 1, None)
        for group in groups.values()
    ]
    mask = None if valid is None else pyarrow.array(~valid)
    return pyarrow.StructArray.from_arrays(children, names=list(groups), mask=mask)


def arrow_type(pyarrow: Any, leaf: Leaf, dtype: np.dtype[Any]) -> Any:
    """Return the type of a value; it depends on the definition of the message, not on the values."""
    if leaf.kind == "array":
        return pyarrow.list_(pyarrow.from_numpy_dtype(dtype), leaf.size)
    if leaf.kind == "numbers":
        # Sequences between two messages are float64.
        return pyarrow.list_(pyarrow.from_numpy_dtype(leaf.dtype))
    if leaf.kind == "list":
        return _defined_type(pyarrow, leaf.type_)
    return {"text": pyarrow.string(), "bytes": pyarrow.binary()}.get(leaf.kind) or pyarrow.from_numpy_dtype(dtype)


def _defined_type(pyarrow: Any, type_: Any) -> Any:
    if isinstance(type_, BasicType):
        return pyarrow.from_numpy_dtype(DTYPES[type_.typename])
    if isinstance(type_, AbstractGenericString):
        return pyarrow.string()
    if isinstance(type_, AbstractNestedType):
        inner = _defined_type(pyarrow, type_.value_type)
        return pyarrow.list_(inner, type_.size) if isinstance(type_, Array) else pyarrow.list_(inner)
    return pyarrow.struct([(name, _defined_type(pyarrow, inner)) for name, inner in class_fields(type_).items()])


def _to_plain_data(value: Any) -> Any:
    """Return a message as a dictionary, and a sequence as a list."""
    if hasattr(type(value), "SLOT_TYPES"):
        return {name: _to_plain_data(getattr(value, name)) for name in class_fields(type(value))}
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, bytes):
        return value[0] if len(value) == 1 else 0
    if isinstance(value, str) or not hasattr(value, "__iter__"):
        return value
    return [_to_plain_data(each) for each in value]
