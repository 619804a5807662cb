# SPDX-License-Identifier: Apache-2.0
"""Message classes by the type of a field."""

import importlib
from typing import Any

__all__ = ["import_message_from_namespaced_type"]


def import_message_from_namespaced_type(message_type: Any) -> Any:
    """Return the class of a message.

    Args:
        message_type: A `NamespacedType`, as in SLOT_TYPES of messages.
    """
    module = importlib.import_module(".".join(message_type.namespaces))
    return getattr(module, message_type.name)
