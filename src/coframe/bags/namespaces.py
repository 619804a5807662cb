# SPDX-License-Identifier: Apache-2.0
"""The transforms of a recording by namespace: one buffer per robot, plus a common one if the names are distinct."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from coframe.analysis.clocks import group_by_clock
from coframe.bags.transforms import ingest_for
from coframe.buffer import Buffer
from coframe.frame_names import TF_STATIC_TOPIC, TF_TOPIC, renaming, shared_frames

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    import numpy as np
    from numpy.typing import NDArray

    from coframe import _core
    from coframe.bags._problems import Problems
    from coframe.bags.storage import Channel
    from coframe.buffer import EdgeInfo
    from coframe.messages.slices import Slices

__all__ = [
    "ALL_TRANSFORMS",
    "TransformChoice",
    "TransformCollector",
    "main_clock_span",
    "namespace_of",
    "report_mixed_clocks",
]


@dataclass(frozen=True)
class TransformChoice:
    """Selects the transforms of a recording to read, and the names of their frames.

    Attributes:
        namespace: Read only the transforms of this namespace: ``/robot1`` for ``/robot1/tf``, or None for all.
        tf_topic: Read only the transforms on this topic and on ``tf_static_topic``. None means all topics, or ``/tf``
        if only the other topic is given.
        tf_static_topic: Read only the transforms on this topic and on ``tf_topic``. None means all topics, or
        ``/tf_static``.
        prefix: A prefix for the names of frames, used as given.
        keep: The frames without the prefix.
        transforms: Whether transforms are read at all.

    Raises:
        ValueError: The prefix begins with a slash.
        TypeError: The prefix or a name is not a string.
    """

    namespace: str | None = None
    tf_topic: str | None = None
    tf_static_topic: str | None = None
    prefix: str = ""
    keep: Iterable[str] = ()
    transforms: bool = True

    def __post_init__(self) -> None:
        renaming(self.prefix, self.keep)  # checks both
        object.__setattr__(self, "keep", tuple(shared_frames(self.keep)))

    @property
    def topics(self) -> tuple[str, ...] | None:
        """The topics whose transforms are read; None: all."""
        if not self.transforms:
            return ()
        if self.tf_topic is None and self.tf_static_topic is None:
            return None
        return self.tf_topic or TF_TOPIC, self.tf_static_topic or TF_STATIC_TOPIC

    @property
    def renaming(self) -> _core.Renaming | None:
        """The renaming of frames, or None if they keep their names."""
        return renaming(self.prefix, self.keep)

    def selects(self, topic: str) -> bool:
        """Return whether the transforms on a topic are read."""
        topics = self.topics
        in_namespace = self.namespace is None or _normalize_namespace(self.namespace) == namespace_of(topic)
        return in_namespace and (topics is None or _normalize_namespace(topic) in map(_normalize_namespace, topics))


ALL_TRANSFORMS: Final = TransformChoice()


class _NamespaceTransforms:
    """The transforms of one namespace.

    Static and dynamic transforms have separate buffers during the reading, because the history of a frame that changes
    between static and dynamic would be cleared.
    """

    def __init__(self) -> None:
        self.dynamic = Buffer(None)
        self.static = Buffer(None)

    def merge(self, problems: Problems) -> Buffer:
        """Return one buffer with all transforms; dynamic ones have priority over static ones of the same frame."""
        moving = {edge.child for edge in self.dynamic.edges() if edge.stored}
        for edge in self.static.edges():
            if edge.child in moving:
                problems.add(
                    f"{edge.parent} -> {edge.child} is published both on {edge.authority} and on a topic of dynamic "
                    "transforms; the dynamic ones are kept"
                )
            elif edge.parent.startswith("/") or edge.child.startswith("/"):  # after one slash has been removed
                problems.add(
                    f"{edge.parent} -> {edge.child} cannot be looked up: frame names of tf2 do not begin with a slash"
                )
            elif edge.parent:
                transform = self.static.lookup(edge.parent, edge.child)
                self.dynamic.set(edge.parent, edge.child, transform, 0, static=True, authority=edge.authority)
        return self.dynamic


class TransformCollector:
    """Ingests the transforms of a recording into one buffer per namespace.

    Args:
        problems: Receives the problems found.
        choice: Selects the topics, and renames the frames.
        on_transforms: Called with all messages that contain transforms, in batches; may be None.
    """

    def __init__(
        self,
        problems: Problems,
        choice: TransformChoice,
        on_transforms: Callable[[Channel, NDArray[np.int64], Slices], object] | None = None,
    ) -> None:
        self._renaming = choice.renaming
        self._problems = problems
        self._on_transforms = on_transforms
        self._choice = choice
        self._namespaces: dict[str, _NamespaceTransforms] = {}

    def ingest(self, channel: Channel) -> Callable[[NDArray[np.int64], Slices], None] | None:
        """Return a function that ingests the messages of a channel, or None if they are not needed."""
        namespace = namespace_of(channel.topic)
        take = ingest_for(channel, self._renaming)
        if take is None or not self._choice.selects(channel.topic):
            return None
        transforms = self._namespaces.setdefault(namespace, _NamespaceTransforms())
        buffer = transforms.static if take.static else transforms.dynamic

        def ingest(receive_times: NDArray[np.int64], messages: Slices) -> None:
            if self._on_transforms is not None:
                self._on_transforms(channel, receive_times, messages)
            if take.names_begin_with_slash(messages):
                self._problems.add(f"{channel.topic}: frame names begin with '/'; the slash is removed, as in tf2", 0)
            damaged, reason = take(buffer, messages)
            if damaged:
                self._problems.add(f"{channel.topic}: damaged messages; the first one: {reason}", damaged)

        return ingest

    def buffers(self) -> dict[str, Buffer]:
        """Return the buffers by namespace."""
        for transforms in self._namespaces.values():
            rejected = transforms.dynamic.statistics["refused"] + transforms.static.statistics["refused"]
            if rejected:
                self._problems.add(
                    "transforms that tf2 rejects: NaN, an invalid rotation, an empty name, or equal frame names",
                    rejected,
                )
        return {name: self._namespaces[name].merge(self._problems) for name in sorted(self._namespaces)}

    def common_buffer(
        self, buffers: dict[str, Buffer], messages: Callable[[], Iterable[tuple[Channel, Slices]]]
    ) -> Buffer:
        """Return one buffer for all namespaces, or the first namespace's buffer if several contain the same frame.

        Args:
            buffers: The buffers by namespace.
            messages: Returns all messages with transforms, to read them again.
        """
        if not buffers:
            return Buffer(None)
        first = next(iter(buffers))
        if len(buffers) == 1:
            return buffers[first]
        seen: dict[str, str] = {}
        for namespace, buffer in buffers.items():
            for edge in buffer.edges():
                other = seen.setdefault(edge.child, namespace)
                if other != namespace and edge.parent:
                    self._problems.add(
                        f"{other}/tf and {namespace}/tf both contain the frame {edge.child!r}: `buffer` contains only "
                        f"the transforms of {first or '/'}; use `buffers` or open_bag(namespace=...) for the others"
                    )
                    return buffers[first]
        return self._merge_buffers(messages())

    def _merge_buffers(self, messages: Iterable[tuple[Channel, Slices]]) -> Buffer:
        transforms = _NamespaceTransforms()
        for channel, slices in messages:
            take = ingest_for(channel, self._renaming)
            if take is not None and self._choice.selects(channel.topic):
                take(transforms.static if take.static else transforms.dynamic, slices)
        return transforms.merge(self._problems)


def namespace_of(topic: str) -> str:
    """Return the namespace of a topic: ``""`` for ``/tf``, ``/robot1`` for ``/robot1/tf``."""
    return _normalize_namespace(topic.rpartition("/")[0])


def _normalize_namespace(namespace: str) -> str:
    stripped = namespace.strip("/")
    return f"/{stripped}" if stripped else ""


def _moving_edges(buffer: Buffer) -> list[EdgeInfo]:
    return [edge for edge in buffer.edges() if not edge.static and edge.samples]


def _group_by_clock(buffer: Buffer) -> list[list[EdgeInfo]]:
    """Return the moving edges by the clock of their stamps, the clock with the most samples first."""
    moving = _moving_edges(buffer)
    groups = group_by_clock([(edge.oldest, edge.newest) for edge in moving])
    clocks = [[moving[position] for position in group] for group in groups]
    return sorted(clocks, key=lambda clock: -sum(edge.samples for edge in clock))


def main_clock_span(buffer: Buffer) -> tuple[int, int] | None:
    """Return the first and last stamp on the clock that most transforms use, or None without dynamic transforms."""
    clocks = _group_by_clock(buffer)
    if not clocks:
        return None
    return min(edge.oldest for edge in clocks[0]), max(edge.newest for edge in clocks[0])


def report_mixed_clocks(buffer: Buffer, problems: Problems) -> None:
    """Add a problem for each clock other than the one that most transforms use."""
    main, *others = _group_by_clock(buffer) or [[]]
    for clock in others:
        names = ", ".join(f"{edge.parent} -> {edge.child}" for edge in clock[:5])
        problems.add(
            f"two clocks are mixed: the stamps of {names} are hours apart from those of "
            f"{main[0].parent} -> {main[0].child}"
        )
