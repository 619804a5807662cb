# SPDX-License-Identifier: Apache-2.0
"""Message publishers for Zenoh."""

from __future__ import annotations

import threading
from typing import TYPE_CHECKING, Any

from coframe import _core
from coframe.wire.zenoh import _library, config
from coframe.wire.zenoh._endpoint import Sequence, ZenohEndpoint

if TYPE_CHECKING:
    from collections.abc import Callable

    import zenoh
    from coframe.wire.qos import QoS
    from coframe.wire.zenoh._endpoint import Place

ENCAPSULATION_SIZE = 4
TOO_SHORT_ERROR = "The message is too short: a serialized message begins with 4 bytes of encapsulation."


class BytesWriter(ZenohEndpoint):
    """A publisher that sends serialized messages only: Python owns the bytes that Zenoh sends."""

    is_writer = True

    def publish(self, codec: _core.MessageCodec, message: object) -> bool:
        """Return False: the message must be serialized first."""
        del codec, message
        return False

    def direct(
        self,
        codec: _core.MessageCodec,
        closed: _core.Event,
        failure: Callable[[str], BaseException],
        of_items: bool,
    ) -> None:
        """Return None: there is no native function that publishes."""
        del codec, closed, failure, of_items


class ZenohWriter(BytesWriter):
    """A publisher on a topic. Implements `coframe.wire._backend.BackendWriter`."""

    def __init__(self, place: Place, qos: QoS, *, checked: bool, on_change: _core.Event | None) -> None:
        super().__init__(place.graph, place.endpoint, place.type_hash, place.guid, on_change)
        self._error = _library.load().ZError
        self._checked = checked
        self._sequence = Sequence(place.guid)
        self._lock = threading.Lock()  # so that sequence numbers are sent in order
        self._publisher = _declare(place.session, place.key_list[0], qos)

    def write(self, message: bytes) -> None:
        """Send a message."""
        if self._checked and not _core.is_tf_message(message):
            raise _core.EndpointError("could not write: the message is not valid")
        self.forward(message)

    def forward(self, message: bytes) -> None:
        """Send a message without checking its bytes."""
        if len(message) < ENCAPSULATION_SIZE:
            raise ValueError(TOO_SHORT_ERROR)
        self._check_open()
        with self._lock:
            try:
                self._publisher.put(message, attachment=self._sequence.next())
            except self._error as error:
                raise _core.EndpointError(f"could not write: {config.reason_of(error)}") from error

    def assert_liveliness(self) -> None:
        """Do nothing: a publisher is alive as long as its session."""

    def wait_for_acks(self, timeout_ns: int) -> bool:
        """Return True, because Zenoh has no message acknowledgements to wait for."""
        del timeout_ns
        return True

    def _undeclare(self) -> None:
        with self._lock:  # waits for a message in progress
            self._publisher.undeclare()


def _declare(session: zenoh.Session, key: str, qos: QoS) -> Any:
    module = _library.load()
    blocks = qos.reliable and qos.keep_all
    options: dict[str, Any] = {
        "congestion_control": module.CongestionControl.BLOCK if blocks else module.CongestionControl.DROP,
        "reliability": module.Reliability.RELIABLE if qos.reliable else module.Reliability.BEST_EFFORT,
    }
    if not qos.transient_local:
        return session.declare_publisher(key, **options)
    ext = module.ext
    detection = ext.MissDetectionConfig(heartbeat=None, sporadic_heartbeat=0.5) if qos.reliable else None
    return ext.declare_advanced_publisher(
        session,
        key,
        cache=ext.CacheConfig(max_samples=qos.depth),
        publisher_detection=True,
        sample_miss_detection=detection,
        **options,
    )
