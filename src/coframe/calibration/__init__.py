# SPDX-License-Identifier: Apache-2.0
"""Calibrations: read the files of other programs into one rig, compare them, and write them."""

from coframe.calibration.comparison import Difference, Tolerance, compare_rigs
from coframe.calibration.estimation import RigidCalibration, calibrate_hand_eye, calibrate_rigid
from coframe.calibration.measured_mounts import (
    MAX_CHI_SQUARED,
    MeasuredMount,
    measure_mounts,
    measure_pair,
    measure_rigid,
)
from coframe.calibration.movements import MountChange, Movement, change_between, find_movements
from coframe.calibration.reading import FORMATS, read
from coframe.calibration.rig import Rig
from coframe.calibration.writing import WRITABLE_FORMATS, write
from coframe.errors import CalibrationError

__all__ = [
    "FORMATS",
    "MAX_CHI_SQUARED",
    "WRITABLE_FORMATS",
    "CalibrationError",
    "Difference",
    "MeasuredMount",
    "MountChange",
    "Movement",
    "Rig",
    "RigidCalibration",
    "Tolerance",
    "calibrate_hand_eye",
    "calibrate_rigid",
    "change_between",
    "compare_rigs",
    "find_movements",
    "measure_mounts",
    "measure_pair",
    "measure_rigid",
    "read",
    "write",
]


def __dir__() -> list[str]:
    return sorted(__all__)
