# Written by scripts/generate_messages.py from interfaces/webots_ros2_msgs/srv; do not edit.
"""Services of webots_ros2_msgs. Each class is created when it is first used."""

from coframe.messages.packages import shipped_exports

__all__, __getattr__, __dir__ = shipped_exports("webots_ros2_msgs", "srv")
