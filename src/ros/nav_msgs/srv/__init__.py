# Written by scripts/generate_messages.py from interfaces/nav_msgs/srv; do not edit.
"""Services of nav_msgs."""

from coframe.messages.events import event_attributes
from coframe.messages.generated.nav_msgs.srv import (
    GetMap,
    GetMap_Request,
    GetMap_Response,
    GetPlan,
    GetPlan_Request,
    GetPlan_Response,
    LoadMap,
    LoadMap_Request,
    LoadMap_Response,
    SetMap,
    SetMap_Request,
    SetMap_Response,
)

__all__ = [
    "GetMap",
    "GetMap_Request",
    "GetMap_Response",
    "GetPlan",
    "GetPlan_Request",
    "GetPlan_Response",
    "LoadMap",
    "LoadMap_Request",
    "LoadMap_Response",
    "SetMap",
    "SetMap_Request",
    "SetMap_Response",
]

__getattr__ = event_attributes("nav_msgs", "srv")
