# SPDX-License-Identifier: Apache-2.0
"""QoS override parameters, which set the QoS of publishers and subscriptions when a node starts."""

from __future__ import annotations

import copy
from collections.abc import Callable, Iterable
from functools import partial
from typing import TYPE_CHECKING, Any

from rcl_interfaces.msg import ParameterDescriptor, SetParametersResult
from rclpy import _absent
from rclpy.duration import Duration
from rclpy.exceptions import ParameterAlreadyDeclaredException
from rclpy.qos import QoSPolicyEnum, QoSPolicyKind, QoSProfile

if TYPE_CHECKING:
    from typing_extensions import Self

    from rclpy._node_parameters import NodeParameters

__all__ = ["InvalidQosOverridesError", "QoSOverridingOptions", "QosCallbackResult", "QosCallbackType"]

QosCallbackResult = SetParametersResult
QosCallbackType = Callable[[QoSProfile], QosCallbackResult]


class InvalidQosOverridesError(Exception):
    """A parameter value is not valid for its policy, or the node's callback rejected the profile."""


class QoSOverridingOptions:
    """Options that declare which QoS policies parameters may override.

    Args:
        policy_kinds: The policies that may be overridden.
        callback: Function that is called with the resulting profile and may reject it.
        entity_id: Identifier that distinguishes several publishers or subscriptions of one topic.
    """

    policy_kinds: list[QoSPolicyKind]
    callback: QosCallbackType | None
    entity_id: str | None

    def __init__(
        self,
        policy_kinds: Iterable[QoSPolicyKind],
        *,
        callback: QosCallbackType | None = None,
        entity_id: str | None = None,
    ) -> None:
        self.policy_kinds = list(policy_kinds)
        self.callback = callback
        self.entity_id = entity_id

    @classmethod
    def with_default_policies(cls, *, callback: QosCallbackType | None = None, entity_id: str | None = None) -> Self:
        """Create options that allow overriding history, depth and reliability."""
        kinds = (QoSPolicyKind.HISTORY, QoSPolicyKind.DEPTH, QoSPolicyKind.RELIABILITY)
        return cls(kinds, callback=callback, entity_id=entity_id)


def apply_qos_overrides(
    node: NodeParameters, entity: str, topic: str, qos: QoSProfile, options: QoSOverridingOptions
) -> QoSProfile:
    """Declare the read-only override parameters of an endpoint and return the resulting profile.

    Args:
        node: Node whose parameters are declared.
        entity: `publisher` or `subscription`.
        topic: Fully qualified name of the topic. The parameters are named `qos_overrides.<topic>.<entity>.<policy>`.
        qos: Profile without overrides.
        options: Policies that may be overridden.

    Raises:
        InvalidQosOverridesError: A value is not valid, or the options' callback rejected the profile.
    """
    suffix = f"_{options.entity_id}" if options.entity_id else ""
    shown = f"{entity} `{topic}` with id `{options.entity_id}`"  # as in ROS 2
    chosen = copy.copy(qos)
    for kind in options.policy_kinds:
        policy = QoSPolicyKind(kind).name.lower()
        name = f"qos_overrides.{topic}.{entity}{suffix}.{policy}"
        default = getattr(qos, policy)
        descriptor = ParameterDescriptor(description=f"{policy} for {shown}", read_only=True)
        try:
            value = node.declare_parameter(name, _as_parameter(default), descriptor).value
        except ParameterAlreadyDeclaredException:
            value = node.get_parameter(name).value
        try:
            setattr(chosen, policy, _as_policy(value, default))
        except (AssertionError, KeyError):
            raise InvalidQosOverridesError(f"Invalid {policy} {value!r}{_values(default)}: {name}") from None
    if options.callback is not None and not (result := options.callback(chosen)).successful:
        raise InvalidQosOverridesError(f"Provided QoS overrides for {shown}, are not valid: {result.reason}")
    return chosen


def _as_parameter(default: Any) -> Any:
    if isinstance(default, QoSPolicyEnum):
        return default.short_key
    return default.nanoseconds if isinstance(default, Duration) else default


def _as_policy(value: Any, default: Any) -> Any:
    if isinstance(default, QoSPolicyEnum):
        return type(default).get_from_short_key(value)
    return Duration(nanoseconds=value) if isinstance(default, Duration) else value


def _values(default: Any) -> str:
    return f" (valid values: {', '.join(type(default).short_keys())})" if isinstance(default, QoSPolicyEnum) else ""


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
