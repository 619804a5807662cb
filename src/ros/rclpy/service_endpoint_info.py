# SPDX-License-Identifier: Apache-2.0
"""Information about clients and servers of services in the graph."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import IntEnum
from functools import partial
from typing import TYPE_CHECKING

from rclpy import _absent
from rclpy.topic_endpoint_info import qos_lines
from rclpy.type_hash import TypeHash

if TYPE_CHECKING:
    from rclpy.qos import QoSProfile

__all__ = ["ServiceEndpointInfo", "ServiceEndpointTypeEnum"]


class ServiceEndpointTypeEnum(IntEnum):
    """Type of an endpoint of a service."""

    INVALID = 0
    CLIENT = 3
    SERVER = 4


@dataclass(eq=False, repr=False)
class ServiceEndpointInfo:
    """A client or server in the graph. `str` returns what `ros2 service info --verbose` prints.

    Attributes:
        node_name: Name of its node, or `_NODE_NAME_UNKNOWN_`.
        node_namespace: Namespace of its node, or `_NODE_NAMESPACE_UNKNOWN_`.
        service_type: Type of the service, for example `std_srvs/srv/SetBool`.
        service_type_hash: Hash of the type, which endpoints of ROS 2 Iron and later announce.
        endpoint_type: Whether it is a client or a server.
        endpoint_count: The number of its endpoints: one for requests and one for replies.
        endpoint_gids: The identifier of each endpoint.
        qos_profiles: The QoS profile of each endpoint.
    """

    node_name: str = ""
    node_namespace: str = ""
    service_type: str = ""
    service_type_hash: TypeHash = field(default_factory=TypeHash)
    endpoint_type: ServiceEndpointTypeEnum = ServiceEndpointTypeEnum.INVALID
    endpoint_count: int = 0
    endpoint_gids: list[list[int]] = field(default_factory=list)
    qos_profiles: list[QoSProfile] = field(default_factory=list)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, ServiceEndpointInfo) and str(self) == str(other)

    __hash__ = None  # type: ignore[assignment]

    def __str__(self) -> str:
        gids = (".".join(f"{byte:02x}" for byte in gid) for gid in self.endpoint_gids)
        return "\n".join(
            [
                f"Node name: {self.node_name}",
                f"Node namespace: {self.node_namespace}",
                f"Service type: {self.service_type}",
                f"Service type hash: {self.service_type_hash}",
                f"Endpoint type: {self.endpoint_type.name}",
                f"Endpoint count: {self.endpoint_count}",
                "GIDs:",
                *(f"  - {gid}" for gid in gids),
                "QoS profiles:",
                *(line for qos in self.qos_profiles for line in _as_item(qos_lines(qos))),
            ]
        )


def _as_item(lines: list[str]) -> list[str]:
    """Return lines as an item of a list."""
    return [("  - " if number == 0 else "    ") + line for number, line in enumerate(lines)]


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
