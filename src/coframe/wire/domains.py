# SPDX-License-Identifier: Apache-2.0
"""ROS domain IDs."""

from __future__ import annotations

import os
import re
from typing import TYPE_CHECKING, Final

from coframe.errors import WireError

if TYPE_CHECKING:
    from collections.abc import Mapping

MAX_DOMAIN_ID: Final = 232


def domain_id(environment: Mapping[str, str] = os.environ) -> int:
    """Return the domain ID: ROS_DOMAIN_ID, or 0 if it is not set.

    Raises:
        WireError: ROS_DOMAIN_ID is not a valid domain ID.
    """
    text = environment.get("ROS_DOMAIN_ID", "").strip()
    return check_domain_id(text or "0", "ROS_DOMAIN_ID is")


def check_domain_id(value: str | int, what: str = "domain") -> int:
    """Return `value` as a domain ID.

    Args:
        value: The domain ID, as a number or a string.
        what: The name of the value in the error message.

    Raises:
        WireError: It is not an integer from 0 to 232.
    """
    text = str(value)
    if not re.fullmatch(r"[0-9]{1,3}", text) or int(text) > MAX_DOMAIN_ID:
        raise WireError(
            f"{what} {text!r}: a domain ID is an integer from 0 to {MAX_DOMAIN_ID}.",
            hint="Nodes communicate only within one domain. Domains 0 to 101 work on every platform.",
        )
    return int(text)
