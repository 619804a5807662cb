# SPDX-License-Identifier: Apache-2.0
"""Validation of namespaces."""

import re
from functools import partial

from rclpy import _absent
from rclpy.exceptions import InvalidNamespaceException


def validate_namespace(namespace: str) -> bool:
    """Return True if `namespace` is valid and fully qualified; otherwise raise an error.

    Raises:
        InvalidNamespaceException: The namespace is not valid.
    """
    if not namespace:
        raise InvalidNamespaceException(namespace, "namespace must not be empty", 0)
    if not namespace.startswith("/"):
        raise InvalidNamespaceException(namespace, "namespace must be absolute, it must lead with a '/'", 0)
    if namespace != "/" and namespace.endswith("/"):
        text = "namespace must not end with a '/', unless only a '/'"
        raise InvalidNamespaceException(namespace, text, len(namespace) - 1)
    if bad := re.search(r"[^A-Za-z0-9_/]", namespace):
        text = "namespace must not contain characters other than alphanumerics, '_', or '/'"
        raise InvalidNamespaceException(namespace, text, bad.start())
    if bad := re.search(r"/(?=/)", namespace):
        raise InvalidNamespaceException(namespace, "namespace must not contain repeated '/'", bad.start() + 1)
    if bad := re.search(r"/(?=\d)", namespace):
        text = "namespace must not have a token that starts with a number"
        raise InvalidNamespaceException(namespace, text, bad.start() + 1)
    return True


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
