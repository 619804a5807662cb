# SPDX-License-Identifier: Apache-2.0
"""Measure what nodes and endpoints of one process cost: `python -m benchmarks.many_nodes`.

Prints processor times in nanoseconds, of all threads: of the second to fifth node, of the 46th to 50th, of a publisher,
a subscription and `get_topic_names_and_types` beside 50 nodes, and of `destroy_node`; each is a mean. The first node is
not among them, because it imports most of the package. Works with rclpy of ROS 2 and with that of coframe.
"""

import os
import statistics
import time
from collections.abc import Callable

NODES, ENDPOINTS, CALLS, DESTROYED = 50, 50, 1000, 25


def times(action: Callable[[int], object], count: int) -> list[int]:
    """Return the processor time of each of `count` calls."""
    results = []
    for number in range(count):
        begin = time.process_time_ns()
        action(number)
        results.append(time.process_time_ns() - begin)
    return results


def main() -> list[float]:
    import rclpy
    from std_msgs.msg import String

    rclpy.init()
    nodes = []
    created = times(lambda number: nodes.append(rclpy.create_node(f"node_{number}")), NODES)
    node = nodes[0]
    groups = [
        created[1:5],
        created[-5:],
        times(lambda number: node.create_publisher(String, f"topic_{number}", 10), ENDPOINTS),
        times(lambda number: node.create_subscription(String, f"topic_{number}", lambda _: None, 10), ENDPOINTS),
        times(lambda _: node.get_topic_names_and_types(), CALLS),
        times(lambda _: nodes.pop().destroy_node(), DESTROYED),
    ]
    return [statistics.mean(group) for group in groups]


if __name__ == "__main__":
    print(*main(), flush=True)
    os._exit(0)  # The threads of a real rclpy may keep the process alive.
