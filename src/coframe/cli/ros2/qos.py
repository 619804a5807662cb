# SPDX-License-Identifier: Apache-2.0
"""The QoS options of ``topic echo`` and ``topic pub``, and the QoS that matches the publishers of a topic."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any, NamedTuple

import click

from coframe.cli.output import fail

if TYPE_CHECKING:
    from rclpy.node import Node
    from rclpy.qos import QoSProfile

__all__ = ["QoSWords", "depth_option", "durability_option", "history_option", "profile_option", "reliability_option"]

profile_option = click.option("--qos-profile", metavar="NAME", help="QoS preset, e.g. sensor_data.")
depth_option = click.option(
    "--qos-depth", metavar="N", type=click.IntRange(min=0, max=2**31 - 1), help="Depth of the QoS history."
)
history_option = click.option("--qos-history", metavar="POLICY", help="QoS history: keep_last or keep_all.")
reliability_option = click.option(
    "--qos-reliability", metavar="POLICY", help="QoS reliability: reliable or best_effort."
)
durability_option = click.option(
    "--qos-durability", metavar="POLICY", help="QoS durability: volatile or transient_local."
)


class QoSWords(NamedTuple):
    """The values of the QoS options of a command."""

    profile: str | None
    depth: int | None
    history: str | None
    reliability: str | None
    durability: str | None

    def to_profile(self, start: QoSProfile | None = None) -> QoSProfile:
        """Return the QoS profile; omitted policies are taken from --qos-profile, else from `start`.

        Args:
            start: QoS for omitted policies. None for the default of ROS.
        """
        from rclpy.qos import (  # noqa: PLC0415 - help starts faster
            DurabilityPolicy,
            HistoryPolicy,
            QoSPresetProfiles,
            QoSProfile,
            ReliabilityPolicy,
        )

        given = start
        if self.profile or given is None:
            name = self.profile or "system_default"
            if name.lower() not in QoSPresetProfiles.short_keys():
                presets = ", ".join(QoSPresetProfiles.short_keys())
                fail(f"--qos-profile: {name!r} is not a QoS preset", f"Presets: {presets}.", code=2)
            given = QoSPresetProfiles.get_from_short_key(name)
        return QoSProfile(
            history=_policy(HistoryPolicy, "--qos-history", self.history) or given.history,
            depth=given.depth if self.depth is None else self.depth,
            reliability=_policy(ReliabilityPolicy, "--qos-reliability", self.reliability) or given.reliability,
            durability=_policy(DurabilityPolicy, "--qos-durability", self.durability) or given.durability,
        )

    def for_subscription(self, node: Node, topic: str) -> QoSProfile:
        """Return the QoS with which a subscription matches as many publishers of a topic as possible.

        The rule and the messages are those of ros2cli: reliable and transient local if every publisher is.
        """
        if self.profile or self.reliability or self.durability:
            return self.to_profile()
        from rclpy.qos import DurabilityPolicy, QoSPresetProfiles, QoSProfile, ReliabilityPolicy  # noqa: PLC0415

        offered = [info.qos_profile for info in node.get_publishers_info_by_topic(topic)]
        start: QoSProfile = QoSPresetProfiles.get_from_short_key("sensor_data")
        reliable = [qos.reliability == ReliabilityPolicy.RELIABLE for qos in offered]
        transient = [qos.durability == DurabilityPolicy.TRANSIENT_LOCAL for qos in offered]
        return self.to_profile(
            QoSProfile(
                history=start.history,
                depth=max([start.depth, *(qos.depth for qos, late in zip(offered, transient, strict=True) if late)]),
                reliability=ReliabilityPolicy.RELIABLE
                if _do_all_offer("reliability", "RELIABLE", reliable)
                else ReliabilityPolicy.BEST_EFFORT,
                durability=DurabilityPolicy.TRANSIENT_LOCAL
                if _do_all_offer("durability", "TRANSIENT_LOCAL", transient)
                else DurabilityPolicy.VOLATILE,
            )
        )


def _do_all_offer(policy: str, value: str, offers: list[bool]) -> bool:
    """Return whether all publishers offer the stronger policy, and print a message on stderr if only some do."""
    if any(offers) and not all(offers):
        print(
            f"Some, but not all, publishers are offering {policy} {value}. Falling back to the weaker policy, "
            "as it will connect to all publishers",
            file=sys.stderr,
        )
    return bool(offers) and all(offers)


def _policy(kind: Any, option: str, word: str | None) -> Any:
    """Return a policy by its short name, None if there is none, or end the command at an unknown name."""
    if word is None:
        return None
    if word.lower() not in kind.short_keys():
        fail(f"{option}: {word!r} is not one of {', '.join(kind.short_keys())}", code=2)
    return kind[word.upper()]
