# SPDX-License-Identifier: Apache-2.0
"""What renderers need besides the messages on their topic."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.connection.connection import Connection
    from coframe.viewer.sources.topic_messages import TopicMessages

__all__ = ["MeshUrl", "Resources"]

MeshUrl: TypeAlias = "Callable[[str], tuple[str | None, str | None]]"


def _no_mesh(_reference: str) -> tuple[str | None, str | None]:
    return None, "meshes are not available here"


@dataclass
class Resources:
    """What renderers need besides the messages on their topic.

    Attributes:
        topic: The name of the topic.
        mesh_url: Returns the URL of a marker's mesh, or the reason why there is none.
        others: The messages on the display's other topics, as far as these exist.
        connection: The connection to the ROS graph, or None if there is none.
    """

    topic: str = ""
    mesh_url: MeshUrl = _no_mesh
    others: dict[str, TopicMessages] = field(default_factory=dict)
    connection: Connection | None = None
