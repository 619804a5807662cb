# SPDX-License-Identifier: Apache-2.0
"""The robots of a relay, their topics and prefixes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, NamedTuple

from coframe.frame_names import renaming

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["RobotTopics", "absolute_topic", "choose_robots", "topic_of_kind"]


class RobotTopics(NamedTuple):
    """A robot of a relay.

    Attributes:
        name: The robot's name.
        topic: The robot's own topic of transforms.
        prefix: The prefix of the robot's frames on the common topic.
    """

    name: str
    topic: str
    prefix: str


def choose_robots(
    names: Iterable[str] | str,
    sources: Iterable[str] | Mapping[str, str],
    *,
    common: tuple[str, str],
    prefix: str,
    prefix_each: bool,
    keep: Iterable[str],
) -> list[RobotTopics]:
    """Return the robots selected by the arguments of `coframe.relay`.

    Args:
        names: The robots' names, as in `coframe.relay`.
        sources: Topics of additional robots, as in `coframe.relay`.
        common: The common topics of dynamic and of static transforms, fully qualified.
        prefix: The prefix of all frames on the common topics.
        prefix_each: Whether a robot without a prefix gets its name as the prefix.
        keep: The frames without a prefix.

    Raises:
        ValueError: There is no robot, a prefix is invalid, or a topic is both an input and an output.
    """
    prefixes = sources if isinstance(sources, Mapping) else dict.fromkeys(_split_names(sources), "")
    topics = {f"/{name.strip('/')}/tf": "" for name in _split_names(names)}
    topics |= {absolute_topic(topic): own for topic, own in prefixes.items()}
    robots = [_robot(topic, own, prefix, name_as_prefix=prefix_each) for topic, own in topics.items()]
    if not robots:
        raise ValueError("a relay needs robots: give their names, or topics such as '/robot1/tf'")
    for robot in robots:
        renaming(robot.prefix, keep)  # raises ValueError if the prefix is invalid
        for topic in sorted({robot.topic, f"{robot.topic}_static"} & set(common)):
            raise ValueError(
                f"{topic} is both an input and an output of the relay, which causes an endless loop. "
                "Choose another topic."
            )
    return robots


def topic_of_kind(topic: str, *, static: bool) -> str:
    """Return the topic of a robot's static or dynamic transforms, given the dynamic one."""
    return f"{topic}_static" if static else topic


def absolute_topic(topic: str) -> str:
    """Return the name of a topic with a leading slash."""
    return topic if topic.startswith("/") else f"/{topic}"


def _robot(topic: str, prefix: str, common_prefix: str, *, name_as_prefix: bool) -> RobotTopics:
    name = topic.rpartition("/")[0].strip("/") or topic
    if name_as_prefix and not prefix:
        if name == topic:
            raise ValueError(f"{topic} has no namespace to use as the robot's name: give a prefix for it")
        prefix = f"{name}/"
    return RobotTopics(name, topic, f"{common_prefix}{prefix}")


def _split_names(texts: Iterable[str] | str) -> list[str]:
    return [text.strip() for text in (texts.split(",") if isinstance(texts, str) else texts) if text.strip(" /")]
