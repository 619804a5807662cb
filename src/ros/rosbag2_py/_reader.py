# SPDX-License-Identifier: Apache-2.0
"""SequentialReader: the messages of a recording, one after the other."""

from __future__ import annotations

import re
from collections import Counter
from typing import TYPE_CHECKING

from coframe.bags import Recording, RecordingError, open_bag
from rosbag2_py._info import BagMetadata, metadata_of
from rosbag2_py._options import (
    ConverterOptions,
    ReadOrder,
    ReadOrderSortBy,
    StorageFilter,
    StorageOptions,
    TopicMetadata,
)

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.bags.storage import Channel

__all__ = ["SequentialCompressionReader", "SequentialReader", "check_formats"]

_Message = tuple[str, bytes, int]


def check_formats(options: ConverterOptions) -> None:
    """Raise RuntimeError if messages would have to be converted."""
    formats = {options.input_serialization_format, options.output_serialization_format} - {"", "cdr"}
    if formats:
        raise RuntimeError(
            f"No conversion to or from the serialization format {', '.join(sorted(formats))}; use 'cdr'."
        )


class SequentialReader:
    """Reads messages in receive order. Errors are RuntimeError, as upstream's."""

    def __init__(self) -> None:
        self.__opened: Recording | None = None
        self.__next: _Message | None = None
        self.__messages: Iterator[tuple[Channel, int, bytes]] = iter(())
        self.__topics: list[str] | None = None
        self.__end: int | None = None
        self.__start: int | None = None
        # The time of the last message, and how many of that time each topic had: a new filter continues after them.
        self.__last: int | None = None
        self.__delivered: Counter[str] = Counter()

    def open(self, storage_options: StorageOptions, converter_options: ConverterOptions | None = None) -> None:
        """Open a recording: a file, or a folder of rosbag2."""
        check_formats(converter_options or ConverterOptions())
        self.close()
        try:
            self.__opened = open_bag(storage_options.uri, transforms=False)
        except RecordingError as error:
            raise RuntimeError(f"No storage could be initialized from the inputs. {error}") from error
        self.__start = storage_options.start_time_ns if storage_options.start_time_ns >= 0 else None
        self.__end = storage_options.end_time_ns + 1 if storage_options.end_time_ns >= 0 else None
        self.__begin(self.__start)

    def open_uri(self, uri: str) -> None:
        """Open a recording with default options."""
        self.open(StorageOptions(uri=uri))

    def close(self) -> None:
        """Close the recording."""
        if self.__opened is not None:
            self.__opened.close()
        self.__opened, self.__next, self.__messages, self.__topics = None, None, iter(()), None

    def has_next(self) -> bool:
        """Return whether there is another message."""
        self.__recording()
        if self.__next is None:
            self.__next = next(((channel.topic, data, stamp) for channel, stamp, data in self.__messages), None)
        return self.__next is not None

    def read_next(self) -> _Message:
        """Return the topic, the serialized message and its receive time in nanoseconds."""
        if not self.has_next() or self.__next is None:
            raise RuntimeError("Bag is at end. No next message.")
        message, self.__next = self.__next, None
        topic, _, stamp = message
        if stamp != self.__last:
            self.__last, self.__delivered = stamp, Counter()
        self.__delivered[topic] += 1
        return message

    def get_all_topics_and_types(self) -> list[TopicMetadata]:
        """Return the topics of the recording, including those that the filter excludes."""
        return [information.topic_metadata for information in self.get_metadata().topics_with_message_count]

    def get_metadata(self) -> BagMetadata:
        """Return the metadata of the recording."""
        return metadata_of(self.__recording())

    def set_filter(self, storage_filter: StorageFilter) -> None:
        """Read only some topics, from the current position on."""
        names = list(self.__recording().topics)
        named = {*storage_filter.topics, *storage_filter.services_events}
        chosen = named or set(names)
        if storage_filter.regex:
            pattern = re.compile(storage_filter.regex)
            matching = {name for name in names if pattern.fullmatch(name)}
            chosen = (chosen | matching) if named else matching
        chosen -= {*storage_filter.exclude_topics, *storage_filter.exclude_service_events}
        if storage_filter.regex_to_exclude:
            excluded = re.compile(storage_filter.regex_to_exclude)
            chosen = {name for name in chosen if not excluded.fullmatch(name)}
        self.__topics = [name for name in names if name in chosen]
        self.__continue()

    def reset_filter(self) -> None:
        """Read all topics, from the current position on."""
        self.__recording()
        self.__topics = None
        self.__continue()

    def seek(self, timestamp: int) -> None:
        """Continue with the first message received at a time in nanoseconds, or after it."""
        self.__begin(timestamp)

    def set_read_order(self, read_order: ReadOrder) -> bool:
        """Return whether the order is supported. Only the receive order is, which is the default."""
        return read_order.sort_by is ReadOrderSortBy.ReceivedTimestamp and not read_order.reverse

    def __recording(self) -> Recording:
        if self.__opened is None:
            raise RuntimeError("Bag is not open. Call open() before reading.")
        return self.__opened

    def __begin(self, start: int | None) -> None:
        self.__last, self.__delivered = None, Counter()
        self.__start = start
        self.__continue()

    def __continue(self) -> None:
        """Read on from the current position, with the current filter."""
        self.__next = None
        start = self.__start if self.__last is None else self.__last
        messages = self.__recording().in_order(self.__topics, start, self.__end)
        self.__messages = _without(messages, self.__last, Counter(self.__delivered))


class SequentialCompressionReader(SequentialReader):
    """The same reader: compressed files and messages are recognized."""


def _without(
    messages: Iterator[tuple[Channel, int, bytes]], stamp: int | None, delivered: Counter[str]
) -> Iterator[tuple[Channel, int, bytes]]:
    """Yield the messages that have not been delivered at a time before."""
    for channel, received, data in messages:
        if received == stamp and delivered[channel.topic] > 0:
            delivered[channel.topic] -= 1
        else:
            yield channel, received, data
