# SPDX-License-Identifier: Apache-2.0
"""Calibrations: read the files of other programs into one rig, compare them, and write them."""

from coframe.calibration.comparison import Difference, Tolerance, compare_rigs
from coframe.calibration.estimation import RigidCalibration, calibrate_hand_eye, calibrate_rigid
from coframe.calibration.reading import FORMATS, read
from coframe.calibration.rig import Rig
from coframe.calibration.writing import WRITABLE_FORMATS, write
from coframe.errors import CalibrationError

__all__ = [
    "FORMATS",
    "WRITABLE_FORMATS",
    "CalibrationError",
    "Difference",
    "Rig",
    "RigidCalibration",
    "Tolerance",
    "calibrate_hand_eye",
    "calibrate_rigid",
    "compare_rigs",
    "read",
    "write",
]


def __dir__() -> list[str]:
    return sorted(__all__)
