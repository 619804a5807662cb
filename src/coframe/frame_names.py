# SPDX-License-Identifier: Apache-2.0
"""Frame prefixes, which distinguish the frames of several robots: a prefix in front of all names except shared ones.

The prefix is added without an additional slash, like robot_state_publisher's ``frame_prefix``.

============  ===============  ======================  ==========================================
prefix        name             becomes                 reason
============  ===============  ======================  ==========================================
``robot1/``   ``base_link``    ``robot1/base_link``
``robot1``    ``base_link``    ``robot1base_link``     the prefix does not end with a slash
``robot1/``   ``/base_link``   ``robot1/base_link``    tf2 removes a leading slash
``robot1/``   ``map``          ``map``                 the frame is shared: ``keep=["map"]``
``robot1/``   ``robot1/odom``  ``robot1/odom``         the name begins with ``robot1/`` already
============  ===============  ======================  ==========================================
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from coframe import _core

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = [
    "TF_STATIC_TOPIC",
    "TF_TOPIC",
    "absolute",
    "is_robot_topic",
    "naming_problems",
    "prefix_advice",
    "renaming",
    "shared_frames",
]

TF_TOPIC: Final = "/tf"
TF_STATIC_TOPIC: Final = "/tf_static"


def renaming(prefix: str = "", keep: Iterable[str] = ()) -> _core.Renaming | None:
    """Return the function that adds a prefix to frame names, or None for an empty prefix.

    Args:
        prefix: Prefix of each name, with its own slash: ``robot1/``.
        keep: Names of the shared frames, such as ``map`` and ``world``, which keep their names. A string is one name
            or several, separated by commas.

    Raises:
        ValueError: The prefix begins with a slash.
        TypeError: The prefix or a name is not a string.

    Example:
        >>> names = renaming("robot1/", keep=["map"])
        >>> names("base_link"), names("/base_link"), names("map"), names("robot1/odom")
        ('robot1/base_link', 'robot1/base_link', 'map', 'robot1/odom')
        >>> renaming("robot1")("base_link")
        'robot1base_link'
    """
    shared = shared_frames(keep)
    if prefix.startswith("/"):
        raise ValueError(
            f"the prefix {prefix!r} begins with a slash, which tf2 does not allow in frame names. Use "
            f"{prefix.lstrip('/')!r}."
        )
    return _core.Renaming(prefix, shared) if prefix else None


def shared_frames(keep: Iterable[str]) -> list[str]:
    """Return the names of the shared frames as a list. A string is split at commas.

    Raises:
        TypeError: A name is not a string.

    Example:
        >>> shared_frames("map, world"), shared_frames(["/map"])
        (['map', 'world'], ['map'])
    """
    names = keep.split(",") if isinstance(keep, str) else list(keep)
    for name in names:
        if not isinstance(name, str):
            raise TypeError(f"the names of shared frames must be strings, not {name!r}")
    return [bare for name in names if (bare := name.strip().removeprefix("/"))]


def absolute(topic: str) -> str:
    """Return the absolute name of a topic, with one leading slash, which recorders and users may omit.

    Example:
        >>> absolute("tf"), absolute("/robot1/tf")
        ('/tf', '/robot1/tf')
    """
    return f"/{topic.strip('/')}"


def is_robot_topic(topic: str, tf_topic: str, tf_static_topic: str) -> bool:
    """Return whether a topic is one of the robot's transform topics or in their namespace.

    Example:
        >>> is_robot_topic("/robot1/scan", "/robot1/tf", "/tf_static")
        True
        >>> is_robot_topic("/robot2/scan", "/robot1/tf", "/tf_static")
        False
        >>> is_robot_topic("/robot2/scan", "/tf", "/tf_static"), is_robot_topic("tf", "/tf", "/tf_static")
        (True, True)
    """
    name, moving, static = map(absolute, (topic, tf_topic, tf_static_topic))
    return name in {moving, static} or name.startswith(f"{moving.rpartition('/')[0]}/")


def prefix_advice(prefix: str) -> str:
    """Return a warning about a prefix that probably lacks its slash, or "" for other prefixes.

    Example:
        >>> prefix_advice("robot1")
        "the prefix 'robot1' turns 'base_link' into 'robot1base_link'; write 'robot1/' for 'robot1/base_link'"
        >>> prefix_advice("robot1/"), prefix_advice("r1_"), prefix_advice("")
        ('', '', '')
    """
    if not prefix[-1:].isalnum():
        return ""
    return (
        f"the prefix {prefix!r} turns 'base_link' into {prefix + 'base_link'!r}; "
        f"write {prefix + '/'!r} for {prefix + '/base_link'!r}"
    )


def naming_problems(origin: str, slashed: str, prefixed: str, plain: str) -> list[str]:
    """Return a warning for each problem with the frame names that a publisher uses.

    Args:
        origin: A description of the publisher.
        slashed: An example of a name with a leading slash, or "" if there is none.
        prefixed: An example of a name that has the prefix already, or "" if there is none.
        plain: An example of a name without the prefix, or "" if there is none.

    Example:
        >>> naming_problems("/robot1/tf", "/odom", "robot1/odom", "laser")[1].partition(":")[0]
        '/robot1/tf uses the prefix for only some of its frames'
    """
    problems = []
    if slashed:
        problems.append(
            f"{origin} publishes the frame {slashed!r}; its leading slash is removed, because frame names of tf2 have "
            "none and lookups of such names fail"
        )
    if prefixed and plain:
        problems.append(
            f"{origin} uses the prefix for only some of its frames: {prefixed!r} and {plain!r}. In tf2 these are two "
            "trees; set the prefix for all nodes of the robot, or for none"
        )
    return problems


def __dir__() -> list[str]:
    return sorted(__all__)
