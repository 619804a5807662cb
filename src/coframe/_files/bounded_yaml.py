# SPDX-License-Identifier: Apache-2.0
"""Parse YAML from untrusted files, with limits on size, depth and aliases."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

__all__ = ["MAX_BYTES", "error_position", "read_yaml", "yaml_events"]

MAX_BYTES = 16 << 20  # of a parameter or launch file, and of the metadata of a recording
MAX_DEPTH = 100
MAX_VALUES = 1 << 18
MAX_DIGITS = 100  # of an integer; one in base 60, such as 1:30:00, takes quadratic time
_INTEGER = "tag:yaml.org,2002:int"
_DEPTH_ERROR = f"the document is nested more than {MAX_DEPTH} levels deep"
_PARSER_DEPTH_ERROR = (
    "maximum nesting depth"  # newer parsers have their own limit, and may reach it before _check_document
)


def read_yaml(
    text: str | bytes,
    max_bytes: int = MAX_BYTES,
    constructors: Mapping[str, Callable[[Any, Any], Any]] | None = None,
) -> Any:
    """Return the content of a YAML document, with aliases replaced by copies.

    Args:
        text: The document.
        max_bytes: The maximum size.
        constructors: PyYAML's constructors of the caller's own tags, by tag.

    Raises:
        ValueError: The text is not valid YAML or exceeds a limit.
        ModuleNotFoundError: PyYAML is missing.
    """

    def load(yaml: Any, base: Any) -> Any:
        loader = type("BoundedLoader", (base,), {})
        for tag, construct in {_INTEGER: _integer, **(constructors or {})}.items():
            yaml.add_constructor(tag, construct, Loader=loader)
        return _deep_copy(yaml.load(text, Loader=loader))

    return _load_checked(text, max_bytes, load)


def yaml_events(text: str | bytes, max_bytes: int = MAX_BYTES) -> list[Any]:
    """Return the events of a YAML stream, for callers that apply their own rules to its structure.

    The arguments and errors are those of :func:`read_yaml`.
    """
    events: list[Any] = _load_checked(text, max_bytes, lambda yaml, base: list(yaml.parse(text, Loader=base)))
    return events


def error_position(error: ValueError) -> tuple[int, int] | None:
    """Return the position of a YAML error as line and column, counted from 0, or None if the position is unknown."""
    return error.position if isinstance(error, _SyntaxError) else None


class _SyntaxError(ValueError):
    def __init__(self, reason: str, position: tuple[int, int]) -> None:
        super().__init__(reason)
        self.position = position


def _load_checked(text: str | bytes, max_bytes: int, load: Callable[[Any, Any], Any]) -> Any:
    """Check the limits, then return the result of a function that takes the yaml module and a loader."""
    yaml: Any = importlib.import_module("yaml")
    if len(text) > max_bytes:
        raise ValueError(f"the document is larger than the maximum of {max_bytes >> 20} MiB")
    base = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    try:
        # PyYAML recurses without a limit and follows aliases of aliases; the event stream reveals both before that.
        _check_document(yaml.parse(text, Loader=base), yaml)
        return load(yaml, base)
    except (yaml.YAMLError, ValueError, TypeError, OverflowError) as error:
        reason = " ".join(str(error).split())
        if _PARSER_DEPTH_ERROR in reason:
            raise ValueError(_DEPTH_ERROR) from None
        mark = getattr(error, "problem_mark", None)
        if mark is not None:
            raise _SyntaxError(reason, (mark.line, mark.column)) from None
        raise ValueError(reason) from None
    except (AttributeError, LookupError):  # PyYAML does not check what follows !!bool, !!int and !!timestamp
        raise ValueError("a value does not have the type that its tag (!!) names") from None


def _integer(loader: Any, node: Any) -> Any:
    if len(loader.construct_scalar(node)) > MAX_DIGITS:
        raise ValueError(f"an integer has more than {MAX_DIGITS} digits")
    return loader.construct_yaml_int(node)


class _Extents:
    """Counts the values of a document with its aliases replaced by copies, and their nesting depth."""

    def __init__(self) -> None:
        self._anchor_extents: dict[str, tuple[int, int]] = {}  # values and levels
        self._open_collections: list[tuple[str | None, int, int]] = [
            (None, 0, 0)
        ]  # anchor, values and levels of the collections

    def begin(self, anchor: str | None) -> None:
        self._open_collections.append((anchor, 1, 0))
        self._check_depth(0)

    def end(self) -> None:
        anchor, values, levels = self._open_collections.pop()
        self.add(values, levels + 1, anchor)

    def add(self, values: int, levels: int, anchor: str | None = None) -> None:
        if anchor is not None:
            self._anchor_extents[anchor] = (values, levels)
        around, before, deepest = self._open_collections[-1]
        self._open_collections[-1] = (around, before + values, max(deepest, levels))
        if before + values > MAX_VALUES:
            raise ValueError(f"the document has more than {MAX_VALUES} values after its aliases (*) are expanded")
        self._check_depth(levels)

    def alias(self, anchor: str) -> None:
        if any(anchor == around for around, _, _ in self._open_collections):
            raise ValueError("an alias (*) refers to a node that contains it")
        self.add(*self._anchor_extents.get(anchor, (1, 1)))

    def _check_depth(self, levels: int) -> None:
        if len(self._open_collections) + levels > MAX_DEPTH + 1:
            raise ValueError(_DEPTH_ERROR)


def _check_document(events: Any, yaml: Any) -> None:
    """Raise ValueError if a document is nested too deeply, or is too large with its aliases replaced by copies."""
    extents = _Extents()
    for event in events:
        if isinstance(event, yaml.AliasEvent):
            extents.alias(event.anchor)
        elif isinstance(event, yaml.CollectionStartEvent):
            extents.begin(event.anchor)
        elif isinstance(event, yaml.CollectionEndEvent):
            extents.end()
        elif isinstance(event, yaml.ScalarEvent):
            extents.add(1, 1, event.anchor)


def _deep_copy(value: Any) -> Any:
    """Return a copy without shared parts, so that changing one part does not change another."""
    if isinstance(value, dict):
        return {key: _deep_copy(part) for key, part in value.items()}
    if isinstance(value, list):
        return [_deep_copy(part) for part in value]
    return value
