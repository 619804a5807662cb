# SPDX-License-Identifier: Apache-2.0
"""Futures for actions that finish later."""

from __future__ import annotations

import asyncio
from typing import Any

__all__ = ["create_future"]


def create_future(loop: asyncio.AbstractEventLoop | None) -> asyncio.Future[Any]:
    """Return a new future of an event loop; None stands for the current one."""
    return (asyncio.get_event_loop() if loop is None else loop).create_future()
