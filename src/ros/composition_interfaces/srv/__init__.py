# Written by scripts/generate_messages.py from interfaces/composition_interfaces/srv; do not edit.
"""Services of composition_interfaces. Each class is created when it is first used."""

from coframe.messages.packages import shipped_exports

__all__, __getattr__, __dir__ = shipped_exports("composition_interfaces", "srv")
