# SPDX-License-Identifier: Apache-2.0
"""Parameter services, through which other nodes get and set the parameters of a node (`ros2 param`)."""

# The modules of rclpy share attributes named `_Coframe__x`, the form of mangled names.
# ruff: noqa: SLF001

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

from rcl_interfaces.msg import SetParametersResult
from rcl_interfaces.srv import (
    DescribeParameters,
    GetParameters,
    GetParameterTypes,
    ListParameters,
    SetParameters,
    SetParametersAtomically,
)
from rclpy import _absent
from rclpy._parameter_limits import ParameterLimits
from rclpy.exceptions import ParameterNotDeclaredException, ParameterUninitializedException
from rclpy.parameter import Parameter
from rclpy.qos import qos_profile_parameters

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from rclpy.node import Node


# RuntimeError: the message has a type that does not exist, which must not end the node.
_NOT_SET = (ParameterNotDeclaredException, RuntimeError)
_WARNING_PERIOD_S = 1.0  # other nodes can send invalid requests at any rate


class ParameterService:
    """Parameter services of a node.

    Args:
        node: Node whose parameters are served.
    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self._limits = ParameterLimits(node.has_parameter)
        for srv_type, name, callback in (
            (DescribeParameters, "describe_parameters", self._describe),
            (GetParameters, "get_parameters", self._get),
            (GetParameterTypes, "get_parameter_types", self._get_types),
            (ListParameters, "list_parameters", self._list),
            (SetParameters, "set_parameters", self._set),
            (SetParametersAtomically, "set_parameters_atomically", self._set_atomically),
        ):
            node.create_service(srv_type, f"~/{name}", callback, qos_profile=qos_profile_parameters)

    def _describe(self, request: Any, response: Any) -> Any:
        try:
            response.descriptors = self._node.describe_parameters(list(request.names))
        except ParameterNotDeclaredException as error:
            self._node.get_logger().warning(
                f"Failed to describe parameters: {error}", throttle_duration_sec=_WARNING_PERIOD_S
            )
            response.descriptors = []  # Upstream rclpy also returns an empty list.
        return response

    def _get(self, request: Any, response: Any) -> Any:
        try:
            response.values = [
                parameter.get_parameter_value() for parameter in self._node.get_parameters(list(request.names))
            ]
        except (ParameterNotDeclaredException, ParameterUninitializedException) as error:
            # Upstream returns no values as well, although it knows those of the other names.
            self._node.get_logger().warning(
                f"Failed to get parameters: {error}", throttle_duration_sec=_WARNING_PERIOD_S
            )
            response.values = []
        return response

    def _get_types(self, request: Any, response: Any) -> Any:
        try:
            response.types = [
                Parameter.Type(kind).value for kind in self._node.get_parameter_types(list(request.names))
            ]
        except ParameterNotDeclaredException as error:
            self._node.get_logger().warning(
                f"Failed to get parameter types: {error}", throttle_duration_sec=_WARNING_PERIOD_S
            )
            response.types = []
        return response

    def _list(self, request: Any, response: Any) -> Any:
        response.result = self._node.list_parameters(list(request.prefixes), request.depth)
        return response

    def _set(self, request: Any, response: Any) -> Any:
        self._limits.forget_deleted()
        response.results = [
            self._result([message], lambda parameters: self._node.set_parameters(parameters)[0])
            for message in request.parameters
        ]
        return response

    def _set_atomically(self, request: Any, response: Any) -> Any:
        self._limits.forget_deleted()
        response.result = self._result(request.parameters, self._node.set_parameters_atomically)
        return response

    def _result(
        self, messages: Sequence[Any], set_parameters: Callable[[list[Parameter[Any]]], SetParametersResult]
    ) -> SetParametersResult:
        fault = self._fault(messages)
        if fault:
            return SetParametersResult(successful=False, reason=fault)
        try:
            result = set_parameters([Parameter.from_parameter_msg(message) for message in messages])
        except _NOT_SET as error:
            return SetParametersResult(successful=False, reason=str(error))
        if result.successful:
            self._limits.add(messages)
        return result

    def _fault(self, messages: Sequence[Any]) -> str:
        """Return why parameters cannot be set, before the node looks for similar names, which takes long for many."""
        unknown = self._node._Coframe__undeclared([message.name for message in messages])
        return str(ParameterNotDeclaredException(unknown)) if unknown else self._limits.fault(messages)


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
