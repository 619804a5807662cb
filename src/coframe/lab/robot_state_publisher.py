"""robot_state_publisher for the lab's arm: the transforms of two_link_arm.urdf.xacro, which lies beside this file.

Try it:
    python -m coframe.lab.robot_state_publisher first_length:=0.4 --ros-args -r joint_states:=arm/joint_states

What stands before --ros-args are arguments of the xacro file; parameters are those of robot_state_publisher.
"""

import sys
from pathlib import Path

from coframe.robots import load
from rclpy.exceptions import NameValidationException, ParameterException
from rclpy.parameter import Parameter
from rclpy.utilities import remove_ros_args
from robot_state_publisher import run

ARM = Path(__file__).with_name("two_link_arm.urdf.xacro")


def main(args: list[str] | None = None) -> None:
    """Run the node until it is stopped."""
    words = sys.argv if args is None else ["robot_state_publisher", *args]
    arguments = dict(word.split(":=", 1) for word in remove_ros_args(words)[1:] if ":=" in word)
    try:
        robot = load(ARM, arguments=arguments)
        run(words, parameter_overrides=[Parameter("robot_description", value=robot.text)])
    except (RuntimeError, NameValidationException, ParameterException, ValueError) as error:
        hint = getattr(error, "hint", "")
        sys.exit(f"robot_state_publisher: {error}" + (f"\n  {hint}" if hint else ""))


if __name__ == "__main__":
    main()
