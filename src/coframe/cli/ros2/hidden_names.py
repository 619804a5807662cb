# SPDX-License-Identifier: Apache-2.0
"""Names that ``ros2`` hides."""

from __future__ import annotations

__all__ = ["is_hidden"]


def is_hidden(name: str) -> bool:
    """Return whether a part of a name begins with an underscore, which ros2 shows only on request."""
    return any(part.startswith("_") for part in name.split("/"))
