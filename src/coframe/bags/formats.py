# SPDX-License-Identifier: Apache-2.0
"""The file formats of recordings: one class each.

All lists of formats and suffixes in coframe come from here. The first bytes of a file determine its format. Names only
help to find and order the files.
"""

from __future__ import annotations

import functools
import re
from pathlib import PurePath
from typing import TYPE_CHECKING, Any, Final

from coframe._files.existence import is_file
from coframe._process.plugins import load_plugins
from coframe.bags._recording_format import RecordingFormat, bare_name
from coframe.interfaces.problems import report

if TYPE_CHECKING:
    from pathlib import Path

    from coframe._sources.sources import Readable
    from coframe.bags._problems import Problems
    from coframe.bags._recording_format import FileWriter
    from coframe.bags.storage import Storage

__all__ = [
    "BUILT_IN",
    "COMPRESSED",
    "GROUP",
    "MCAP",
    "METADATA",
    "ROS1",
    "SQLITE",
    "file_kinds",
    "formats",
    "has_known_suffix",
    "is_recording",
    "matches",
    "recording_name",
    "storage_formats",
    "suffixes",
]

METADATA: Final = "metadata.yaml"  # in a folder of rosbag2
COMPRESSED: Final = ".zstd"  # after the suffix of a file that rosbag2 compressed as a whole


class Mcap(RecordingFormat):
    """MCAP files, of rosbag2, Foxglove and others."""

    name = "MCAP"
    suffixes = (".mcap",)
    magic = b"\x89MCAP0\r\n"
    storage_id = "mcap"

    def open(self, path: Path, problems: Problems) -> Storage:
        """Open a file."""
        return self.open_source(path, problems)

    def open_source(self, source: Readable, problems: Problems) -> Storage:
        """Open a local or remote file."""
        from coframe.bags._mcap_file import McapStorage  # noqa: PLC0415 - see the base class

        return McapStorage(source, problems)

    def create(self, path: Path, compression: str) -> FileWriter:
        """Create a file with compressed chunks."""
        from coframe.bags._mcap_writer import McapWriter  # noqa: PLC0415 - see the base class

        return McapWriter(path, compression)


class Sqlite(RecordingFormat):
    """SQLite databases of rosbag2."""

    name = "SQLite"
    suffixes = (".db3",)
    magic = b"SQLite format 3\0"
    storage_id = "sqlite3"

    def matches(self, path: Path, beginning: bytes) -> bool:
        """Return whether a file is a database, possibly without its first page: other pages contain the messages."""
        if beginning != bytes(len(self.magic)) or path.suffix.lower() not in self.suffixes:
            return super().matches(path, beginning)
        from coframe.bags._sqlite_leaves import has_leaves_of_recording  # noqa: PLC0415 - see the base class

        return has_leaves_of_recording(path)

    def open(self, path: Path, problems: Problems) -> Storage:
        """Open a file."""
        from coframe.bags._sqlite_file import SqliteStorage  # noqa: PLC0415 - see the base class

        return SqliteStorage(path, problems)

    def create(self, path: Path, compression: str) -> FileWriter:
        """Create a file. It is not compressed."""
        from coframe.bags._sqlite_writer import SqliteWriter  # noqa: PLC0415 - see the base class

        del compression
        return SqliteWriter(path)


class Ros1(RecordingFormat):
    """ROS 1 bags."""

    name = "ROS 1 bag"
    suffixes = (".bag",)
    magic = b"#ROSBAG V2.0\n"

    _OLD = b"#ROSBAG V1"
    _DATE = re.compile(r"[_-]?\d{4}(-\d\d){5}$", re.ASCII)

    def refusal(self, beginning: bytes) -> str:
        """Reject bags of version 1."""
        if not beginning.startswith(self._OLD):
            return ""
        return "bags of version 1 are not supported; convert it to version 2.0 with `rosbag fix` of ROS 1"

    def open(self, path: Path, problems: Problems) -> Storage:
        """Open a file."""
        return self.open_source(path, problems)

    def open_source(self, source: Readable, problems: Problems) -> Storage:
        """Open a local or remote file."""
        from coframe.bags._ros1_file import Ros1Storage  # noqa: PLC0415 - see the base class

        return Ros1Storage(source, problems)

    def recording_name(self, file: str) -> str:
        """Return the common part of the file names, without the start time of each file: ``2024-05-01-10-00-00_0``."""
        bare = bare_name(file)
        return file if bare is None else self._DATE.sub("", bare)


