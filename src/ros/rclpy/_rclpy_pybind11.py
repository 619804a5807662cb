"""Where upstream's users import the errors of its native module from."""

from rclpy.exceptions import InvalidHandle, RCLError, RCLInvalidROSArgsError, UnknownROSArgsError

__all__ = ["InvalidHandle", "RCLError", "RCLInvalidROSArgsError", "UnknownROSArgsError"]
