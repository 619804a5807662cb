# SPDX-License-Identifier: Apache-2.0
"""Compatibility of the QoS profiles of a publisher and a subscription, with the messages of upstream's middleware."""

from __future__ import annotations

from enum import Enum
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from rclpy.qos import QoSProfile


class QoSCompatibility(Enum):
    """Compatibility of the profiles of a publisher and a subscription."""

    OK = 0
    WARNING = 1
    ERROR = 2

    def __repr__(self) -> str:
        return str(self)


# For each policy: what is weaker than requested, and the messages of the error and of the two warnings.
_POLICIES: Final = {
    "reliability": (
        ("best_effort", "reliable"),
        "Best effort publisher and reliable subscription",
        "Reliable subscription, but publisher is",
        "Best effort publisher, but subscription is",
    ),
    "durability": (
        ("volatile", "transient_local"),
        "Volatile publisher and transient local subscription",
        "Transient local subscription, but publisher is",
        "Volatile publisher, but subscription is",
    ),
    "liveliness": (
        ("automatic", "manual_by_topic"),
        "Publisher's liveliness is automatic and subscription's is manual by topic",
        "Subscription's liveliness is manual by topic, but publisher's is",
        "Publisher's liveliness is automatic, but subscription's is",
    ),
}
_DURATIONS: Final = {"deadline": "deadline", "liveliness_lease_duration": "liveliness lease duration"}
_UNDECIDED: Final = ("system_default", "unknown")


def qos_check_compatible(publisher_qos: QoSProfile, subscription_qos: QoSProfile) -> tuple[QoSCompatibility, str]:
    """Return whether the profiles are compatible, and the reasons if they are not or if that is not certain.

    Args:
        publisher_qos: Profile offered by the publisher.
        subscription_qos: Profile requested by the subscription.
    """
    if errors := _errors(publisher_qos, subscription_qos):
        return QoSCompatibility.ERROR, "".join(f"ERROR: {text};" for text in errors)
    if warnings := _warnings(publisher_qos, subscription_qos):
        return QoSCompatibility.WARNING, "".join(f"WARNING: {text};" for text in warnings)
    return QoSCompatibility.OK, ""


def _errors(publisher: QoSProfile, subscription: QoSProfile) -> list[str]:
    found = [
        error
        for policy, (pair, error, _, _) in _POLICIES.items()
        if (getattr(publisher, policy).short_key, getattr(subscription, policy).short_key) == pair
    ]
    for policy, name in _DURATIONS.items():
        offered, requested = (getattr(profile, policy).nanoseconds for profile in (publisher, subscription))
        if requested and not offered:
            found.append(f"Subscription has a {name}, but publisher does not")
        elif requested and requested < offered:
            found.append(f"Subscription {name} is less than publisher {name}")
    return found


def _warnings(publisher: QoSProfile, subscription: QoSProfile) -> list[str]:
    found = []
    for policy, ((weak, strong), _, publisher_is, subscription_is) in _POLICIES.items():
        offered, requested = getattr(publisher, policy).short_key, getattr(subscription, policy).short_key
        if offered in _UNDECIDED and requested in _UNDECIDED:
            found.append(f"Publisher {policy} is {offered} and subscription {policy} is {requested}")
        elif offered in _UNDECIDED and requested == strong:
            found.append(f"{publisher_is} {offered}")
        elif offered == weak and requested in _UNDECIDED:
            found.append(f"{subscription_is} {requested}")
    return found
