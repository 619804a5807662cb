# SPDX-License-Identifier: Apache-2.0
"""Runs programs with coframe and compares what they print with what they print on ROS 2."""

import difflib
import json
import re
from pathlib import Path
from typing import NamedTuple

from coframe.distributions import BEHAVIORS, Distribution

HERE = Path(__file__).parent
EXPECTED = HERE / "expected.json"
BY_DISTRIBUTION = HERE / "by_distribution.json"

# What differs between runs and machines, and how each side names the file of a class.
_NORMALIZED = (
    (r"\[\d{9,10}\.\d+\]", "[TIME]"),
    (r"0x[0-9a-f]{6,}", "0xADDR"),
    (r"0xADDR", "ADDRESS"),
    (r", at \S+\.(c|cpp):\d+", ""),
    (r"\.(msg|srv|action)\._\w+?\.", r".\1."),
    (r"(\n    \d\. \(?[^\n]*)+\n\nInvoked with: [^\n]*", ""),
    (r"np\.float64\(([^)]*)\)", r"\1"),  # how NumPy 2 shows numbers
)


class Difference(NamedTuple):
    """An output of ROS 2 and that of coframe in its place. Either is empty if the other side has no counterpart."""

    ros: str
    coframe: str


def entries(output: str) -> list[str]:
    """Return the outputs of a program, each of which may have several lines: continuations are indented."""
    for pattern, replacement in _NORMALIZED:
        output = re.sub(pattern, replacement, output)
    found: list[str] = []
    for line in output.splitlines():
        if line.startswith(" ") and found:
            found[-1] += "\n" + line
        else:
            found.append(line)
    return found


def differences(ros: str, coframe: str) -> list[Difference]:
    """Return the outputs that differ. What follows the end of the program on ROS 2 is one difference."""
    left, right = entries(ros), entries(coframe)
    found: list[Difference] = []
    matcher = difflib.SequenceMatcher(
        None, [_label(line) for line in left], [_label(line) for line in right], autojunk=False
    )
    for kind, start, end, other_start, other_end in matcher.get_opcodes():
        if kind == "equal":
            pairs = zip(left[start:end], right[other_start:other_end], strict=True)
            found.extend(Difference(*pair) for pair in pairs if pair[0] != pair[1])
        else:
            found.append(Difference("\n".join(left[start:end]), "\n".join(right[other_start:other_end])))
    return found


def _label(line: str) -> str:
    """Return what the program prints in front of a result, which is the same on both sides."""
    if line.startswith("[-"):  # the arguments of a node
        return line
    label, colon, _ = line.partition(": ")
    if colon and not line.startswith(("[", "(", "{", "rclpy.")):
        return label
    return line.split(" ", maxsplit=1)[0] if line.startswith(("[ERROR]", "[WARN]", "rclpy.", "ok")) else ""


def expected(program: str) -> tuple[dict[Difference, str], set[Difference]]:
    """Return the differences of a program that are intended, with their reasons, and those that do not always occur."""
    listed = json.loads(EXPECTED.read_text(encoding="utf-8"))[program]
    reasons = {Difference(item["ros"], item["coframe"]): item["reason"] for item in listed}
    return reasons, {Difference(item["ros"], item["coframe"]) for item in listed if item.get("sometimes")}


def expected_change(program: str, distribution: Distribution) -> set[Difference]:
    """Return how the output of coframe differs between Humble and a later distribution, and check the reasons."""
    listed = json.loads(BY_DISTRIBUTION.read_text(encoding="utf-8")).get(program, [])
    assert {item["behavior"] for item in listed} <= BEHAVIORS.keys()
    return {
        Difference(item["before"], item["after"])
        for item in listed
        if BEHAVIORS[item["behavior"]].since <= distribution
    }
