# SPDX-License-Identifier: Apache-2.0
"""A subscription that stores transforms in a buffer."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from coframe_fastdds import _fastdds as native

if TYPE_CHECKING:
    from coframe import _core


class FastDdsTfReader(native.TfReader):
    """A reader with the statistics of its store. Implements `coframe.wire._backend.BackendTfReader`.

    Args:
        store: Stores the transforms.
        arguments: Those of the native class, which include the store.
    """

    def __init__(self, store: _core.TransformStore, *arguments: Any) -> None:
        self.arm = store.arm
        self.writers = store.writers
        self.name_writer = store.name_writer
        self.forget_writer = store.forget_writer
        self.writer_left = store.writer_left
        self.settle_statics = store.settle_statics
        self._store = store
        super().__init__(*arguments)

    @property
    def stored_at(self) -> int:
        """When the transforms of the newest message were stored, in nanoseconds of the steady clock, or 0 if never."""
        return self._store.stored_at

    @property
    def received(self) -> int:
        """The number of received messages."""
        return self._store.received
