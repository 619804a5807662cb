# Written by scripts/generate_messages.py from interfaces/example_interfaces/msg; do not edit.
"""Messages of example_interfaces. Each class is created when it is first used."""

from coframe.messages.packages import shipped_exports

__all__, __getattr__, __dir__ = shipped_exports("example_interfaces", "msg")
