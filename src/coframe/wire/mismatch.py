"""Endpoints that meet on a topic and yet cannot talk: why, in a sentence."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from coframe.wire import names

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from coframe.wire.endpoints import WireEndpoint
    from coframe.wire.graph import DdsEndpoint, Graph

_QOS = {  # what a writer offers, what a reader asks for, what to do
    "reliability": (
        "best-effort",
        "reliable",
        "Ask for best-effort (qos_profile_sensor_data) or make the publisher reliable.",
    ),
    "durability": ("volatile", "transient-local", "Ask for volatile or make the publisher transient-local."),
}

# What else DDS may refuse by, as it numbers its policies.
_OTHER_POLICIES = {
    3: "presentation",
    4: "deadline",
    5: "latency budget",
    6: "ownership",
    8: "liveliness",
    10: "partition",
    12: "destination order",
    25: "data representation",
}


def reasons(writer: DdsEndpoint, reader: DdsEndpoint) -> list[str]:
    """Why the two cannot talk, as far as both say: "type", or "reliability" and "durability"."""
    if writer.type != reader.type:
        return ["type"]
    found = []
    if reader.qos.reliable and not writer.qos.reliable:
        found.append("reliability")
    if reader.qos.transient_local and not writer.qos.transient_local:
        found.append("durability")
    return found


def sentence(own: WireEndpoint, peer: DdsEndpoint, node: str | None, reason: str) -> str:
    """What is wrong between our endpoint and that of `node`, and what to do."""
    who = f"node {node}" if node else "an unnamed node"
    ours = "publisher" if own.is_writer else "subscription"
    topic = names.any_ros_name(own.topic)
    own_type = names.ros_type(own.description.type)
    if reason == "type":
        their_verb, our_verb = ("expects", "publishes") if own.is_writer else ("publishes", "expects")
        return (
            f"{who} on {topic} {their_verb} {names.ros_type(peer.type)}, but this {ours} {our_verb} {own_type}: "
            "nothing will arrive. Use one message type, or another topic name."
        )
    if reason == "refused":
        what = _OTHER_POLICIES.get(own.refused_policy, f"definition of {own_type}")
        return (
            f"{who} on {topic} has another {what} than this {ours}: nothing will arrive. "
            "Use the same message definitions and the same quality of service on both sides."
        )
    offered, asked, advice = _QOS[reason]
    if own.is_writer:
        return f"{who} on {topic} asks for {asked}, but this publisher offers {offered}: nothing will arrive. {advice}"
    return f"{who} on {topic} offers {offered}, but this subscription asks for {asked}: nothing will arrive. {advice}"


class MismatchWatch:
    """Tells once of every pair of endpoints that cannot talk.

    Args:
        graph: who is there.
        warn: is called with the sentences.
    """

    # DDS tells of an endpoint before its participant tells whose it is, and before it has decided on a match.
    _PATIENCE = 2.0  # seconds

    def __init__(self, graph: Graph, warn: Callable[[str], None]) -> None:
        self._graph = graph
        self._warn = warn
        self._suspects: dict[tuple[bytes, bytes, str], float] = {}  # (own, peer, reason): since when
        self._told: set[tuple[str, str | bytes, str]] = set()

    @property
    def waiting(self) -> bool:
        """Whether something is to be looked at again although nothing has changed."""
        return bool(self._suspects)

    def check(self, endpoints: list[WireEndpoint]) -> None:
        """Looks at all pairs of `endpoints`, our own, with what the graph knows."""
        suspects, self._suspects = self._suspects, {}
        now = time.monotonic()
        for own, peer, reason in self._pairs(endpoints):
            node = self._graph.owner(peer.guid)
            key = (names.any_ros_name(own.topic), node or peer.guid, reason)
            if key in self._told:
                continue
            suspect = (own.guid, peer.guid, reason)
            since = suspects.get(suspect, now)
            if now - since < self._PATIENCE and (node is None or reason == "refused"):
                self._suspects[suspect] = since
                continue
            self._told.add(key)
            self._warn(sentence(own, peer, node, reason))

    def _pairs(self, endpoints: list[WireEndpoint]) -> Iterator[tuple[WireEndpoint, DdsEndpoint, str]]:
        own_guids = {endpoint.guid for endpoint in endpoints}
        writers, readers = self._graph.by_topic(writers=True), self._graph.by_topic(writers=False)
        for own in endpoints:
            peers = (readers if own.is_writer else writers).get(own.topic, {})
            matched = own.matched_handles()
            for handle, peer in peers.items():
                # Two of our own are told of once, from the subscription's side.
                if handle in matched or (own.is_writer and peer.guid in own_guids):
                    continue
                pair = (own.description, peer) if own.is_writer else (peer, own.description)
                for reason in reasons(*pair) or ["refused"]:
                    if reason not in _QOS or not own.adapts:
                        yield own, peer, reason
