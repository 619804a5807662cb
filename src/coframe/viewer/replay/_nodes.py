# SPDX-License-Identifier: Apache-2.0
"""The nodes of a replay: the scene nodes of the program when the replay was saved."""

from __future__ import annotations

import base64
from typing import TYPE_CHECKING

from coframe.viewer.protocol.replay_block import ReplayNode

if TYPE_CHECKING:
    from collections.abc import Sequence

    from coframe.viewer.scripting.nodes import NodeRecord

__all__ = ["MAX_NODE_BYTES", "record_nodes"]

MAX_NODE_BYTES = 32 << 20


def record_nodes(nodes: Sequence[NodeRecord], origin: int) -> list[ReplayNode]:
    """Return the nodes, with times relative to an origin in nanoseconds.

    Small nodes are included first; the page lists nodes omitted because of `MAX_NODE_BYTES`.
    """
    left = MAX_NODE_BYTES
    found: dict[int, ReplayNode] = {}
    for record in sorted(nodes, key=lambda one: 0 if one.geometry is None else one.geometry.size):
        geometry, problem = "", ""
        if record.geometry is not None:
            if record.geometry.size <= left:
                left -= record.geometry.size
                geometry = base64.b64encode(record.geometry.encode(record.id)).decode()
            else:
                problem = f"omitted from this replay; the maximum is {MAX_NODE_BYTES >> 20} MiB"
        message = record.message(origin, problem)
        message["clickable"] = False  # There is no program to call.
        found[record.id] = ReplayNode(node=message, geometry=geometry)
    return [found[record.id] for record in nodes]
