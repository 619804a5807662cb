# SPDX-License-Identifier: Apache-2.0
"""Definitions shared by buffer clients and servers: the QoS profile and the error codes of the action."""

from typing import Final

from rclpy.qos import QoSProfile
from tf2_msgs.msg import TF2Error
from tf2_py import (
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TimeoutException,
    TransformException,
)

# Each client receives the replies to all clients, and there may be hundreds of requests, so the depth is larger than
# that of services.
QOS: Final = QoSProfile(depth=1000)

# The base class comes last, because the first match is used.
EXCEPTIONS: Final[dict[int, type[TransformException]]] = {
    TF2Error.LOOKUP_ERROR: LookupException,
    TF2Error.CONNECTIVITY_ERROR: ConnectivityException,
    TF2Error.EXTRAPOLATION_ERROR: ExtrapolationException,
    TF2Error.INVALID_ARGUMENT_ERROR: InvalidArgumentException,
    TF2Error.TIMEOUT_ERROR: TimeoutException,
    TF2Error.TRANSFORM_ERROR: TransformException,
}


def error_message(error: TransformException) -> TF2Error:
    """Return the message that describes the exception of a lookup."""
    code = next(code for code, kind in EXCEPTIONS.items() if isinstance(error, kind))
    return TF2Error(error=code, error_string=str(error))


def raise_error(error: TF2Error) -> None:
    """Raise the exception that a message describes, if it describes an error."""
    if error.error != TF2Error.NO_ERROR:
        raise EXCEPTIONS.get(error.error, TransformException)(error.error_string)
