# SPDX-License-Identifier: Apache-2.0
"""Parameter services, through which other nodes get and set the parameters of a node (`ros2 param`)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from rcl_interfaces.msg import ListParametersResult, ParameterValue, SetParametersResult
from rcl_interfaces.srv import (
    DescribeParameters,
    GetParameters,
    GetParameterTypes,
    ListParameters,
    SetParameters,
    SetParametersAtomically,
)
from rclpy.exceptions import ParameterNotDeclaredException, ParameterUninitializedException
from rclpy.parameter import PARAMETER_SEPARATOR_STRING, Parameter
from rclpy.qos import qos_profile_parameters

if TYPE_CHECKING:
    from rclpy.node import Node


class ParameterService:
    """Parameter services of a node.

    Args:
        node: Node whose parameters are served.
    """

    def __init__(self, node: Node) -> None:
        self._node = node
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
        except ParameterNotDeclaredException:
            response.descriptors = []  # Upstream rclpy also returns an empty list.
        return response

    def _get(self, request: Any, response: Any) -> Any:
        response.values = [self._value(name) for name in request.names]
        return response

    def _value(self, name: str) -> ParameterValue:
        try:
            return self._node.get_parameter(name).get_parameter_value()
        except (ParameterNotDeclaredException, ParameterUninitializedException):
            return ParameterValue()

    def _get_types(self, request: Any, response: Any) -> Any:
        try:
            response.types = [int(self._node.get_parameter_type(name)) for name in request.names]
        except ParameterNotDeclaredException:
            response.types = []
        return response

    def _list(self, request: Any, response: Any) -> Any:
        names = [name for name in self._node.get_parameters_by_prefix("") if _is_listed(name, request)]
        prefixes = {name.rpartition(PARAMETER_SEPARATOR_STRING)[0] for name in names} - {""}
        response.result = ListParametersResult(names=names, prefixes=sorted(prefixes))
        return response

    def _set(self, request: Any, response: Any) -> Any:
        for message in request.parameters:
            try:
                [result] = self._node.set_parameters([Parameter.from_parameter_msg(message)])
            except ParameterNotDeclaredException as error:
                result = SetParametersResult(successful=False, reason=str(error))
            response.results = [*response.results, result]
        return response

    def _set_atomically(self, request: Any, response: Any) -> Any:
        try:
            parameters = [Parameter.from_parameter_msg(message) for message in request.parameters]
            response.result = self._node.set_parameters_atomically(parameters)
        except ParameterNotDeclaredException as error:
            response.result = SetParametersResult(successful=False, reason=str(error))
        return response


def _is_listed(name: str, request: Any) -> bool:
    """Return whether a name has one of the prefixes and is at most `depth` levels below it (0: any level)."""
    for prefix in request.prefixes or [""]:
        rest = name if not prefix else name.removeprefix(prefix + PARAMETER_SEPARATOR_STRING)
        if prefix and rest == name and name != prefix:
            continue
        if not request.depth or rest.count(PARAMETER_SEPARATOR_STRING) < request.depth:
            return True
    return False
