# SPDX-License-Identifier: Apache-2.0
"""Files that users drop on the page: received into a temporary folder, which is removed when the viewer ends."""

from __future__ import annotations

import re
import shutil
from pathlib import Path
from typing import TYPE_CHECKING, BinaryIO, NamedTuple

from coframe._files.regular_files import read_regular
from coframe._files.temporary_folders import temporary_folder
from coframe.bags.formats import suffixes
from coframe.errors import CoframeError, ViewerError
from coframe.robots import parse_urdf
from coframe.trajectories import read_trajectory
from coframe.viewer.sources.source import BufferSource
from coframe.viewer.sources.transforms import buffer_of_transform

if TYPE_CHECKING:
    import tempfile
    from collections.abc import Sequence

    from coframe.robots import Robot
    from coframe.viewer.sources.source import ViewerSource

__all__ = [
    "MAX_FILES",
    "MAX_UPLOAD_BYTES",
    "MAX_URDF_BYTES",
    "TRAJECTORIES",
    "URDF",
    "Upload",
    "UploadedFile",
    "Uploads",
    "open_files",
]

MAX_UPLOAD_BYTES = 16 << 30
"""The size of the files of one upload."""
MAX_FILES = 8
"""The number of files of one upload."""
MAX_URDF_BYTES = 16 << 20
_FREE_SPACE = 1 << 30  # bytes that uploads leave free on the disk
_MAX_NAME = 120
_UNSAFE = re.compile(r"[^A-Za-z0-9._-]")

URDF = (".urdf", ".xml")
TRAJECTORIES = (".tum", ".txt", ".csv", ".kitti", ".npz")


class UploadedFile(NamedTuple):
    """A file with the name that the user sees, and its size."""

    name: str
    size: int


class Upload:
    """Files that are being received, one after another.

    Args:
        folder: The folder for the files.
        files: Their names and sizes.
    """

    def __init__(self, folder: Path, files: Sequence[UploadedFile]) -> None:
        # Each file has a folder of its own, so that equal names do not collide.
        self.paths = [folder / str(number) / safe_name(file.name) for number, file in enumerate(files)]
        self.total = sum(file.size for file in files)
        self.received = 0
        self._folder = folder
        self._missing_bytes = [file.size for file in files]
        self._number = 0
        self._stream: BinaryIO | None = None
        for path in self.paths:
            path.parent.mkdir(parents=True)
            path.touch()

    @property
    def is_complete(self) -> bool:
        """Whether all bytes were received."""
        return self.received == self.total

    def write(self, data: bytes) -> None:
        """Store the next bytes.

        Raises:
            ViewerError: There are more bytes than were announced.
            OSError: The disk is full.
        """
        if self.received + len(data) > self.total:
            raise ViewerError("the upload has more bytes than it announced")
        self.received += len(data)
        while data:
            if self._stream is None:
                while not self._missing_bytes[self._number]:
                    self._number += 1
                self._stream = self.paths[self._number].open("wb")
            part, data = data[: self._missing_bytes[self._number]], data[self._missing_bytes[self._number] :]
            self._stream.write(part)
            self._missing_bytes[self._number] -= len(part)
            if not self._missing_bytes[self._number]:
                self._end_file()

    def close(self) -> None:
        """End the reception of the files."""
        self._end_file()

    def cancel(self) -> None:
        """Remove the files."""
        self._end_file()
        shutil.rmtree(self._folder, ignore_errors=True)

    def _end_file(self) -> None:
        if self._stream is not None:
            self._stream.close()
            self._stream = None


class Uploads:
    """The uploads of one viewer, in a temporary folder that is created with the first of them."""

    def __init__(self) -> None:
        self._folder: tempfile.TemporaryDirectory[str] | None = None
        self._number = 0

    def begin(self, files: Sequence[UploadedFile]) -> Upload:
        """Return a new upload.

        Raises:
            ViewerError: There are too many files or bytes, or the viewer cannot open such files.
        """
        if not 0 < len(files) <= MAX_FILES:
            raise ViewerError(f"{len(files)} files cannot be opened together; the maximum is {MAX_FILES}")
        total = sum(file.size for file in files)
        if total > MAX_UPLOAD_BYTES:
            raise ViewerError(
                f"the files have {total} bytes; the maximum of an upload is {MAX_UPLOAD_BYTES}",
                hint="Open them on the machine of the viewer: coframe view FILE",
            )
        check_suffixes([file.name for file in files])
        for file in files:
            if Path(file.name).suffix.lower() in URDF and file.size > MAX_URDF_BYTES:
                raise ViewerError(f"{file.name} is too large: a URDF has at most {MAX_URDF_BYTES} bytes")
        return Upload(self.folder(total), files)

    def folder(self, size: int) -> Path:
        """Return a new folder with space for a number of bytes.

        Raises:
            ViewerError: The disk is too full.
        """
        if self._folder is None:
            self._folder = temporary_folder("coframe-viewer-")
        if shutil.disk_usage(self._folder.name).free < size + _FREE_SPACE:
            raise ViewerError(f"the disk of the viewer has too little free space for {size} bytes")
        self._number += 1
        made = Path(self._folder.name, str(self._number))
        made.mkdir()
        return made

    def close(self) -> None:
        """Remove all files."""
        if self._folder is not None:
            self._folder.cleanup()
            self._folder = None