MCAP: Final = Mcap()
SQLITE: Final = Sqlite()
ROS1: Final = Ros1()
BUILT_IN: Final = (MCAP, SQLITE, ROS1)
GROUP: Final = "coframe.recordings"  # of entry points
_SUFFIX: Final = re.compile(r"\.[a-z0-9_-]+")


@functools.cache
def formats() -> tuple[RecordingFormat, ...]:
    """Return all formats in the order in which they are tried: coframe's own, then those of other distributions."""
    found = list(BUILT_IN)
    for plugin, loaded in load_plugins(GROUP, report):
        problem = _find_problem(loaded, found)
        if problem:
            report(str(plugin.error(problem)))
        else:
            found.append(loaded())
    return tuple(found)


def _find_problem(loaded: Any, others: list[RecordingFormat]) -> str:
    """Return why an object is not a valid format class, as the end of a sentence, or "" if it is valid."""
    if not (isinstance(loaded, type) and issubclass(loaded, RecordingFormat)):
        return "is not a subclass of coframe.bags.RecordingFormat"
    name, endings = getattr(loaded, "name", None), getattr(loaded, "suffixes", None)
    if not (isinstance(name, str) and name.isprintable() and name):
        return "has no name such as 'MCAP'"
    if not (isinstance(endings, tuple) and endings and all(_SUFFIX.fullmatch(str(ending)) for ending in endings)):
        return "has no suffixes such as ('.log',), in small letters"
    if any(each.name == name for each in others):
        return f"has the name {name!r}, which another format already uses"
    return ""


def suffixes() -> tuple[str, ...]:
    """Return the suffixes of all formats: ``.mcap``, ``.db3``, ``.bag``."""
    return tuple(dict.fromkeys(suffix for each in formats() for suffix in each.suffixes))


def storage_formats(*, written: bool = False) -> dict[str, RecordingFormat]:
    """Return the formats that rosbag2 has a name for, by that name.

    Args:
        written: Return only formats that can be written.
    """
    return {each.storage_id: each for each in formats() if each.storage_id and (each.is_written or not written)}


def file_kinds() -> str:
    """Return a description of recording files for messages: ``.mcap, .db3 or .bag file``."""
    *first, last = suffixes()
    return f"{', '.join(first)} or {last} file"


def matches(format_: RecordingFormat, path: Path, beginning: bytes) -> bool:
    """Return whether a file with these first bytes is in a format. A plug-in that raises an error does not match."""
    if format_ in BUILT_IN:
        return format_.matches(path, beginning)
    try:
        return bool(format_.matches(path, beginning))
    except Exception as error:  # noqa: BLE001 - the code is not ours
        report(f"The format {format_.name} cannot recognize files: {type(error).__name__}: {error}")
        return False


def has_known_suffix(path: PurePath) -> bool:
    """Return whether a path has the suffix of a format, including in front of a compression suffix."""
    return PurePath(path.name.removesuffix(COMPRESSED)).suffix.lower() in suffixes()


def is_recording(path: Path) -> bool:
    """Return whether a path is a file named like a recording, or a rosbag2 folder."""
    return is_file(path / METADATA) or (has_known_suffix(path) and is_file(path))


def recording_name(path: Readable, format_: RecordingFormat) -> str:
    """Return the common part of the file names of a recording: ``run`` for ``run_0.mcap``."""
    name = path.name.removesuffix(COMPRESSED)
    return format_.recording_name(name.rpartition(".")[0] or path.name)
