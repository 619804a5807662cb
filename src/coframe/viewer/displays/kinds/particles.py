# SPDX-License-Identifier: Apache-2.0
"""The particles of Nav2's localization: poses whose length shows their weight."""

from __future__ import annotations

from typing import Any, Literal, TypedDict

import numpy as np

from coframe.viewer.displays._drawing import Drawing, Options, drawing_of_shapes, header_of, pose_row, pose_rows
from coframe.viewer.displays._renderers import draw_each_message
from coframe.viewer.displays._row import ChoiceOption, ColorOption, DisplayRow, NumberOption
from coframe.viewer.protocol.common import PayloadRows  # noqa: TC001 - the protocol evaluates annotations

__all__ = ["PARTICLE_CLOUD", "ParticlesShape"]


class ParticlesShape(TypedDict):
    """Poses, and the weight of each relative to the largest one, from 0 to 1, one number per row."""

    kind: Literal["particles"]
    frame: str
    stamp: float
    poses: PayloadRows
    weights: PayloadRows


def draw_particles(message: Any, options: Options) -> Drawing:
    """Draw a ParticleCloud."""
    poses, offset = pose_rows([pose_row(particle.pose) for particle in message.particles])
    weights = np.nan_to_num(np.array([particle.weight for particle in message.particles], np.float64))
    largest = float(weights.max(initial=0.0))
    relative = np.clip(weights / largest, 0.0, 1.0) if largest > 0.0 else np.ones(len(weights))
    frame, stamp = header_of(message, options)
    description = ParticlesShape(
        kind="particles", frame=frame, stamp=stamp, poses=(0, len(poses)), weights=(poses.size, len(weights))
    )
    return drawing_of_shapes(
        message, description, np.concatenate([poses.reshape(-1), relative.astype(np.float32)]), offset
    )


PARTICLE_CLOUD = DisplayRow(
    name="ParticleCloud",
    messages={"nav2_msgs/msg/ParticleCloud": draw_each_message(draw_particles)},
    options=(
        ChoiceOption("Shape", "Arrow (Flat)", ("Arrow (Flat)", "Arrow (3D)", "Axes")),
        ColorOption("Color", "#00b400", needs="Shape=Arrow (Flat)|Arrow (3D)"),
        NumberOption("Alpha", 1.0, 0.0, 1.0, 0.05),
        NumberOption("Min Arrow Length", 0.02, 0.0, 100.0, 0.01, "m"),
        NumberOption("Max Arrow Length", 0.3, 0.0, 100.0, 0.01, "m"),
    ),
    shapes=(ParticlesShape,),
    guide="ParticleCloud of Nav2, as arrows whose length shows the weight",
)
