"""Rules for parameter names."""

from rclpy.exceptions import InvalidParameterException


def validate_parameter_name(name: str) -> bool:
    """Returns True for a valid parameter name.

    Raises:
        InvalidParameterException: It is empty.
    """
    if not name:
        raise InvalidParameterException(name)
    return True
