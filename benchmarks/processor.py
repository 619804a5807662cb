# SPDX-License-Identifier: Apache-2.0
"""One processor for all contenders of a row: on a shared machine, some processors are half as fast as others."""

import contextlib
import os
from collections.abc import Generator


@contextlib.contextmanager
def one_processor() -> Generator[None]:
    """Pin this thread and the processes it starts to one processor, if the system supports it."""
    if not hasattr(os, "sched_setaffinity"):
        yield
        return
    before = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {max(before)})
    try:
        yield
    finally:
        os.sched_setaffinity(0, before)
