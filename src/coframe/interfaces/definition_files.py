# SPDX-License-Identifier: Apache-2.0
"""Definition files in the folder of a package, and their contents."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, NamedTuple

from coframe._files.existence import exists
from coframe._files.regular_files import read_regular
from coframe.interfaces.ownership import is_own
from coframe.interfaces.problems import report

if TYPE_CHECKING:
    from pathlib import Path

__all__ = [
    "KINDS",
    "PACKAGE_NAME",
    "Definition",
    "definitions_in",
    "has_definitions",
    "is_own_package",
    "package_name",
    "read",
]

KINDS = ("msg", "srv", "action")
MAX_BYTES = 1 << 18  # per file; the largest ones in public packages have 20 000
PACKAGE_NAME = re.compile(r"[a-z](?:_?[a-z0-9])*")
_NAME_ELEMENT = r"<name>\s*([\w-]+)\s*</name>"


class Definition(NamedTuple):
    """The text of a message, service or action.

    Attributes:
        text: Its definition.
        file: The file that contains it, or None if it is part of coframe.
    """

    text: str
    file: str | None = None

    @property
    def is_idl(self) -> bool:
        """Whether the text is IDL."""
        return self.file is not None and self.file.endswith(".idl")


def has_definitions(folder: Path) -> bool:
    """Return whether a folder is a package with messages, services or actions."""
    return any(_files(folder / kind, kind) for kind in KINDS)


def definitions_in(folder: Path) -> dict[str, Path]:
    """Return the definition files of a package, by names such as ``msg/Pose``."""
    return {f"{kind}/{path.stem}": path for kind in KINDS for path in _files(folder / kind, kind)}


def read(path: Path) -> Definition:
    """Read a definition file.

    Raises:
        InterfaceError: The file cannot be read, is too large, or is not text.
    """
    from coframe.errors import InterfaceError  # noqa: PLC0415 - it imports the native core

    try:
        return Definition(read_regular(path, MAX_BYTES).decode("utf-8-sig").replace("\r\n", "\n"), str(path))
    except OSError as error:
        raise InterfaceError(f"cannot be read: {error.strerror}", file=str(path)) from None
    except UnicodeDecodeError as error:
        raise InterfaceError(f"is not UTF-8: {error.reason} at byte {error.start}", file=str(path)) from None


def package_name(folder: Path) -> str | None:
    """Return the package name of a folder: from its ``package.xml``, or the folder name, or None if invalid."""
    name, manifest = folder.name, folder / "package.xml"
    if exists(manifest):
        try:
            text = read_regular(manifest, MAX_BYTES).decode("utf-8", "replace")
            match = re.search(_NAME_ELEMENT, text)
        except OSError as error:
            report(f"{manifest} is skipped in the search for interface packages: {error.strerror}")
            return None
        name = match[1] if match else name
    return name if PACKAGE_NAME.fullmatch(name) else None


def is_own_package(folder: Path) -> bool:
    """Return whether a package and all its definitions belong to the user; report files that do not."""
    kinds = [folder / kind for kind in KINDS if exists(folder / kind)]
    manifest = [path for path in [folder / "package.xml"] if exists(path)]
    return all(map(is_own, [folder, *manifest, *kinds, *definitions_in(folder).values()]))


def _files(folder: Path, kind: str) -> list[Path]:
    """Return the files of one kind, without ``.idl`` files that rosidl generated from them."""
    try:
        paths = sorted(path for path in folder.iterdir() if path.suffix in {f".{kind}", ".idl"})
    except OSError:
        return []
    message_names = {path.stem for path in paths if path.suffix != ".idl"}
    return [path for path in paths if path.suffix != ".idl" or path.stem not in message_names]
