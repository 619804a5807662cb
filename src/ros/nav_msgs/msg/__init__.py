# Written by scripts/generate_messages.py from interfaces/nav_msgs/msg; do not edit.
"""Messages of nav_msgs."""

from coframe.messages.generated.nav_msgs.msg import (
    Goals,
    GridCells,
    MapMetaData,
    OccupancyGrid,
    Odometry,
    Path,
    Trajectory,
    TrajectoryPoint,
)

__all__ = [
    "Goals",
    "GridCells",
    "MapMetaData",
    "OccupancyGrid",
    "Odometry",
    "Path",
    "Trajectory",
    "TrajectoryPoint",
]
