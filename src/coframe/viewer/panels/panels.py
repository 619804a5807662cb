# SPDX-License-Identifier: Apache-2.0
"""Panel data for one source that all clients share. Each part is created on demand."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.viewer.panels.own_messages import OwnMessages

if TYPE_CHECKING:
    from coframe.viewer.panels._curve_store import CurveStore
    from coframe.viewer.panels._log import Log
    from coframe.viewer.panels._node_graph import NodeGraphWatcher
    from coframe.viewer.sources.source import ViewerSource

__all__ = ["Panels"]


class Panels:
    """The curves, the log and the graph of one source. Use only on the server's thread.

    Args:
        source: The source that the panels describe.
    """

    # The modules are imported on demand, because the first frame update does not need them.

    def __init__(self, source: ViewerSource) -> None:
        self._source = source
        self._own_messages = OwnMessages()
        self._curves: CurveStore | None = None
        self._log: Log | None = None
        self._graph: NodeGraphWatcher | None = None

    @property
    def curves(self) -> CurveStore:
        """The curves."""
        if self._curves is None:
            from coframe.viewer.panels._curve_store import CurveStore  # noqa: PLC0415

            self._curves = CurveStore(self._source)
        return self._curves

    @property
    def log(self) -> Log:
        """The log."""
        if self._log is None:
            from coframe.viewer.panels._log import Log  # noqa: PLC0415

            self._log = Log(self._source, self._own_messages)
        return self._log

    @property
    def graph(self) -> NodeGraphWatcher:
        """The graph of nodes and topics."""
        if self._graph is None:
            from coframe.viewer.panels._node_graph import NodeGraphWatcher  # noqa: PLC0415

            self._graph = NodeGraphWatcher(self._source)
        return self._graph

    def restart(self) -> None:
        """Close all curves, because their times have jumped back. The pages request them again."""
        if self._curves is not None:
            self._curves.close()
            self._curves = None

    def poll(self) -> None:
        """Process new data; called for each update of a client, even if the client cannot receive it."""
        for part in (self._curves, self._log, self._graph):
            if part is not None:
                part.poll()

    def close(self) -> None:
        """Stop everything."""
        for part in (self._curves, self._log, self._graph, self._own_messages):
            if part is not None:
                part.close()
