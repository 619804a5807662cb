# Written by scripts/generate_messages.py from interfaces/action_tutorials_interfaces/action; do not edit.
"""Actions of action_tutorials_interfaces. Each class is created when it is first used."""

from coframe.messages.packages import shipped_exports

__all__, __getattr__, __dir__ = shipped_exports("action_tutorials_interfaces", "action")
