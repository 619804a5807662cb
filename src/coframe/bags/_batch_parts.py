# SPDX-License-Identifier: Apache-2.0
"""The Parquet file of one recording in a batch dataset, with its checksum and its inputs."""

from __future__ import annotations

import hashlib
import importlib
import json
import os
import uuid
from contextlib import suppress
from typing import TYPE_CHECKING, Any, Final

from coframe._files.complete_files import write_complete
from coframe._files.os_errors import reason
from coframe._files.regular_files import open_regular, read_regular
from coframe._sources.sources import Source
from coframe.bags._batch_results import Omission, QueryResult, query_as_dict
from coframe.errors import RecordingError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable
    from pathlib import Path

    from coframe._sources.sources import Readable
    from coframe.bags._trajectory_query import TrajectoryQuery
    from coframe.bags.tables import TableQuery

__all__ = ["fingerprint", "keep_if_of_query", "part_of", "previous_result", "write_part"]

_METADATA_KEY: Final = b"coframe"
_REPORT_KEY: Final = b"coframe.report"  # of what is missing, and the problems
_CHECKSUM_DIGITS: Final = 64  # of SHA-256
_MAX_CHECKSUM_FILE: Final = 10_000  # bytes: the digest and the file name


def part_of(bag: Readable, folder: Path) -> Path:
    """Return the file for a recording in a folder."""
    identity = bag.identity if isinstance(bag, Source) else str(bag)
    return folder / f"{bag.stem or 'recording'}-{hashlib.sha256(identity.encode()).hexdigest()[:12]}.parquet"


def fingerprint(bag: Readable, query: TrajectoryQuery | TableQuery) -> bytes:
    """Return a string that changes with the query and with the files of the recording.

    Raises:
        OSError: The recording cannot be read.
    """
    state: list[Any]
    if isinstance(bag, Source):
        # Without a version, it is not known whether the file has changed.
        state = [bag.size, *(bag.version or [uuid.uuid4().hex])]
    else:
        files = sorted(bag.iterdir()) if bag.is_dir() else [bag]
        state = [(file.name, file.stat().st_size, file.stat().st_mtime_ns) for file in files if file.is_file()]
    return json.dumps({"query": query_as_dict(query), "state": state}, sort_keys=True).encode()


def previous_result(part: Path, bag: str, made_from: bytes) -> QueryResult | None:
    """Return the result of an earlier run, or None if its file does not exist, is damaged or is out of date."""
    if not _is_intact(part):
        return None
    try:
        with open_regular(part) as file:
            metadata = importlib.import_module("pyarrow.parquet").read_metadata(file)
        stored = metadata.metadata or {}
        if stored.get(_METADATA_KEY) != made_from:
            return None
        missing, problems, omitted = json.loads(stored[_REPORT_KEY])
    except Exception:  # noqa: BLE001 - a damaged file is written again
        return None
    omissions = tuple(Omission(*each) for each in omitted)
    return QueryResult(
        bag, int(metadata.num_rows), missing, tuple(problems), kept=True, omitted=omissions, file=part.name
    )


def keep_if_of_query(part: Path, query: TrajectoryQuery | TableQuery) -> bool:
    """Return whether a recording that cannot be read now has the file of an earlier run; remove that of another query.

    Otherwise, the dataset would contain rows of two queries.
    """
    with suppress(Exception):
        with open_regular(part) as file:
            stored = importlib.import_module("pyarrow.parquet").read_metadata(file).metadata or {}
        if json.loads(stored[_METADATA_KEY])["query"] == query_as_dict(query):
            return True
    _remove(part)
    _remove(_checksum_file(part))
    return False


def write_part(part: Path, tables: Iterable[Any], result: Callable[[], QueryResult], made_from: bytes) -> QueryResult:
    """Write the file of a recording: completely, or not at all.

    Args:
        part: The file.
        tables: The rows as ``pyarrow.Table`` s with equal schemas, at least one.
        result: Returns the result without the number of rows, after the rows have been written.
        made_from: The fingerprint.

    Returns:
        The result with the number of rows.

    Raises:
        RecordingError: The file cannot be written.
    """
    parquet: Any = importlib.import_module("pyarrow.parquet")
    for left in part.parent.glob(f"_{part.name}.*.tmp"):  # by a process that was killed
        _remove(left)
    temporary = part.with_name(f"_{part.name}.{os.getpid()}.tmp")  # dataset readers ignore names with this prefix
    try:
        rows = 0
        writer: Any = None
        try:
            for table in tables:
                writer = writer or parquet.ParquetWriter(temporary, table.schema)
                writer.write_table(table)
                rows += table.num_rows
            found = result()
            report = [found.missing, found.problems, found.omitted]
            writer.add_key_value_metadata({_METADATA_KEY: made_from, _REPORT_KEY: json.dumps(report).encode()})
        finally:
            if writer is not None:
                writer.close()
        checksum = _checksum(temporary)
        temporary.replace(part)
        write_complete(_checksum_file(part), f"{checksum}  {part.name}\n".encode())
    except OSError as error:
        raise RecordingError(
            f"{part} cannot be written: {reason(error)}", hint="Check the free space and the write permission."
        ) from None
    finally:
        _remove(temporary)
    return found._replace(poses=rows, file=part.name)


def _remove(file: Path) -> None:
    with suppress(OSError):
        file.unlink()


def _is_intact(part: Path) -> bool:
    """Return whether a file matches its checksum. Without this check, a flipped bit would silently change a pose."""
    try:
        return read_regular(_checksum_file(part), _MAX_CHECKSUM_FILE)[:_CHECKSUM_DIGITS].decode() == _checksum(part)
    except (OSError, UnicodeDecodeError):
        return False


def _checksum_file(part: Path) -> Path:
    return part.with_name(f"_{part.name}.sha256")  # in the format of the program sha256sum


def _checksum(file: Path) -> str:
    digest = hashlib.sha256()
    with open_regular(file) as stream:
        while block := stream.read(1 << 20):
            digest.update(block)
    return digest.hexdigest()
