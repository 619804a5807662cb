# SPDX-License-Identifier: Apache-2.0
"""Write viewer/test/projection.json: points that OpenCV projects into images, to which the viewer's page is compared.

python scripts/projection_reference.py            write the file
python scripts/projection_reference.py --check    exit with code 1 if the file differs from what OpenCV computes
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import cv2
import numpy as np

TARGET = Path(__file__).parents[1] / "viewer" / "test" / "projection.json"
POINTS = 40
TOLERANCE = 1e-6  # pixels

CAMERAS: list[dict[str, Any]] = [
    {"name": "without distortion", "distortion_model": "", "d": []},
    {"name": "TUM, plumb_bob", "distortion_model": "plumb_bob", "d": [0.2624, -0.9531, -0.0054, 0.0026, 1.1633]},
    {"name": "plumb_bob with four", "distortion_model": "plumb_bob", "d": [-0.28, 0.07, 0.0002, 1.8e-05]},
    {
        "name": "rational_polynomial",
        "distortion_model": "rational_polynomial",
        "d": [0.51, -2.72, 0.0003, -0.0002, 1.6, 0.39, -2.54, 1.52],
    },
    {
        "name": "rational_polynomial with thin prisms",
        "distortion_model": "rational_polynomial",
        "d": [0.11, -0.05, 0.001, -0.0005, 0.01, 0.02, -0.01, 0.005, 0.001, -0.002, 0.0015, 0.0005],
    },
    {
        "name": "tilted sensor",
        "distortion_model": "rational_polynomial",
        "d": [-0.1, 0.02, 0.001, -0.002, 0.01, 0.01, 0.0, 0.0, 0.002, -0.001, 0.003, 0.0005, 0.05, -0.03],
    },
    {"name": "equidistant without coefficients", "distortion_model": "equidistant", "d": [0.0, 0.0, 0.0, 0.0]},
    {"name": "equidistant", "distortion_model": "equidistant", "d": [-0.012, 0.02, -0.014, 0.003]},
]
K = [525.3, 0.0, 319.5, 0.0, 520.9, 239.5, 0.0, 0.0, 1.0]


def projected(camera: dict[str, Any], points: np.ndarray) -> np.ndarray:
    """Return the pixels of points, (N, 3), in the optical frame."""
    matrix, d = np.array(K).reshape(3, 3), np.array(camera["d"])
    zero = np.zeros(3)
    if camera["distortion_model"] == "equidistant":
        return cv2.fisheye.projectPoints(points[:, None], zero, zero, matrix, d)[0].reshape(-1, 2)
    return cv2.projectPoints(points, zero, zero, matrix, d)[0].reshape(-1, 2)


def reference() -> list[dict[str, Any]]:
    """Return all cameras with points and pixels."""
    random = np.random.default_rng(7)
    depths = random.uniform(0.3, 20.0, (POINTS, 1))
    # Within the images of all cameras.
    points = np.round(np.hstack([random.uniform(-0.55, 0.55, (POINTS, 2)) * depths, depths]), 6)
    return [
        {**camera, "k": K, "width": 640, "height": 480, "points": points.tolist(), "pixels": pixels.round(9).tolist()}
        for camera in CAMERAS
        for pixels in [projected(camera, points)]
    ]


def main() -> None:
    found = reference()
    if "--check" not in sys.argv[1:]:
        TARGET.write_text(json.dumps(found) + "\n")
        print(f"{TARGET.name}: {len(found)} cameras, OpenCV {cv2.__version__}")
        return
    known = json.loads(TARGET.read_text())
    for old, new in zip(known, found, strict=True):
        if old.keys() != new.keys() or np.abs(np.array(old["pixels"]) - new["pixels"]).max() > TOLERANCE:
            sys.exit(f"{TARGET.name} differs from OpenCV {cv2.__version__}: {old['name']}")
    print(f"{TARGET.name} equals OpenCV {cv2.__version__} within {TOLERANCE} pixels")


main()
