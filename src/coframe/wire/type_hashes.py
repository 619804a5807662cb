# SPDX-License-Identifier: Apache-2.0
"""The type hashes of endpoints, by type name."""

from __future__ import annotations

from coframe.type_names import TF_MESSAGE

# Constants, because computing a hash imports message classes, which pure transform listeners do not need.
TF_MESSAGE_HASH = "RIHS01_e369d0f05a23ae52508854b66f6aa0437f3449d652e8cbf22d5abe85d020f087"
_CONSTANTS = {
    TF_MESSAGE: TF_MESSAGE_HASH,
    # Of Iron and later. The definition of Humble, which coframe has, differs in the size of an identifier.
    "rmw_dds_common/msg/ParticipantEntitiesInfo": (
        "RIHS01_91a0593bacdcc50ea9bdcf849a938b128412cc1ea821245c663bcd26f83c295e"
    ),
}


def type_hash_of_name(ros_type: str) -> str:
    """Return the hash of a type, or "" if its definition is unknown in this process."""
    if (known := _CONSTANTS.get(ros_type)) is not None:
        return known
    from coframe.messages.registry import find  # noqa: PLC0415 - importing coframe.wire must be cheap
    from coframe.messages.type_hash import type_hash  # noqa: PLC0415

    try:
        return type_hash(find(ros_type))
    except LookupError:
        return ""
