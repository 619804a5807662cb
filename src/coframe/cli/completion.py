# SPDX-License-Identifier: Apache-2.0
"""Completion of frame and topic names for the shell; it is installed by ``coframe --install-completion``."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

from coframe.errors import CoframeError

__all__ = ["complete_frames", "complete_live_topics", "complete_tf_topics"]

_TF_TYPE = "tf2_msgs/msg/TFMessage"
_DISCOVERY = 0.5  # seconds
_LARGEST = 200 << 20  # bytes: reading more takes longer than typing the name


def complete_frames(ctx: Any, incomplete: str) -> list[str]:
    """Return the frames of the recording in the first argument that begin with a text."""
    words = ctx.params.get("names") or []
    if not words or not Path(words[0]).exists():
        return []
    from coframe.bags import open_bag  # noqa: PLC0415 - only if there is a recording

    path = Path(words[0])
    files = path.iterdir() if path.is_dir() else [path]
    if sum(file.stat().st_size for file in files if file.is_file()) > _LARGEST:
        return []
    try:
        with open_bag(path) as recording:
            names = {name for buffer in recording.buffers.values() for name in buffer.frame_names()}
    except CoframeError:
        return []
    return sorted(name for name in names if name.startswith(incomplete))


def complete_live_topics(incomplete: str) -> list[str]:
    """Return the topics of the ROS graph that begin with a text."""
    from coframe.cli.ros2.graph import DISCOVERY, graph_node, is_hidden  # noqa: PLC0415 - only for this completion

    try:
        with graph_node(DISCOVERY) as node:
            names = [name for name, _ in node.get_topic_names_and_types()]
    except (CoframeError, ImportError, SystemExit):
        return []
    return sorted(name for name in names if name.startswith(incomplete) and not is_hidden(name))


def complete_tf_topics(ctx: Any, incomplete: str) -> list[str]:
    """Return the topics of transforms on the ROS graph that begin with a text."""
    from coframe.wire import Participant  # noqa: PLC0415 - only for this completion

    try:
        participant = Participant.get(ctx.params.get("domain"))
    except CoframeError:
        return []
    try:
        time.sleep(_DISCOVERY)
        topics = participant.topics()
    finally:
        participant.close()
    return sorted(name for name, types in topics.items() if _TF_TYPE in types and name.startswith(incomplete))
