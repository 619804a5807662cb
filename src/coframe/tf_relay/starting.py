# SPDX-License-Identifier: Apache-2.0
"""The function `relay`, which starts a relay."""

from __future__ import annotations

from typing import TYPE_CHECKING

from coframe.tf_relay._forwarding import Relay
from coframe.tf_relay._max_error import MaxError
from coframe.tf_relay._robots import absolute_topic, choose_robots
from coframe.time import SECOND

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

__all__ = ["relay"]

_THINNED_RATE = 10.0  # Hz; the default with a maximum error


def relay(
    robots: Iterable[str] | str = (),
    *,
    sources: Iterable[str] | Mapping[str, str] = (),
    common: str = "/tf",
    common_static: str | None = None,
    prefix: str = "",
    prefix_each: bool = False,
    keep: Iterable[str] = (),
    rate: float | None = None,
    max_error: str | tuple[float, float] | None = None,
    split: bool = False,
    domain: int | None = None,
    wire: str | None = None,
    node_name: str = "coframe_relay",
    warn: Callable[[str], None] | None = None,
) -> Relay:
    """Merge the transforms of several robots, each on its own topics, into one topic, or split one topic by robot.

    The static transforms of a topic are read from and written to the topic with the suffix ``_static``. Every static
    message contains all static transforms received so far, so that late-joining subscribers receive all of them.
    Transforms that were published by a relay are never relayed again. If several robots publish the same child frame,
    the first one is used until it becomes stale.

    Args:
        robots: The names of the robots: ``robot1`` stands for the topic ``/robot1/tf``. A string can contain several
            names, separated by commas.
        sources: The topics of additional robots, such as ``/robot1/tf``, or a mapping from topics to the prefixes of
            their frames. A prefix is used as given, including its slash.
        common: The topic of all robots. The relay writes to it, or reads from it if `split` is set.
        common_static: The topic of the static transforms of all robots. If None, it is `common` with the suffix
            ``_static``.
        prefix: A prefix for all frames on the common topic, in front of each robot's own prefix.
        prefix_each: Whether to add each robot's name and a slash to its frames: ``robot1/``.
        keep: The frames that are shared by the robots and get no prefix, such as ``["map", "world"]``.
        rate: The maximum rate of each edge in Hz. If None, every transform is forwarded. Static transforms are always
            forwarded. With `max_error`, see below.
        max_error: Forward a transform only if interpolation between the forwarded ones would be wrong by more than
            this on its edge: a distance and an angle, such as ``"1mm,0.1deg"``, or in meters and radians. While a
            robot moves, all of its edges are forwarded at least at `rate` (10 Hz if None), else at least every 0.5 s.
            The values of forwarded transforms are not changed. Errors of the edges of a chain add up.
        split: Whether to read the common topic and write to the robots' topics. Each robot receives the frames that
            begin with its prefix, without the prefix, and the shared frames.
        domain: The ROS domain, 0 to 232. If None, it is ROS_DOMAIN_ID, or 0 if that is not set.
        wire: The middleware, "dds" or "zenoh"; see :func:`coframe.connect`.
        node_name: The name of the relay's node.
        warn: Called with each warning, on the thread of the relay: clocks that differ, robots that are
            gone, frames that two robots publish, invalid frame names. If None, warnings go to the logger
            "coframe.wire".

    Raises:
        ValueError: There is no robot, a prefix is invalid, a topic is both an input and an output, the rate is not
            positive, or the maximum error is invalid.
        WireError: The graph cannot be joined, see :func:`coframe.connect`.

    Example:
        >>> with relay("robot1,robot2", prefix_each=True, keep=["map"]) as running:    # doctest: +SKIP
        ...     [(edge.child, edge.robot, edge.node) for edge in running.edges()]
    """
    if rate is not None and not 0 < rate < SECOND:
        raise ValueError(f"the rate must be above 0 Hz, not {rate!r}")
    if max_error is not None:
        max_error = MaxError.of(max_error)
        rate = rate or _THINNED_RATE
    common = absolute_topic(common)
    topics = common, absolute_topic(common_static or f"{common}_static")
    members = choose_robots(robots, sources, common=topics, prefix=prefix, prefix_each=prefix_each or split, keep=keep)
    return Relay(
        members,
        common=topics,
        keep=keep,
        rate=rate,
        max_error=max_error,
        split=split,
        domain=domain,
        wire=wire,
        node_name=node_name,
        warn=warn,
    )
