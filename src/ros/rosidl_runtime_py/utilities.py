# SPDX-License-Identifier: Apache-2.0
"""Classes of interfaces by name."""

import importlib
from typing import Any

__all__ = ["get_action", "get_interface", "get_message", "get_service", "is_action", "is_message", "is_service"]


def get_interface(identifier: str) -> Any:
    """Return the class of a message, service or action.

    Args:
        identifier: Name such as `std_msgs/msg/String`.

    Raises:
        ValueError: The identifier has no slash.
        ModuleNotFoundError: There is no such package, or it has no interfaces of this kind.
        AttributeError: The package has no interface with this name.
    """
    module, separator, name = identifier.rpartition("/")
    if not (module and separator and name):
        raise ValueError(f"Expected the full name of an interface, such as 'std_msgs/msg/String', got '{identifier}'")
    return getattr(importlib.import_module(module.replace("/", ".")), name)


def get_message(identifier: str) -> Any:
    """Return the class of a message. It raises the same errors as `get_interface`.

    Raises:
        ValueError: The interface is not a message.
    """
    interface = get_interface(identifier)
    if not is_message(interface):
        raise ValueError(f"Expected '{identifier}' to be a message")
    return interface


def get_service(identifier: str) -> Any:
    """Return the class of a service. It raises the same errors as `get_interface`.

    Raises:
        ValueError: The interface is not a service.
    """
    interface = get_interface(identifier)
    if not is_service(interface):
        raise ValueError(f"Expected '{identifier}' to be a service")
    return interface


def get_action(identifier: str) -> Any:
    """Return the class of an action. It raises the same errors as `get_interface`.

    Raises:
        ValueError: The interface is not an action.
    """
    interface = get_interface(identifier)
    if not is_action(interface):
        raise ValueError(f"Expected '{identifier}' to be an action")
    return interface


def is_message(interface: Any) -> bool:
    """Return whether an object is a message or the class of one."""
    return hasattr(interface, "_fields_and_field_types")


def is_service(interface: Any) -> bool:
    """Return whether an object is the class of a service."""
    return hasattr(interface, "Request") and hasattr(interface, "Response")


def is_action(interface: Any) -> bool:
    """Return whether an object is the class of an action."""
    return hasattr(interface, "Goal") and hasattr(interface, "Result") and hasattr(interface, "Feedback")
