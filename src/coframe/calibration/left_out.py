# SPDX-License-Identifier: Apache-2.0
"""What a written calibration lacks, because its format cannot store it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.calibration.reading import read
from coframe.calibration.rig import Rig
from coframe.calibration.writing import COMMANDS
from coframe.errors import CalibrationError, CoframeError

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["left_out"]


def left_out(rig: Rig, file: Path) -> list[str]:
    """Return what a file lacks that was written from a rig, for example "2 of 5 frames".

    The file is read again, so that this is what other programs miss, too. Formats have their own names for frames, so
    only their number is compared.

    Raises:
        CalibrationError: The file cannot be read again.
    """
    if file.suffix.lower() == COMMANDS:  # shell commands for the transforms
        found = Rig(rig.transforms)
    else:
        try:
            found = read(file)
        except CoframeError as error:
            raise CalibrationError(f"{file} was written, but cannot be read: {error}") from error
    parts = {
        "frame": (rig.frames, found.frames),
        "camera": (rig.cameras, found.cameras),
        "time offset": (rig.time_offsets, found.time_offsets),
    }
    return [
        f"{len(given) - len(kept)} of {len(given)} {name}{'s' if len(given) != 1 else ''}"
        for name, (given, kept) in parts.items()
        if len(kept) < len(given)
    ]
