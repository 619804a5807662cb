# Written by scripts/generate_messages.py from interfaces/nav_msgs/msg; do not edit.
"""Messages of nav_msgs."""

from coframe.messages.generated.nav_msgs.msg import (
    GridCells,
    MapMetaData,
    OccupancyGrid,
    Odometry,
    Path,
)

__all__ = [
    "GridCells",
    "MapMetaData",
    "OccupancyGrid",
    "Odometry",
    "Path",
]
