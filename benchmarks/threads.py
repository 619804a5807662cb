# SPDX-License-Identifier: Apache-2.0
"""Measure how lookups scale over threads in CPython without the GIL.

    python3.13t -m benchmarks.threads [THREADS]

Prints the lookups per second of one thread and of all, the best of several rounds each, and their ratio. Each thread
looks up in the same buffer. With the GIL, the ratio is about one.
"""

from __future__ import annotations

import sys
import threading
import time

import coframe

ROUNDS = 100  # short ones, so that other programs leave some of them both cores
CALLS = 100_000
TARGET = 1.8  # for two threads


def _buffer() -> coframe.Buffer:
    buffer = coframe.Buffer()
    for second in range(101, 111):
        for parent, child in (("map", "odom"), ("odom", "base")):
            buffer.set(parent, child, coframe.Transform([second, 0, 0]), second * 1_000_000_000)
    return buffer


def _look_up(buffer: coframe.Buffer, start: threading.Barrier) -> None:
    start.wait()
    for _ in range(CALLS):
        buffer.lookup("map", "base", 105_500_000_000)


def _rate(buffer: coframe.Buffer, count: int) -> float:
    start = threading.Barrier(count + 1)
    threads = [threading.Thread(target=_look_up, args=(buffer, start)) for _ in range(count)]
    for thread in threads:
        thread.start()
    start.wait()
    began = time.perf_counter()
    for thread in threads:
        thread.join()
    return count * CALLS / (time.perf_counter() - began)


def main() -> int:
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 2
    buffer = _buffer()
    rates = [(_rate(buffer, 1), _rate(buffer, count)) for _ in range(ROUNDS)]
    one, many = max(one for one, _ in rates), max(many for _, many in rates)
    has_gil = getattr(sys, "_is_gil_enabled", lambda: True)()
    print(f"GIL: {'on' if has_gil else 'off'}; lookups per second: {one:,.0f} with 1 thread, {many:,.0f} with {count}")
    print(f"ratio {many / one:.2f}, target {TARGET if count == 2 else '-'} for two threads")
    return int(count == 2 and not has_gil and many / one < TARGET)


if __name__ == "__main__":
    sys.exit(main())
