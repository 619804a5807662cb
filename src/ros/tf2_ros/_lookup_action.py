"""What the clients and the servers of a buffer agree on: the action's quality of service and its error codes."""

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

# Everybody's answers come by every client, and questions may come by the hundred: more room than services have.
QOS: Final = QoSProfile(depth=1000)

# Their parent comes last.
EXCEPTIONS: Final[dict[int, type[TransformException]]] = {
    TF2Error.LOOKUP_ERROR: LookupException,
    TF2Error.CONNECTIVITY_ERROR: ConnectivityException,
    TF2Error.EXTRAPOLATION_ERROR: ExtrapolationException,
    TF2Error.INVALID_ARGUMENT_ERROR: InvalidArgumentException,
    TF2Error.TIMEOUT_ERROR: TimeoutException,
    TF2Error.TRANSFORM_ERROR: TransformException,
}


def error_message(error: TransformException) -> TF2Error:
    """Put what a look-up raised into a message."""
    code = next(code for code, kind in EXCEPTIONS.items() if isinstance(error, kind))
    return TF2Error(error=code, error_string=str(error))


def raise_error(error: TF2Error) -> None:
    """Raise what a message tells of; nothing if it tells of no error."""
    if error.error != TF2Error.NO_ERROR:
        raise EXCEPTIONS.get(error.error, TransformException)(error.error_string)
