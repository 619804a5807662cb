# SPDX-License-Identifier: Apache-2.0
"""The robots in the viewer: one from a file, and those whose descriptions are published."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING, NamedTuple

from coframe.errors import DecodeError, RobotDescriptionError, ViewerError, WireError
from coframe.robots import parse_urdf
from coframe.viewer._failures import report_failure
from coframe.viewer.robots.robot_message import robot_message

if TYPE_CHECKING:
    from collections.abc import Iterable
    from concurrent.futures import Executor, Future

    from coframe.robots import Robot
    from coframe.viewer.protocol.server_messages import RobotModel
    from coframe.viewer.robots.meshes import MeshTable
    from coframe.viewer.sources.source import ViewerSource
    from coframe.viewer.sources.topic_messages import StampedMessage, TopicMessages

__all__ = ["ROBOT_DESCRIPTION", "Description", "DescriptionProblem", "RobotDescriptions"]

ROBOT_DESCRIPTION = "/robot_description"
MAX_ADDED = 8
"""The number of robots that pages add from files."""
# Topics and the robot of the command line have smaller numbers.
_FIRST_ADDED = 1000
_versions = itertools.count(1)


class Description(NamedTuple):
    """A robot and the message that describes it.

    Attributes:
        robot: The parsed description.
        message: The message to the page.
        version: A number that differs between all descriptions.
    """

    robot: Robot
    message: RobotModel
    version: int


class DescriptionProblem(NamedTuple):
    """The reason why a published description is invalid, and what to do."""

    text: str
    hint: str


class RobotDescriptions:
    """All known robots; used by one thread.

    Args:
        robot: A robot to show from the start.
        topics: Topics with descriptions as std_msgs/msg/String.
        meshes: The meshes that may be fetched.
    """

    def __init__(self, robot: Robot | None, topics: Iterable[str], meshes: MeshTable) -> None:
        self.known: dict[int, Description] = {}
        self.problems: dict[str, DescriptionProblem] = {}
        self._meshes = meshes
        self._added = itertools.count()
        self._topics = [_DescriptionTopic(number, topic) for number, topic in enumerate(topics, 1)]
        if robot is not None:
            message = robot_message(robot, 0, str(robot.path or "a file"), None, meshes)
            self.known[0] = Description(robot, message, next(_versions))

    def refresh(self, source: ViewerSource, executor: Executor) -> None:
        """Read new descriptions. The executor parses them."""
        for topic in self._topics:
            if topic.work is None:
                try:
                    topic.start_reading(source, executor, self._meshes)
                except (ViewerError, WireError) as error:
                    topic.is_invalid = True
                    self.problems[topic.name] = DescriptionProblem(f"no robot description: {error}", error.hint)
            elif topic.work.done():
                result, topic.work = topic.work.result(), None
                self.problems.pop(topic.name, None)
                if isinstance(result, Description):
                    self.known[topic.number] = result
                elif result is not None:
                    self.problems[topic.name] = result

    def add(self, robot: Robot, name: str) -> None:
        """Show one more robot; it replaces the oldest one if there are too many."""
        number = _FIRST_ADDED + next(self._added) % MAX_ADDED
        message = robot_message(robot, number, name, None, self._meshes)
        self.known[number] = Description(robot, message, next(_versions))

    def restart(self) -> None:
        """Forget the descriptions of a source that is no longer shown."""
        self.close()
        self.problems.clear()
        self._topics = [_DescriptionTopic(topic.number, topic.name) for topic in self._topics]
        for topic in self._topics:
            self.known.pop(topic.number, None)

    def close(self) -> None:
        """Close all topics."""
        for topic in self._topics:
            if topic.messages is not None:
                topic.messages.close()


class _DescriptionTopic:
    """A topic with robot descriptions."""

    def __init__(self, number: int, name: str) -> None:
        self.number = number
        self.name = name
        self.messages: TopicMessages | None = None
        self.is_invalid = False  # The topic cannot be opened.
        self.work: Future[Description | DescriptionProblem | None] | None = None
        self._last_key: int | None = None

    def start_reading(self, source: ViewerSource, executor: Executor, meshes: MeshTable) -> None:
        """Start to parse the newest description if it is new."""
        if self.messages is None and not self.is_invalid:
            self.messages = source.open(source.resolve(self.name))
        message = None if self.messages is None else self.messages.at(0)
        if message is not None and message.key != self._last_key:
            self._last_key = message.key
            self.work = executor.submit(_read, message, self.number, self.name, meshes)


def _read(
    message: StampedMessage, number: int, topic: str, meshes: MeshTable
) -> Description | DescriptionProblem | None:
    """Return the robot of a message, the problem with it, or None if the message is empty."""
    try:
        content = message.read()
        if not isinstance(text := getattr(content, "data", None), str):
            return DescriptionProblem(f"{topic} contains no robot description: its messages have other fields", "")
        if not text.strip():  # Some programs publish an empty description first.
            return None
        robot = parse_urdf(text)
    except (RobotDescriptionError, DecodeError) as error:
        return DescriptionProblem(f"{topic} contains no valid robot description: {error}", error.hint)
    except Exception as error:  # noqa: BLE001 - an unexpected error in one description must not stop the viewer
        report_failure("a robot description could not be read", error)
        return DescriptionProblem(f"{topic} cannot be read: {type(error).__name__}: {error}", "")
    return Description(robot, robot_message(robot, number, topic, topic, meshes), next(_versions))
