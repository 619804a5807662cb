# Written by scripts/generate_messages.py from interfaces/rmw_dds_common/msg; do not edit.
"""Messages of rmw_dds_common. Each class is created when it is first used."""

from coframe.messages.packages import shipped_exports

__all__, __getattr__, __dir__ = shipped_exports("rmw_dds_common", "msg")
