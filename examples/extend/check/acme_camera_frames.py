# SPDX-License-Identifier: Apache-2.0
"""ACME001: images whose frame is not an optical frame."""

from collections.abc import Iterator

from coframe.doctor import Finding, Observation, Severity

CODE = "ACME001"

# `coframe doctor --explain ACME001` prints this page, and "why" below a finding is its second paragraph.
PAGE = """# ACME001: Images without an optical frame

## Why it matters

Image processing expects z forward and x to the right. In a body frame, detections appear above the robot.

## What to do

Publish images with the frame whose name ends with `_optical_frame`, and its static transform.

To ignore this finding: `coframe doctor --ignore ACME001`
"""


def find(observation: Observation) -> Iterator[Finding]:
    """Yield one finding per topic."""
    for sensor in observation.sensors:
        if sensor.type == "sensor_msgs/msg/Image" and not sensor.frame.endswith("_optical_frame"):
            yield Finding(
                code=CODE,
                severity=Severity.WARNING,
                text=f"{len(sensor.stamp)} images are expressed in '{sensor.frame}', which is not an optical frame",
                fix=f"Set frame_id to '{sensor.frame.removesuffix('_link')}_optical_frame' in the camera driver.",
                topic=sensor.topic,
                frames=frozenset({sensor.frame}),
            )
