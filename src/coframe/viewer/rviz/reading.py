# SPDX-License-Identifier: Apache-2.0
"""YAML of untrusted files, with limits on its size, depth and aliases."""

from __future__ import annotations

from typing import Any

from coframe.errors import ViewerError

__all__ = ["read_yaml", "yaml_module"]

MAX_FILE_BYTES = 1 << 20
MAX_DEPTH = 100
MAX_VALUES = 1 << 18


def yaml_module() -> Any:
    """Return the module yaml.

    Raises:
        ViewerError: PyYAML is missing.
    """
    try:
        import yaml  # noqa: PLC0415 - Only RViz files need the package.
    except ModuleNotFoundError:
        raise ViewerError("RViz files need the package PyYAML: pip install 'coframe[viewer]'") from None
    return yaml


def read_yaml(text: str, source: str) -> Any:
    """Return the content of a YAML document, with aliases replaced by copies.

    Args:
        text: The document.
        source: The name of the file, for error messages.

    Raises:
        ViewerError: The text is not valid YAML or exceeds a limit, or PyYAML is missing.
    """
    if len(text) > MAX_FILE_BYTES:
        raise ViewerError(f"{source} has more than {MAX_FILE_BYTES >> 20} MiB, the limit for an RViz configuration")
    yaml = yaml_module()

    class Loader(yaml.SafeLoader):  # type: ignore[misc,name-defined]
        """A loader that limits nesting while it parses, because the time per token grows with the depth."""

        def fetch_flow_collection_start(self, token: Any) -> None:
            check_depth(self.flow_level)
            super().fetch_flow_collection_start(token)

        def add_indent(self, column: int) -> Any:
            check_depth(len(self.indents))
            return super().add_indent(column)

    def check_depth(depth: int) -> None:
        if depth > MAX_DEPTH:
            raise yaml.YAMLError(f"it is nested more than {MAX_DEPTH} levels deep")

    def check_size(size: int, depth: int) -> None:
        check_depth(depth)
        if size > MAX_VALUES:
            raise yaml.YAMLError(f"with its aliases (*) replaced by copies it has more than {MAX_VALUES} values")

    loader = None
    try:
        loader = Loader(text)
        root = loader.get_single_node()
        check_size(*_measure(root, {}))
        # Aliases become copies, so that a change of one display does not change another.
        return None if root is None else _copied(loader.construct_document(root))
    except (yaml.YAMLError, ValueError, OverflowError) as error:
        reason = " ".join(str(error).split())
        raise ViewerError(f"{source} is not valid YAML: {reason}", hint="Is it an .rviz file?") from None
    finally:
        if loader is not None:
            loader.dispose()


def _measure(node: Any, known: dict[int, tuple[int, int]]) -> tuple[int, int]:
    """Return how many values a YAML node has with its aliases replaced by copies, and how deep they are nested.

    Each node is visited once only, because a few aliases of aliases make a small file very large.

    Raises:
        ValueError: A node contains itself.
    """
    value = getattr(node, "value", None)
    if not isinstance(value, list):
        return 1, 1
    if id(node) in known:
        size, depth = known[id(node)]
        if not size:
            raise ValueError("an alias (*) refers to a node that contains it")
        return size, depth
    known[id(node)] = (0, 0)  # Marks a node that is being measured.
    parts = [part for child in value for part in (child if isinstance(child, tuple) else (child,))]
    measured = [_measure(part, known) for part in parts]
    known[id(node)] = 1 + sum(size for size, _ in measured), 1 + max((depth for _, depth in measured), default=0)
    return known[id(node)]


def _copied(value: Any) -> Any:
    """Return a copy in which no part occurs twice."""
    if isinstance(value, dict):
        return {key: _copied(part) for key, part in value.items()}
    if isinstance(value, list):
        return [_copied(part) for part in value]
    return value
