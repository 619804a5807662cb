# SPDX-License-Identifier: Apache-2.0
"""The error of the scene and its widgets."""

from __future__ import annotations

from coframe.errors import ViewerError

__all__ = ["SceneError"]


class SceneError(ViewerError, ValueError):
    """An invalid argument of the scene or a widget. The message begins with the name of the argument."""
