# SPDX-License-Identifier: Apache-2.0
"""The installation prefixes that are searched."""

import os

from ament_index_python.constants import AMENT_PREFIX_PATH_ENV_VAR

__all__ = ["get_search_paths"]


def get_search_paths() -> list[str]:
    """Return the existing folders in AMENT_PREFIX_PATH. Without ROS there are none, which is not an error here."""
    entries = os.environ.get(AMENT_PREFIX_PATH_ENV_VAR, "").split(os.pathsep)
    return [entry for entry in entries if entry and os.path.isdir(entry)]  # noqa: PTH112 - a NUL character is no error
