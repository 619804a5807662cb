# SPDX-License-Identifier: Apache-2.0
"""The row of Fast DDS in the middlewares of coframe, which imports nothing else of this package."""

from __future__ import annotations

from typing import Final

from coframe.wire.selection import MiddlewareRow

ROW: Final = MiddlewareRow(
    "fastdds", "Fast DDS", "coframe_fastdds.middleware", "fastrtps", "rmw_fastrtps_cpp", "rtps", rmw_selects_it=True
)
