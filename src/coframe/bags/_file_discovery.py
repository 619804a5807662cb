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

from coframe._files.bounded_yaml import read_yaml
from coframe._files.other_files import BEGINNING, what_else
from coframe._files.regular_files import UnsuitableFileError, open_regular, read_regular, reading_hint
from coframe._files.temporary_folders import temporary_folder
from coframe._output.formatting import join_names
from coframe._process.optional_imports import pip_install
from coframe.bags._compressed_messages import UnpackedMessages
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
from coframe.bags.storage import Channel, unpacked_budget
from coframe.errors import CoframeError, RecordingError

if TYPE_CHECKING:
    from collections.abc import Iterator
    from contextlib import ExitStack

    from coframe.bags._problems import Problems
    from coframe.bags._recording_format import RecordingFormat
    from coframe.bags.storage import Storage

__all__ = ["OpenedFiles", "open_files"]

_ZSTD = b"\x28\xb5\x2f\xfd"
_UNPACKED_PIECE = 1 << 20  # bytes
_MAX_METADATA_BYTES = 16 << 20
_MAX_EXPANSION = 16 << 20  # bytes; incompressible data grows by less than this


class OpenedFiles(NamedTuple):
    """The opened files of a recording, the topics that its metadata lists, and the metadata; {} if there are none."""

    storages: list[Storage]
    listed_topics: list[Channel]
    metadata: dict[str, Any]


def open_files(path: Path, problems: Problems, closing: ExitStack) -> OpenedFiles:
    """Open the files of a recording, in order.

    Args:
        path: A file, a folder with files, or the ``metadata.yaml`` of a folder.
        problems: Receives the problems found.
        closing: Receives the clean-up to perform when the recording is closed.

    Raises:
        RecordingError: No file can be read.
    """
    if path.name == METADATA:
        path = path.parent
    try:
        metadata = _metadata(path / METADATA, problems) if path.is_dir() else {}
        candidates = _candidates(path, metadata, problems) if path.is_dir() else [path]
        found = [storage for file in candidates if (storage := _open(file, problems, closing)) is not None]
    except OSError as error:
        raise RecordingError(
            f"{path} cannot be read: {error.strerror or error}",
            hint=_existing_instead(path) or reading_hint(error),
        ) from None
    if not found:
        reasons = problems.sentences()
        raise RecordingError(
            f"{path} is not a recording" + (f": {reasons[0].removeprefix(f'{path}: ')}" if reasons else ""),
            hint=_inner_recordings(path) or f"Give a {file_kinds()}, or the folder that contains such files.",
        )
    if _word(metadata, "compression_mode").lower() == "message":
        compression = _word(metadata, "compression_format")
        found = [UnpackedMessages(storage, compression) for storage in found]
    return OpenedFiles(found, list(_listed_topics(metadata)), metadata)


def _existing_instead(path: Path) -> str:
    """Return a hint with similar paths if a path does not exist; "" if there are none, or if it exists."""
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


def _inner_recordings(folder: Path) -> str:
    """Return a hint that names the recordings inside a folder; "" if there are none."""
    try:
        inner = [each.name for each in sorted(folder.iterdir()) if each.is_dir() and (each / METADATA).is_file()]
    except OSError:
        return ""
    return f"Give one of the recordings in this folder: {join_names(inner)}." if inner else ""


def _candidates(folder: Path, metadata: dict[str, Any], problems: Problems) -> list[Path]:
    """Return the files of a folder that may be part of the recording: those in the metadata first, then others."""
    existing = sorted((file for file in folder.iterdir() if _is_candidate(file, problems)), key=_natural_sort_key)
    in_metadata: list[Path] = []
    for name in _listed_files(metadata):
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
        start = _beginning(file)
    except FileNotFoundError:  # A running recorder renames its metadata between the listing and this line.
        return False
    except OSError as error:
        if is_named_so and not file.is_dir():
            problems.add(f"{file.name} cannot be read: {error.strerror or error}")
        return False
    return is_named_so or any(matches(each, file, start) for each in formats())


def _beginning(file: Path) -> bytes:
    with open_regular(file) as opened:
        return opened.read(BEGINNING)


