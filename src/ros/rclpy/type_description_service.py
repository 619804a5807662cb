# SPDX-License-Identifier: Apache-2.0
"""The service `~/get_type_description`, with which tools ask a node for the definitions of its types."""

# The modules of rclpy share attributes named `_Coframe__x`, the form of mangled names.
# ruff: noqa: SLF001

from __future__ import annotations

import re
from contextlib import suppress
from functools import partial
from typing import TYPE_CHECKING, Any, Final

from coframe.messages.definition_texts import source_of
from coframe.messages.registry import find
from coframe.messages.type_hash import description_text, type_hash
from rcl_interfaces.msg import ParameterDescriptor, ParameterType
from rclpy import _absent
from rclpy.parameter import Parameter
from rclpy.qos import qos_profile_services_default

if TYPE_CHECKING:
    from rclpy.node import Node
    from rclpy.service import Service

__all__ = ["START_TYPE_DESCRIPTION_SERVICE_PARAM", "TypeDescriptionService"]

START_TYPE_DESCRIPTION_SERVICE_PARAM: Final = "start_type_description_service"
_SERVICE: Final = "type_description_interfaces/srv/GetTypeDescription"
_HASH = re.compile("RIHS01_[0-9a-f]{64}")
_UNUSED: Final = "Type not currently in use by this node"


class TypeDescriptionService:
    """Declares the parameter `start_type_description_service`, and starts the service unless it is false.

    Args:
        node: Node that serves it.
    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self._service: Service | None = None
        self.service_name = f"{node.get_name()}/get_type_description"
        self.enabled = False
        name = START_TYPE_DESCRIPTION_SERVICE_PARAM
        if not node.has_parameter(name):
            descriptor = ParameterDescriptor(
                name=name,
                type=ParameterType.PARAMETER_BOOL,
                description="If enabled, start the ~/get_type_description service.",
                read_only=True,
            )
            node.declare_parameter(name, True, descriptor)
        parameter = node.get_parameter(name)
        if parameter.type_ is Parameter.Type.BOOL:
            self.enabled = bool(parameter.value)
        elif parameter.type_ is not Parameter.Type.NOT_SET:
            node.get_logger().error(f"Invalid type for parameter '{name}' {parameter.type_!r} should be bool")
        if self.enabled:
            self._service = node.create_service(
                find(_SERVICE), "~/get_type_description", self._answer, qos_profile=qos_profile_services_default
            )

    def destroy(self) -> None:
        """Stop the service."""
        service, self._service = self._service, None
        if service is not None:
            self._node.destroy_service(service)

    def _answer(self, request: Any, response: Any) -> Any:
        if not _HASH.fullmatch(request.type_hash):
            response.failure_reason = "Failed to parse type hash"
            return response
        interface = self._interface(request.type_name, request.type_hash)
        if interface is None:
            response.failure_reason = _UNUSED
            return response
        import json  # noqa: PLC0415 - few programs ask for a description

        description = json.loads(description_text(interface))
        response.type_description.type_description = _individual(description["type_description"])
        response.type_description.referenced_type_descriptions = [
            _individual(each) for each in description["referenced_type_descriptions"]
        ]
        if request.include_type_sources:
            names = [interface.ROS_TYPE, *(each["type_name"] for each in description["referenced_type_descriptions"])]
            response.type_sources = [_source(name) for name in names]
        response.successful = True
        return response

    def _interface(self, name: str, hash_: str) -> Any:
        """Return the class with a type hash, by its name or among those of the node, or None if it is unknown."""
        entities = self._node._Coframe__entities.all()
        used = [getattr(entity, "msg_type", None) or getattr(entity, "srv_type", None) for entity in entities]
        with suppress(LookupError):
            used.insert(0, find(name))
        return next((each for each in used if each is not None and type_hash(each) == hash_), None)


def _individual(description: dict[str, Any]) -> Any:
    """Return a `type_description_interfaces/msg/IndividualTypeDescription`."""
    field_class, type_class = (find(f"type_description_interfaces/msg/{name}") for name in ("Field", "FieldType"))
    fields = [field_class(name=each["name"], type=type_class(**each["type"])) for each in description["fields"]]
    whole = find("type_description_interfaces/msg/IndividualTypeDescription")
    return whole(type_name=description["type_name"], fields=fields)


def _source(name: str) -> Any:
    """Return a `type_description_interfaces/msg/TypeSource`; parts of services and actions have no file."""
    encoding, text = source_of(name)
    source_class = find("type_description_interfaces/msg/TypeSource")
    return source_class(type_name=name, encoding=encoding, raw_file_contents=text)


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
