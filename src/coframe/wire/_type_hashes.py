# SPDX-License-Identifier: Apache-2.0
"""The type hashes of endpoints, by type name."""

from __future__ import annotations

from coframe.type_names import TF_MESSAGE

# Imported on demand, because computing a hash imports message classes, which pure transform listeners do not need.
TF_MESSAGE_HASH = "RIHS01_e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087"


def type_hash_of_name(ros_type: str) -> str:
    """Return the hash of a type; "" if its definition is unknown in this process."""
    if ros_type == TF_MESSAGE:
        return TF_MESSAGE_HASH
    from coframe.messages.registry import find  # noqa: PLC0415 - importing coframe.wire must be cheap
    from coframe.messages.type_hash import type_hash  # noqa: PLC0415

    try:
        return type_hash(find(ros_type))
    except LookupError:
        return ""
