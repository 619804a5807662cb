# SPDX-License-Identifier: Apache-2.0
"""Decorators that make actions and substitutions available in XML and YAML launch files."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeVar

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["action_parse_methods", "expose_action", "expose_substitution", "substitution_parse_methods"]

T = TypeVar("T")

action_parse_methods: dict[str, Callable[..., tuple[type[Any], dict[str, Any]]]] = {}
substitution_parse_methods: dict[str, Callable[..., tuple[type[Any], dict[str, Any]]]] = {}


def expose_action(name: str) -> Callable[[T], T]:
    """Return a decorator for a class with a method `parse`, or for a function that parses an entity."""
    return _decorator(name, action_parse_methods)


def expose_substitution(name: str) -> Callable[[T], T]:
    """Return a decorator for a class with a method `parse`, or for a function that parses arguments."""
    return _decorator(name, substitution_parse_methods)


def _decorator(name: str, methods: dict[str, Any]) -> Callable[[T], T]:
    def register(exposed: T) -> T:
        if not hasattr(exposed, "parse") and not callable(exposed):
            raise RuntimeError(f"Exposed class '{exposed}' must have a method 'parse'")
        methods[name] = getattr(exposed, "parse", exposed)
        return exposed

    return register
