# SPDX-License-Identifier: Apache-2.0
"""TF005: an edge that is published both as static and as dynamic."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe._output.formatting import times
from coframe.doctor._edge import publishers_of
from coframe.doctor._finding import Finding, Severity

if TYPE_CHECKING:
    from collections.abc import Iterator

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
                "one to the other clears its history in every buffer",
                fix="Publish it on one topic only. If it moves, remove it from the StaticTransformBroadcaster, or "
                f"change the type of its URDF joint from fixed; otherwise stop publishing {edge.child!r} on /tf.",
                edge=edge.key,
                first_stamp=edge.first_stamp,
                publishers=publishers_of([other, edge]),
            )
