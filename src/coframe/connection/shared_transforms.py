# SPDX-License-Identifier: Apache-2.0
"""Transforms in memory shared by all processes of a user on this machine: one process receives, all read."""

from __future__ import annotations

import atexit
import contextlib
import logging
import os
import threading
from dataclasses import astuple, replace
from pathlib import Path
from typing import TYPE_CHECKING, ClassVar

from coframe import _core
from coframe.time import MILLISECOND, SECOND
from coframe.wire import selection
from coframe.wire.participant import Participant
from coframe.wire.tf_reader import STATICS_TIMEOUT

if TYPE_CHECKING:
    from collections.abc import Callable

    from coframe.buffer.buffer import Buffer
    from coframe.connection.listener_config import ListenerConfig
    from coframe.wire.endpoints import GraphNode
    from coframe.wire.tf_reader import TfReader

    Mismatch = Callable[[str, str], object]
    Mismatches = tuple[Mismatch | None, Mismatch | None]  # of the subscriptions to dynamic and static transforms

__all__ = ["SharedTransforms", "open_segment"]

_logger = logging.getLogger("coframe.wire")

_FOLDER = "/dev/shm/coframe-{user}"  # noqa: S108 - memory of this user only; the native code checks its owner
_VACANCY_TIMEOUT = 10 * SECOND  # the end of a writer is noticed immediately; each check costs every process some time
_RETRY_PAUSE = 10 * MILLISECOND / SECOND
_CHECK_PERIOD = 10.0  # seconds between two checks whether the memory is full
GENERATIONS = 8  # of the memory of one configuration
_EXIT_TIMEOUT = 1.0  # seconds


def open_segment(config: ListenerConfig, generation: int = 0) -> _core.Segment:
    """Open the shared memory of the transforms for this configuration.

    Args:
        config: The topics, frames, cache, domain and middleware.
        generation: The number of the memory; see `SharedTransforms`.

    Raises:
        SegmentError: This system cannot share transforms.
    """
    import hashlib  # noqa: PLC0415 - it loads OpenSSL, which takes 3 ms

    if not hasattr(os, "getuid"):
        raise _core.SegmentError("sharing transforms between processes is supported only on Linux")
    # The name differs for every configuration, network namespace and configuration of the middleware.
    received = astuple(replace(config, interpolation="decoupled"))  # Buffers may interpolate in different ways.
    text = repr((*received, selection.network(config.wire), _network(), generation))
    name = f"{config.domain}-{hashlib.sha256(text.encode()).hexdigest()[:16]}"
    return _core.Segment.open(_FOLDER.format(user=os.getuid()), name, config.cache)


