# SPDX-License-Identifier: Apache-2.0
"""The substitution that checks whether a parameter file has parameters of a node."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe._files.bounded_yaml import MAX_BYTES
from coframe._files.regular_files import read_regular_text
from launch.substitution import Substitution
from launch.utilities import normalize_to_list_of_substitutions, perform_substitutions
from launch.utilities.yaml_loading import load_yaml

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch.some_substitutions_type import SomeSubstitutionsType

__all__ = ["HasNodeParams"]


class HasNodeParams(Substitution):
    """``True`` if a parameter file has a block for a node, else ``False``.

    Args:
        source_file: The parameter file.
        node_name: Name of the node.
    """

    def __init__(self, source_file: SomeSubstitutionsType, node_name: str) -> None:
        self.__source_file = normalize_to_list_of_substitutions(source_file)
        self.__node_name = node_name

    def describe(self) -> str:
        """Return nothing, as upstream."""
        return ""

    def perform(self, context: LaunchContext) -> str:
        """Return ``True`` or ``False``."""
        data = load_yaml(read_regular_text(perform_substitutions(context, self.__source_file), MAX_BYTES))
        return str(isinstance(data, dict) and self.__node_name in data)
