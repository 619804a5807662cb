"""The native half of the wire, typed by the stub beside this file."""

from coframe._core import Event
from coframe._core.wire import (
    PUBLICATIONS,
    SUBSCRIPTIONS,
    DdsError,
    DomainParticipant,
    EndpointReader,
    QosProfile,
    Reader,
    TfReader,
    Writer,
    load,
)

__all__ = [
    "PUBLICATIONS",
    "SUBSCRIPTIONS",
    "DdsError",
    "DomainParticipant",
    "EndpointReader",
    "Event",
    "QosProfile",
    "Reader",
    "TfReader",
    "Writer",
    "load",
]
