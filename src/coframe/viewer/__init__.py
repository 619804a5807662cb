# SPDX-License-Identifier: Apache-2.0
"""The viewer: RViz's displays in a browser tab, with time travel.

`coframe.show(buffer)` and the command `coframe view` start it. The server looks up all poses, and the page draws them.

Subpackages; each imports only those above it in this list:
    protocol: The messages between server and page.
    sources: The ROS graph, a recording or a buffer.
    scene: Poses, statistics, the timeline and relations of a buffer's frames.
    displays: Messages converted to drawings.
    scripting: Scene nodes and widgets that a Python program adds.
    robots, rviz, tools: Robot descriptions, RViz configuration files, and the publishers of the page's tools.
    replay: A span of time as one HTML file.
    clients: The state, requests and updates of each connected tab.
    server: HTTP and WebSockets.
"""

from coframe.viewer.scripting.errors import SceneError
from coframe.viewer.scripting.gui_api import GuiApi
from coframe.viewer.scripting.node_handles import (
    ClickEvent,
    FrameHandle,
    ImageHandle,
    LinesHandle,
    MeshHandle,
    NodeHandle,
    PointsHandle,
    TextHandle,
)
from coframe.viewer.scripting.scene_api import SceneApi
from coframe.viewer.scripting.widget_handles import (
    ButtonHandle,
    CheckboxHandle,
    DropdownHandle,
    FolderHandle,
    NumberHandle,
    PictureHandle,
    PlotHandle,
    TextFieldHandle,
    WidgetEvent,
    WidgetHandle,
)
from coframe.viewer.show import Viewer, show, start_viewer

__all__ = [
    "ButtonHandle",
    "CheckboxHandle",
    "ClickEvent",
    "DropdownHandle",
    "FolderHandle",
    "FrameHandle",
    "GuiApi",
    "ImageHandle",
    "LinesHandle",
    "MeshHandle",
    "NodeHandle",
    "NumberHandle",
    "PictureHandle",
    "PlotHandle",
    "PointsHandle",
    "SceneApi",
    "SceneError",
    "TextFieldHandle",
    "TextHandle",
    "Viewer",
    "WidgetEvent",
    "WidgetHandle",
    "show",
    "start_viewer",
]


def __dir__() -> list[str]:
    return sorted(__all__)
