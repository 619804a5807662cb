"""The viewer: RViz's work in a browser tab, with time travel.

`coframe.show(buffer)` and the command `coframe view` start it. The server knows tf and works out where everything is;
the page draws. `coframe.viewer.protocol.binary` says what travels between both.
"""

from coframe.viewer.show import Viewer, expect, show

__all__ = ["Viewer", "expect", "show"]
