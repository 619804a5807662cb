# SPDX-License-Identifier: Apache-2.0
"""Reindexer: writes the metadata.yaml of a recording again, from its files."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from coframe.bags import RecordingError, open_bag
from rosbag2_py._info import MetadataIo, metadata_of

if TYPE_CHECKING:
    from rosbag2_py._options import StorageOptions

__all__ = ["Reindexer"]


class Reindexer:
    """Restores the metadata of a recording."""

    def reindex(self, storage_options: StorageOptions) -> None:
        """Read all files of a recording and write its metadata.yaml."""
        folder = Path(storage_options.uri)
        try:
            with open_bag(folder, transforms=False) as recording:
                metadata = metadata_of(recording)
        except RecordingError as error:
            raise RuntimeError(str(error)) from error
        MetadataIo().write_metadata(str(folder if folder.is_dir() else folder.parent), metadata)
