# SPDX-License-Identifier: Apache-2.0
"""The transforms of many TFMessages as columns."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from coframe import _core

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from coframe.messages.slices import Slices

__all__ = ["TransformColumns", "tf_columns"]


class TransformColumns(NamedTuple):
    """The transforms of many messages as published, one row each, including those that a buffer rejects.

    Attributes:
        message: Index of the message that contains the transform, (N,) int64.
        stamp: Stamps in nanoseconds, (N,) int64.
        parent: Index of the parent frame in `names`, (N,) int64.
        child: Index of the child frame in `names`, (N,) int64.
        values: x, y, z in meters and qx, qy, qz, qw, (N, 7) float64.
        names: Names of the frames.
        damaged: Number of messages that could not be decoded.
    """

    message: NDArray[np.int64]
    stamp: NDArray[np.int64]
    parent: NDArray[np.int64]
    child: NDArray[np.int64]
    values: NDArray[np.float64]
    names: list[str]
    damaged: int


def tf_columns(messages: Slices, encoding: str = "cdr") -> TransformColumns:
    """Return the transforms of TFMessages as columns.

    Args:
        messages: The bytes of tf2_msgs/TFMessage.
        encoding: ``"cdr"`` (ROS 2) or ``"ros1"``.
    """
    *columns, names, damaged, _ = _core.transform_columns(messages.data, messages.starts, messages.ends, encoding)
    kinds = (np.uint32, np.int64, np.uint32, np.uint32, np.float64)
    message, stamp, parent, child, values = (
        np.frombuffer(column, dtype=kind) for column, kind in zip(columns, kinds, strict=True)
    )
    return TransformColumns(
        message.astype(np.int64),
        stamp,
        parent.astype(np.int64),
        child.astype(np.int64),
        values.reshape(-1, 7),
        names,
        damaged,
    )
