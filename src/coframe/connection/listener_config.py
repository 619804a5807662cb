# SPDX-License-Identifier: Apache-2.0
"""The configuration of a listener (topics, frame names, cache, domain and middleware) as one checked value."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Final, TypeVar

from coframe import frame_names
from coframe.buffer.buffer import Buffer, cache_length
from coframe.connection._connection_buffer import ConnectionBuffer
from coframe.frame_names import TF_STATIC_TOPIC, TF_TOPIC
from coframe.time import SECOND
from coframe.transform.interpolation import is_screw
from coframe.wire import domains, selection

if TYPE_CHECKING:
    from collections.abc import Iterable

    from typing_extensions import Self

    from coframe import _core
    from coframe.time import DurationLike
    from coframe.transform.interpolation import Interpolation

__all__ = ["ListenerConfig"]

_B = TypeVar("_B", bound=Buffer)

_TEN_SECONDS: Final = 10 * SECOND  # as tf2's buffer


@dataclass(frozen=True)
class ListenerConfig:
    """The configuration of a listener and its buffer. Created by `of`, which checks the values.

    Processes share the transforms of listeners with equal configurations, because these receive the same data.

    Attributes:
        tf_topic: The topic of dynamic transforms.
        tf_static_topic: The topic of static transforms.
        prefix: The prefix of the frames in the buffer, used as given, or "" for none.
        keep: The frames without a prefix, sorted.
        cache: The length of the buffer's cache in nanoseconds; negative to keep everything.
        domain: The ROS domain, 0 to 232.
        wire: The middleware, "dds" or "zenoh".
        interpolation: How the buffer computes poses between two samples; it does not change what is received.
    """

    tf_topic: str = TF_TOPIC
    tf_static_topic: str = TF_STATIC_TOPIC
    prefix: str = ""
    keep: tuple[str, ...] = ()
    cache: int = _TEN_SECONDS
    domain: int = 0
    wire: str = selection.DEFAULT.wire
    interpolation: Interpolation = field(default="decoupled", compare=False)

    @classmethod
    def of(
        cls,
        *,
        namespace: str | None = None,
        tf_topic: str | None = None,
        tf_static_topic: str | None = None,
        prefix: str = "",
        keep: Iterable[str] = (),
        cache: DurationLike | None = _TEN_SECONDS,
        domain: int | None = None,
        wire: str | None = None,
        interpolation: Interpolation = "decoupled",
    ) -> Self:
        """Check the arguments of a caller, and replace None with the defaults.

        Args:
            namespace: The namespace of the topics: "/robot1" for /robot1/tf and /robot1/tf_static.
            tf_topic: The topic of dynamic transforms. If None, it is /tf in the namespace.
            tf_static_topic: The topic of static transforms. If None, it is /tf_static in the namespace.
            prefix: The prefix of the frames in the buffer.
            keep: The frames without a prefix.
            cache: The length of the cache: a string such as "10s", nanoseconds or a timedelta. If None, all transforms
            are kept.
            domain: The ROS domain. If None, it is ROS_DOMAIN_ID, or 0 if that is not set.
            wire: The middleware. If None, the selected one; see `coframe.wire.selection`.
            interpolation: ``"decoupled"``, as in tf2, or ``"screw"``; see :class:`coframe.Buffer`.

        Raises:
            ValueError: The prefix begins with a slash, the cache is negative, or the interpolation is unknown.
            TypeError: The cache is not a duration, or a name is not a string.
            WireError: The domain or the middleware does not exist.
        """
        frame_names.renaming(prefix, keep)  # checks both
        is_screw(interpolation)  # checks the name
        root = f"/{namespace.strip('/')}".rstrip("/") if namespace else ""
        return cls(
            tf_topic=tf_topic or root + TF_TOPIC,
            tf_static_topic=tf_static_topic or root + TF_STATIC_TOPIC,
            prefix=prefix,
            keep=tuple(sorted(frame_names.shared_frames(keep))),
            cache=cache_length(cache),
            domain=domains.domain_id() if domain is None else domains.check_domain_id(domain),
            wire=selection.resolve(wire),
            interpolation=interpolation,
        )

    @property
    def topics(self) -> tuple[str, str]:
        """The topics of dynamic and of static transforms."""
        return self.tf_topic, self.tf_static_topic

    def new_buffer(self) -> Buffer:
        """Return an empty buffer with this cache."""
        return self._buffer(Buffer)

    def new_connection_buffer(self) -> ConnectionBuffer:
        """Return an empty buffer with this cache for a connection of the user's program."""
        return self._buffer(ConnectionBuffer)

    def _buffer(self, kind: type[_B]) -> _B:
        cache = None if self.cache < 0 else f"{self.cache}ns"
        return kind(cache, interpolation=self.interpolation)

    @cached_property
    def renaming(self) -> _core.Renaming | None:
        """The renaming of frames, or None if they keep their names."""
        return frame_names.renaming(self.prefix, self.keep)

    def frame(self, name: str) -> str:
        """Return the buffer's name for a frame in a message."""
        return name.removeprefix("/") if self.renaming is None else self.renaming(name)

    def with_cache(self, cache: int) -> Self:
        """Return this configuration with another cache length, in nanoseconds."""
        return replace(self, cache=cache)