class SharedTransforms:
    """The shared transforms of one configuration in this process. Created by `join`.

    The first process becomes the writer: it receives the transforms. If it ends, another one takes over.

    The memory keeps static transforms that are no longer published, like every buffer, but a listener that starts later
    does not receive these. Once there are such transforms, later listeners therefore use a separate memory with the
    next generation number.
    """

    _instances: ClassVar[dict[tuple[ListenerConfig, int], SharedTransforms]] = {}
    _lock: ClassVar[threading.RLock] = threading.RLock()

    def __init__(
        self, config: ListenerConfig, generation: int, segment: _core.Segment, on_mismatch: Mismatches
    ) -> None:
        self.config = config
        self._on_mismatch = on_mismatch
        self._key = (config, generation)
        self._users = 0
        self._closed = threading.Event()
        self._hub: _Hub | None = None
        self._segment = segment
        try:
            if self._segment.try_to_write():
                self._hub = _Hub(self._segment, config, on_mismatch)
        except BaseException:
            self._segment.close()
            raise
        self._thread = threading.Thread(target=self._run, name="coframe shared transforms", daemon=True)
        self._thread.start()

    @classmethod
    def join(cls, config: ListenerConfig, on_mismatch: Mismatches = (None, None)) -> SharedTransforms:
        """Return the shared transforms of a configuration. Each call needs one call of `leave`.

        Args:
            config: The topics, frames, cache, domain and middleware.
            on_mismatch: The attributes of the subscriptions to dynamic and static transforms, if this process has not
                joined before; see `LocalEndpoint`.

        Raises:
            SegmentError: This system cannot share transforms.
            WireError: This process is the first one, and the middleware cannot join the graph.
        """
        with cls._lock:
            for generation in range(GENERATIONS):
                shared = cls._instances.get((config, generation)) or cls._open(config, generation, on_mismatch)
                if shared is not None and not shared.is_outdated:
                    shared._users += 1  # noqa: SLF001 - of this class
                    return shared
        raise _core.SegmentError(f"static transforms were withdrawn in all {GENERATIONS} generations of the memory")

    @classmethod
    def _open(cls, config: ListenerConfig, generation: int, on_mismatch: Mismatches) -> SharedTransforms | None:
        """Open shared transforms that this process has not joined before, or None if they are outdated."""
        segment = open_segment(config, generation)
        if segment.outdated:
            segment.close()
            return None
        shared = cls._instances[config, generation] = cls(config, generation, segment, on_mismatch)
        return shared

    @classmethod
    def forget_all(cls) -> None:
        """Forget everything in a forked process: its buffers can still read, but the threads do not exist there."""
        cls._instances.clear()
        cls._lock = threading.RLock()

    @classmethod
    def close_all(cls) -> None:
        """Stop receiving when the interpreter exits."""
        for shared in list(cls._instances.values()):
            shared.close()

    def leave(self) -> None:
        """Stop using the transforms. The last call in this process also stops receiving them."""
        with self._lock:
            self._users -= 1
            if self._users > 0 or self._instances.get(self._key) is not self:
                return
            del self._instances[self._key]
        self.close()

    def follow(self, buffer: Buffer, authority: str = "") -> bool:
        """Let an empty buffer read the shared transforms.

        Args:
            buffer: The empty buffer, which then looks up the shared transforms.
            authority: The authority of all transforms in the buffer. If empty, the names of the publishing nodes.

        Returns:
            False if the buffer is not empty.
        """
        return self._segment.follow(buffer, authority)

    @property
    def is_outdated(self) -> bool:
        """Whether they contain static transforms that are no longer published."""
        return self._segment.outdated

    @property
    def is_writer(self) -> bool:
        """Whether this process is the writer, which receives the transforms."""
        return self._hub is not None

    @property
    def writer_process(self) -> int:
        """The ID of the process that receives the transforms."""
        return self._segment.writer_process

    @property
    def writer_is_suspended(self) -> bool:
        """Whether the process that receives the transforms is suspended (Ctrl-Z, debugger) and stores nothing."""
        return is_suspended(self.writer_process)

    @property
    def shortage(self) -> str:
        """Why the memory could not grow; empty if it could."""
        return self._segment.shortage

    @property
    def used(self) -> int:
        """The size of the shared memory in use, in bytes."""
        return self._segment.used

    @property
    def readers(self) -> list[TfReader]:
        """The subscriptions of this process; empty if another process receives the transforms."""
        hub = self._hub
        return [] if hub is None else hub.readers

    @property
    def participant(self) -> Participant | None:
        """The participant of these subscriptions."""
        hub = self._hub
        return None if hub is None else hub.participant

    def _run(self) -> None:
        self._take_over()
        # Publishers deliver the static transforms again that an earlier writer received.
        if not self._closed.wait(STATICS_TIMEOUT):
            for reader in self.readers:
                reader.settle_statics()
        self._report_shortage()

    def _report_shortage(self) -> None:
        """Log once when the memory becomes full or is lost."""
        while self.is_writer:
            if self._segment.lost:
                _logger.error(
                    "Another program has truncated the file of the shared transforms in /dev/shm: this process no "
                    "longer stores transforms for others. Restart the programs that share them."
                )
                return
            if shortage := self._segment.shortage:
                _logger.warning(full_memory_warning(shortage))
                return
            if self._closed.wait(_CHECK_PERIOD):
                return

    def _take_over(self) -> None:
        """Wait until this process is the writer."""
        warned = False
        while not self._closed.is_set() and self._hub is None:
            try:
                if self._segment.try_to_write():
                    hub = _Hub(self._segment, self.config, self._on_mismatch)
                    with self._lock:
                        self._hub = hub
                    if self._closed.is_set():
                        self._close_hub()
                    return
            except _core.SegmentError as error:
                _logger.warning(
                    "This process cannot receive the shared transforms; another process must receive them: %s", error
                )
                self._segment.close()
                return
            except Exception:
                _logger.exception(
                    "This process cannot receive the shared transforms; another process must receive them."
                )
                self._segment.close()
                return
            self._segment.wait_for_vacancy(_VACANCY_TIMEOUT)
            if self.writer_is_suspended and not warned:
                _logger.warning(suspension_warning(self.writer_process))
            warned = self.writer_is_suspended
            self._closed.wait(_RETRY_PAUSE)

    def close(self) -> None:
        """Stop receiving, even if other parts of this process still use the transforms."""
        self._closed.set()
        self._segment.interrupt()
        if self._thread is not threading.current_thread():
            self._thread.join(_EXIT_TIMEOUT)
        self._close_hub()
        self._segment.close()

    def _close_hub(self) -> None:
        with self._lock:
            hub, self._hub = self._hub, None
        if hub is not None:
            hub.close()


