# Written by scripts/generate_messages.py from interfaces/rosbag2_interfaces/srv; do not edit.
"""Services of rosbag2_interfaces. Each class is created when it is first used."""

from coframe.messages.packages import shipped_exports

__all__, __getattr__, __dir__ = shipped_exports("rosbag2_interfaces", "srv")
