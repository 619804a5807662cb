# Written by scripts/generate_messages.py from interfaces/visualization_msgs/msg; do not edit.
"""Messages of visualization_msgs."""

from coframe.messages.generated.visualization_msgs.msg import (
    ImageMarker,
    InteractiveMarker,
    InteractiveMarkerControl,
    InteractiveMarkerFeedback,
    InteractiveMarkerInit,
    InteractiveMarkerPose,
    InteractiveMarkerUpdate,
    Marker,
    MarkerArray,
    MenuEntry,
    MeshFile,
    UVCoordinate,
)

__all__ = [
    "ImageMarker",
    "InteractiveMarker",
    "InteractiveMarkerControl",
    "InteractiveMarkerFeedback",
    "InteractiveMarkerInit",
    "InteractiveMarkerPose",
    "InteractiveMarkerUpdate",
    "Marker",
    "MarkerArray",
    "MenuEntry",
    "MeshFile",
    "UVCoordinate",
]
