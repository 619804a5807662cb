# SPDX-License-Identifier: Apache-2.0
"""The files of a recording without a path: one file, or the files of a folder on a server."""

from __future__ import annotations

from pathlib import PurePosixPath
from typing import TYPE_CHECKING, Any, Final

from coframe.bags._folder_metadata import listed_files, read_metadata
from coframe.bags.formats import COMPRESSED, METADATA, file_kinds, has_known_suffix
from coframe.errors import RecordingError

if TYPE_CHECKING:
    from coframe._sources.sources import Source
    from coframe.bags._problems import Problems

__all__ = ["files_of_source"]

MAX_FILES: Final = 2000


def files_of_source(source: Source, problems: Problems) -> tuple[list[Source], dict[str, Any]]:
    """Return the files of a recording in their order, and the content of its metadata.

    Args:
        source: A file, a folder, or the ``metadata.yaml`` of a folder.
        problems: Receives the problems found.

    Raises:
        RemoteFileError: The folder cannot be read.
        RecordingError: The folder contains no recording.
    """
    is_metadata = source.name == METADATA
    if not is_metadata and not source.is_folder():
        return [source], {}
    names = None if is_metadata else source.names()
    metadata = {}
    if names is None or METADATA in names:
        metadata = read_metadata(source if is_metadata else source.inner(METADATA), problems)
    listed = [PurePosixPath(name).name for name in listed_files(metadata)]
    if names is not None:
        listed = _existing_files(listed, names, problems)
    if not listed:
        raise RecordingError(
            f"{source} is not a recording: {_reason(names)}",
            hint=f"Give the URL of a {file_kinds()}, or of a folder with its {METADATA}.",
        )
    if len(listed) > MAX_FILES:
        raise RecordingError(f"{source} has {len(listed)} files, more than the maximum of {MAX_FILES}")
    return [source.inner(name) for name in listed], metadata


def _existing_files(listed_names: list[str], names: list[str], problems: Problems) -> list[str]:
    """Return the files of a folder that exist: those in the metadata first, then others."""
    found = []
    for name in listed_names:
        there = [each for each in (name, f"{name}{COMPRESSED}") if each in names]
        found += there[:1]
        if not there:
            problems.add(f"{METADATA} lists {name}, which does not exist")
    others = [name for name in names if has_known_suffix(PurePosixPath(name)) and name not in found]
    return list(dict.fromkeys([*found, *others]))


def _reason(names: list[str] | None) -> str:
    if names is None:
        return f"there is no {METADATA} that lists its files"
    return "the folder has no files with the suffix of a recording" if names else "the folder is empty"
