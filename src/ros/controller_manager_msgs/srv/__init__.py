# Written by scripts/generate_messages.py from interfaces/controller_manager_msgs/srv; do not edit.
"""Services of controller_manager_msgs. Each class is created when it is first used."""

from coframe.messages.packages import shipped_exports

__all__, __getattr__, __dir__ = shipped_exports("controller_manager_msgs", "srv")
