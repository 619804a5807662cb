# SPDX-License-Identifier: Apache-2.0
"""The nodes that a program has added to the scene."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Any

from coframe._output.formatting import did_you_mean, join_quoted
from coframe.viewer.protocol.server_messages import SceneNode
from coframe.viewer.scripting.errors import SceneError
from coframe.viewer.scripting.records import Record, RecordStore

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.viewer.protocol.client_messages import ClickNode
    from coframe.viewer.protocol.common import NodeKind, Pose, Vector
    from coframe.viewer.scripting._geometry import Geometry
    from coframe.viewer.scripting.callbacks import CallbackThread

__all__ = ["IDENTITY", "MAX_NODES", "MAX_NODE_BYTES", "NodeRecord", "NodeStore"]

MAX_NODES = 5000
MAX_NODE_BYTES = 512 << 20
IDENTITY: Pose = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)


@dataclass(frozen=True)
class NodeRecord(Record):
    """A node. The attributes are described in :class:`coframe.viewer.protocol.server_messages.SceneNode`.

    Attributes:
        time: The time from which the node is shown, in nanoseconds, or None for always.
        geometry: The geometry, or None for axes and text.
        geometry_version: A number that changes with the geometry.
    """

    name: str
    kind: NodeKind
    frame: str | None = None
    pose: Pose = IDENTITY
    time: int | None = None
    visible: bool = True
    clickable: bool = False
    color: Vector | None = None
    opacity: float = 1.0
    size: float = 1.0
    text: str = ""
    wireframe: bool = False
    geometry: Geometry | None = None
    geometry_version: int = 0

    def message(self, origin: int, problem: str = "") -> SceneNode:
        """Return the message to the pages, with times relative to an origin in nanoseconds."""
        return SceneNode(
            type="node",
            id=self.id,
            name=self.name,
            kind=self.kind,
            frame=self.frame,
            pose=self.pose,
            time=None if self.time is None else float(self.time - origin),
            visible=self.visible,
            clickable=self.clickable,
            color=self.color,
            opacity=self.opacity,
            size=self.size,
            text=self.text,
            wireframe=self.wireframe,
            problem=problem,
        )


class NodeStore(RecordStore[NodeRecord]):
    """All nodes. Any thread may use it.

    Args:
        callbacks: The thread in which callbacks run.
    """

    def __init__(self, callbacks: CallbackThread) -> None:
        super().__init__()
        self._callbacks = callbacks
        self._ids_by_name: defaultdict[str, dict[int | None, int]] = defaultdict(dict)  # each has times and ids
        self._clicked: defaultdict[int, list[Callable[[ClickNode], object]]] = defaultdict(list)
        self._size = 0

    def add(self, record: NodeRecord) -> NodeRecord:
        """Add a node, replacing all nodes with its name. A node with a time replaces only the one with the same time.

        Raises:
            SceneError: There are too many nodes, or too many bytes.
        """
        with self.lock:
            replaced = self._replaced_nodes(record)
            if len(self) - len(replaced) >= MAX_NODES:
                raise SceneError(f"name: the scene has the maximum of {MAX_NODES} nodes", hint="Remove other nodes.")
            freed = sum(_size(one.geometry) for one in replaced)
            self._check_size(_size(record.geometry) - freed, record)
            self._remove_records(replaced)
            self._size += _size(record.geometry)
            self._ids_by_name[record.name][record.time] = record.id
            return self.put(record, geometry_version=self.revision + 1)

    def update(self, number: int, **fields: Any) -> NodeRecord:
        """Change a node.

        Raises:
            SceneError: The node was removed, or there are too many bytes.
        """
        with self.lock:
            record = self.get(number)
            if record is None:
                raise SceneError("this node was removed, or replaced by another one with its name")
            if "geometry" in fields:
                change = _size(fields["geometry"]) - _size(record.geometry)
                self._check_size(change, record)
                self._size += change
                fields["geometry_version"] = self.revision + 1
            return self.put(record, **fields)

    def remove(self, number: int) -> None:
        """Remove a node with everything below it, if it exists."""
        with self.lock:
            record = self.get(number)
            if record is None:
                return
            is_only_one = len(self._ids_by_name[record.name]) == 1
            self._remove_records(self._subtree(record.name) if is_only_one else [record])

    def remove_name(self, name: str) -> None:
        """Remove all nodes with a name, and everything below them.

        Raises:
            SceneError: There is no such node.
        """
        with self.lock:
            found = self._subtree(name)
            if not found:
                names = self.names()
                known = f"Nodes: {join_quoted(names)}." if names else "The scene has no nodes."
                raise SceneError(f"name: no node {name!r}", hint=f"{did_you_mean(name, names)} {known}".strip())
            self._remove_records(found)

    def names(self) -> list[str]:
        """Return the names of all nodes, in alphabetical order."""
        with self.lock:
            return sorted(self._ids_by_name)

    def reset(self) -> None:
        """Remove all nodes."""
        with self.lock:
            self._remove_records(self.all())

    def on_click(self, number: int, callback: Callable[[ClickNode], object]) -> None:
        """Call a function with each click on a node.

        Raises:
            SceneError: The node was removed.
        """
        with self.lock:
            self.update(number, clickable=True)
            self._clicked[number].append(callback)

    def clicked(self, click: ClickNode) -> None:
        """Run the callbacks of a node. Do nothing if it was removed meanwhile."""
        with self.lock:
            callbacks = list(self._clicked.get(click.node, ()))
        for callback in callbacks:
            self._callbacks.submit(partial(callback, click))

    def _replaced_nodes(self, record: NodeRecord) -> list[NodeRecord]:
        """Return the nodes that another one with their name replaces: all of them, or those with its time or none."""
        ids = self._ids_by_name.get(record.name, {})
        replaced = [number for time, number in ids.items() if record.time is None or time in {None, record.time}]
        return [found for number in replaced if (found := self.get(number)) is not None]

    def _subtree(self, name: str) -> list[NodeRecord]:
        return [one for one in self.all() if one.name == name or one.name.startswith(f"{name}/")]

    def _remove_records(self, records: list[NodeRecord]) -> None:
        for record in records:
            self._size -= _size(record.geometry)
            self._clicked.pop(record.id, None)
            ids = self._ids_by_name[record.name]
            ids.pop(record.time, None)
            if not ids:
                del self._ids_by_name[record.name]
        self.drop(record.id for record in records)

    def _check_size(self, change: int, record: NodeRecord) -> None:
        if self._size + change > MAX_NODE_BYTES:
            raise SceneError(
                f"with {record.name!r}, the scene would be larger than the maximum of {MAX_NODE_BYTES >> 20} MiB",
                hint="Remove other nodes, or thin the data.",
            )


def _size(geometry: Geometry | None) -> int:
    return 0 if geometry is None else geometry.size
