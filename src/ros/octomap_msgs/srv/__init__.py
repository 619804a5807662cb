# Written by scripts/generate_messages.py from interfaces/octomap_msgs/srv; do not edit.
"""Services of octomap_msgs. Each class is created when it is first used."""

from coframe.messages.packages import shipped_exports

__all__, __getattr__, __dir__ = shipped_exports("octomap_msgs", "srv")
