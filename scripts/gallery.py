# SPDX-License-Identifier: Apache-2.0
"""Draw the pictures of the gallery: one for each program in examples, in docs/images/gallery.

A program that shows a viewer gets a picture of its page, the others a picture of their output in a terminal.
`scripts/pictures.py` calls this module.
"""

from __future__ import annotations

import io
import json
import os
import re
import runpy
import signal
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING

from PIL import Image
from rich.console import Console
from rich.text import Text

if TYPE_CHECKING:
    from playwright.sync_api import Browser

ROOT = Path(__file__).resolve().parents[1]
EXAMPLES = ROOT / "examples"
PICTURES = ROOT / "docs" / "images" / "gallery"
SIZE, SHOWN = (800, 500), (480, 300)  # pixels of the page, and of the picture
COLUMNS = 76  # of a terminal
MAX_BYTES = 60_000  # of one picture
ENVIRONMENT = {
    **os.environ,
    "ROS_DOMAIN_ID": "96",
    "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
    "COLUMNS": str(COLUMNS),
}
# The examples that a picture needs to run, and the command whose output it shows; None: that of the last example.
NODES = {
    "01_static_broadcaster": (["01"], ["-m", "coframe.cli", "frames", "--duration", "8"]),
    "02_dynamic_broadcaster": (["01", "02"], ["-m", "coframe.cli", "frames", "--duration", "8"]),
    "03_listener": (["01", "02", "03"], None),
}
NOTEBOOK = "09_notebook"


def example_files() -> list[Path]:
    return sorted(EXAMPLES.glob("[0-9]*"))


def draw(browser: Browser, start: str = "") -> None:
    """Draw the pictures of the examples whose names begin with `start`."""
    PICTURES.mkdir(exist_ok=True)
    for path in example_files():
        if path.name.startswith(start):
            source = path.read_text("utf-8")
            if "show_scene" in source:
                with runpy.run_path(str(path))["show_scene"]() as viewer:
                    write_page(path.stem, browser, viewer.url)
            elif "coframe.show(" in source and path.suffix == ".py":
                draw_running(path, browser)
            else:
                write_terminal(path, output_of(path))


def draw_running(path: Path, browser: Browser) -> None:
    """Draw the page of a program that waits for clicks."""
    with subprocess.Popen([sys.executable, path], stdout=subprocess.PIPE, text=True) as program:
        try:
            assert program.stdout is not None
            address = re.search(r"http://\S+", program.stdout.readline())
            assert address is not None, path.name
            write_page(path.stem, browser, address[0])
        finally:
            program.send_signal(signal.SIGINT)


def write_page(name: str, browser: Browser, url: str) -> None:
    page = browser.new_page(viewport={"width": SIZE[0], "height": SIZE[1]}, color_scheme="dark")
    page.goto(url)
    page.wait_for_function("() => window.coframe && coframe.updates > 0 && Object.keys(coframe.frames).length > 0")
    page.wait_for_timeout(2500)
    page.keyboard.press("a")  # everything in view
    page.wait_for_timeout(2000)
    image = Image.open(io.BytesIO(page.screenshot())).convert("RGB").resize(SHOWN)
    page.close()
    target = PICTURES / f"{name}.webp"
    image.save(target, quality=78, method=6)
    check_size(target)


def output_of(path: Path) -> str:
    """Return what a program prints, or the first lines of a node."""
    if path.stem == NOTEBOOK:
        return "\n".join(run_notebook(path))
    if path.stem not in NODES:
        return subprocess.check_output([sys.executable, path], text=True, env=ENVIRONMENT)
    examples, command = NODES[path.stem]
    programs = [next(EXAMPLES.glob(f"{number}_*")) for number in examples]
    running = [
        subprocess.Popen([sys.executable, each], stderr=subprocess.PIPE, text=True, env=ENVIRONMENT)
        for each in programs
    ]
    try:
        if command is not None:
            return subprocess.check_output([sys.executable, *command], text=True, env=ENVIRONMENT)
        assert running[-1].stderr is not None
        lines = (line for line in running[-1].stderr if "lidar at" in line)
        return "".join(next(lines) for _ in range(3))
    finally:
        for program in running:
            program.send_signal(signal.SIGINT)
        for program in running:
            program.communicate(timeout=30)


def run_notebook(path: Path) -> list[str]:
    """Run the cells of the notebook, and return their code with the text of the last value."""
    names: dict[str, object] = {}
    lines = []
    for cell in json.loads(path.read_text("utf-8"))["cells"]:
        if cell["cell_type"] == "code":
            source = "".join(cell["source"])
            exec(source, names)  # noqa: S102 - our own notebook
            lines += [f">>> {line}" for line in source.splitlines() if line]
    return [*lines[:9], repr(names["transform"])]


def write_terminal(path: Path, output: str) -> None:
    """Draw what a terminal shows as SVG, without fonts of other hosts."""
    console = Console(record=True, width=COLUMNS, file=io.StringIO())
    console.print(Text(path.name if path.stem == NOTEBOOK else f"$ python examples/{path.name}", style="bold green"))
    console.print(Text(output.rstrip()))
    drawn = console.export_svg(title="coframe", unique_id=f"example{path.stem}")  # CSS classes begin with a letter
    drawn = re.sub(r"@font-face \{.*?\}\s*", "", drawn, flags=re.DOTALL)
    drawn = re.sub(r"<!-- Generated with Rich [^>]*-->\s*", "", drawn)
    target = PICTURES / f"{path.stem}.svg"
    target.write_text(drawn, "utf-8")
    check_size(target)


def check_size(target: Path) -> None:
    size = target.stat().st_size
    print(f"{target}: {size // 1000} kB")
    if size > MAX_BYTES:
        sys.exit(f"{target} has {size} bytes, at most {MAX_BYTES} are allowed")
