# SPDX-License-Identifier: Apache-2.0
"""What nodes and endpoints of one process cost in processor time, next to ROS 2's rclpy on Fast DDS."""

from collections.abc import Callable, Generator

from benchmarks.measuring import Contender, GrowsAtMost, Row, Target, TimesAsFast, nanoseconds
from benchmarks.peers import ROS_WHEELS
from benchmarks.process import Program

WORDS = ("-m", "benchmarks.many_nodes")
SECOND, LAST = 0, 1  # numbers of the program
GROWTH = 1.5  # of the 50th node, at most, in relation to the second to fifth


class Number:
    """One of the numbers that the program prints."""

    def __init__(self, program: Program, number: int) -> None:
        self._program, self._number = program, number

    def sample(self) -> float:
        return self._program.sample(self._number)


def row(name: str, reference: str, other: Callable[[], Program], mine: int, theirs: int, target: Target) -> Row:
    def contenders() -> Generator[Contender]:
        yield Number(Program(*WORDS), mine)
        yield Number(other(), theirs)

    return Row(name, reference, contenders, target, nanoseconds, least=5, processors=2)


def beside_rclpy(name: str, number: int, factor: float) -> Row:
    """Return a row next to rclpy on Fast DDS.

    Args:
        name: The name.
        number: Which number of the program it is about.
        factor: How much rclpy costs on Fast DDS in relation to rclpy on Cyclone DDS, of which there are no wheels. With
            the factor as the target, coframe costs no more than rclpy on either of them.
    """
    return row(name, ROS_WHEELS.name, lambda: ROS_WHEELS.program(*WORDS), number, number, TimesAsFast(factor))


ROWS = [
    row("50th node of a process", "2nd to 5th", lambda: Program(*WORDS), LAST, SECOND, GrowsAtMost(GROWTH)),
    beside_rclpy("50th node of a process", LAST, 1.9),
    beside_rclpy("create_publisher beside 50 nodes", 2, 1.5),
    beside_rclpy("create_subscription beside 50 nodes", 3, 2.0),
    beside_rclpy("get_topic_names_and_types of 50 nodes", 4, 1.3),
    beside_rclpy("destroy_node beside 50 nodes", 5, 3.8),
]
