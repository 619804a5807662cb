# SPDX-License-Identifier: Apache-2.0
"""DDS topics."""

from __future__ import annotations

from coframe import _core
from coframe.errors import WireError
from coframe.wire.names import check_name


def create_topic(participant: int, name: str, type_name: str) -> int:
    """Create a DDS topic and return its handle.

    As in ROS, only the type name is declared: endpoints match by name, and the receiver of a message validates the
    bytes. Declaring the fields would take several milliseconds for each type.

    Args:
        participant: The handle of the participant.
        name: The DDS name of the topic.
        type_name: The DDS name of the type.

    Raises:
        WireError: DDS cannot create the topic, or a name is longer than 256 bytes or not valid UTF-8.
    """
    for text in (name, type_name):
        check_name(text)
    try:
        return _core.create_unchecked_topic(participant, name, type_name)
    except _core.EndpointError as error:
        raise WireError(
            f"DDS cannot create the topic {name} ({error}).", hint="Check the name of the topic."
        ) from error
