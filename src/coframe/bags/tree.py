"""The transforms of a recording: by namespace, statics apart, and what is odd about them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.analysis.clocks import group_by_clock
from coframe.bags.transforms import ingest_for
from coframe.buffer import Buffer

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    import numpy as np
    from numpy.typing import NDArray

    from coframe import _core
    from coframe.bags.problems import Problems
    from coframe.bags.storage import Channel
    from coframe.buffer import EdgeInfo
    from coframe.messages.slices import Slices

__all__ = ["Transforms", "Wanted", "namespace_of", "report", "span"]


class Wanted:
    """Which topics' transforms are read.

    Args:
        namespace: Only those in this one; None: all.
        topics: Only these; None: all.
    """

    def __init__(self, namespace: str | None = None, topics: Iterable[str] | None = None) -> None:
        self._namespace = None if namespace is None else _bare(namespace)
        self._topics = None if topics is None else {_bare(topic) for topic in topics}

    def __call__(self, topic: str) -> bool:
        """Whether this topic's are."""
        in_namespace = self._namespace in {None, namespace_of(topic)}
        return in_namespace and (self._topics is None or _bare(topic) in self._topics)


class _Tree:
    """One namespace's transforms.

    Statics are kept apart until the end: they are valid for all time, and a frame that changes between static and
    dynamic would start anew.
    """

    def __init__(self) -> None:
        self.moving = Buffer(None)
        self.static = Buffer(None)

    def joined(self, problems: Problems) -> Buffer:
        """All in one buffer; of what is said both ways, what moves."""
        moving = {edge.child for edge in self.moving.edges() if edge.stored}
        for edge in self.static.edges():
            if edge.child in moving:
                problems.add(
                    f"{edge.parent} -> {edge.child} is both on {edge.authority} and on a topic of moving transforms: "
                    "the moving ones are kept"
                )
            elif edge.parent.startswith("/") or edge.child.startswith("/"):  # once one slash is left off
                problems.add(f"{edge.parent} -> {edge.child} cannot be looked up: tf2 wants no slash in front")
            elif edge.parent:
                transform = self.static.lookup(edge.parent, edge.child)
                self.moving.set(edge.parent, edge.child, transform, 0, static=True, authority=edge.authority)
        return self.moving


class Transforms:
    """Takes in all transforms of a recording.

    Args:
        problems: Gets what is damaged or odd.
        wanted: Which topics'.
        renaming: What the frames are called in the buffers; None: as they come.
        heard: Is told of all of them, too.
    """

    def __init__(
        self,
        problems: Problems,
        wanted: Wanted,
        renaming: _core.Renaming | None = None,
        heard: Callable[[Channel, NDArray[np.int64], Slices], object] | None = None,
    ) -> None:
        self._renaming = renaming
        self._problems = problems
        self._heard = heard
        self._wanted = wanted
        self._trees: dict[str, _Tree] = {}

    def ingest(self, channel: Channel) -> Callable[[NDArray[np.int64], Slices], None] | None:
        """What takes in a channel's messages with the times of their receipt; None if they are not wanted."""
        namespace = namespace_of(channel.topic)
        take = ingest_for(channel, self._renaming)
        if take is None or not self._wanted(channel.topic):
            return None
        tree = self._trees.setdefault(namespace, _Tree())
        buffer = tree.static if take.static else tree.moving

        def ingest(received: NDArray[np.int64], messages: Slices) -> None:
            if self._heard is not None:
                self._heard(channel, received, messages)
            if take.names_begin_with_slash(messages):
                self._problems.add(f"{channel.topic}: names of frames begin with '/': it is left off, as tf2 does", 0)
            damaged, reason = take(buffer, messages)
            if damaged:
                self._problems.add(f"{channel.topic}: damaged messages, the first: {reason}", damaged)

        return ingest

    def buffers(self) -> dict[str, Buffer]:
        """By namespace."""
        for tree in self._trees.values():
            refused = tree.moving.statistics["refused"] + tree.static.statistics["refused"]
            if refused:
                self._problems.add(
                    "transforms that tf2 refuses: no numbers, no rotation, no name, or a frame in itself", refused
                )
        return {name: self._trees[name].joined(self._problems) for name in sorted(self._trees)}

    def together(self, buffers: dict[str, Buffer], messages: Callable[[], Iterable[tuple[Channel, Slices]]]) -> Buffer:
        """All namespaces in one buffer, or the first one if they use the same names."""
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
                        f"{other}/tf and {namespace}/tf both tell of {edge.child!r}: `buffer` holds those of "
                        f"{first or '/'} only; `buffers`, and open_bag(..., namespace=...), those of the others"
                    )
                    return buffers[first]
        return self._merged(messages())

    def _merged(self, messages: Iterable[tuple[Channel, Slices]]) -> Buffer:
        tree = _Tree()
        for channel, slices in messages:
            take = ingest_for(channel, self._renaming)
            if take is not None and self._wanted(channel.topic):
                take(tree.static if take.static else tree.moving, slices)
        return tree.joined(self._problems)


def namespace_of(topic: str) -> str:
    """What a topic is in: ``""`` for ``/tf``, ``/robot1`` for ``/robot1/tf``."""
    return _bare(topic.rpartition("/")[0])


def _bare(namespace: str) -> str:
    stripped = namespace.strip("/")
    return f"/{stripped}" if stripped else ""


def _moving(buffer: Buffer) -> list[EdgeInfo]:
    return [edge for edge in buffer.edges() if not edge.static and edge.samples]


def _clocks(buffer: Buffer) -> list[list[EdgeInfo]]:
    """Return the moving edges by the clock of their stamps, the clock with the most samples first."""
    moving = _moving(buffer)
    groups = group_by_clock([(edge.oldest, edge.newest) for edge in moving])
    clocks = [[moving[position] for position in group] for group in groups]
    return sorted(clocks, key=lambda clock: -sum(edge.samples for edge in clock))


def span(buffer: Buffer) -> tuple[int, int] | None:
    """The first and the last stamp on the clock that most transforms are told by; None if nothing moves."""
    clocks = _clocks(buffer)
    if not clocks:
        return None
    return min(edge.oldest for edge in clocks[0]), max(edge.newest for edge in clocks[0])


def report(buffer: Buffer, problems: Problems) -> None:
    """Notes clocks that do not fit together."""
    main, *others = _clocks(buffer) or [[]]
    for clock in others:
        names = ", ".join(f"{edge.parent} -> {edge.child}" for edge in clock[:5])
        problems.add(
            f"two clocks are mixed: {names} {'is' if len(clock) == 1 else 'are'} told hours apart from "
            f"{main[0].parent} -> {main[0].child}"
        )
