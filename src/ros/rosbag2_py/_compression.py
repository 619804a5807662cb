# SPDX-License-Identifier: Apache-2.0
"""Options of compressed recordings."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

__all__ = ["CompressionMode", "CompressionOptions", "compression_mode_from_string", "compression_mode_to_string"]


class CompressionMode(Enum):
    """The compressed units. coframe compresses the chunks of MCAP files in both modes, so that they stay readable."""

    NONE = 0
    FILE = 1
    MESSAGE = 2


@dataclass
class CompressionOptions:
    """The compression options of a recording."""

    compression_format: str
    compression_mode: CompressionMode
    compression_queue_size: int = 1
    compression_threads: int = 0


def compression_mode_from_string(text: str) -> CompressionMode:
    """Return the mode with a name such as ``FILE``; NONE for an unknown one, as upstream does."""
    return CompressionMode.__members__.get(text.upper(), CompressionMode.NONE)


def compression_mode_to_string(mode: CompressionMode) -> str:
    """Return the name of a mode."""
    return mode.name
