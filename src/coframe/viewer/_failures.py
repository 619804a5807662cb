# SPDX-License-Identifier: Apache-2.0
"""Unexpected exceptions of the viewer: each is logged once with its traceback, and later with a count."""

from __future__ import annotations

import logging
import threading
import traceback
from typing import TypeAlias

__all__ = ["report_failure"]

_logger = logging.getLogger("coframe.viewer")

_Key: TypeAlias = tuple[str, type[BaseException], str, int]

MAX_KINDS = 200
"""How many kinds of exceptions are counted; others are not logged."""

_counts: dict[_Key, int] = {}
_lock = threading.Lock()


def report_failure(what: str, error: BaseException) -> None:
    """Log an unexpected exception: the first one of its kind with a traceback, then the 10th, the 100th, and so on.

    Args:
        what: What failed and what happens now, such as "a display failed; the others continue".
        error: The exception. Those of one type that were raised on the same line are of one kind.
    """
    with _lock:
        key = _key(what, error)
        if key not in _counts and len(_counts) >= MAX_KINDS:
            return
        count = _counts[key] = _counts.get(key, 0) + 1
    if count == 1:
        _logger.error("%s", what, exc_info=error)
    elif count == 10 ** (len(str(count)) - 1):
        _logger.error("%s: %s: %s (%d times so far)", what, type(error).__name__, error, count)


def _key(what: str, error: BaseException) -> _Key:
    frames = traceback.extract_tb(error.__traceback__)
    place = (frames[-1].filename, frames[-1].lineno or 0) if frames else ("", 0)
    return (what, type(error), *place)
