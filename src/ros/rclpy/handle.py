"""Where upstream's users import InvalidHandle from."""

from rclpy.exceptions import InvalidHandle

__all__ = ["InvalidHandle"]