def _natural_sort_key(file: Path) -> list[tuple[int, int, str]]:
    """Return a key that sorts numbers in names by value: run_2 before run_10."""
    return [
        (1, int(part), "") if part.isascii() and part.isdigit() else (0, 0, part)
        for part in re.split(r"(\d+)", file.name)
    ]


def _open(file: Path, problems: Problems, closing: ExitStack) -> Storage | None:
    start = _beginning(file)
    if start.startswith(_ZSTD):
        file, start = _unpack_file(file, problems, closing)
    for each in formats():
        if matches(each, file, start):
            return _open_file(each, file, problems, closing)
    names = [each.name for each in formats()]
    reason = next(filter(None, (each.refusal(start) for each in formats())), "")
    unknown = f"the file is in none of these formats: {', '.join(names)}"
    problems.add(f"{file.name}: {reason or what_else(start) or unknown}")
    return None


def _open_file(format_: RecordingFormat, file: Path, problems: Problems, closing: ExitStack) -> Storage | None:
    try:
        storage = format_.open(file, problems)
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
    with open_regular(file) as packed, target.open("wb") as whole, suppress(zstandard.ZstdError):
        source = _PackedFile(packed, whole)
        reader = zstandard.ZstdDecompressor().stream_reader(source)
        while piece := reader.read(_UNPACKED_PIECE):
            if whole.tell() + len(piece) > budget:
                problems.add(f"{file.name} unpacks to more than the maximum of {budget} bytes; the rest was not read")
                break
            whole.write(piece)
        if source.is_implausible:
            problems.add(f"{file.name} is damaged: {packed.tell()} bytes unpack to only {whole.tell()}")
    return target, _beginning(target)


class _PackedFile:
    """A compressed file that ends early if it unpacks to fewer bytes than it has (empty blocks can fill a file)."""

    def __init__(self, packed: BinaryIO, whole: BinaryIO) -> None:
        self._packed = packed
        self._whole = whole

    @property
    def is_implausible(self) -> bool:
        return self._packed.tell() > self._whole.tell() + _MAX_EXPANSION

    def read(self, size: int) -> bytes:
        return b"" if self.is_implausible else self._packed.read(size)


def _metadata(file: Path, problems: Problems) -> dict[str, Any]:
    """Return the contents of metadata.yaml; empty if it is missing or damaged, because it is not required."""
    found: dict[str, Any] = {}
    try:
        text = read_regular(file, _MAX_METADATA_BYTES)
        found = dict(read_yaml(text, _MAX_METADATA_BYTES)["rosbag2_bagfile_information"])
    except FileNotFoundError:
        pass
    except UnsuitableFileError as error:
        problems.add(f"{METADATA} cannot be read: {error.strerror}; the files were read without it")
    except ModuleNotFoundError:
        problems.add(f"{METADATA} was not read: the package PyYAML is not installed")
    except (ValueError, TypeError, KeyError) as error:
        reason = " ".join(str(error).split())[:200]
        problems.add(f"{METADATA} is damaged ({reason}); the files were read without it")
    return found


def _word(metadata: dict[str, Any], key: str) -> str:
    """Return a string value; "" for another type."""
    value = metadata.get(key)
    return value if isinstance(value, str) else ""


def _listed_topics(metadata: dict[str, Any]) -> Iterator[Channel]:
    """Yield the topics in the metadata, which also lists those without messages."""
    entries = metadata.get("topics_with_message_count")
    for entry in entries if isinstance(entries, list) else []:
        topic = entry.get("topic_metadata") if isinstance(entry, dict) else None
        if isinstance(topic, dict) and isinstance(topic.get("name"), str) and isinstance(topic.get("type"), str):
            offered = topic.get("offered_qos_profiles")
            yield Channel(
                topic["name"],
                topic["type"],
                _word(topic, "serialization_format") or "cdr",
                offered_qos=offered if isinstance(offered, str) else "",
            )


def _listed_files(metadata: dict[str, Any]) -> list[str]:
    names = metadata.get("relative_file_paths")
    return [name for name in names if isinstance(name, str) and name] if isinstance(names, list) else []