def safe_name(name: str) -> str:
    """Return a name of a file that is inside its folder, regardless of what the browser sends."""
    cleaned = _UNSAFE.sub("_", name.replace("\\", "/").rpartition("/")[2])[-_MAX_NAME:].lstrip(".")
    return cleaned or "file"


def check_suffixes(names: Sequence[str]) -> None:
    """Check that files can be opened, and together if there are several.

    Raises:
        ViewerError: They cannot.
    """
    for name in names:
        suffix = Path(name).suffix.lower()
        if suffix == ".xacro":
            command = f"coframe view --robot {safe_name(name)}"
            raise ViewerError(
                "xacro files can contain Python expressions, so the page does not open them", hint=f"Run `{command}`."
            )
        if suffix not in {*suffixes(), *URDF, *TRAJECTORIES}:
            known = ", ".join(sorted({*suffixes(), *URDF, *TRAJECTORIES, ".rviz"}))
            raise ViewerError(f"files named {name[-60:]!r} cannot be opened", hint=f"Suffixes: {known}.")
    if len(names) > 1 and any(Path(name).suffix.lower() not in suffixes() for name in names):
        raise ViewerError("only recordings can be opened together", hint="Open the other files one after another.")


def open_files(paths: Sequence[Path], target: Path, *, together: bool) -> ViewerSource | Robot:
    """Return what files contain: the source of a recording, of several, or of a trajectory, or a robot.

    Args:
        paths: The files. The frames and topics of several recordings get the names of their files as prefixes.
        target: A folder for recordings that are combined.
        together: Whether several recordings begin at the same time; otherwise they keep their times.

    Raises:
        ViewerError: A file cannot be read.
    """
    suffix = paths[0].suffix.lower()
    try:
        if suffix in URDF:
            # Without its path, which is no place for meshes.
            return parse_urdf(read_regular(paths[0], MAX_URDF_BYTES))
        if suffix in TRAJECTORIES:
            poses = read_trajectory(paths[0], report=lambda _sentence: None)
            return BufferSource(buffer_of_transform(poses), paths[0].name)
        # Imported here because most viewers open no recording.
        from coframe.bags.recording import open_bag  # noqa: PLC0415
        from coframe.viewer.sources.recorded import RecordedSource  # noqa: PLC0415

        if len(paths) == 1:
            return RecordedSource(open_bag(paths[0]), own=True)
        source = RecordedSource(open_bag(_combine(paths, target, together=together)), own=True)
    except CoframeError as error:
        raise ViewerError(f"{paths[0].name} cannot be opened: {error}", hint=error.hint) from None
    source.title = " + ".join(path.name for path in paths)
    return source


def _combine(paths: Sequence[Path], target: Path, *, together: bool) -> Path:
    """Copy recordings into one, and return its folder."""
    from coframe.bags.copying import copy_recordings  # noqa: PLC0415 - see above
    from coframe.bags.recording import open_bag  # noqa: PLC0415

    offsets: list[str | None] | None = None
    if together:
        starts = []
        for path in paths:
            with open_bag(path, transforms=False) as recording:
                starts.append(recording.span[0])
        offsets = [None, *(f"{starts[0] - start:+d}ns" for start in starts[1:])]
    names = [f"{re.sub(r'[^A-Za-z0-9_]', '_', path.stem)}_{number}/" for number, path in enumerate(paths, 1)]
    prefixes = [name if name[0].isalpha() else f"r{name}" for name in names]
    copy_recordings(paths, target / "combined", prefixes=prefixes, offsets=offsets, compression="none")
    return target / "combined"
