# SPDX-License-Identifier: Apache-2.0
"""The parser of XML launch files."""

from __future__ import annotations

from typing import Any

from coframe._files.bounded_xml import read_xml
from coframe._files.regular_files import UnsuitableFileError
from launch.frontend import Parser as BaseParser
from launch_xml.entity import Entity

__all__ = ["Parser"]


class Parser(BaseParser):
    """The parser of XML launch files."""

    @classmethod
    def load(cls, file: str | Any) -> tuple[Entity, Parser]:
        """Read a file, and return its root and the parser.

        Raises:
            ValueError: The file is not XML, or exceeds a limit of :mod:`coframe._files.bounded_xml`.
        """
        try:
            return Entity(read_xml(file)), cls()
        except UnsuitableFileError:  # Its text has the path.
            raise
        except ValueError as error:
            raise ValueError(f"{getattr(file, 'name', file)}: {error}") from None

    @classmethod
    def get_file_extensions(cls) -> set[str]:
        """Return the extensions of XML launch files."""
        return {"xml"}
