# SPDX-License-Identifier: Apache-2.0
"""The names of topics and frames when recordings are merged. Names of different robots stay separate."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import numpy as np

from coframe._output.formatting import join_names
from coframe.bags.transforms import ingest_for
from coframe.frame_names import absolute, renaming, shared_frames

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

    from coframe import _core
    from coframe.bags.recording import Recording

__all__ = ["MergedNames"]

# Topics that all robots share, as programs expect them under these names.
_SHARED_TOPICS = {"/clock", "/diagnostics", "/diagnostics_agg", "/parameter_events", "/rosout", "/tf", "/tf_static"}
_NAMESPACE = re.compile(r"[A-Za-z_]\w*(/[A-Za-z_]\w*)*", re.ASCII)
_SYSTEM_TOPICS = {"/clock", "/rosout", "/parameter_events"}  # not in the namespace of a robot
_MAX_COMPARED_MESSAGES = 50  # messages on a topic whose frames are compared


class MergedNames:
    """The new names of the topics and frames of several recordings.

    Args:
        recordings: The recordings to merge.
        prefixes: The prefix of the frames and topics of each; None: frames keep their names, and topics that several
            recordings contain are prefixed if the frames of each recording have their own prefix.
        keep: Frames without the prefix.
        namespaces: The namespace of the topics of each; "" or None: they keep their names.

    Raises:
        ValueError: The number of prefixes or namespaces differs from that of the recordings, or one is invalid.
    """

    def __init__(
        self,
        recordings: Sequence[Recording],
        prefixes: Sequence[str] | None,
        keep: Iterable[str] = (),
        namespaces: Sequence[str] | None = None,
    ) -> None:
        if namespaces is not None and len(namespaces) != len(recordings):
            raise ValueError(
                f"each of the {len(recordings)} recordings needs one namespace, in the same order; {len(namespaces)} "
                "given"
            )
        self._namespaces = [_namespace(each) for each in namespaces or [""] * len(recordings)]
        if prefixes is not None and len(prefixes) != len(recordings):
            raise ValueError(
                f"each of the {len(recordings)} recordings needs one prefix, in the same order, but there are "
                f"{len(prefixes)}"
            )
        self._recordings = recordings
        self._prefixes = list(prefixes) if prefixes is not None else _own_prefixes(recordings)
        self._renamings = [renaming(prefix, shared_frames(keep)) for prefix in prefixes or [""] * len(recordings)]
        self._has_given_prefixes = prefixes is not None or namespaces is not None
        self._shared_topics: dict[str, list[int]] = {}  # the recordings that contain a topic
        for number, recording in enumerate(recordings):
            for name in recording.topics:
                self._shared_topics.setdefault(name, []).append(number)

    def frames(self, recording: int) -> _core.Renaming | None:
        """Return the renaming of the frames of a recording, or None if they keep their names."""
        return self._renamings[recording]

    def frame(self, recording: int) -> Callable[[str], str]:
        """Return the function that gives the frames of a recording their new names."""
        return self._renamings[recording] or str

    def is_shared(self, topic: str) -> bool:
        """Return whether all robots publish on a topic."""
        return absolute(topic) in _SHARED_TOPICS

    def topic(self, recording: int, name: str) -> str:
        """Return the new name of a topic of a recording."""
        if self._namespaces[recording]:
            return name if absolute(name) in _SYSTEM_TOPICS else f"{self._namespaces[recording]}{absolute(name)}"
        prefix = self._prefixes[recording]
        is_alone = len(self._shared_topics.get(name, ())) < 2 and not self._has_given_prefixes
        if not prefix or is_alone or absolute(name) in _SHARED_TOPICS or absolute(name).startswith(f"/{prefix}"):
            return name
        return f"/{prefix}{absolute(name).lstrip('/')}"

    def notes(self, topics: Sequence[Sequence[str]]) -> list[str]:
        """Return which topics were joined from several recordings, and which were kept separate.

        Args:
            topics: The topics that are copied, for each recording.
        """
        sources: dict[str, list[tuple[int, str]]] = {}
        apart: dict[str, list[str]] = {}
        for number, names in enumerate(topics):
            for name in names:
                if self._recordings[number].topics[name].messages:
                    new = self.topic(number, name)
                    sources.setdefault(new, []).append((number, name))
                    if new != name and not self._has_given_prefixes:
                        apart.setdefault(name, []).append(new)
        kept_apart = [
            f"{name}: kept apart as {join_names(new)}, because the frames have different prefixes"
            for name, new in apart.items()
        ]
        joined = [
            f"{name}: joined from {len(parts)} recordings{self._frames_text(parts)}"
            for name, parts in sources.items()
            if len(parts) > 1 and absolute(name) not in _SHARED_TOPICS
        ]
        return kept_apart + joined

    def _frames_text(self, parts: list[tuple[int, str]]) -> str:
        """Return the frames of the messages of a joined topic if they differ between the recordings."""
        found = [_find_frames(self._recordings[number], name) - {""} for number, name in parts]
        if not all(found) or len(set.union(*found)) == len(set.intersection(*found)):
            return ""
        names = join_names(repr(frame) for frame in sorted(set.union(*found)))
        return f", with messages in {names}: prefixes keep those of different robots apart"


def _namespace(name: str) -> str:
    """Return a namespace with one slash before it and none after it, or "" for none."""
    bare = name.strip("/")
    if bare and not _NAMESPACE.fullmatch(bare):
        raise ValueError(f"{name[:60]!r} is not a namespace such as /robot1")
    return f"/{bare}" if bare else ""


def _own_prefixes(recordings: Sequence[Recording]) -> list[str]:
    """Return the prefix that the frames of each recording have, or "" for all if not each has one of its own."""
    found = [_own_prefix(recording) for recording in recordings]
    return found if all(found) and len(set(found)) == len(found) > 1 else [""] * len(found)


def _own_prefix(recording: Recording) -> str:
    """Return the prefix, with its slash, of all frames but the roots, or "" if there are several or none."""
    edges = [edge for buffer in recording.buffers.values() for edge in buffer.edges() if edge.parent]
    children = {edge.child for edge in edges}
    roots = {edge.parent for edge in edges} - children
    sensed = {frame for name in recording.topics if (frame := recording.first_frame(name).lstrip("/"))}
    prefixes = {name.partition("/")[0] if "/" in name else "" for name in children | (sensed - roots)}
    return f"{prefixes.pop()}/" if len(prefixes) == 1 and "" not in prefixes else ""


def _find_frames(recording: Recording, topic: str) -> set[str]:
    if any(ingest_for(channel) for channel in recording.channels() if channel.topic == topic):
        return set()
    messages = recording.topics[topic].messages
    rows = np.unique(np.linspace(0, messages - 1, _MAX_COMPARED_MESSAGES).astype(np.int64)).tolist() if messages else []
    return {frame.lstrip("/") for frame in recording.frames(topic, rows)}
