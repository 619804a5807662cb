# SPDX-License-Identifier: Apache-2.0
"""YAML of RViz's files."""

from __future__ import annotations

from typing import Any

from coframe._files import bounded_yaml
from coframe._process.optional_imports import pip_install
from coframe.errors import ViewerError

__all__ = ["MAX_FILE_BYTES", "read_yaml", "yaml_module"]

MAX_FILE_BYTES = 1 << 20


def yaml_module() -> Any:
    """Return the module yaml.

    Raises:
        ViewerError: PyYAML is missing.
    """
    try:
        import yaml  # noqa: PLC0415 - Only RViz files need the package.
    except ModuleNotFoundError:
        raise ViewerError(f"RViz files need the package PyYAML: {pip_install('viewer')}") from None
    return yaml


def read_yaml(text: str, source: str) -> Any:
    """Return the content of a YAML document, with aliases replaced by copies.

    Args:
        text: The document.
        source: The name of the file, for error messages.

    Raises:
        ViewerError: The text is not valid YAML or exceeds a limit, or PyYAML is missing.
    """
    yaml_module()
    if len(text) > MAX_FILE_BYTES:
        raise ViewerError(f"{source} is larger than the maximum of {MAX_FILE_BYTES >> 20} MiB")
    try:
        return bounded_yaml.read_yaml(text, MAX_FILE_BYTES)
    except ValueError as error:
        raise ViewerError(f"{source} is not valid YAML: {error}", hint="Is it an .rviz file?") from None
