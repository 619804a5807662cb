# SPDX-License-Identifier: Apache-2.0
"""Find the files of a recording below a path, and open each with the reader for its format.

The first bytes of a file determine its format. Names and metadata.yaml only help to find and order the files.
"""

from __future__ import annotations

import difflib
import importlib
import os
import re
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO, NamedTuple

from coframe._files.other_files import BEGINNING_SIZE, describe_other_kind
from coframe._files.regular_files import open_regular, reading_hint
from coframe._files.temporary_folders import temporary_folder
from coframe._output.formatting import join_names
from coframe._process.optional_imports import pip_install
from coframe._sources.remote_error import RemoteFileError
from coframe._sources.sources import Source
from coframe.bags._compressed_messages import UnpackedMessages
from coframe.bags._folder_metadata import listed_files, listed_topics, read_metadata, word
from coframe.bags._remote_files import files_of_source
from coframe.bags.formats import (
    BUILT_IN,
    COMPRESSED,
    METADATA,
    file_kinds,
    formats,
    has_known_suffix,
    is_recording,
    matches,
)
from coframe.bags.storage import unpacked_budget
from coframe.errors import CoframeError, RecordingError

if TYPE_CHECKING:
    from collections.abc import Callable
    from contextlib import ExitStack

    from coframe._sources.sources import Readable
    from coframe.bags._problems import Problems
    from coframe.bags._recording_format import RecordingFormat
    from coframe.bags.storage import Channel, Storage

__all__ = ["OpenedFiles", "open_files"]

_ZSTD_MAGIC = b"\x28\xb5\x2f\xfd"
_UNPACKED_PIECE = 1 << 20  # bytes
_MAX_EXPANSION = 16 << 20  # bytes; incompressible data grows by less than this


class OpenedFiles(NamedTuple):
    """The opened files of a recording, the topics that its metadata lists, and the metadata; {} if there are none."""

    storages: list[Storage]
    listed_topics: list[Channel]
    metadata: dict[str, Any]


def open_files(
    path: Readable,
    problems: Problems,
    closing: ExitStack,
    progress: Callable[[int, int], object] = lambda _done, _total: None,
) -> OpenedFiles:
    """Open the files of a recording, in order.

    Args:
        path: A file, a folder with files, or the ``metadata.yaml`` of a folder.
        problems: Receives the problems found.
        closing: Receives the clean-up to perform when the recording is closed.
        progress: Called with the number of bytes of a file that is copied from a server, and its size or 0.

    Raises:
        RecordingError: No file can be read.
    """
    try:
        if isinstance(path, Source):
            candidates: list[Readable] = []
            files, metadata = files_of_source(path, problems)
            for source in files:
                source.progress = progress
                closing.callback(source.close)
                candidates.append(source)
        else:
            path = path.parent if path.name == METADATA else path
            metadata = read_metadata(path / METADATA, problems) if path.is_dir() else {}
            candidates = [*_candidates(path, metadata, problems)] if path.is_dir() else [path]
        found = [storage for file in candidates if (storage := _open(file, problems, closing)) is not None]
    except RemoteFileError as error:
        raise RecordingError(str(error), hint=error.hint) from None
    except OSError as error:
        raise RecordingError(
            f"{path} cannot be read: {error.strerror or error}",
            hint=(isinstance(path, Path) and _similar_paths_hint(path)) or reading_hint(error),
        ) from None
    if not found:
        reasons = problems.sentences()
        raise RecordingError(
            f"{path} is not a recording" + (f": {reasons[0].removeprefix(f'{path}: ')}" if reasons else ""),
            hint=(isinstance(path, Path) and _inner_recordings_hint(path))
            or f"Give a {file_kinds()}, or the folder that contains such files.",
        )
    if word(metadata, "compression_mode").lower() == "message":
        compression = word(metadata, "compression_format")
        found = [UnpackedMessages(storage, compression) for storage in found]
    return OpenedFiles(found, list(listed_topics(metadata)), metadata)


def _similar_paths_hint(path: Path) -> str:
    """Return a hint with similar paths if a path does not exist, or "" if there are none, or if it exists."""
    try:
        entries = [] if os.path.lexists(path) else sorted(path.parent.iterdir())
    except FileNotFoundError:
        return f"There is no folder {str(path.parent)!r}."
    except OSError:
        return ""
    names = [each.name for each in entries]
    near = difflib.get_close_matches(path.name, names, n=1) or [name for name in names if Path(name).stem == path.name]
    if near:
        return f"Did you mean {str(path.with_name(near[0]))!r}?"
    recordings = [each.name for each in entries if is_recording(each)]
    return f"Recordings in {str(path.parent.absolute())!r}: {join_names(recordings)}." if recordings else ""


def _inner_recordings_hint(folder: Path) -> str:
    """Return a hint that names the recordings inside a folder, or "" if there are none."""
    try:
        inner = [each.name for each in sorted(folder.iterdir()) if each.is_dir() and (each / METADATA).is_file()]
    except OSError:
        return ""
    return f"Give one of the recordings in this folder: {join_names(inner)}." if inner else ""


