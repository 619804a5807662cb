# SPDX-License-Identifier: Apache-2.0
"""Recorder: records topics of the graph."""

from __future__ import annotations

import threading
import weakref
from typing import TYPE_CHECKING

from coframe.errors import RecordingError, WireError
from coframe.recorder import record as start_recording
from rosbag2_py._defaults import get_default_storage_id
from rosbag2_py._transport_options import RecordOptions

if TYPE_CHECKING:
    from coframe.recorder import Recorder as RunningRecorder
    from rosbag2_py._options import StorageOptions

__all__ = ["Recorder"]

_PERIOD = "0.05s"  # between two checks for cancellation
_ALL_TOPICS, _ALL_WITH_HIDDEN = r"(?!.*/_).*", ".*"  # regular expressions
_SECOND = 1_000_000_000
_running: weakref.WeakSet[Recorder] = weakref.WeakSet()


class Recorder:
    """Records topics, in either of upstream's two forms. Errors are RuntimeError, as upstream's.

    Until Kilted, ``Recorder().record(storage_options, record_options)`` records until Ctrl-C or ``cancel()``. In
    Lyrical, ``Recorder(storage_options, record_options)`` has methods that control it, and ``record()`` returns at
    once.

    Args:
        storage_options: The recording.
        record_options: What is recorded.
        log_level: Not used.
        node_name: Not used.
    """

    def __init__(
        self,
        storage_options: StorageOptions | str | None = None,
        record_options: RecordOptions | None = None,
        log_level: str = "info",
        node_name: str = "rosbag2_recorder",
    ) -> None:
        del log_level, node_name
        # Jazzy's only argument is the level of the log.
        self.__storage = None if isinstance(storage_options, str) else storage_options
        self.__options = record_options or RecordOptions()
        self.__recorder: RunningRecorder | None = None
        self.__cancelled = threading.Event()
        _running.add(self)

    def record(
        self,
        storage_options: StorageOptions | None = None,
        record_options: RecordOptions | None = None,
        node_name: str = "rosbag2_recorder",
    ) -> None:
        """Start the recording of the constructor, or record until Ctrl-C or `cancel`."""
        del node_name
        if storage_options is None:
            if self.__storage is None:
                raise RuntimeError("The recorder has no recording: give StorageOptions to its constructor.")
            self.__recorder = self.__recorder or self.__start(self.__storage, self.__options)
            return
        self.__cancelled.clear()
        recorder = self.__start(storage_options, record_options or RecordOptions())
        try:
            while not (recorder.wait(_PERIOD) or self.__cancelled.is_set()):
                pass
        except KeyboardInterrupt:
            pass  # Ctrl-C ends the recording, as upstream's signal handler does.
        finally:
            recorder.close()

    def start_spin(self) -> None:
        """Have no effect: the threads of coframe run without an executor."""

    def stop_spin(self) -> None:
        """Have no effect, see `start_spin`."""

    def stop(self) -> None:
        """End the recording and close its files."""
        recorder, self.__recorder = self.__recorder, None
        if recorder is not None:
            recorder.close()

    def pause(self) -> None:
        """Record no messages until `resume` is called."""
        self.__started().pause()

    def resume(self) -> None:
        """Record messages again."""
        self.__started().resume()

    def toggle_paused(self) -> None:
        """Pause the recording, or continue it."""
        self.resume() if self.is_paused() else self.pause()

    def is_paused(self) -> bool:
        """Return whether the recording is paused."""
        return self.__started().paused

    @staticmethod
    def cancel() -> None:
        """End the recordings of this process."""
        for recorder in list(_running):
            recorder.__cancelled.set()  # noqa: SLF001 - of the same class

    def __started(self) -> RunningRecorder:
        if self.__recorder is None:
            raise RuntimeError("The recorder is not recording: call record() first.")
        return self.__recorder

    def __start(self, storage: StorageOptions, options: RecordOptions) -> RunningRecorder:
        everything = options.all or options.all_topics
        pattern = _ALL_WITH_HIDDEN if options.include_hidden_topics else _ALL_TOPICS
        is_compressed = options.compression_mode.lower() not in {"", "none"}
        selects = everything or options.topics or options.topic_types or options.regex
        try:
            recorder = start_recording(
                storage.uri,
                topics=options.topics or (None if selects or options.services or options.all_services else []),
                regex=pattern if everything else options.regex or None,
                exclude=options.exclude_regex or options.exclude or None,
                types=options.topic_types,
                services=True if options.all_services else options.services,
                exclude_topics=options.exclude_topics,
                exclude_types=options.exclude_topic_types,
                exclude_services=options.exclude_service_events,
                storage=storage.storage_id or get_default_storage_id(),
                compression=(options.compression_format or "zstd") if is_compressed else "none",
                max_size=storage.max_bagfile_size or None,
                max_duration=storage.max_bagfile_duration * _SECOND or None,
            )
        except (RecordingError, WireError, ValueError) as error:
            raise RuntimeError(str(error)) from error
        if options.start_paused:
            recorder.pause()
        return recorder
