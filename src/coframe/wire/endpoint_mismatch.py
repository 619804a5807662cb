# SPDX-License-Identifier: Apache-2.0
"""Warnings about publishers and subscriptions on the same topic that cannot communicate."""

from __future__ import annotations

import time
from functools import partial
from typing import TYPE_CHECKING

from coframe._output.warn_once import WarnOnce
from coframe.wire import names
from coframe.wire._foreign_services import foreign_services_text
from coframe.wire.type_hashes import type_hash_of_name

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from coframe.wire.endpoints import LocalEndpoint
    from coframe.wire.graph import DiscoveredEndpoint, Graph

_PREFIX_SIZE = 12  # bytes of a GUID that identify the participant

# For each QoS policy: the offer, the request, and how to fix the mismatch.
_QOS = {
    "reliability": (
        "best-effort",
        "reliable",
        "Request best-effort (qos_profile_sensor_data), or make the publisher reliable.",
    ),
    "durability": ("volatile", "transient-local", "Request volatile, or make the publisher transient-local."),
    "deadline": ("a longer deadline", "a shorter deadline", "Use a deadline at least as long as the publisher's."),
    "liveliness": (
        "a weaker liveliness or a longer lease",
        "a stronger liveliness or a shorter lease",
        "Use the same liveliness and lease duration on both sides.",
    ),
}

# The other policies that are compared, by their numbers in DDS.
_OTHER_POLICIES = {
    3: "presentation",
    5: "latency budget",
    6: "ownership",
    10: "partition",
    12: "destination order",
    25: "data representation",
}


def mismatch_reasons(
    writer: DiscoveredEndpoint, reader: DiscoveredEndpoint, *, qos_must_match: bool = True
) -> list[str]:
    """Return why the two do not match: "type", or "reliability" and "durability"; empty if it is unknown.

    Args:
        writer: A writer on the topic.
        reader: A reader on the topic.
        qos_must_match: Whether quality of service can prevent a match (`GraphQueries.qos_must_match`).
    """
    if writer.type != reader.type:
        return ["type"]
    if not qos_must_match:
        return []
    found = []
    if reader.qos.reliable and not writer.qos.reliable:
        found.append("reliability")
    if reader.qos.transient_local and not writer.qos.transient_local:
        found.append("durability")
    if reader.qos.deadline < writer.qos.deadline:
        found.append("deadline")
    if reader.qos.manual_liveliness > writer.qos.manual_liveliness or reader.qos.lease < writer.qos.lease:
        found.append("liveliness")
    return found


def mismatch_text(
    own: LocalEndpoint, peer: DiscoveredEndpoint, node: str | None, reason: str, middleware: str = ""
) -> str:
    """Return the warning for an endpoint of this process and one of `node` that do not match.

    Args:
        own: The endpoint of this process.
        peer: The endpoint of the other node.
        node: The name of the other node, or None if it is unknown.
        reason: "type", "services", "other" or a QoS policy.
        middleware: The middleware of the other node, for the reason "services".
    """
    who = f"Node {node}" if node else "An unnamed node"
    role = "publisher" if own.is_writer else "subscription"
    topic = names.any_ros_name(own.topic)
    own_type = names.ros_type(own.description.type)
    if reason == "type":
        their_verb, our_verb = ("expects", "publishes") if own.is_writer else ("publishes", "expects")
        return (
            f"{who} {their_verb} {names.ros_type(peer.type)} on {topic}, but this {role} {our_verb} {own_type}: "
            "no messages will arrive. Use the same message type, or another topic name."
        )
    if reason == "definition":
        return _definition_text(f"{who} {'expects' if own.is_writer else 'publishes'}", topic, own_type, role, peer)
    if reason == "services":
        return foreign_services_text(own.topic, middleware, node, is_writer=own.is_writer)
    if reason == "other":
        if _differs(own, peer):
            return f"{mismatch_text(own, peer, node, 'definition')} Until then, no messages will arrive."
        what = _OTHER_POLICIES.get(own.refused_policy, f"definition of {own_type}")
        return (
            f"{who} on {topic} has a different {what} from this {role}: no messages will arrive. "
            "Use the same message definitions and the same quality of service on both sides."
        )
    offered, requested, advice = _QOS[reason]
    if own.is_writer:
        problem = f"requests {requested} on {topic}, but this publisher offers {offered}"
    else:
        problem = f"offers {offered} on {topic}, but this subscription requests {requested}"
    return f"{who} {problem}: no messages will arrive. {advice}"


