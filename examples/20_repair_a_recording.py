# SPDX-License-Identifier: Apache-2.0
"""Rename a frame and shift the stamps in a recording; the original does not change."""

from __future__ import annotations

import tempfile
from pathlib import Path

import coframe

START = 1_700_000_000_000_000_000


def main() -> None:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        buffer = coframe.Buffer()
        buffer.set("odom", "base", coframe.Transform([1.0, 0.0, 0.0]), START)
        with coframe.bags.Writer(folder / "run") as writer:
            tf = writer.add_topic("/tf", "tf2_msgs/msg/TFMessage")
            writer.write(tf, buffer.encode(static=False), received=START)

        recipe = coframe.bags.Recipe(["rename-frame base=base_link", "shift /tf=+35ms"])
        report = coframe.bags.edit(folder / "run", folder / "fixed.mcap", recipe)
        for rule in report.rules:
            print(rule.text)
        with coframe.open_bag(folder / "fixed.mcap") as fixed:
            stamp = fixed.buffer.lookup("odom", "base_link").stamp
        print(f"stamp: +{(stamp - START) // 1_000_000} ms")


if __name__ == "__main__":
    main()
