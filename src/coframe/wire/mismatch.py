"""Endpoints that meet on a topic and yet cannot talk: why, in a sentence."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Literal

from coframe.wire import names

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from coframe.wire.endpoints import WireEndpoint
    from coframe.wire.graph import DdsEndpoint, Graph

Reason = Literal["type", "reliability", "durability"]

# What DDS may also refuse by, as it numbers its policies.
POLICIES = {
    3: "presentation",
    4: "deadline",
    5: "latency budget",
    6: "ownership",
    8: "liveliness",
    10: "partition",
    12: "destination order",
    24: "message definition",
    25: "data representation",
}


def mismatches(
    own: DdsEndpoint, peers: Iterable[DdsEndpoint], *, own_is_writer: bool
) -> Iterator[tuple[DdsEndpoint, Reason]]:
    """The peers on `own`'s topic that it cannot talk to, each with the reason."""
    for peer in peers:
        writer, reader = (own, peer) if own_is_writer else (peer, own)
        if writer.type != reader.type:
            yield peer, "type"
            continue
        if reader.qos.reliable and not writer.qos.reliable:
            yield peer, "reliability"
        if reader.qos.transient_local and not writer.qos.transient_local:
            yield peer, "durability"


def sentence(own: DdsEndpoint, peer: DdsEndpoint, node: str | None, reason: Reason, *, own_is_writer: bool) -> str:
    """What is wrong between our endpoint and that of `node`, and what to do."""
    who = f"node {node}" if node else "an unnamed node"
    where = names.any_ros_name(own.topic)
    if reason == "type":
        verb, ours = ("expects", "publishes") if own_is_writer else ("publishes", "expects")
        own_name = "publisher" if own_is_writer else "subscription"
        return (
            f"{who} on {where} {verb} {names.ros_type(peer.type)}, but this {own_name} {ours} "
            f"{names.ros_type(own.type)}: nothing will arrive. Use one message type, or another topic name."
        )
    offered, asked, advice = _QOS_WORDS[reason]
    if own_is_writer:
        return f"{who} on {where} asks for {asked}, but this publisher offers {offered}: nothing will arrive. {advice}"
    return f"{who} on {where} offers {offered}, but this subscription asks for {asked}: nothing will arrive. {advice}"


def other_policy_sentence(own: DdsEndpoint, policy: int, *, own_is_writer: bool) -> str:
    """What is wrong where only DDS knows: its number of the policy, and no peer."""
    what = POLICIES[policy]
    ours, theirs = ("publisher", "a subscription") if own_is_writer else ("subscription", "a publisher")
    return (
        f"{theirs} on {names.any_ros_name(own.topic)} has another {what} than this {ours}: nothing will arrive. "
        "Use the same settings and the same message definitions on both sides."
    )


_QOS_WORDS: dict[str, tuple[str, str, str]] = {
    "reliability": (
        "best-effort",
        "reliable",
        "Ask for best-effort (qos_profile_sensor_data) or make the publisher reliable.",
    ),
    "durability": (
        "volatile",
        "transient-local",
        "Ask for volatile or make the publisher transient-local.",
    ),
}


class MismatchWatch:
    """Tells once of every pair of endpoints that cannot talk.

    Args:
        graph: who is there.
        warn: is called with the sentences.
    """

    # DDS tells of an endpoint before its participant tells whose it is.
    _PATIENCE = 2.0  # seconds

    def __init__(self, graph: Graph, warn: Callable[[str], None]) -> None:
        self._graph = graph
        self._warn = warn
        self._first_seen: dict[tuple[str, bytes, str], float] = {}
        self._told: set[tuple[str, str | bytes, str]] = set()
        self._refused: dict[bytes, int] = {}

    def check(self, endpoints: list[WireEndpoint]) -> None:
        """Looks at all pairs of `endpoints`, our own, with what the graph knows."""
        own_guids = {endpoint.guid for endpoint in endpoints}
        for endpoint in endpoints:
            own, own_is_writer = endpoint.description, endpoint.is_writer
            known = self._graph.readers(own.topic) if own_is_writer else self._graph.writers(own.topic)
            for peer, reason in mismatches(own, known.values(), own_is_writer=own_is_writer):
                # Two of our own are told of once, from the subscription's side.
                if not (own_is_writer and peer.guid in own_guids):
                    self._tell(own, peer, reason, own_is_writer=own_is_writer)
            self._check_other_policies(endpoint)

    def _tell(self, own: DdsEndpoint, peer: DdsEndpoint, reason: Reason, *, own_is_writer: bool) -> None:
        node = self._graph.owner(peer.guid)
        first_seen = self._first_seen.setdefault((own.topic, peer.guid, reason), time.monotonic())
        if node is None and time.monotonic() - first_seen < self._PATIENCE:
            return
        key = (own.topic, node or peer.guid, reason)
        if key not in self._told:
            self._told.add(key)
            self._warn(sentence(own, peer, node, reason, own_is_writer=own_is_writer))

    def _check_other_policies(self, endpoint: WireEndpoint) -> None:
        count, policy = endpoint.incompatible()
        if count == self._refused.get(endpoint.guid, 0):
            return
        self._refused[endpoint.guid] = count
        key = (endpoint.topic, "", str(policy))
        if policy in POLICIES and key not in self._told:
            self._told.add(key)
            self._warn(other_policy_sentence(endpoint.description, policy, own_is_writer=endpoint.is_writer))
