# SPDX-License-Identifier: Apache-2.0
"""Expansion of topic and service names to fully qualified names."""

from __future__ import annotations

import re
from functools import partial

from rclpy import _absent
from rclpy.exceptions import NameValidationException
from rclpy.validate_namespace import validate_namespace
from rclpy.validate_node_name import validate_node_name
from rclpy.validate_topic_name import validate_topic_name


def expand_topic_name(topic_name: str, node_name: str, node_namespace: str) -> str:
    """Expand `~`, relative names and the substitutions `{node}`, `{ns}` and `{namespace}`.

    Args:
        topic_name: The name, for example `~/state`.
        node_name: Name of the node, for example `arm`.
        node_namespace: Namespace of the node, for example `/robot1`.

    Returns:
        The fully qualified name, for example `/robot1/arm/state`.

    Raises:
        ValueError: One of the names is not valid, or contains an unknown substitution.
    """
    try:
        validate_topic_name(topic_name)
        validate_node_name(node_name)
        validate_namespace(node_namespace)
    except NameValidationException as error:
        what = "node namespace" if error.name_type == "namespace" else error.name_type
        raise ValueError(f"{what} '{error.name}' is invalid: {error.error_msg}") from None
    prefix = node_namespace.rstrip("/")
    name = topic_name
    if name.startswith("~"):
        name = f"{prefix}/{node_name}{name[1:]}"
    for key, value in (("node", node_name), ("ns", prefix), ("namespace", prefix)):
        name = name.replace("{" + key + "}", value)
    if unknown := re.search(r"{\w*}", name):
        raise ValueError(f"topic name '{topic_name}' is invalid: unknown substitution: {unknown[0]}")
    return name if name.startswith("/") else f"{prefix}/{name}"


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
