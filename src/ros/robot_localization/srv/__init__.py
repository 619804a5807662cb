# Written by scripts/generate_messages.py from interfaces/robot_localization/srv; do not edit.
"""Services of robot_localization. Each class is created when it is first used."""

from coframe.messages.packages import shipped_exports

__all__, __getattr__, __dir__ = shipped_exports("robot_localization", "srv")
