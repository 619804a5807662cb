# SPDX-License-Identifier: Apache-2.0
"""Editing a recording: what pymcap-cli can do as well, by the processor time of all threads."""

import tempfile
import time
from collections.abc import Generator
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks import peers
from benchmarks.measuring import Contender, Row, TimesAsFast
from benchmarks.statement import Statement
from coframe.bags import Writer, edit
from coframe.messages import find, serialize

IMAGES, SCANS = 300, 10  # images, and scans for each image
MESSAGES = IMAGES * (SCANS + 1)


def recording(folder: Path) -> Path:
    """Write images with some noise, and many small messages."""
    random = np.random.default_rng(0)
    image, scan = find("sensor_msgs/msg/Image")(height=480, width=640), find("sensor_msgs/msg/LaserScan")()
    image.data = (random.integers(0, 255, 480 * 640) // 8).astype(np.uint8).tobytes()
    scan.ranges = [3.0] * 360
    with Writer(folder / "run") as writer:
        images = writer.add_topic("/image", image.ROS_TYPE)
        scans = writer.add_topic("/scan", scan.ROS_TYPE)
        pixels, ranges = serialize(image), serialize(scan)
        for number in range(IMAGES):
            writer.write(images, pixels, number * 50_000_000)
            for part in range(SCANS):
                writer.write(scans, ranges, number * 50_000_000 + part * 5_000_000)
    return folder / "run" / "run_0.mcap"


def statement(code: str, **names: Any) -> Statement:
    names |= {"clear": lambda path: path.unlink(missing_ok=True)}
    return Statement(code, names, setup="clear(out)", items=MESSAGES, limit=1, clock=time.process_time_ns)


def editing(name: str, rule: str, options: list[str]) -> Row:
    def contenders() -> Generator[Contender]:
        app = peers.package("pymcap_cli.cli").app
        with tempfile.TemporaryDirectory() as temporary:
            path, out = recording(Path(temporary)), Path(temporary) / "out.mcap"
            yield statement("edit(path, out, [rule])", edit=edit, path=path, out=out, rule=rule)
            words = ["process", str(path), "-o", str(out), "-f", *options]
            yield statement("app(words, result_action='return_value')", app=app, words=words, out=out)

    return Row(f"edit, {name}, per message", "pymcap-cli process", contenders, TimesAsFast(1))


ROWS = [
    editing("a topic renamed", "rename-topic /scan=/front", ["--rename-topic", "/scan=/front"]),
    editing("a topic dropped", "drop-topic /image", ["-x", "/image", "--compression-level", "1"]),
    editing("log times shifted", "shift-log /scan=35ms", ["--time-offset", "/scan=35ms", "--compression-level", "1"]),
]
