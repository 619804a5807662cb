# SPDX-License-Identifier: Apache-2.0
"""SequentialWriter: writes recordings as MCAP or SQLite files."""

from __future__ import annotations

from typing import NoReturn

from coframe.bags import RecordingError, Writer, from_yaml
from rosbag2_py._compression import CompressionMode, CompressionOptions
from rosbag2_py._defaults import get_default_storage_id
from rosbag2_py._options import ConverterOptions, StorageOptions, TopicMetadata
from rosbag2_py._reader import check_formats

__all__ = ["SequentialCompressionWriter", "SequentialWriter"]


class SequentialWriter:
    """Writes messages into a new folder. Errors are RuntimeError, as upstream's.

    As upstream's, the writer has no end: the files are complete when it is closed or deleted.
    """

    def __init__(self) -> None:
        self.__writer: Writer | None = None
        self.__topics: dict[str, int] = {}

    def open(self, storage_options: StorageOptions, converter_options: ConverterOptions | None = None) -> None:
        """Create the folder of a recording, which must not exist."""
        self._open(storage_options, converter_options, compression="none")

    def _open(self, options: StorageOptions, converter: ConverterOptions | None, *, compression: str) -> None:
        check_formats(converter or ConverterOptions())
        self.close()
        try:
            self.__writer = Writer(
                options.uri,
                storage=options.storage_id or get_default_storage_id(),
                compression=compression,
                max_size=options.max_bagfile_size or None,
                max_duration=options.max_bagfile_duration * 1_000_000_000 or None,
            )
        except (RecordingError, ValueError) as error:
            raise RuntimeError(str(error)) from error

    def create_topic(self, topic_with_type: TopicMetadata) -> None:
        """Add a topic. A topic that already exists stays as it is."""
        if topic_with_type.name in self.__topics:
            return
        qos = topic_with_type.offered_qos_profiles
        offered = from_yaml(qos) if isinstance(qos, str) and qos else []
        self.__topics[topic_with_type.name] = self.__opened().add_topic(
            topic_with_type.name,
            topic_with_type.type,
            offered_qos=offered,
            encoding=topic_with_type.serialization_format or "cdr",
        )

    def remove_topic(self, topic_with_type: TopicMetadata) -> None:
        """Reject more messages on a topic."""
        self.__topics.pop(topic_with_type.name, None)

    def write(self, topic_name: str, message: bytes, time_stamp: int, *_sequence_number: int) -> None:
        """Write a serialized message, received at a time in nanoseconds."""
        writer = self.__opened()
        if topic_name not in self.__topics:
            raise RuntimeError(f"Topic '{topic_name}' has not been created yet! Call 'create_topic' first.")
        try:
            writer.write(self.__topics[topic_name], bytes(message), time_stamp)
        except RecordingError as error:
            raise RuntimeError(str(error)) from error

    def take_snapshot(self) -> NoReturn:
        """Raise RuntimeError: coframe has no snapshot mode."""
        raise RuntimeError("Snapshot mode is not supported: write the messages with write().")

    def close(self) -> None:
        """Write everything to the disk."""
        writer, self.__writer, self.__topics = self.__writer, None, {}
        if writer is not None:
            writer.close()

    def __opened(self) -> Writer:
        if self.__writer is None:
            raise RuntimeError("Bag is not open. Call open() before writing.")
        return self.__writer

    def __del__(self) -> None:
        if not hasattr(self, "_SequentialWriter__writer"):
            return  # The constructor of a subclass has not called this one.
        self.close()


class SequentialCompressionWriter(SequentialWriter):
    """Writes compressed MCAP files. SQLite files are not compressed."""

    def __init__(self, compression_options: CompressionOptions | None = None) -> None:
        super().__init__()
        self.__options = compression_options or CompressionOptions("zstd", CompressionMode.FILE)

    def open(self, storage_options: StorageOptions, converter_options: ConverterOptions | None = None) -> None:
        """Create the folder of a recording, which must not exist."""
        compressed = self.__options.compression_mode is not CompressionMode.NONE
        self._open(
            storage_options,
            converter_options,
            compression=(self.__options.compression_format or "zstd") if compressed else "none",
        )
