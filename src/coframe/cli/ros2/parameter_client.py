# SPDX-License-Identifier: Apache-2.0
"""Client of the parameter services of another node, for ``coframe param``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from coframe.cli.output import fail
from coframe.cli.ros2.calls import call_service, fail_if_incompatible
from coframe.cli.ros2.graph import ENDPOINT_TIMEOUT, fail_without_node, node_names, wait_until

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from coframe.cli.options import PositiveDuration
    from rclpy.node import Node

__all__ = ["ParameterClient"]

# How long to wait for the services of each node in a list; nodes without them are common.
_SHORT_TIMEOUT = 1.0  # seconds


class ParameterClient:
    """Client of the parameter services of a node.

    Args:
        node: Node of the command.
        target: Full name of the other node.
        required: Whether to end the command if the node does not exist or has no parameter services.
        timeout: How long to wait for each response; 5 s if it is None.
    """

    def __init__(
        self, node: Node, target: str, *, is_required: bool = True, timeout: PositiveDuration | None = None
    ) -> None:
        self._node = node
        self._target = target
        self._timeout = timeout
        if is_required and not wait_until(lambda: target in node_names(node, include_hidden=True)):
            fail_without_node(node, f"Node not found: {target}", target)
        self.is_available = self._has_services(is_required=is_required)
        if is_required and not self.is_available:
            fail(f"Node {target} has no parameter services.", "It was started without them, or does not respond.")

    def _has_services(self, *, is_required: bool) -> bool:
        from rcl_interfaces.srv import ListParameters  # noqa: PLC0415 - slow import
        from rclpy.exceptions import InvalidServiceNameException  # noqa: PLC0415

        try:
            probe = self._node.create_client(ListParameters, f"{self._target}/list_parameters")
        except InvalidServiceNameException:  # Other programs can announce nodes with arbitrary names.
            return False
        found: bool = probe.wait_for_service(ENDPOINT_TIMEOUT if is_required else _SHORT_TIMEOUT)
        if is_required and not found:
            fail_if_incompatible(probe)
        self._node.destroy_client(probe)
        return found

    def names(self, prefixes: Iterable[str] = ()) -> list[str]:
        """Return the names of the parameters, sorted."""
        from rcl_interfaces.srv import ListParameters  # noqa: PLC0415 - slow import

        request = ListParameters.Request(prefixes=list(prefixes))
        return sorted(self._call(ListParameters, "list_parameters", request).result.names)

    def get(self, names: Iterable[str]) -> list[Any]:
        """Return the values of parameters as messages."""
        from rcl_interfaces.srv import GetParameters  # noqa: PLC0415 - slow import

        return list(self._call(GetParameters, "get_parameters", GetParameters.Request(names=list(names))).values)

    def types(self, names: Iterable[str]) -> list[int]:
        """Return the types of parameters as numbers of `ParameterType`."""
        from rcl_interfaces.srv import GetParameterTypes  # noqa: PLC0415 - slow import

        request = GetParameterTypes.Request(names=list(names))
        return list(self._call(GetParameterTypes, "get_parameter_types", request).types)

    def describe(self, names: Iterable[str]) -> list[Any]:
        """Return the descriptors of parameters."""
        from rcl_interfaces.srv import DescribeParameters  # noqa: PLC0415 - slow import

        request = DescribeParameters.Request(names=list(names))
        return list(self._call(DescribeParameters, "describe_parameters", request).descriptors)

    def set(self, values: Mapping[str, Any]) -> list[Any]:
        """Set parameters and return a result for each.

        Args:
            values: `ParameterValue` messages or Python values by name; None deletes a parameter.
        """
        from rcl_interfaces.msg import ParameterValue  # noqa: PLC0415 - slow import
        from rcl_interfaces.srv import SetParameters  # noqa: PLC0415
        from rclpy.parameter import Parameter  # noqa: PLC0415

        parameters = []
        for name, value in values.items():
            if isinstance(value, ParameterValue):
                message = Parameter(name).to_parameter_msg()
                message.value = value
            else:
                message = Parameter(name, value=value).to_parameter_msg()
            parameters.append(message)
        request = SetParameters.Request(parameters=parameters)
        return list(self._call(SetParameters, "set_parameters", request).results)

    def _call(self, kind: Any, service: str, request: Any) -> Any:
        return call_service(self._node, kind, f"{self._target}/{service}", request, timeout=self._timeout)
