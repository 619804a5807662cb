# SPDX-License-Identifier: Apache-2.0
"""rosbag2's Python interface on coframe's recordings: reads and writes MCAP and SQLite without a ROS installation."""

from coframe.workspace import ros_side

ros_side.check("rosbag2_py")

from coframe.bags.formats import storage_formats
from rosbag2_py._compression import (
    CompressionMode,
    CompressionOptions,
    compression_mode_from_string,
    compression_mode_to_string,
)
from rosbag2_py._defaults import get_default_storage_id
from rosbag2_py._definitions import LocalMessageDefinitionSource, MessageDefinition
from rosbag2_py._info import BagMetadata, FileInformation, Info, MetadataIo, TopicInformation
from rosbag2_py._options import (
    ConverterOptions,
    ReadOrder,
    ReadOrderSortBy,
    StorageFilter,
    StorageOptions,
    TopicMetadata,
)
from rosbag2_py._player import Player
from rosbag2_py._reader import SequentialCompressionReader, SequentialReader
from rosbag2_py._recorder import Recorder
from rosbag2_py._reindexer import Reindexer
from rosbag2_py._rewrite import bag_rewrite
from rosbag2_py._transport_options import PlayOptions, RecordOptions, ServiceRequestsSource
from rosbag2_py._writer import SequentialCompressionWriter, SequentialWriter

__all__ = [
    "BagMetadata",
    "CompressionMode",
    "CompressionOptions",
    "ConverterOptions",
    "FileInformation",
    "Info",
    "LocalMessageDefinitionSource",
    "MessageDefinition",
    "MetadataIo",
    "PlayOptions",
    "Player",
    "ReadOrder",
    "ReadOrderSortBy",
    "RecordOptions",
    "Recorder",
    "Reindexer",
    "SequentialCompressionReader",
    "SequentialCompressionWriter",
    "SequentialReader",
    "SequentialWriter",
    "ServiceRequestsSource",
    "StorageFilter",
    "StorageOptions",
    "TopicInformation",
    "TopicMetadata",
    "bag_rewrite",
    "compression_mode_from_string",
    "compression_mode_to_string",
    "get_default_storage_id",
    "get_registered_compressors",
    "get_registered_readers",
    "get_registered_serializers",
    "get_registered_writers",
]


def get_registered_readers() -> set[str]:
    """Return the storage formats that can be read."""
    return set(storage_formats())


def get_registered_writers() -> set[str]:
    """Return the storage formats that can be written."""
    return set(storage_formats(written=True))


def get_registered_compressors() -> set[str]:
    """Return the compressions that can be written."""
    return {"zstd"}


def get_registered_serializers() -> set[str]:
    """Return the serialization formats."""
    return {"cdr"}
