# SPDX-License-Identifier: Apache-2.0
"""The parser of XML launch files."""

from __future__ import annotations

from typing import Any
from xml.etree import ElementTree as ET

from launch.frontend import Parser as BaseParser
from launch_xml.entity import Entity

__all__ = ["Parser"]


class Parser(BaseParser):
    """The parser of XML launch files."""

    @classmethod
    def load(cls, file: str | Any) -> tuple[Entity, Parser]:
        """Read a file, and return its root and the parser.

        Raises:
            ValueError: The file is not XML.
        """
        try:
            return Entity(ET.parse(file).getroot()), cls()  # noqa: S314 - launch files are programs anyway
        except ET.ParseError as error:
            raise ValueError(f"{getattr(file, 'name', file)}: not valid XML: {error}") from error

    @classmethod
    def get_file_extensions(cls) -> set[str]:
        """Return the extensions of XML launch files."""
        return {"xml"}
