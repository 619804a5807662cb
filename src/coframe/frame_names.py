"""The frames of one robot among those of others: a prefix in front of every name but the shared ones.

The prefix is put there as it is, as robot_state_publisher's ``frame_prefix``: nobody invents a slash.

============  ===============  ======================  ==========================================
prefix        name             becomes                 because
============  ===============  ======================  ==========================================
``robot1/``   ``base_link``    ``robot1/base_link``
``robot1``    ``base_link``    ``robot1base_link``     the prefix has no slash of its own
``robot1/``   ``/base_link``   ``robot1/base_link``    tf2 takes a leading slash off
``robot1/``   ``map``          ``map``                 where it is kept: ``keep=["map"]``
``robot1/``   ``robot1/odom``  ``robot1/odom``         it begins with ``robot1/`` already
============  ===============  ======================  ==========================================
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe import _core

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["absolute", "belongs", "kept", "oddities", "prefix_advice", "renaming"]


def renaming(prefix: str = "", keep: Iterable[str] = ()) -> _core.Renaming | None:
    """What gives frames their names among those of others; None where all keep theirs.

    Args:
        prefix: In front of each name, with its own slash: ``robot1/``.
        keep: The frames that are shared, such as ``map`` and ``world``; a text is one name, or several behind commas.

    Raises:
        ValueError: The prefix begins with a slash.
        TypeError: Something is no text.

    Example:
        >>> names = renaming("robot1/", keep=["map"])
        >>> names("base_link"), names("/base_link"), names("map"), names("robot1/odom")
        ('robot1/base_link', 'robot1/base_link', 'map', 'robot1/odom')
        >>> renaming("robot1")("base_link")
        'robot1base_link'
    """
    shared = kept(keep)
    if prefix.startswith("/"):
        raise ValueError(f"the prefix {prefix!r} begins with a slash, as no frame of tf2 does: {prefix.lstrip('/')!r}")
    return _core.Renaming(prefix, shared) if prefix else None


def kept(keep: Iterable[str]) -> list[str]:
    """The shared frames, from their names or from one text with commas between them.

    Example:
        >>> kept("map, world"), kept(["/map"])
        (['map', 'world'], ['map'])
    """
    names = keep.split(",") if isinstance(keep, str) else keep
    return [bare for name in names if (bare := name.strip().removeprefix("/"))]


def absolute(topic: str) -> str:
    """A topic's name as the graph has it, with one slash in front: recorders and users may leave it out.

    Example:
        >>> absolute("tf"), absolute("/robot1/tf")
        ('/tf', '/robot1/tf')
    """
    return f"/{topic.strip('/')}"


def belongs(topic: str, tf_topic: str, tf_static_topic: str) -> bool:
    """Whether a topic is of the robot whose transforms are on these two: one of them, or in the first one's namespace.

    Example:
        >>> belongs("/robot1/scan", "/robot1/tf", "/tf_static"), belongs("/robot2/scan", "/robot1/tf", "/tf_static")
        (True, False)
        >>> belongs("/robot2/scan", "/tf", "/tf_static"), belongs("tf", "/tf", "/tf_static")
        (True, True)
    """
    name, moving, static = map(absolute, (topic, tf_topic, tf_static_topic))
    return name in {moving, static} or name.startswith(f"{moving.rpartition('/')[0]}/")


def prefix_advice(prefix: str) -> str:
    """A sentence for who may have forgotten the prefix's slash; "" where it ends as prefixes do.

    Example:
        >>> prefix_advice("robot1")
        "the prefix 'robot1' makes 'robot1base_link' of 'base_link': write 'robot1/' for 'robot1/base_link'"
        >>> prefix_advice("robot1/"), prefix_advice("r1_"), prefix_advice("")
        ('', '', '')
    """
    if not prefix[-1:].isalnum():
        return ""
    return (
        f"the prefix {prefix!r} makes {prefix + 'base_link'!r} of 'base_link': "
        f"write {prefix + '/'!r} for {prefix + '/base_link'!r}"
    )


def oddities(origin: str, slashed: str, prefixed: str, plain: str) -> list[str]:
    """What is odd about the names that come from `origin`, a sentence each, from examples ("": there is none).

    Example:
        >>> oddities("/robot1/tf", "/odom", "robot1/odom", "laser")[1].partition(":")[0]
        '/robot1/tf has half a prefix'
    """
    told = []
    if slashed:
        told.append(
            f"{origin} tells of {slashed!r}, with a slash in front, which is left off: tf2's frames have none, "
            "and look-ups of such names fail"
        )
    if prefixed and plain:
        told.append(
            f"{origin} has half a prefix: {prefixed!r} beside {plain!r}. Elsewhere these are two trees; "
            "give all of its nodes the prefix, or none"
        )
    return told
