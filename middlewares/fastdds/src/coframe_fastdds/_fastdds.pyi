# SPDX-License-Identifier: Apache-2.0
"""The native part: participants, writers and readers of Fast DDS. Operations raise `coframe._core.EndpointError`."""

from collections.abc import Callable, Sequence
from typing import Any, TypeAlias

from coframe import _core

Qos: TypeAlias = tuple[Any, ...]  # see coframe_fastdds._session.native_qos

VERSION: str
SHARES_MEMORY: bool
HAS_SECURITY: bool

def library() -> str:
    """Return the path of the library that is loaded."""

def handle_of(guid: bytes) -> int:
    """Return the handle of an endpoint in this process."""

class Participant:
    """A participant of a DDS domain."""

    def __init__(
        self,
        *,
        domain: int,
        name: str,
        user_data: str,
        discovery_range: str,
        peers: Sequence[str],
        profiles: str,
        qos_from_profiles: bool,
        asynchronous: bool,
        properties: Sequence[tuple[str, str]],
        changed: _core.Event,
    ) -> None: ...
    @property
    def guid(self) -> bytes: ...
    def take_writers(self) -> list[tuple[Any, ...]]:
        """Return the changes of writers; see `_core.EndpointReader.take`."""

    def take_readers(self) -> list[tuple[Any, ...]]:
        """Return the changes of readers."""

    def take_participants(self) -> list[tuple[Any, ...]]:
        """Return the changes of participants."""

    def take_ignored(self) -> list[tuple[str, int]]:
        """Return the topics with received messages that could not be passed on, and how many since the last call."""

    def close(self) -> None: ...

class _Endpoint:
    @property
    def guid(self) -> bytes: ...
    @property
    def matched(self) -> int: ...
    def matched_handles(self) -> list[int]: ...
    @property
    def refused_policy(self) -> int: ...
    def take_status(self, kind: int) -> tuple[int, int, int, int] | None: ...
    def close(self) -> None: ...

class Writer(_Endpoint):
    """A publisher of serialized messages."""

    def __init__(
        self,
        participant: Participant,
        topic: str,
        type_name: str,
        qos: Qos,
        user_data: str,
        checked: bool = False,
        on_change: _core.Event | None = None,
    ) -> None: ...
    def write(self, message: bytes) -> None: ...
    def forward(self, message: bytes) -> None: ...
    def write_related(self, message: bytes, guid: bytes, sequence: int) -> int:
        """Send a message with a related sample identity; return its sequence number."""

    def write_nothing(self) -> None:
        """Send a message without a payload, which Cyclone DDS acknowledges and delivers to no reader."""

    def publish(self, codec: _core.MessageCodec, message: object) -> bool: ...
    def direct(
        self,
        codec: _core.MessageCodec,
        closed: _core.Event,
        failure: Callable[[str], BaseException],
        of_items: bool,
    ) -> Callable[[object], bool] | None: ...
    def assert_liveliness(self) -> None: ...
    def wait_for_acks(self, timeout_ns: int) -> bool: ...

class Reader(_Endpoint):
    """A subscription that queues messages."""

    def __init__(
        self,
        participant: Participant,
        topic: str,
        type_name: str,
        qos: Qos,
        user_data: str,
        on_data: _core.Event | None,
    ) -> None: ...
    def take(self, limit: int) -> list[tuple[bytes, int, int]]: ...
    def take_decoded(self, limit: int, codec: _core.MessageCodec) -> list[tuple[Any, int, int]]: ...
    def take_identified(self, limit: int) -> list[tuple[bytes, int, int, bytes, int, bytes, int]]:
        """Return messages with the identities of requests and replies.

        Returns:
            For each message its bytes, the time of publication in ns since 1970, and the writer's handle; the writer's
            GUID and the sequence number; the related GUID and sequence number.
        """

    @property
    def pending(self) -> bool: ...

class Tap(_Endpoint):
    """A subscription that records messages with their arrival times."""

    def __init__(
        self,
        participant: Participant,
        topic: str,
        type_name: str,
        qos: Qos,
        user_data: str,
        head: int,
        messages: int,
        size: int,
    ) -> None: ...
    def take(self) -> tuple[bytes, bytes, bytes, bytes, bytes]: ...
    @property
    def missed(self) -> int: ...

class TfReader(_Endpoint):
    """A subscription that stores transforms on the threads of Fast DDS."""

    def __init__(
        self,
        participant: Participant,
        topic: str,
        type_name: str,
        qos: Qos,
        user_data: str,
        store: _core.TransformStore,
        on_change: _core.Event | None,
    ) -> None: ...
