# SPDX-License-Identifier: Apache-2.0
"""TF016: static transforms that late joiners do not receive, and outdated ones from old processes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from coframe._output.formatting import duration, join_names, times
from coframe.doctor._finding import Finding, Severity
from coframe.doctor.pose_mistakes import explain_mutual_difference
from coframe.time import SECOND

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor._edge import Edge
    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF016"
_BROADCASTER_ADVICE = (
    "Use tf2_ros.StaticTransformBroadcaster(node), or QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)."
)


def find(observation: Observation) -> Iterator[Finding]:
    """Yield findings for wrong QoS on either side, for overwritten static transforms, and for outdated ones."""
    for facts in observation.topics.values():
        if facts.name.rpartition("/")[2] != "tf_static":
            continue
        for endpoint in facts.publishers:
            if not endpoint.transient_local:
                yield _publisher(facts.name, endpoint.node)
        for endpoint in facts.subscribers:
            if not endpoint.transient_local:
                yield _subscriber_finding(facts.name, endpoint.node)
    if observation.live:
        yield from _overwritten_statics(observation)
    for edge in observation.static:
        yield from _find_outdated_statics(edge)


def _publisher(topic: str, node: str) -> Finding:
    return Finding(
        code=CODE,
        severity=Severity.ERROR,
        text=f"{node} publishes {topic} with durability volatile: listeners with the QoS of tf2 receive nothing"
        if node
        else f"a publisher of {topic} offered durability volatile: listeners with the QoS of tf2 received nothing from "
        "it, and receive nothing when the recording is replayed with the recorded QoS",
        fix=_BROADCASTER_ADVICE
        if node
        else f"{_BROADCASTER_ADVICE} On the running robot, `coframe doctor` names the node. Replay this recording with "
        "`coframe play`, which publishes static transforms with durability transient local.",
        topic=topic,
        publishers=(node,) if node else (),
    )


def _subscriber_finding(topic: str, node: str) -> Finding:
    return Finding(
        code=CODE,
        severity=Severity.WARNING,
        text=f"{node} subscribes to {topic} with durability volatile: it does not receive earlier messages",
        fix="Use tf2_ros.TransformListener(buffer, node), or QoSProfile(depth=100, "
        "durability=DurabilityPolicy.TRANSIENT_LOCAL).",
        topic=topic,
        publishers=(node,),
    )


def _overwritten_statics(observation: Observation) -> Iterator[Finding]:
    """Yield static transforms that late joiners miss, because a publisher usually keeps only its last message."""
    transforms = observation.transforms
    for number, publisher in enumerate(transforms.publishers):
        rows = np.flatnonzero(transforms.static & (transforms.publisher == number))
        messages = np.unique(transforms.arrived[rows])
        if not publisher or len(messages) < 2:
            continue
        kept = transforms.arrived[rows] == messages[-1]
        in_last = {transforms.names[name] for name in transforms.child[rows[kept]]}
        lost = sorted({transforms.names[name] for name in transforms.child[rows[~kept]]} - in_last)
        if lost:
            yield Finding(
                code=CODE,
                severity=Severity.WARNING,
                text=f"{publisher} has published {len(messages)} messages of static transforms, and the last one does "
                f"not contain {join_names(lost)}: nodes that start now do not receive these unless the publisher keeps "
                "more than one message",
                fix="Publish all of them in one call of one broadcaster: broadcaster.sendTransform([t1, t2, ...]).",
                frames=frozenset(lost),
                first_stamp=int(transforms.stamp[rows[0]]),
                publishers=(publisher,),
            )


def _find_outdated_statics(edge: Edge) -> Iterator[Finding]:
    """Yield an edge whose messages have very different delays: a process that repeats a message renews its stamp."""
    has_stamp = edge.stamp != 0
    stamps, lags = edge.stamp[has_stamp], edge.arrived[has_stamp] - edge.stamp[has_stamp]
    if len(lags) < 2 or lags.max() - lags.min() < SECOND or len(edge.publishers) == 1:
        return
    yield Finding(
        code=CODE,
        severity=Severity.NOTE if edge.constant else Severity.WARNING,
        text=f"published {times(len(stamps))} with stamps up to {duration(int(stamps.max() - stamps.min()))} apart"
        + (" and equal values" if edge.constant else f" and different values{_cause(edge)}")
        + ": processes that were started earlier are still running and publish the older ones",
        harm="A late joiner receives the message of each of these processes; if their values differ, the one that "
        "arrives last is used.",
        fix="Stop the older processes: find them with `ps` (static_transform_publisher, robot_state_publisher).",
        edge=edge.key,
        first_stamp=int(stamps.min()),
        publishers=edge.publishers,
    )


def _cause(edge: Edge) -> str:
    """Return a clause with the mistake that explains how the last value differs from the one before it."""
    different = np.flatnonzero((edge.values != edge.values[-1]).any(axis=1))
    explained = explain_mutual_difference(edge.last_pose, edge.poses(different[-1:]))
    if explained is None:
        return ""
    mistake, is_last = explained
    wrong, right = ("last", "earlier") if is_last else ("earlier", "last")
    return f" ({mistake.text(f'the {right} one', f'the {wrong} value')})"
