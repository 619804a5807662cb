# SPDX-License-Identifier: Apache-2.0
"""The default storage of recordings."""

from coframe.bags.formats import MCAP, SQLITE
from coframe.distributions import since

__all__ = ["get_default_storage_id"]


def get_default_storage_id() -> str:
    """Return the storage of new recordings: ``mcap``, in Humble ``sqlite3``."""
    return (MCAP if since("bag_storage") else SQLITE).storage_id
