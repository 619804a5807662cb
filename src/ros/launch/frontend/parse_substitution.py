# SPDX-License-Identifier: Apache-2.0
"""Parse text with substitutions, under the module name of ROS."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from launch.frontend.parser import Parser
from launch.frontend.substitution_grammar import parse_text

if TYPE_CHECKING:
    from launch.substitution import Substitution

__all__ = ["parse_if_substitutions", "parse_substitution"]


def parse_substitution(string: str) -> list[Substitution]:
    """Return the parts of a string such as ``$(find-pkg-share my_robot)/urdf``.

    Raises:
        ValueError: A substitution is unknown or not complete.
    """
    Parser.load_launch_extensions()
    return parse_text(string)


def parse_if_substitutions(value: Any) -> Any:
    """Return the substitutions of a string or list of strings, and return other values unchanged."""
    Parser.load_launch_extensions()
    return Parser().parse_if_substitutions(value)
