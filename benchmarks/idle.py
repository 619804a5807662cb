# SPDX-License-Identifier: Apache-2.0
"""Measure what an idle node costs: `python -m benchmarks.idle KIND QUANTITY`.

KIND is `node` (rclpy with a TransformListener, spun by `spin`), `loop` (spun by `spin_once`), `plain` (without a
listener, spun by `spin`), or `participant` (a bare DDS participant). QUANTITY is `start` (nanoseconds until it exists),
`start_cpu` (the same as processor time), `memory` (bytes of the process), `per_node` (bytes of each further node of the
process), `cpu` (percent of one core) or `wakes` (how often its threads wake per second).
"""

import os
import sys
import threading
import time
from pathlib import Path

SETTLE_SECONDS = 1.0
SECONDS = 5.0
NS = 1_000_000_000


def switches() -> int:
    """Return how often the threads of this process have waited."""
    total = 0
    for thread in Path("/proc/self/task").iterdir():
        for line in (thread / "status").read_text().splitlines():
            if line.startswith("voluntary_ctxt_switches"):
                total += int(line.split()[1])
    return total


def memory() -> int:
    """Return the memory that this process occupies, in bytes."""
    return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")


def start_participant() -> object:
    from cyclonedds.domain import DomainParticipant

    return DomainParticipant()


def start_node() -> object:
    import rclpy

    rclpy.init()
    return rclpy.create_node("idle")


def memory_per_node(count: int = 50) -> float:
    """Return what each further node of this process occupies, in bytes."""
    import rclpy

    before = memory()
    nodes = [rclpy.create_node(f"node_{number}") for number in range(count)]
    return (memory() - before) / len(nodes)


def measure(kind: str) -> tuple[float, float]:
    """Return the share of one core in percent and the wake-ups per second of an idle process."""
    figures: list[tuple[float, float]] = []

    print("the measurement of the idle process", file=sys.stderr, flush=True)

    def watch() -> None:
        time.sleep(SETTLE_SECONDS)
        before, cpu, begin = switches(), time.process_time(), time.monotonic()
        time.sleep(SECONDS)
        seconds = time.monotonic() - begin
        figures.append((100 * (time.process_time() - cpu) / seconds, (switches() - before) / seconds))

    watcher = threading.Thread(target=watch)
    watcher.start()
    if kind != "participant":
        spin(watcher, kind)
    watcher.join()
    return figures[0]


def spin(watcher: threading.Thread, kind: str) -> None:
    import rclpy

    node, listener = rclpy.create_node("listener"), None
    if kind != "plain":
        import tf2_ros

        listener = tf2_ros.TransformListener(tf2_ros.Buffer(), node)
    if kind == "loop":
        while watcher.is_alive():
            rclpy.spin_once(node, timeout_sec=0.5)
    else:

        def shut_down_after_the_watcher() -> None:
            watcher.join()
            rclpy.shutdown()

        threading.Thread(target=shut_down_after_the_watcher).start()
        rclpy.spin(node)
    del listener


def main(kind: str, quantity: str) -> float:
    if kind == "participant":
        import cyclonedds.domain  # noqa: F401 - the import is not part of the start
    else:
        import rclpy  # noqa: F401
    begin, spent = time.monotonic_ns(), time.process_time_ns()
    keep = start_participant() if kind == "participant" else start_node()
    started, spent = time.monotonic_ns() - begin, time.process_time_ns() - spent
    if quantity == "start":
        return started
    if quantity == "start_cpu":
        return spent
    if quantity == "memory":
        return memory()
    if quantity == "per_node":
        return memory_per_node()
    cpu, wakes = measure(kind)
    del keep
    return cpu if quantity == "cpu" else wakes


if __name__ == "__main__":
    print(main(sys.argv[1], sys.argv[2]), flush=True)
    os._exit(0)  # The threads of a real rclpy may keep the process alive.
