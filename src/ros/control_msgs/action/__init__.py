# Written by scripts/generate_messages.py from interfaces/control_msgs/action; do not edit.
"""Actions of control_msgs. Each class is created when it is first used."""

from coframe.messages.packages import shipped_exports

__all__, __getattr__, __dir__ = shipped_exports("control_msgs", "action")
