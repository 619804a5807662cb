# SPDX-License-Identifier: Apache-2.0
"""The files of a recording that is edited, and one editor for each of them."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from coframe.bags._file_discovery import open_files
from coframe.bags.editing._converting_editor import ConvertingEditor, ConvertingSource
from coframe.bags.editing._mcap_editor import McapEditor
from coframe.bags.editing._mcap_source import McapSource
from coframe.bags.editing._sqlite_editor import SqliteEditor, SqliteSource
from coframe.bags.editing._survey import Source
from coframe.bags.formats import COMPRESSED, MCAP, METADATA, SQLITE

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from contextlib import ExitStack
    from pathlib import Path

    from coframe.bags._problems import Problems
    from coframe.bags._recorded_types import RecordedTypes
    from coframe.bags._recording_format import RecordingFormat
    from coframe.bags.editing._metadata import EditedFile
    from coframe.bags.editing._pipeline import InsertedMessage, Pipeline
    from coframe.bags.storage import Channel

__all__ = ["EditedInput", "InputFile", "read_input"]


@dataclass(frozen=True)
class InputFile:
    """One file of the input.

    Attributes:
        path: The file, unpacked if it was compressed as a whole.
        name: Its name without the suffix of a compressed file.
        size: In bytes.
        source: Reads it.
    """

    path: Path
    name: str
    size: int
    source: McapSource | SqliteSource | ConvertingSource

    def edit(
        self,
        target: Path | None,
        pipeline: Pipeline,
        inserted_messages: list[InsertedMessage],
        compression: str | None,
        edited: EditedFile,
        progress: Callable[[int], object],
    ) -> None:
        """Write the edited file; None as the target writes nothing."""
        if isinstance(self.source, McapSource):
            McapEditor(
                self.path, target, pipeline, self.source.definitions, inserted_messages, compression, edited
            ).run(progress)
        elif isinstance(self.source, SqliteSource):
            SqliteEditor(self.source, target, pipeline, inserted_messages, edited).run(progress)
        else:
            ConvertingEditor(self.source, target, pipeline, inserted_messages, compression, edited).run(progress)


@dataclass
class EditedInput(Source):
    """The recording that is edited.

    Attributes:
        files: Its files, in order.
        metadata: The content of metadata.yaml; empty if there is none.
        is_folder: Whether it is a folder.
        format: The format of the output.
        notes: What the output cannot have as the input does.
        listed: The topics that the metadata list.
    """

    files: list[InputFile]
    metadata: dict[str, Any]
    is_folder: bool
    format: RecordingFormat
    notes: list[str] = field(default_factory=list)
    listed: list[Channel] = field(default_factory=list)

    def channels(self) -> list[Channel]:
        """Return all channels."""
        return [channel for file in self.files for channel in file.source.channels()]

    def span(self) -> tuple[int, int] | None:
        """Return the first and last receive time in nanoseconds."""
        spans = [span for file in self.files if (span := file.source.span()) is not None]
        return (min(first for first, _ in spans), max(last for _, last in spans)) if spans else None

    def messages(self, is_selected: Callable[[Channel], bool]) -> Iterator[tuple[Channel, int, bytes]]:
        """Yield the messages of some channels in file order."""
        for file in self.files:
            yield from file.source.messages(is_selected)


def read_input(path: Path, types: RecordedTypes, problems: Problems, closing: ExitStack) -> EditedInput:
    """Open the files of a recording.

    Raises:
        RecordingError: No file can be read.
        DamagedError: A file is damaged.
        OSError: A file cannot be read.
    """
    folder = path.parent if path.name == METADATA else path
    storages, listed, metadata = open_files(folder, problems, closing)
    is_packed = str(metadata.get("compression_mode") or "").lower() == "message"
    formats = {storage.format for storage in storages}
    converts = is_packed or not formats <= {MCAP, SQLITE} or len(formats) > 1
    notes = []
    if converts:
        kind = "messages that are compressed one by one" if is_packed else " and ".join(each.name for each in formats)
        notes.append(f"coframe does not write {kind}; the edited recording is MCAP, with all messages in CDR")
        whole = ConvertingSource(folder, types, problems, closing)
        name = f"{folder.stem if not folder.is_dir() else folder.name}{MCAP.suffixes[0]}"
        size = sum(storage.size for storage in storages)
        return EditedInput([InputFile(folder, name, size, whole)], {}, folder.is_dir(), MCAP, notes)
    if any(storage.local_path.parent not in {folder, folder.parent} for storage in storages):
        notes.append("the files were compressed as a whole; those of the edited recording are not")
        metadata = {**metadata, "compression_format": "", "compression_mode": ""}
    files = []
    for storage in storages:
        source: McapSource | SqliteSource
        if storage.format is MCAP:
            source = McapSource(storage.local_path)
        else:
            source = SqliteSource(storage.local_path)
            closing.callback(source.database.close)
        name = storage.path.name.removesuffix(COMPRESSED)
        files.append(InputFile(storage.local_path, name, storage.size, source))
    return EditedInput(files, metadata, folder.is_dir(), formats.pop(), notes, listed)
