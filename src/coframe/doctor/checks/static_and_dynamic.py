# SPDX-License-Identifier: Apache-2.0
"""TF005: an edge that is published both as static and as dynamic."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe._output.formatting import times
from coframe.doctor._edge import publishers_of
from coframe.doctor._finding import Finding, Severity
from coframe.doctor._rules import drop_edge
from coframe.doctor.pose_mistakes import explain_mutual_difference
from coframe.frame_names import TF_STATIC_TOPIC, TF_TOPIC

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.doctor._edge import Edge
    from coframe.doctor.observation import Observation

__all__ = ["CODE", "find"]

CODE = "TF005"


def find(observation: Observation) -> Iterator[Finding]:
    """Yield one finding per edge."""
    static = {edge.key: edge for edge in observation.static}
    for edge in observation.dynamic:
        other = static.get(edge.key)
        if other is not None:
            yield Finding(
                code=CODE,
                severity=Severity.WARNING,
                text=f"published {times(other.count)} on /tf_static and {times(edge.count)} on /tf; each change from "
                f"one to the other clears its history in every buffer{_cause(other, edge)}",
                fix="Publish it on only one topic. If it moves, remove it from the StaticTransformBroadcaster, or "
                f"change the type of its URDF joint from fixed; otherwise stop publishing {edge.child!r} on /tf.",
                edge=edge.key,
                first_stamp=edge.first_stamp,
                publishers=publishers_of([other, edge]),
                choices=(drop_edge(edge.key, TF_STATIC_TOPIC), drop_edge(edge.key, TF_TOPIC)),
            )


def _cause(static: Edge, dynamic_edge: Edge) -> str:
    """Return a clause with the mistake that explains the difference of the two last poses, or "" if there is none."""
    explained = explain_mutual_difference(static.last_pose, dynamic_edge.last_pose)
    if explained is None:
        return ""
    mistake, is_static = explained
    wrong, right = ("/tf_static", "/tf") if is_static else ("/tf", "/tf_static")
    return f"; {mistake.text(f'that on {right}', f'the pose on {wrong}')}"
