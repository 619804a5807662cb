# Written by scripts/generate_messages.py from interfaces/ros_gz_interfaces/msg; do not edit.
"""Messages of ros_gz_interfaces. Each class is created when it is first used."""

from coframe.messages.packages import shipped_exports

__all__, __getattr__, __dir__ = shipped_exports("ros_gz_interfaces", "msg")
