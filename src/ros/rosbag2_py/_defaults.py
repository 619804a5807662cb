# SPDX-License-Identifier: Apache-2.0
"""The storage that recordings have if none is selected."""

from coframe.bags.formats import SQLITE

__all__ = ["get_default_storage_id"]


def get_default_storage_id() -> str:
    """Return the storage of new recordings, ``sqlite3`` as in Humble."""
    return SQLITE.storage_id or ""
