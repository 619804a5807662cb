# SPDX-License-Identifier: Apache-2.0
"""Compute the values of expressions: message fields, pose quantities, and rates; also used for live curves."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from coframe._output.formatting import did_you_mean, join_names
from coframe.errors import CoframeError, PlotError
from coframe.plotting.expressions import Expression, FieldExpression, PoseExpression
from coframe.time import SECOND
from coframe.transform.quantities import ANGLES

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = ["NoElementError", "axis_title", "field_content", "field_names", "field_value", "rates"]

_WINDOW = SECOND  # of rates
_MAX_LISTED_NAMES = 12  # names in a hint


def axis_title(expression: Expression) -> str:
    """Return the title of the axis of the values; curves with the same title share a plot."""
    if isinstance(expression, PoseExpression):
        return "angle [rad]" if expression.quantity in ANGLES else "position [m]"
    if isinstance(expression, FieldExpression):
        names = [step for step in expression.path if isinstance(step, str)]
        group = names[-2:-1] or names[-1:]
        return group[0] if isinstance(expression.path[-1], str) else names[-1]
    return "delay [s]" if expression.quantity == "delay" else "rate [Hz]"


class NoElementError(CoframeError, LookupError):
    """A sequence in a message is too short for the index."""


def field_content(message: Any, expression: FieldExpression, type_: str) -> Any:
    """Return the content of a field of any type.

    Args:
        message: The message; bytes if the definition of its type is unknown.
        expression: The field.
        type_: The type of the message.

    Raises:
        PlotError: The field does not exist.
        NoElementError: A sequence is too short for an index.
    """
    if isinstance(message, bytes):
        raise PlotError(f"{expression.text}: the messages have the type {type_}, whose definition is unknown")
    value, written = message, expression.topic
    for step in expression.path:
        value = _select_step(value, step, written, expression)
        written += f"[{step}]" if isinstance(step, int) else f".{step}"
    return value


def field_value(message: Any, expression: FieldExpression, type_: str) -> float:
    """Return the value of a numeric field.

    Args:
        message: The message; bytes if the definition of its type is unknown.
        expression: The field.
        type_: The type of the message.

    Raises:
        PlotError: The field does not exist or is not a number.
        NoElementError: A sequence is too short for an index.
    """
    value = field_content(message, expression, type_)
    if isinstance(value, bool | int | float | np.number | np.bool_):
        return float(value)
    if isinstance(value, str):
        raise PlotError(f"{expression.text} is a string, not a number: {value[:40]!r}")
    names = field_names(value)
    if names:
        hint = f"Choose a field: {join_names(f'{expression.text}.{name}' for name in names)}."
        raise PlotError(f"{expression.text} is a message, not a number", hint=hint)
    hint = f"Choose an element, such as {expression.text}[0]."
    raise PlotError(f"{expression.text} is a sequence, not a number", hint=hint)


def _select_step(value: Any, step: str | int, written: str, expression: FieldExpression) -> Any:
    if isinstance(step, int):
        if isinstance(value, str) or not hasattr(value, "__getitem__") or isinstance(value, dict):
            raise PlotError(f"{expression.text}: {written} is not a sequence, so it has no element {step}")
        try:
            return value[step]
        except IndexError:
            raise NoElementError from None
    names = field_names(value)
    if step not in names:
        if not names and hasattr(value, "__len__") and not isinstance(value, str):
            raise PlotError(
                f"{expression.text}: {written} is a sequence, which has no field {step!r}",
                hint=f"Choose an element, such as {written}[0].{step}.",
            )
        known = (
            f"Fields: {', '.join(names[:_MAX_LISTED_NAMES])}{', ...' if len(names) > _MAX_LISTED_NAMES else ''}."
            if names
            else ""
        )
        hint = f"{did_you_mean(step, names)} {known}".strip()
        raise PlotError(f"{expression.text}: {written} has no field {step!r}", hint=hint)
    return value[step] if isinstance(value, dict) else getattr(value, step)


def field_names(value: Any) -> list[str]:
    """Return the names of the fields of a message of ROS, JSON or protobuf; none for other values."""
    if isinstance(value, dict):
        return list(map(str, value))
    if hasattr(value, "get_fields_and_field_types"):
        return list(value.get_fields_and_field_types())
    descriptor = getattr(value, "DESCRIPTOR", None)
    if descriptor is not None:
        return [each.name for each in descriptor.fields]
    return list(getattr(value, "__dataclass_fields__", ()))


def rates(times: NDArray[np.int64]) -> NDArray[np.float64]:
    """Return the mean rate before each of the sorted times; NaN until enough time has passed.

    The mean begins at the last message that is at least a second older, so that a burst after a pause has no high rate.
    """
    window = min(_WINDOW, int(times[-1] - times[0]) // 2) if times.size else 0
    first = np.searchsorted(times, times - window, side="right") - 1
    elapsed = (times - times[np.maximum(first, 0)]) / SECOND
    means: NDArray[np.float64] = np.full(len(times), np.nan)
    np.divide(np.arange(len(times)) - first, elapsed, out=means, where=(first >= 0) & (elapsed > 0))
    return means