def _definition_text(start: str, topic: str, own_type: str, role: str, peer: DiscoveredEndpoint) -> str:
    from coframe.distributions import DEFINITIONS, current  # noqa: PLC0415 - only for the warning
    from coframe.messages.other_forms import difference  # noqa: PLC0415

    theirs = difference(own_type, peer.type_hash)
    if own_type in DEFINITIONS and theirs != "another definition":
        consequence = "Fields that only one of them has are not transferred. Set COFRAME_DISTRO to use the same one."
        return f"{start} {own_type} on {topic} with {theirs}, but this {role} follows {current().title}. {consequence}"
    return (
        f"{start} {own_type} on {topic} with another definition than this {role} ({peer.type_hash}): messages may be "
        "dropped or misread. Use the same definition on both sides; coframe interface show prints this one."
    )


class MismatchMonitor:
    """Warns once about every pair of endpoints that cannot communicate.

    Args:
        graph: The graph, which contains the endpoints of other processes.
        warn: Called with each warning.
    """

    # An endpoint may be discovered before the name of its node and the result of the match are known.
    _GRACE_PERIOD = 2.0  # seconds

    def __init__(self, graph: Graph, warn: Callable[[str], None]) -> None:
        self._graph = graph
        self._warn_once = WarnOnce(warn)
        self._suspects: dict[tuple[bytes, bytes, str], float] = {}  # (own, peer, reason): time of discovery

    @property
    def waiting(self) -> bool:
        """Whether `check` must be called again even if the graph does not change."""
        return bool(self._suspects)

    def check(self, endpoints: list[LocalEndpoint]) -> None:
        """Compare `endpoints` of this process with the endpoints of the graph, and warn about mismatches."""
        suspects, self._suspects = self._suspects, {}
        now = time.monotonic()
        for own, peer, reason in self._pairs(endpoints):
            node = self._graph.owner(peer.guid)
            # A node has many services, but only one middleware.
            about: str | bytes = "" if reason == "services" else names.any_ros_name(own.topic)
            if own.on_mismatch is not None:
                about = own.guid
            unnamed: bytes = peer.guid[:_PREFIX_SIZE] if reason == "services" else peer.guid
            key = (about, node or unnamed, reason)
            if self._warn_once.is_suppressed(key) or self._warn_once.is_suppressed((about, unnamed, reason)):
                continue
            suspect = (own.guid, peer.guid, reason)
            since = suspects.get(suspect, now)
            if now - since < self._GRACE_PERIOD and (node is None or reason == "other"):
                self._suspects[suspect] = since
                continue
            text = mismatch_text(own, peer, node, reason, self._graph.foreign_services(peer))
            if own.on_mismatch is None or reason in ("services", "definition"):
                self._warn_once(text, key)
            else:
                self._warn_once(text, key, partial(own.on_mismatch, _policy(own) if reason == "other" else reason))

    def _pairs(self, endpoints: list[LocalEndpoint]) -> Iterator[tuple[LocalEndpoint, DiscoveredEndpoint, str]]:
        own_guids = {endpoint.guid for endpoint in endpoints}
        writers, readers = self._graph.by_topic(writers=True), self._graph.by_topic(writers=False)
        for own in endpoints:
            peers = (readers if own.is_writer else writers).get(own.topic)
            if not peers:
                continue
            matched = own.matched_handles()
            for handle, peer in peers.items():
                if handle in matched:
                    if not names.is_topic(own.topic) and self._graph.foreign_services(peer):
                        yield own, peer, "services"
                    elif _differs(own, peer) and peer.guid not in own_guids:
                        yield own, peer, "definition"
                    continue
                # A pair within this process is reported once, from the side of the subscription.
                if own.is_writer and peer.guid in own_guids and own.on_mismatch is None:
                    continue
                foreign = not names.is_topic(own.topic) and self._graph.foreign_services(peer)
                for reason in _reasons(own, peer, self._graph):
                    # Processes that use coframe on Fast DDS have writers that only others match.
                    if (reason not in _QOS or not own.adapts) and not (reason == "other" and foreign):
                        yield own, peer, reason


def _differs(own: LocalEndpoint, peer: DiscoveredEndpoint) -> bool:
    """Return whether both endpoints of a topic announce a hash of its type, and these differ."""
    if not peer.type_hash or not names.is_topic(own.topic):
        return False
    own_hash = type_hash_of_name(names.ros_type(own.description.type))
    return bool(own_hash) and own_hash != peer.type_hash


def _reasons(own: LocalEndpoint, peer: DiscoveredEndpoint, graph: Graph) -> list[str]:
    pair = (own.description, peer) if own.is_writer else (peer, own.description)
    reasons = mismatch_reasons(*pair, qos_must_match=graph.qos_must_match) or ["other"]
    # As in ROS, endpoints with a callback report only the first policy.
    return reasons if own.on_mismatch is None else reasons[:1]


def _policy(own: LocalEndpoint) -> str:
    return _OTHER_POLICIES.get(own.refused_policy, "invalid")
