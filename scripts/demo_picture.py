"""Makes docs/demo.svg: the last picture of a few seconds of `coframe demo`."""

from __future__ import annotations

import re
import time
from pathlib import Path

from rich.console import Console, Group
from rich.text import Text

import coframe
from coframe.cli.demo import CloudCounter
from coframe.cli.live import tree_table
from coframe.lab.launcher import Launcher
from coframe.messages.generated.sensor_msgs.msg import PointCloud2

SECONDS = 8.0


def main() -> None:
    console = Console(record=True, width=104, force_terminal=True)
    with coframe.connect("coframe_demo") as ros, Launcher() as nodes:
        clouds = CloudCounter()
        ros.subscribe("/scan_base_frame", PointCloud2, clouds.add)
        time.sleep(SECONDS)
        table = tree_table(ros.buffer, "base_link")
        console.print(Group(table, Text(str(clouds)), Text(f"{', '.join(nodes.names)}", style="dim")))
    target = Path(__file__).parents[1] / "docs" / "demo.svg"
    # rich would load its font from elsewhere
    picture = re.sub(r"@font-face \{[^}]*\}", "", console.export_svg(title="coframe demo"))
    target.write_text(re.sub(r"<!--.*?-->", "", picture))


main()