def _candidates(folder: Path, metadata: dict[str, Any], problems: Problems) -> list[Path]:
    """Return the files of a folder that may be part of the recording: those in the metadata first, then others."""
    existing = sorted((file for file in folder.iterdir() if _is_candidate(file, problems)), key=_natural_sort_key)
    in_metadata: list[Path] = []
    for name in listed_files(metadata):
        file = folder / Path(name).name
        same = [other for other in existing if other.name in {file.name, f"{file.name}{COMPRESSED}"}]
        in_metadata += same
        if not same and not file.exists():
            problems.add(f"{METADATA} lists {Path(name).name}, which does not exist")
    others = [file for file in existing if file not in in_metadata]
    # The order of these files does not matter, because messages are sorted by time.
    if metadata and others:
        names = ", ".join(file.name for file in others)
        problems.add(f"{METADATA} does not list {names}; {'it was' if len(others) == 1 else 'they were'} read as well")
    return list(dict.fromkeys([*in_metadata, *others]))


def _is_candidate(file: Path, problems: Problems) -> bool:
    is_named_so = has_known_suffix(file)
    try:
        start = _read_beginning(file)
    except FileNotFoundError:  # A running recorder renames its metadata between the listing and this line.
        return False
    except OSError as error:
        if is_named_so and not file.is_dir():
            problems.add(f"{file.name} cannot be read: {error.strerror or error}")
        return False
    return is_named_so or any(matches(each, file, start) for each in formats())


def _read_beginning(file: Readable) -> bytes:
    if isinstance(file, Source):
        return file.read(0, BEGINNING_SIZE)
    with open_regular(file) as opened:
        return opened.read(BEGINNING_SIZE)


def _natural_sort_key(file: Path) -> list[tuple[int, int, str]]:
    """Return a key that sorts numbers in names by value: run_2 before run_10."""
    return [
        (1, int(part), "") if part.isascii() and part.isdigit() else (0, 0, part)
        for part in re.split(r"(\d+)", file.name)
    ]


def _open(file: Readable, problems: Problems, closing: ExitStack) -> Storage | None:
    start = _read_beginning(file)
    if start.startswith(_ZSTD_MAGIC):
        path = file.copy(closing) if isinstance(file, Source) else file
        file, start = _unpack_file(path, problems, closing)
    for each in formats():
        if matches(each, Path(file.name) if isinstance(file, Source) else file, start):
            return _open_file(each, file, problems, closing)
    names = [each.name for each in formats()]
    reason = next(filter(None, (each.refusal(start) for each in formats())), "")
    unknown = f"the file is in none of these formats: {', '.join(names)}"
    problems.add(f"{file.name}: {reason or describe_other_kind(start) or unknown}")
    return None


def _open_file(format_: RecordingFormat, file: Readable, problems: Problems, closing: ExitStack) -> Storage | None:
    try:
        storage = format_.open_source(file, problems) if isinstance(file, Source) else None
        if storage is None:
            storage = format_.open(file.copy(closing) if isinstance(file, Source) else file, problems)
    except (OSError, CoframeError):
        raise
    except Exception as error:
        if format_ in BUILT_IN:
            raise
        problems.add(f"{file.name} cannot be opened ({format_.name}): {type(error).__name__}: {error}")
        return None
    closing.callback(storage.close)
    return storage


def _unpack_file(file: Path, problems: Problems, closing: ExitStack) -> tuple[Path, bytes]:
    """Unpack a compressed file into a folder that exists while the recording is open."""
    try:
        zstandard: Any = importlib.import_module("zstandard")
    except ModuleNotFoundError:
        raise RecordingError(
            f"{file} is compressed, and the package zstandard is not installed", hint=pip_install("bags")
        ) from None
    folder = Path(closing.enter_context(temporary_folder("coframe-unpacked-")))
    target = folder / file.name.removesuffix(COMPRESSED)
    budget = unpacked_budget(file.stat().st_size)
    # A damaged file yields a truncated one, and reading that reports the damage.
    with open_regular(file) as packed, target.open("wb") as unpacked_file, suppress(zstandard.ZstdError):
        source = _PackedFile(packed, unpacked_file)
        reader = zstandard.ZstdDecompressor().stream_reader(source)
        while piece := reader.read(_UNPACKED_PIECE):
            if unpacked_file.tell() + len(piece) > budget:
                problems.add(f"{file.name} unpacks to more than the maximum of {budget} bytes; the rest was not read")
                break
            unpacked_file.write(piece)
        if source.is_implausible:
            problems.add(f"{file.name} is damaged: {packed.tell()} bytes unpack to only {unpacked_file.tell()}")
    return target, _read_beginning(target)


class _PackedFile:
    """A compressed file that ends early if it unpacks to fewer bytes than it has (empty blocks can fill a file)."""

    def __init__(self, packed_file: BinaryIO, unpacked_file: BinaryIO) -> None:
        self._packed_file = packed_file
        self._unpacked_file = unpacked_file

    @property
    def is_implausible(self) -> bool:
        return self._packed_file.tell() > self._unpacked_file.tell() + _MAX_EXPANSION

    def read(self, size: int) -> bytes:
        return b"" if self.is_implausible else self._packed_file.read(size)