class _Hub:
    """The subscriptions that store transforms in the shared memory."""

    def __init__(self, segment: _core.Segment, config: ListenerConfig, on_mismatch: Mismatches) -> None:
        _remove_abandoned(Path(_FOLDER.format(user=os.getuid())))
        self._buffer = config.new_buffer()
        segment.write(self._buffer)
        self.participant = Participant.get(config.domain, config.wire)
        try:
            self._node: GraphNode = self.participant.add_node("/", f"coframe_hub_{os.getpid()}")
            self.readers = [
                self.participant.tf_reader(
                    self._node,
                    topic,
                    self._buffer,
                    static=static,
                    authority=None,
                    renaming=config.renaming,
                    on_mismatch=report,
                )
                for topic, static, report in zip(config.topics, (False, True), on_mismatch, strict=True)
            ]
        except BaseException:
            self.participant.close()
            raise

    def close(self) -> None:
        self._node.close()
        self._buffer.freeze()  # before another process writes
        self.participant.close()


def _remove_abandoned(folder: Path) -> None:
    """Remove shared memory whose processes were all killed. Every process locks the memory that it uses."""
    import fcntl  # noqa: PLC0415 - not on Windows, where there is no shared memory

    for path in folder.iterdir():
        if path.suffix:  # locks of writers, and memory that is being created
            continue
        with contextlib.suppress(OSError), path.open("rb") as file:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            path.unlink()


def is_suspended(process: int) -> bool:
    """Return whether a process is stopped by a signal or a debugger, or False if that is unknown."""
    try:
        status = Path(f"/proc/{process}/stat").read_text(encoding="utf-8", errors="replace")
    except OSError:
        return False
    return status.rpartition(")")[2].split()[:1] in (["T"], ["t"])


def suspension_warning(process: int) -> str:
    """Return a warning about a suspended process that receives the shared transforms."""
    return (
        f"Process {process}, which receives the shared transforms, is suspended: no new transforms are stored until it "
        f"continues (kill -CONT {process}) or ends."
    )


def full_memory_warning(shortage: str) -> str:
    """Return a warning about shared memory that cannot grow; `shortage` is the reason."""
    return (
        f"The memory of the shared transforms is full: {shortage}. New frames are rejected, and the oldest samples are "
        "dropped early. Make /dev/shm larger (docker run --shm-size=512m) or shorten the cache, and restart the "
        "programs."
    )


def _network() -> int:
    """Return a number that identifies the network namespace; containers often have their own."""
    try:
        return Path("/proc/self/ns/net").stat().st_ino
    except OSError:
        return 0


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=SharedTransforms.forget_all)
atexit.register(SharedTransforms.close_all)
