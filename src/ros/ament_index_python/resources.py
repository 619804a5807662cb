# SPDX-License-Identifier: Apache-2.0
"""Resources in the ament index of the installation prefixes: files `share/ament_index/resource_index/TYPE/NAME`."""

from pathlib import Path
from typing import Literal

from ament_index_python.constants import RESOURCE_INDEX_SUBFOLDER
from ament_index_python.search_paths import get_search_paths
from coframe._files.regular_files import read_regular_text

__all__ = [
    "InvalidResourceNameError",
    "InvalidResourceTypeNameError",
    "get_resource",
    "get_resource_types",
    "get_resources",
    "has_resource",
    "name_is_invalid",
]

MAX_BYTES = 16 << 20


class InvalidResourceTypeNameError(ValueError):
    """The name of a resource type is empty or has a separator of paths."""


class InvalidResourceNameError(ValueError):
    """The name of a resource is empty or has a separator of paths."""


def name_is_invalid(resource_name: str) -> bool:
    """Return whether a name is empty or has a separator of paths."""
    return not resource_name or "/" in resource_name or "\\" in resource_name


def get_resource(resource_type: str, resource_name: str) -> tuple[str, str]:
    """Return the content of a resource, and the prefix that contains it.

    Raises:
        InvalidResourceTypeNameError: The type is not valid.
        InvalidResourceNameError: The name is not valid.
        LookupError: There is no such resource.
        OSError: The resource cannot be read.
    """
    prefix = has_resource(resource_type, resource_name)
    if not prefix:
        raise LookupError(f"Could not find the resource '{resource_name}' of type '{resource_type}'")
    path = Path(prefix, RESOURCE_INDEX_SUBFOLDER, resource_type, resource_name)
    try:
        return read_regular_text(path, MAX_BYTES), prefix
    except OSError as error:
        raise OSError(f"Could not open the resource '{resource_name}' of type '{resource_type}':\n{error}") from error


def has_resource(resource_type: str, resource_name: str) -> str | Literal[False]:
    """Return the first prefix that contains a resource, or False.

    Raises:
        InvalidResourceTypeNameError: The type is not valid.
        InvalidResourceNameError: The name is not valid.
    """
    _check_type(resource_type)
    if name_is_invalid(resource_name):
        raise InvalidResourceNameError(f"Resource name '{resource_name}' is invalid")
    for prefix in get_search_paths():
        if Path(prefix, RESOURCE_INDEX_SUBFOLDER, resource_type, resource_name).is_file():
            return prefix
    return False


def get_resources(resource_type: str) -> dict[str, str]:
    """Return the names of all resources of a type with their prefixes. The first prefix that contains one applies.

    Raises:
        InvalidResourceTypeNameError: The type is not valid.
    """
    _check_type(resource_type)
    found: dict[str, str] = {}
    for prefix in get_search_paths():
        folder = Path(prefix, RESOURCE_INDEX_SUBFOLDER, resource_type)
        for path in sorted(folder.iterdir()) if folder.is_dir() else ():
            if path.is_file() and not path.name.startswith("."):
                found.setdefault(path.name, prefix)
    return found


def get_resource_types() -> set[str]:
    """Return all types of resources."""
    folders = [Path(prefix, RESOURCE_INDEX_SUBFOLDER) for prefix in get_search_paths()]
    paths = [path for folder in folders if folder.is_dir() for path in folder.iterdir()]
    return {path.name for path in paths if path.is_dir() and not path.name.startswith(".")}


def _check_type(resource_type: str) -> None:
    if name_is_invalid(resource_type):
        raise InvalidResourceTypeNameError(f"Resource type '{resource_type}' is invalid")
