# SPDX-License-Identifier: Apache-2.0
"""Run robot_state_publisher with the description of the lab's arm, two_link_arm.urdf.xacro.

Try it:
    python -m coframe.lab.robot_state_publisher first_length:=0.4 --ros-args -r joint_states:=arm/joint_states

Arguments before --ros-args are arguments of the xacro file. The parameters are the same as for robot_state_publisher.
"""

from pathlib import Path

from coframe.nodes.program import program
from coframe.nodes.robot_state_publisher import run
from coframe.robots import load
from rclpy.parameter import Parameter

ARM = Path(__file__).with_name("two_link_arm.urdf.xacro")


def main(args: list[str] | None = None) -> None:
    """Run the node until it is interrupted."""

    def start(words: list[str], own: list[str]) -> None:
        robot = load(ARM, arguments=dict(word.split(":=", 1) for word in own if ":=" in word))
        run(words, parameter_overrides=[Parameter("robot_description", value=robot.text)])

    program("robot_state_publisher", args, start)


if __name__ == "__main__":
    main()
