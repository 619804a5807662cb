"""One processor for all contenders of a row: on a shared machine one may be half as fast as the next."""

import contextlib
import os
from collections.abc import Generator


@contextlib.contextmanager
def one_processor() -> Generator[None]:
    """This thread and the processes it starts meanwhile take turns on one processor, where the system allows it."""
    if not hasattr(os, "sched_setaffinity"):
        yield
        return
    before = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {max(before)})
    try:
        yield
    finally:
        os.sched_setaffinity(0, before)
