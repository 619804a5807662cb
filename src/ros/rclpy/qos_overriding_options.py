"""Parameters by which a user chooses the quality of service of a publisher or a subscription when a node is started."""

from __future__ import annotations

import copy
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any

from rcl_interfaces.msg import ParameterDescriptor, SetParametersResult
from rclpy.duration import Duration
from rclpy.exceptions import ParameterAlreadyDeclaredException, ParameterException
from rclpy.qos import QoSPolicyEnum, QoSPolicyKind, QoSProfile

if TYPE_CHECKING:
    from typing_extensions import Self

    from rclpy.node import Node

__all__ = ["InvalidQosOverridesError", "QoSOverridingOptions", "QosCallbackResult", "QosCallbackType"]

QosCallbackResult = SetParametersResult
QosCallbackType = Callable[[QoSProfile], QosCallbackResult]


class InvalidQosOverridesError(ParameterException):
    """A parameter is no value of its policy, or the node's callback refuses the profile."""


class QoSOverridingOptions:
    """Which policies may be overridden.

    Args:
        policy_kinds: Those policies.
        callback: Is given the profile with what was overridden, and may refuse it.
        entity_id: Tells several publishers, or subscriptions, of one topic apart.
    """

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
        """Those of history, depth and reliability."""
        kinds = (QoSPolicyKind.HISTORY, QoSPolicyKind.DEPTH, QoSPolicyKind.RELIABILITY)
        return cls(kinds, callback=callback, entity_id=entity_id)


def overridden(node: Node, entity: str, topic: str, qos: QoSProfile, options: QoSOverridingOptions) -> QoSProfile:
    """Returns the profile with what the node's parameters say, which are declared, and read-only.

    Args:
        node: Whose parameters.
        entity: `publisher` or `subscription`.
        topic: Its whole name: the parameters are called `qos_overrides.<topic>.<entity>.<policy>`.
        qos: What holds without them.
        options: Which policies they are.

    Raises:
        InvalidQosOverridesError: One of them makes no sense, or the options' callback refuses the profile.
    """
    suffix = f"_{options.entity_id}" if options.entity_id else ""
    chosen = copy.copy(qos)
    for kind in options.policy_kinds:
        policy = QoSPolicyKind(kind).name.lower()
        name = f"qos_overrides.{topic}.{entity}{suffix}.{policy}"
        usual = getattr(qos, policy)
        try:
            value = node.declare_parameter(name, _as_parameter(usual), ParameterDescriptor(read_only=True)).value
        except ParameterAlreadyDeclaredException:
            value = node.get_parameter(name).value
        try:
            setattr(chosen, policy, _as_policy(value, usual))
        except (AssertionError, KeyError):
            raise InvalidQosOverridesError(f"{value!r} is no {policy}{_values(usual)}", name) from None
    if options.callback is not None and not (result := options.callback(chosen)).successful:
        reason = result.reason or "the node refuses this quality of service"
        raise InvalidQosOverridesError(reason, f"qos_overrides.{topic}.{entity}{suffix}")
    return chosen


def _as_parameter(usual: Any) -> Any:
    if isinstance(usual, QoSPolicyEnum):
        return usual.short_key
    return usual.nanoseconds if isinstance(usual, Duration) else usual


def _as_policy(value: Any, usual: Any) -> Any:
    if isinstance(usual, QoSPolicyEnum):
        return type(usual).get_from_short_key(value)
    return Duration(nanoseconds=value) if isinstance(usual, Duration) else value


def _values(usual: Any) -> str:
    return f", which are {', '.join(type(usual).short_keys())}" if isinstance(usual, QoSPolicyEnum) else ""
