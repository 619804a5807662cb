# SPDX-License-Identifier: Apache-2.0
"""DDS topics."""

from __future__ import annotations

from coframe import _core
from coframe.errors import WireError
from coframe.escaping import shown
from coframe.wire.names import MAX_NAME


def create_topic(participant: int, name: str, type_name: str) -> int:
    """Create a DDS topic and return its handle.

    Only the name of the type is declared, as ROS does: the endpoints match by it, and the receiver of a message
    validates the bytes. Declaring the fields as well would take several milliseconds for each type.

    Args:
        participant: The handle of the participant.
        name: The DDS name of the topic.
        type_name: The DDS name of the type.

    Raises:
        WireError: DDS cannot create the topic, or a name is longer than 256 bytes or not valid UTF-8.
    """
    for text in (name, type_name):
        # Cyclone DDS crashes when it announces a name of 64 KiB; the DDS standard allows 256 bytes.
        if (size := len(text.encode(errors="surrogatepass"))) > MAX_NAME:
            raise WireError(
                f"The name {shown(text)!r} has {size} bytes. The limit is {MAX_NAME} bytes.",
                hint="Choose a shorter name.",
            )
    try:
        return _core.create_unchecked_topic(participant, name, type_name)
    except _core.EndpointError as error:
        raise WireError(
            f"DDS cannot create the topic {name} ({error}).", hint="Check the name of the topic."
        ) from error
    except TypeError:  # lone surrogates, which the arguments of programs contain for bytes that are not UTF-8
        raise WireError(f"The name {shown(name)!r} is not valid UTF-8.", hint="Choose another name.") from None
