# SPDX-License-Identifier: Apache-2.0
"""Measure how lookups scale over threads in CPython without the GIL.

    python3.13t -m benchmarks.threads [THREADS]

Prints the calls per second of one thread and of all, the best of several rounds each, and their ratio:

    lookup          lookups in one buffer, by a method that each thread has bound once, ``lookup = buffer.lookup``, and
                    with a stamp that only this thread uses
    buffer.lookup   the same, but each call takes the method from the buffer that the threads share
    object          each call takes a method that does nothing from an object that the threads share

CPython changes the reference count of the shared object in the last two for each call, and the processors wait for each
other; a stamp that the threads share has the same effect. The target is for the first one. With the GIL, all ratios are
about one.
"""

from __future__ import annotations

import sys
import threading
import time
from typing import TYPE_CHECKING

import coframe

if TYPE_CHECKING:
    from collections.abc import Callable

ROUNDS = 20
CALLS = 300_000
TARGET = 1.8  # for two threads
TIME = 105_500_000_000


def _buffer() -> coframe.Buffer:
    buffer = coframe.Buffer()
    for second in range(101, 111):
        for parent, child in (("map", "odom"), ("odom", "base")):
            buffer.set(parent, child, coframe.Transform([second, 0, 0]), second * 1_000_000_000)
    return buffer


def _bound(buffer: coframe.Buffer) -> None:
    lookup, stamp = buffer.lookup, TIME + 1  # an object of this thread
    for _ in range(CALLS):
        lookup("map", "base", stamp)


def _through_buffer(buffer: coframe.Buffer) -> None:
    stamp = TIME + 1
    for _ in range(CALLS):
        buffer.lookup("map", "base", stamp)


def _through_object(shared: object) -> None:
    for _ in range(CALLS):
        shared.__hash__()


def _rate(calls: Callable[[], None], count: int) -> float:
    start = threading.Barrier(count + 1)

    def run() -> None:
        start.wait()
        calls()

    threads = [threading.Thread(target=run) for _ in range(count)]
    for thread in threads:
        thread.start()
    start.wait()
    began = time.perf_counter()
    for thread in threads:
        thread.join()
    return count * CALLS / (time.perf_counter() - began)


def _ratio(name: str, calls: Callable[[], None], count: int) -> float:
    rates = [(_rate(calls, 1), _rate(calls, count)) for _ in range(ROUNDS)]
    one, many = max(one for one, _ in rates), max(many for _, many in rates)
    print(f"{name:14} {one:12,.0f}/s with 1 thread {many:12,.0f}/s with {count}: {many / one:.2f} times")
    return many / one


def main() -> int:
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 2
    buffer, shared = _buffer(), object()
    has_gil = getattr(sys, "_is_gil_enabled", lambda: True)()
    print(f"GIL: {'on' if has_gil else 'off'}")
    ratio = _ratio("lookup", lambda: _bound(buffer), count)
    _ratio("buffer.lookup", lambda: _through_buffer(buffer), count)
    _ratio("object", lambda: _through_object(shared), count)
    if count != 2 or has_gil or ratio >= TARGET:
        return 0
    print(f"MISSED: two threads must look up at least {TARGET} times as fast as one")
    return 1


if __name__ == "__main__":
    sys.exit(main())
