# Written by scripts/generate_messages.py from interfaces/moveit_msgs/msg; do not edit.
"""Messages of moveit_msgs. Each class is created when it is first used."""

from coframe.messages.packages import shipped_exports

__all__, __getattr__, __dir__ = shipped_exports("moveit_msgs", "msg")
