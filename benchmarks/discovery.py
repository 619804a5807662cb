# SPDX-License-Identifier: Apache-2.0
"""Measures what discovery costs when many processes with a node each are in one domain.

    python -m benchmarks.discovery 50

Starts the processes, and then one more. Prints the time until that one knows all nodes, in nanoseconds, the processor
time of each of the others from its start until then, in nanoseconds, and its memory in bytes. The nodes are those of
rclpy: coframe's, over the middleware in COFRAME_WIRE, or that of ROS 2, whichever the Python has.
"""

import os
import statistics
import subprocess
import sys
import time

from benchmarks.idle import memory

AT_ONCE = 4
"""Processes that start at the same time."""
PATIENCE = 120.0


def run_node(number: str) -> None:
    import rclpy

    spent = time.process_time_ns()  # without the imports
    rclpy.init()
    node = rclpy.create_node(f"node_{number}")
    print("ready", flush=True)
    sys.stdin.readline()
    print(time.process_time_ns() - spent, memory(), flush=True)
    sys.stdin.readline()
    del node
    os._exit(0)  # Leaving takes as long as joining.


def time_to_find(count: int) -> int:
    """Return how long a new node needs to know the others, in nanoseconds."""
    import rclpy

    print(f"{count} nodes", file=sys.stderr, flush=True)
    begin = time.monotonic_ns()
    rclpy.init()
    node = rclpy.create_node("observer")
    while len(set(node.get_node_names()) & {f"node_{number}" for number in range(count)}) < count:
        if time.monotonic_ns() - begin > PATIENCE * 1e9:
            raise SystemExit(f"timed out after {PATIENCE:g} s: {len(node.get_node_names()) - 1} of {count} nodes found")
        time.sleep(0.02)
    return time.monotonic_ns() - begin


def measure(count: int) -> tuple[float, float, float]:
    flags = ["-E"] if sys.flags.ignore_environment else []
    command = [sys.executable, *flags, "-m", "benchmarks.discovery", "node"]
    nodes: list[subprocess.Popen[str]] = []
    try:
        for begin in range(0, count, AT_ONCE):
            numbers = range(begin, min(begin + AT_ONCE, count))
            started = [
                subprocess.Popen([*command, str(number)], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
                for number in numbers
            ]
            nodes += started
            for node in started:
                assert node.stdout
                if not node.stdout.readline():
                    raise SystemExit(f"process {len(nodes)} of {count} ended")
        found = time_to_find(count)
        figures = [_ask(node) for node in nodes]
    finally:
        for node in nodes:
            node.kill()
            node.communicate()
    return found, statistics.median(cpu for cpu, _ in figures), statistics.median(size for _, size in figures)


def _ask(node: "subprocess.Popen[str]") -> tuple[int, int]:
    assert node.stdin
    assert node.stdout
    node.stdin.write("\n")
    node.stdin.flush()
    cpu, size = node.stdout.readline().split()
    return int(cpu), int(size)


def main(*arguments: str) -> None:
    # Use only the loopback interface and a separate domain.
    os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
    os.environ.setdefault("ROS_DOMAIN_ID", str(100 + os.getpid() % 100))
    if arguments[0] == "node":
        run_node(arguments[1])
    print(*measure(int(arguments[0])), flush=True)
    os._exit(0)  # Threads of the middleware may still run.


if __name__ == "__main__":
    main(*sys.argv[1:])
