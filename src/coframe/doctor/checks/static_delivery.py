"""TF016: static transforms that late joiners do not get, or that are told again and again."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from coframe.doctor.finding import Finding, Severity
from coframe.doctor.phrases import listed, times
from coframe.formatting import duration

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor.edge import Edge
    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF016"
_SECOND = 1_000_000_000
_BROADCASTER = (
    "Use tf2_ros.StaticTransformBroadcaster(node), or QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)."
)


def find(observation: Observation) -> Iterator[Finding]:
    """QoS on both sides, statics that one process overwrites, and leftovers of earlier ones."""
    for facts in observation.topics.values():
        if facts.name.rpartition("/")[2] != "tf_static":
            continue
        for endpoint in facts.publishers:
            if not endpoint.transient_local:
                yield _publisher(facts.name, endpoint.node)
        for endpoint in facts.subscribers:
            if not endpoint.transient_local:
                yield _subscriber(facts.name, endpoint.node)
    if observation.live:
        yield from _overwritten(observation)
    for edge in observation.static:
        yield from _told_again(edge)


def _publisher(topic: str, node: str) -> Finding:
    return Finding(
        code=CODE,
        severity=Severity.ERROR,
        text=f"{node} publishes on {topic} with the durability volatile: listeners with tf2's QoS get nothing at all"
        if node
        else f"a publisher on {topic} offered the durability volatile: listeners with tf2's QoS got nothing of it, and "
        "get nothing when it is played as it was recorded",
        fix=_BROADCASTER
        if node
        else f"{_BROADCASTER} On the running robot `coframe doctor` names the node; play this one by coframe play, or "
        "by ros2 bag play --qos-profile-overrides-path FILE.",
        topic=topic,
        publishers=(node,) if node else (),
    )


def _subscriber(topic: str, node: str) -> Finding:
    return Finding(
        code=CODE,
        severity=Severity.WARNING,
        text=f"{node} listens to {topic} with the durability volatile: it misses what was sent before it started",
        fix="Use tf2_ros.TransformListener(buffer, node), or QoSProfile(depth=100, "
        "durability=DurabilityPolicy.TRANSIENT_LOCAL).",
        topic=topic,
        publishers=(node,),
    )


def _overwritten(observation: Observation) -> Iterator[Finding]:
    """A late joiner is given as many messages of a writer as that keeps, which DDS does not tell: usually the last."""
    told = observation.transforms
    for number, publisher in enumerate(told.publishers):
        rows = np.flatnonzero(told.static & (told.publisher == number))
        messages = np.unique(told.arrived[rows])
        if not publisher or len(messages) < 2:
            continue
        kept = told.arrived[rows] == messages[-1]
        lost = sorted(
            {told.names[n] for n in told.child[rows[~kept]]} - {told.names[n] for n in told.child[rows[kept]]}
        )
        if lost:
            yield Finding(
                code=CODE,
                severity=Severity.WARNING,
                text=f"{publisher} has sent {len(messages)} messages of static transforms, and the last one lacks "
                f"{listed(lost)}: who joins now does not get them, unless its writer keeps more than the usual one",
                fix="Send all of them in one call of one broadcaster: broadcaster.sendTransform([t1, t2, ...]).",
                frames=frozenset(lost),
                first_stamp=int(told.stamp[rows[0]]),
                publishers=(publisher,),
            )


def _told_again(edge: Edge) -> Iterator[Finding]:
    """Messages that came late by very different times: what a process sends once more is as new as it was at first."""
    set_ = edge.stamp != 0
    stamps, lags = edge.stamp[set_], edge.arrived[set_] - edge.stamp[set_]
    if len(lags) < 2 or lags.max() - lags.min() < _SECOND or len(edge.publishers) == 1:
        return
    yield Finding(
        code=CODE,
        severity=Severity.NOTE if edge.constant else Severity.WARNING,
        text=f"told {times(len(stamps))} with stamps up to {duration(int(stamps.max() - stamps.min()))} apart"
        + (", always the same" if edge.constant else ", and not the same")
        + ": the older ones are of processes that were started before and still run",
        harm="A late joiner is given what each of these processes has sent: where one of them says something else, the "
        "last to be heard wins, by chance.",
        fix="End them, `ps` finds them (static_transform_publisher, robot_state_publisher); the one that is "
        "heard last wins.",
        edge=edge.key,
        first_stamp=int(stamps.min()),
        publishers=edge.publishers,
    )
