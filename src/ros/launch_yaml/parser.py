# SPDX-License-Identifier: Apache-2.0
"""The parser of YAML launch files."""

from __future__ import annotations

from typing import Any

from coframe._files.bounded_yaml import MAX_BYTES
from coframe._files.regular_files import read_regular_text
from launch.frontend import Parser as BaseParser
from launch.utilities.yaml_loading import load_yaml
from launch_yaml.entity import Entity

__all__ = ["Parser"]


class Parser(BaseParser):
    """The parser of YAML launch files."""

    @classmethod
    def load(cls, file: str | Any) -> tuple[Entity, Parser]:
        """Read a file, and return its root and the parser.

        Raises:
            ValueError: The file is not YAML, or has no root.
        """
        name = getattr(file, "name", file)
        text = file.read() if hasattr(file, "read") else read_regular_text(file, MAX_BYTES)
        tree = load_yaml(text)
        if not isinstance(tree, dict) or len(tree) != 1:
            raise ValueError(f"{name}: expected one root 'launch:'")
        root, element = next(iter(tree.items()))
        return Entity(element, str(root)), cls()

    @classmethod
    def get_file_extensions(cls) -> set[str]:
        """Return the extensions of YAML launch files."""
        return {"yaml", "yml"}
