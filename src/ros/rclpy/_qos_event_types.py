# SPDX-License-Identifier: Apache-2.0
"""The kinds of QoS events, and what their callbacks receive."""

from __future__ import annotations

from enum import Enum
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from coframe import _core
from rclpy.qos import QoSPolicyKind

if TYPE_CHECKING:
    from collections.abc import Callable


class QoSPublisherEventType(Enum):
    """Kinds of events of a publisher."""

    RCL_PUBLISHER_OFFERED_DEADLINE_MISSED = 0
    RCL_PUBLISHER_LIVELINESS_LOST = 1
    RCL_PUBLISHER_OFFERED_INCOMPATIBLE_QOS = 2
    RCL_PUBLISHER_INCOMPATIBLE_TYPE = 3
    RCL_PUBLISHER_MATCHED = 4


class QoSSubscriptionEventType(Enum):
    """Kinds of events of a subscription."""

    RCL_SUBSCRIPTION_REQUESTED_DEADLINE_MISSED = 0
    RCL_SUBSCRIPTION_LIVELINESS_CHANGED = 1
    RCL_SUBSCRIPTION_REQUESTED_INCOMPATIBLE_QOS = 2
    RCL_SUBSCRIPTION_MESSAGE_LOST = 3
    RCL_SUBSCRIPTION_INCOMPATIBLE_TYPE = 4
    RCL_SUBSCRIPTION_MATCHED = 5


class QoSOfferedDeadlineMissedInfo(NamedTuple):
    """The publisher published later than its deadline allows."""

    total_count: int
    total_count_change: int


class QoSRequestedDeadlineMissedInfo(NamedTuple):
    """A message came later than the deadline of the subscription allows."""

    total_count: int
    total_count_change: int


class QoSLivelinessLostInfo(NamedTuple):
    """The publisher did not assert its liveliness in time."""

    total_count: int
    total_count_change: int


class QoSMessageLostInfo(NamedTuple):
    """Messages were lost."""

    total_count: int
    total_count_change: int


class IncompatibleTypeInfo(NamedTuple):
    """An endpoint on the same topic has another message type."""

    total_count: int
    total_count_change: int


class QoSLivelinessChangedInfo(NamedTuple):
    """The number of publishers that are alive has changed."""

    alive_count: int
    not_alive_count: int
    alive_count_change: int
    not_alive_count_change: int


class QoSMatchedInfo(NamedTuple):
    """The number of matched endpoints has changed."""

    total_count: int
    total_count_change: int
    current_count: int
    current_count_change: int


QoSPublisherMatchedInfo = QoSSubscriptionMatchedInfo = QoSMatchedInfo


class QoSOfferedIncompatibleQoSInfo(NamedTuple):
    """A subscription requests more than the publisher offers."""

    total_count: int
    total_count_change: int
    last_policy_kind: QoSPolicyKind


class QoSRequestedIncompatibleQoSInfo(NamedTuple):
    """A publisher offers less than the subscription requests."""

    total_count: int
    total_count_change: int
    last_policy_kind: QoSPolicyKind


# The policies that can be incompatible, by their numbers in DDS.
_POLICY_KINDS: Final = {
    2: QoSPolicyKind.DURABILITY,
    4: QoSPolicyKind.DEADLINE,
    8: QoSPolicyKind.LIVELINESS,
    11: QoSPolicyKind.RELIABILITY,
}


def _policy(counts: tuple[int, int, int, int]) -> tuple[int, int, QoSPolicyKind]:
    return *counts[:2], _POLICY_KINDS.get(counts[2], QoSPolicyKind.INVALID)


# For each kind of event: the status of DDS, and what the callback receives.
PUBLISHER_STATUSES: Final[dict[QoSPublisherEventType, tuple[int, Callable[[Any], Any]]]] = {
    QoSPublisherEventType.RCL_PUBLISHER_OFFERED_DEADLINE_MISSED: (
        _core.DEADLINE_MISSED,
        lambda counts: QoSOfferedDeadlineMissedInfo(*counts[:2]),
    ),
    QoSPublisherEventType.RCL_PUBLISHER_LIVELINESS_LOST: (
        _core.LIVELINESS,
        lambda counts: QoSLivelinessLostInfo(*counts[:2]),
    ),
    QoSPublisherEventType.RCL_PUBLISHER_OFFERED_INCOMPATIBLE_QOS: (
        _core.INCOMPATIBLE_QOS,
        lambda counts: QoSOfferedIncompatibleQoSInfo(*_policy(counts)),
    ),
    QoSPublisherEventType.RCL_PUBLISHER_MATCHED: (_core.MATCHED, lambda counts: QoSMatchedInfo(*counts)),
}
SUBSCRIPTION_STATUSES: Final[dict[QoSSubscriptionEventType, tuple[int, Callable[[Any], Any]]]] = {
    QoSSubscriptionEventType.RCL_SUBSCRIPTION_REQUESTED_DEADLINE_MISSED: (
        _core.DEADLINE_MISSED,
        lambda counts: QoSRequestedDeadlineMissedInfo(*counts[:2]),
    ),
    QoSSubscriptionEventType.RCL_SUBSCRIPTION_LIVELINESS_CHANGED: (
        _core.LIVELINESS,
        lambda counts: QoSLivelinessChangedInfo(*counts),
    ),
    QoSSubscriptionEventType.RCL_SUBSCRIPTION_REQUESTED_INCOMPATIBLE_QOS: (
        _core.INCOMPATIBLE_QOS,
        lambda counts: QoSRequestedIncompatibleQoSInfo(*_policy(counts)),
    ),
    QoSSubscriptionEventType.RCL_SUBSCRIPTION_MESSAGE_LOST: (
        _core.SAMPLE_LOST,
        lambda counts: QoSMessageLostInfo(*counts[:2]),
    ),
    QoSSubscriptionEventType.RCL_SUBSCRIPTION_MATCHED: (_core.MATCHED, lambda counts: QoSMatchedInfo(*counts)),
}
INCOMPATIBLE_TYPES: Final = (
    QoSPublisherEventType.RCL_PUBLISHER_INCOMPATIBLE_TYPE,
    QoSSubscriptionEventType.RCL_SUBSCRIPTION_INCOMPATIBLE_TYPE,
)
