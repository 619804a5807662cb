# SPDX-License-Identifier: Apache-2.0
"""The registry of message, service and action classes by ROS type name."""

from __future__ import annotations

import importlib
import re
from typing import Any

from coframe.messages.definition import NamespacedType, ResolvedType

_TYPE_NAME = re.compile(r"([a-z][a-z0-9_]*)/(msg|srv|action)/([A-Za-z]\w*)")

# Classes by ROS type name; each class is added when it is created.
classes: dict[str, Any] = {}


def find(ros_type: str) -> Any:
    """Return the class of a ROS type.

    Args:
        ros_type: The full name, such as ``tf2_msgs/msg/TFMessage``, ``std_srvs/srv/SetBool`` or
            ``std_srvs/srv/SetBool_Request``.

    Raises:
        LookupError: The name is not a full type name, or coframe does not have the type.
    """
    if ros_type in classes:
        return classes[ros_type]
    match = _TYPE_NAME.fullmatch(ros_type)
    if match is None:
        raise LookupError(f"{ros_type!r} is not a full ROS type name such as 'geometry_msgs/msg/Pose'")
    package, kind, name = match.groups()
    if not _load(package, kind, name):
        raise LookupError(f"no type {ros_type}: coframe has no package {package} with {kind} types")
    if ros_type not in classes and not (name.endswith("_Event") and _create_event_class(ros_type)):
        raise LookupError(f"no type {ros_type}: package {package} has no {kind} type {name}")
    return classes[ros_type]


def _create_event_class(ros_type: str) -> bool:
    from coframe.messages.events import create_event_class  # noqa: PLC0415 - it imports this module

    return create_event_class(ros_type)


def class_of(type_: NamespacedType) -> Any:
    """Return the class of the messages in a field.

    Raises:
        LookupError: coframe does not have the type.
    """
    return type_.message_class if isinstance(type_, ResolvedType) else find("/".join(type_.namespaced_name()))


def _load(package: str, kind: str, name: str) -> bool:
    """Register the classes with a name if they exist, and return whether the package has types of this kind."""
    module = f"{__package__}.generated.{package}.{kind}"
    try:
        importlib.import_module(module)
    except ModuleNotFoundError as error:
        if error.name is None or not module.startswith(error.name):
            raise
    else:
        return True
    from coframe.messages.packages import find_package  # noqa: PLC0415 - it imports this module

    found = find_package(package)
    if found is None or kind not in found.kinds():
        return False
    found.create(kind, name)
    return True
