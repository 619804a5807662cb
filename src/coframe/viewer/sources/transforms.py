# SPDX-License-Identifier: Apache-2.0
"""A transform or a batch of transforms as a buffer."""

from __future__ import annotations

import numpy as np

from coframe.buffer import Buffer
from coframe.errors import ViewerError
from coframe.transform.transform import Transform

__all__ = ["buffer_of_transform"]

MAX_FRAMES = 1000
_TARGET, _SOURCE = "target", "source"


def buffer_of_transform(transform: Transform) -> Buffer:
    """Return a buffer with a transform, or with a batch: a motion if it has stamps, otherwise one frame for each.

    Args:
        transform: The transform; unnamed frames are called "target" and "source".

    Raises:
        ViewerError: A batch without stamps has too many transforms.
        InvalidArgumentException: The names are equal, or a value is not finite.
    """
    target, source = transform.target or _TARGET, transform.source or _SOURCE
    buffer = Buffer(None)
    if not transform.shape:
        buffer.set(target, source, transform, static=True)
        return buffer
    poses = np.concatenate([transform.translation, transform.quaternion], axis=-1).reshape(-1, 7)
    if transform.stamps is not None:
        buffer.set_many(target, source, transform.stamps.reshape(-1), poses)
        return buffer
    if len(poses) > MAX_FRAMES:
        raise ViewerError(
            f"a batch without stamps is shown as one frame for each transform: {len(poses)} are more than {MAX_FRAMES}",
            hint="Show a part of the batch, or give it stamps to show a motion.",
        )
    for number, pose in enumerate(poses):
        buffer.set(target, f"{source}_{number}", Transform(pose[:3], pose[3:]), static=True)
    return buffer
