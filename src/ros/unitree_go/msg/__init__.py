# Written by scripts/generate_messages.py from interfaces/unitree_go/msg; do not edit.
"""Messages of unitree_go. Each class is created when it is first used."""

from coframe.messages.packages import shipped_exports

__all__, __getattr__, __dir__ = shipped_exports("unitree_go", "msg")
