# SPDX-License-Identifier: Apache-2.0
"""Programs of ROS packages that are commands of coframe: ``python -m coframe.cli.ros_programs tf2_echo a b ...``.

Launch files append ``--ros-args`` to each program. Of these, the remappings of the topics of transforms and the
namespace apply to commands; names of nodes and parameters are skipped.
"""

from __future__ import annotations

import sys
from typing import Final

__all__ = ["PROGRAMS", "main"]

# The words of the command for each program.
PROGRAMS: Final[dict[str, tuple[str, ...]]] = {
    "joint_state_publisher_gui": ("joints", "--gui"),
    "rviz2": ("view",),
    "static_transform_publisher": ("static",),
    "tf2_echo": ("echo",),
    "tf2_monitor": ("monitor", "--classic"),
    "view_frames": ("frames", "-o", "frames.pdf", "-o", "frames.gv"),
}
_TOPICS: Final = {"/tf": "--tf-topic", "/tf_static": "--tf-static-topic"}
_PASSES_ROS_ARGUMENTS_ON = {"joints"}


def main() -> None:
    """Run the command for the program in the first argument."""
    from coframe.cli import main as run_command  # noqa: PLC0415 - it reads the new arguments

    _, program, *words = sys.argv
    command = PROGRAMS[program]
    if command[0] in _PASSES_ROS_ARGUMENTS_ON:
        sys.argv = ["coframe", *command, *words]
    else:
        sys.argv = ["coframe", *command, *_without_ros_arguments(words)]
    run_command()


def _without_ros_arguments(words: list[str]) -> list[str]:
    """Return the words of the program, and options in place of the remappings of /tf and /tf_static."""
    if "--ros-args" not in words:
        return words
    own = words[: words.index("--ros-args")]
    rules = [word.split(":=", 1) for word in words[len(own) :] if ":=" in word]
    namespace = next((right for left, right in rules if left == "__ns"), "").rstrip("/")
    for left, right in rules:
        option = _TOPICS.get(left if left.startswith("/") else f"/{left}")
        if option is not None:
            own += [option, right if right.startswith("/") else f"{namespace}/{right}"]
    return own


if __name__ == "__main__":
    main()
