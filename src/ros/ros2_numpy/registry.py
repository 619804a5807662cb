# SPDX-License-Identifier: Apache-2.0
"""The registry of conversions by message class."""

from collections.abc import Callable
from typing import Any, TypeVar

__all__ = ["converts_from_numpy", "converts_to_numpy", "msgify", "numpify"]

Function = TypeVar("Function", bound=Callable[..., Any])

# Functions by message class, and whether they convert a list of messages.
_to_numpy: dict[tuple[Any, bool], Callable[..., Any]] = {}
_from_numpy: dict[tuple[Any, bool], Callable[..., Any]] = {}


def converts_to_numpy(msgtype: Any, plural: bool = False) -> Callable[[Function], Function]:
    """Return a decorator that registers a function for `numpify`.

    Args:
        msgtype: Class of the messages.
        plural: Whether the function converts a list of messages.
    """

    def register(function: Function) -> Function:
        _to_numpy[msgtype, plural] = function
        return function

    return register


def converts_from_numpy(msgtype: Any, plural: bool = False) -> Callable[[Function], Function]:
    """Return a decorator that registers a function for `msgify`. The arguments are those of `converts_to_numpy`."""

    def register(function: Function) -> Function:
        _from_numpy[msgtype, plural] = function
        return function

    return register


def numpify(msg: Any, *args: Any, **kwargs: Any) -> Any:
    """Return a message, or a list of messages, as a NumPy object.

    Args:
        msg: The message.
        args: Arguments of the conversion of this class.
        kwargs: Keyword arguments of the conversion of this class.

    Raises:
        ValueError: There is no conversion for this class, or a list is empty.
    """
    if msg is None:
        raise ValueError("Cannot determine the type of NoneType")
    plural = isinstance(msg, (list, tuple))
    if plural and not msg:
        raise ValueError("Cannot determine the type of an empty Collection")
    return _find(_to_numpy, type(msg[0]) if plural else type(msg), plural)(msg, *args, **kwargs)


def msgify(msg_type: Any, numpy_obj: Any, *args: Any, **kwargs: Any) -> Any:
    """Return a NumPy object as a message.

    Args:
        msg_type: Class of the message. A list with one class: the result is a list of messages.
        numpy_obj: The object.
        args: Arguments of the conversion of this class.
        kwargs: Keyword arguments of the conversion of this class.

    Raises:
        ValueError: There is no conversion for this class.
    """
    plural = isinstance(msg_type, (list, tuple))
    return _find(_from_numpy, msg_type[0] if plural else msg_type, plural)(numpy_obj, *args, **kwargs)


def _find(functions: dict[tuple[Any, bool], Callable[..., Any]], class_: Any, plural: bool) -> Callable[..., Any]:
    if (class_, plural) not in functions:
        known = ", ".join(f"{known.__name__}{'[]' if many else ''}" for known, many in functions)
        name = f"{class_.__name__}{'[]' if plural else ''}"
        raise ValueError(f"Unable to convert message {name} - only supports {known}")
    return functions[class_, plural]
