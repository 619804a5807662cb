"""Quality of service as rosbag2 writes it down: what the publishers of a topic offered."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["OfferedQos", "from_yaml", "to_yaml"]

_LONGEST = 1 << 20
# rmw's numbers, and the words that rosbag2 writes from version 9 of its metadata on.
_KEEP_LAST, _KEEP_ALL = 1, 2
_RELIABLE, _BEST_EFFORT = 1, 2
_TRANSIENT_LOCAL, _VOLATILE = 1, 2
_NUMBERS = {"keep_all": _KEEP_ALL, "best_effort": _BEST_EFFORT, "transient_local": _TRANSIENT_LOCAL}
_FOREVER = "{sec: 9223372036, nsec: 854775807}"
_PROFILE = """\
- history: {history}
  depth: {depth}
  reliability: {reliability}
  durability: {durability}
  deadline: {forever}
  lifespan: {forever}
  liveliness: 1
  liveliness_lease_duration: {forever}
  avoid_ros_namespace_conventions: false
"""


class OfferedQos(NamedTuple):
    """What one publisher offered.

    Attributes:
        depth: How many messages it kept.
        reliable: Lost messages were sent again.
        transient_local: Late joiners got the last messages.
        keep_all: It kept every message.
    """

    depth: int = 10
    reliable: bool = True
    transient_local: bool = False
    keep_all: bool = False


def to_yaml(profiles: Iterable[OfferedQos]) -> str:
    """As the versions 4 to 8 of rosbag2's metadata have it, which later versions read, too."""
    return "".join(
        _PROFILE.format(
            history=_KEEP_ALL if profile.keep_all else _KEEP_LAST,
            depth=profile.depth,
            reliability=_RELIABLE if profile.reliable else _BEST_EFFORT,
            durability=_TRANSIENT_LOCAL if profile.transient_local else _VOLATILE,
            forever=_FOREVER,
        )
        for profile in profiles
    )


def from_yaml(text: str) -> tuple[OfferedQos, ...]:
    """Of any version; nothing where it cannot be read."""
    if not text or len(text) > _LONGEST:
        return ()
    try:
        yaml: Any = importlib.import_module("yaml")
        profiles = yaml.load(text, Loader=getattr(yaml, "CSafeLoader", yaml.SafeLoader))
        return tuple(_profile(profile) for profile in profiles)
    except Exception:  # noqa: BLE001 - no PyYAML, no YAML, or not what it should be: it is as if nothing had been offered
        return ()


def _profile(profile: Any) -> OfferedQos:
    history, reliability, durability = (
        _NUMBERS.get(value, value) for value in (profile[name] for name in ("history", "reliability", "durability"))
    )
    return OfferedQos(
        depth=min(max(int(profile["depth"]), 1), 10_000),
        reliable=reliability != _BEST_EFFORT,
        transient_local=durability == _TRANSIENT_LOCAL,
        keep_all=history == _KEEP_ALL,
    )
