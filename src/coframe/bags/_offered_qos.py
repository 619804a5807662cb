# SPDX-License-Identifier: Apache-2.0
"""QoS profiles that the publishers of a topic offered, as rosbag2 stores them in YAML."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from coframe._files.bounded_yaml import read_yaml

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["OfferedQos", "from_yaml", "to_yaml"]

_MAX_LENGTH = 1 << 20
# The enum values of rmw, and the words that rosbag2 writes since metadata version 9.
_KEEP_LAST, _KEEP_ALL = 1, 2
_RELIABLE, _BEST_EFFORT = 1, 2
_TRANSIENT_LOCAL, _VOLATILE = 1, 2
_POLICY_NUMBERS = {"keep_all": _KEEP_ALL, "best_effort": _BEST_EFFORT, "transient_local": _TRANSIENT_LOCAL}
_INFINITE_DURATION = "{sec: 9223372036, nsec: 854775807}"
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
    """QoS that one publisher offered.

    Attributes:
        depth: History depth in messages.
        reliable: Whether the publisher is reliable, not best effort.
        transient_local: Whether late joiners receive the last messages.
        keep_all: Whether the history keeps all messages, regardless of its depth.
    """

    depth: int = 10
    reliable: bool = True
    transient_local: bool = False
    keep_all: bool = False


def to_yaml(profiles: Iterable[OfferedQos]) -> str:
    """Return the YAML of metadata versions 4 to 8, which later versions of rosbag2 also read."""
    return "".join(
        _PROFILE.format(
            history=_KEEP_ALL if profile.keep_all else _KEEP_LAST,
            depth=profile.depth,
            reliability=_RELIABLE if profile.reliable else _BEST_EFFORT,
            durability=_TRANSIENT_LOCAL if profile.transient_local else _VOLATILE,
            forever=_INFINITE_DURATION,
        )
        for profile in profiles
    )


def from_yaml(text: str) -> tuple[OfferedQos, ...]:
    """Return the profiles in YAML of any metadata version; empty if it cannot be read."""
    if not text:
        return ()
    try:
        return tuple(_profile(profile) for profile in read_yaml(text, _MAX_LENGTH))
    except Exception:  # noqa: BLE001 - without PyYAML or with damaged YAML, the offer is unknown
        return ()


def _profile(profile: Any) -> OfferedQos:
    history, reliability, durability = (
        _POLICY_NUMBERS.get(value, value)
        for value in (profile[name] for name in ("history", "reliability", "durability"))
    )
    return OfferedQos(
        depth=min(max(int(profile["depth"]), 1), 10_000),
        reliable=reliability != _BEST_EFFORT,
        transient_local=durability == _TRANSIENT_LOCAL,
        keep_all=history == _KEEP_ALL,
    )
