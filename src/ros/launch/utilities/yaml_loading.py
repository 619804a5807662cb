# SPDX-License-Identifier: Apache-2.0
"""Reading and writing of YAML, which needs PyYAML."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from coframe._files.bounded_yaml import read_yaml
from coframe._process.optional_imports import pip_install

__all__ = ["dump_yaml", "load_yaml"]


def load_yaml(text: str) -> Any:
    """Return the value of a YAML document.

    Raises:
        ValueError: The text is not YAML, or exceeds a limit of :mod:`coframe._files.bounded_yaml`.
        RuntimeError: PyYAML is not installed.
    """
    _yaml()
    try:
        return read_yaml(text)
    except ValueError as error:
        raise ValueError(f"invalid YAML: {error}") from error


def dump_yaml(value: Any) -> str:
    """Return a value as YAML.

    Raises:
        RuntimeError: PyYAML is not installed.
    """
    yaml = _yaml()
    # Parameter files must not contain aliases, which a list that is used twice would become.
    dumper = type("DumperWithoutAliases", (yaml.SafeDumper,), {"ignore_aliases": lambda *_: True})
    text: str = yaml.dump(value, Dumper=dumper, default_flow_style=False)
    return text


def _yaml() -> Any:
    try:
        return import_module("yaml")
    except ImportError:
        raise RuntimeError(f"Launch files with parameters or YAML need PyYAML: {pip_install('params')}") from None
