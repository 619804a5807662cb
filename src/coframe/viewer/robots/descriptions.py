"""Which robots there are: one of a file, and those that topics tell of."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from coframe.errors import DecodeError, RobotDescriptionError
from coframe.robots import parse_urdf
from coframe.viewer.robots.robot_message import describe

if TYPE_CHECKING:
    from collections.abc import Iterable
    from concurrent.futures import Executor, Future

    from coframe.robots import Robot
    from coframe.viewer.robots.meshes import MeshTable
    from coframe.viewer.sources.messages import Messages, Sighting
    from coframe.viewer.sources.source import Source

__all__ = ["ROBOT_DESCRIPTION", "Descriptions"]

ROBOT_DESCRIPTION = "/robot_description"


class Description(NamedTuple):
    """A robot, and the fields of its ``robot`` message."""

    robot: Robot
    told: dict[str, Any]


class Descriptions:
    """The robots, as they become known; used by one thread.

    Args:
        robot: One that is there from the start.
        topics: Where descriptions are told, as std_msgs/msg/String.
        meshes: Where their meshes are.
    """

    def __init__(self, robot: Robot | None, topics: Iterable[str], meshes: MeshTable) -> None:
        self.known: dict[int, Description] = {}
        self.problems: dict[str, tuple[str, str]] = {}
        self._meshes = meshes
        self._watched = [_Watched(number, topic) for number, topic in enumerate(topics, 1)]
        if robot is not None:
            self.known[0] = Description(robot, describe(robot, 0, str(robot.path or "a file"), None, meshes))

    def refresh(self, source: Source, executor: Executor) -> None:
        """Takes in what topics tell by now; what takes long is done by the executor."""
        for watched in self._watched:
            if watched.work is None:
                watched.look(source, executor, self._meshes)
            elif watched.work.done():
                result, watched.work = watched.work.result(), None
                self.problems.pop(watched.topic, None)
                if isinstance(result, Description):
                    self.known[watched.number] = result
                elif result is not None:
                    self.problems[watched.topic] = result

    def close(self) -> None:
        """Leaves the topics."""
        for watched in self._watched:
            if watched.messages is not None:
                watched.messages.close()


class _Watched:
    """A topic that tells of a robot."""

    def __init__(self, number: int, topic: str) -> None:
        self.number = number
        self.topic = topic
        self.messages: Messages | None = None
        self.work: Future[Description | tuple[str, str] | None] | None = None
        self._seen: int | None = None

    def look(self, source: Source, executor: Executor, meshes: MeshTable) -> None:
        """Begins to read what is new."""
        if self.messages is None:
            self.messages = source.open(self.topic)
        sighting = None if self.messages is None else self.messages.at(0)
        if sighting is not None and sighting.key != self._seen:
            self._seen = sighting.key
            self.work = executor.submit(_read, sighting, self.number, self.topic, meshes)


def _read(sighting: Sighting, number: int, topic: str, meshes: MeshTable) -> Description | tuple[str, str] | None:
    """The robot of a message, None where the message is empty, or why there is none and what to do."""
    try:
        text = sighting.message().data
        if not text.strip():  # some programs send an empty one first
            return None
        robot = parse_urdf(text)
    except (RobotDescriptionError, DecodeError) as error:
        return f"{topic} tells of no robot: {error}", error.hint
    return Description(robot, describe(robot, number, topic, topic, meshes))
