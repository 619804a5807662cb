# SPDX-License-Identifier: Apache-2.0
"""Parameters as messages, for the services of a container."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch_ros.parameter_descriptions import Parameter as ParameterDescription

if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path

    from launch.launch_context import LaunchContext
    from rcl_interfaces.msg import Parameter as ParameterMessage

__all__ = ["to_parameters_list"]


def to_parameters_list(
    context: LaunchContext,
    node_name: str,
    namespace: str,
    evaluated_parameters: Iterable[dict[str, Any] | Path | ParameterDescription],
) -> list[ParameterMessage]:
    """Return evaluated parameters as messages.

    Args:
        context: The launch.
        node_name: Name of the node whose parameters are read from files; "" reads those of ``/**`` only.
        namespace: Namespace of the node.
        evaluated_parameters: The result of `evaluate_parameters`.
    """
    from rclpy.parameter import Parameter  # noqa: PLC0415 - slow to import

    full_name = f"{namespace.rstrip('/')}/{node_name}"
    found: list[ParameterMessage] = []
    for each in evaluated_parameters:
        if isinstance(each, dict):
            found += [Parameter(name, value=value).to_parameter_msg() for name, value in each.items()]
        elif isinstance(each, ParameterDescription):
            name, value = each.evaluate(context)
            found.append(Parameter(name, value=value).to_parameter_msg())
        else:
            found += _read(str(each), full_name if full_name.startswith("/") else f"/{full_name}")
    return found


def _read(file: str, node: str) -> list[ParameterMessage]:
    import rclpy.parameter  # noqa: PLC0415 - slow to import

    read = getattr(rclpy.parameter, "parameter_dict_from_yaml_file", None)
    if read is None:  # in a sourced Humble
        raise RuntimeError(
            f"{file} cannot be passed to a container: the rclpy of this ROS has no parser of parameter files. Give the "
            f"parameters as a dictionary."
        )
    try:
        return list(read(file, use_wildcard=True, target_nodes=[node]).values())
    except RuntimeError as error:
        if "does not contain any valid parameters" in str(error):  # It contains those of other nodes.
            return []
        raise
