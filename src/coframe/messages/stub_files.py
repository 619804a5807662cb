# SPDX-License-Identifier: Apache-2.0
"""Stub files of interface packages, written into a folder that editors and type checkers search."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.errors import InterfaceError
from coframe.messages._stubs import stub

if TYPE_CHECKING:
    from pathlib import Path

    from coframe.messages.packages import InterfacePackage

__all__ = ["write_stubs"]


def write_stubs(package: InterfacePackage, folder: Path) -> list[InterfaceError]:
    """Write ``my_msgs/msg/__init__.pyi`` and the like, and return the errors of omitted definitions.

    Args:
        package: The package whose definitions are read.
        folder: The folder that editors search; it is created if it does not exist.

    Raises:
        OSError: The files cannot be written.
    """
    errors: list[InterfaceError] = []
    _write(folder / package.name / "__init__.pyi", "")
    for kind in package.kinds():
        definitions = {}
        for name in package.names(kind):
            try:
                definitions[name] = package.parse(kind, name)
            except InterfaceError as error:
                errors.append(error)
        _write(folder / package.name / kind / "__init__.pyi", stub(package.name, kind, definitions))
    return errors


def _write(file: Path, text: str) -> None:
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text, encoding="utf-8")
