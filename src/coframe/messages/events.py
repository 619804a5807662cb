# SPDX-License-Identifier: Apache-2.0
"""The event messages of services, in which services publish their requests and responses (service introspection).

The class of a service's events is created when it is first used, as ``SetBool.Event`` or ``SetBool_Event``.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from coframe.messages._class_factory import new_message_class
from coframe.messages.compounds import event
from coframe.messages.message import EVENT_SUFFIX, Service
from coframe.messages.registry import classes, find

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["create_event_class", "event_attributes"]


def create_event_class(ros_type: str) -> bool:
    """Create and register the class of a service's events.

    Args:
        ros_type: The name of the event type, such as ``std_srvs/srv/SetBool_Event``.

    Returns:
        Whether there is a service that has these events.
    """
    service_type = ros_type.removesuffix(EVENT_SUFFIX)
    try:
        service = find(service_type)
    except LookupError:
        return False
    if not issubclass(service, Service):
        return False
    package, kind, name = service_type.split("/")
    inner = {
        "service_msgs__msg__ServiceEventInfo": find("service_msgs/msg/ServiceEventInfo"),
        f"{package}__{kind}__{name}_Request": service.Request,
        f"{package}__{kind}__{name}_Response": service.Response,
    }
    if ros_type not in classes:
        new_message_class(ros_type, event(package, name, kind), inner)
    return True


def event_attributes(package: str, kind: str) -> Callable[[str], Any]:
    """Return the function ``__getattr__`` of a module of services, which finds ``SetBool_Event``."""

    def get(name: str) -> Any:
        ros_type = f"{package}/{kind}/{name}"
        if name.endswith(EVENT_SUFFIX) and create_event_class(ros_type):
            return classes[ros_type]
        raise AttributeError(f"module '{package}.{kind}' has no attribute {name!r}")

    return get
