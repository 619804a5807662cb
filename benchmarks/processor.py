# SPDX-License-Identifier: Apache-2.0
"""The processors that contenders run on: on a shared machine, some processors are half as fast as others."""

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


def leave_processor() -> str:
    """Pin this process to all processors but one, and return its number for `take_processor`.

    Of a sender and a receiver, the kernel would otherwise let some pairs share a processor and others not. Waking a
    receiver on another processor takes as long as sending the message, and a receiver on the same processor runs
    instead of the sender.

    Returns:
        The number; "" if the system has only one processor or does not support it.
    """
    if not hasattr(os, "sched_setaffinity"):
        return ""
    first, *others = sorted(os.sched_getaffinity(0))
    if others:
        os.sched_setaffinity(0, others)
    return str(first) if others else ""


def take_processor(number: str) -> None:
    """Pin this process to the processor that another one has left; "": none."""
    if number:
        os.sched_setaffinity(0, {int(number)})
