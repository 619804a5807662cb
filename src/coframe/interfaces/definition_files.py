# SPDX-License-Identifier: Apache-2.0
"""Definition files in the folder of a package: which there are, and what they define."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["KINDS", "Definition", "definitions_in", "has_definitions", "package_name", "read"]

KINDS = ("msg", "srv", "action")
_LARGEST = 1 << 18  # bytes of one file; the largest of public packages have 20 000
_PACKAGE_NAME = re.compile(r"[a-z](?:_?[a-z0-9])*")
_NAME_ELEMENT = re.compile(r"<name>\s*([\w-]+)\s*</name>")


class Definition(NamedTuple):
    """The text of a message, service or action.

    Attributes:
        text: Its definition.
        file: The file that contains it; None if coframe contains it.
    """

    text: str
    file: str | None = None

    @property
    def is_idl(self) -> bool:
        """Whether the text is IDL."""
        return self.file is not None and self.file.endswith(".idl")


def has_definitions(folder: Path) -> bool:
    """Return whether a folder is that of a package with messages, services or actions."""
    return any(_files(folder / kind, kind) for kind in KINDS)


def definitions_in(folder: Path) -> dict[str, Path]:
    """Return the definition files of a package, by names such as ``msg/Pose``."""
    return {f"{kind}/{path.stem}": path for kind in KINDS for path in _files(folder / kind, kind)}


def read(path: Path) -> Definition:
    """Return the definition in a file.

    Raises:
        InterfaceError: The file cannot be read, is too large, or is not text.
    """
    from coframe.errors import InterfaceError  # noqa: PLC0415 - it imports the native core

    try:
        if path.stat().st_size > _LARGEST:
            raise InterfaceError(f"the file is larger than {_LARGEST} bytes", file=str(path))
        return Definition(path.read_text("utf-8-sig"), str(path))
    except OSError as error:
        raise InterfaceError(f"cannot be read: {error.strerror}", file=str(path)) from None
    except UnicodeDecodeError as error:
        raise InterfaceError(f"is not UTF-8: {error.reason} at byte {error.start}", file=str(path)) from None


def package_name(folder: Path) -> str | None:
    """Return the name of the package in a folder: that of its ``package.xml``, or of the folder; None if invalid."""
    name = folder.name
    try:
        with (folder / "package.xml").open(encoding="utf-8", errors="replace") as file:
            match = _NAME_ELEMENT.search(file.read(_LARGEST))
        name = match[1] if match else name
    except OSError:
        pass
    return name if _PACKAGE_NAME.fullmatch(name) else None


def _files(folder: Path, kind: str) -> list[Path]:
    """Return the files of one kind; where a name has an ``.idl`` file as well, rosidl has generated it."""
    try:
        paths = sorted(path for path in folder.iterdir() if path.suffix in {f".{kind}", ".idl"})
    except OSError:
        return []
    plain = {path.stem for path in paths if path.suffix != ".idl"}
    return [path for path in paths if path.suffix != ".idl" or path.stem not in plain]
