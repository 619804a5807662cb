# SPDX-License-Identifier: Apache-2.0
"""Create a node with each of some command lines, and print what happens. The output of Humble is `bad.humble.txt`."""

import rclpy

LINES = """--ros-args -r
--ros-args -r foo
--ros-args -r a:=b c
--ros-args -p x
--ros-args -p x:=
--ros-args -p x:=abc
--ros-args -p 1x:=2
--ros-args --params-file nofile.yaml
--ros-args --log-level nope
--ros-args --unknown
--ros-args -r __node:=1bad
--ros-args -r __ns:=bad
--ros-args -r __ns:=/bad//x
--ros-args -r __name:=old
--ros-args -p x:=[1,a]
--ros-args -e /enc
--ros-args --disable-rosout-logs
--ros-args --enable-stdout-logs --log-config-file x
-r __node:=noros
--ros-args --param x:=7 --remap __node:=long
--ros-args -r rosservice://a:=b
--ros-args --disable-stdout-logs"""


def main() -> None:
    """Print the name of the node and the value of its parameter, or the error."""
    for line in LINES.splitlines():
        print(f"[{line}]")
        try:
            rclpy.init(args=["tiny", *line.split()])
            node = rclpy.create_node("tiny")
            print("ok", node.get_fully_qualified_name())
            print(node.declare_parameter("x", 1).value)
        except BaseException as error:  # noqa: BLE001 - as the recorded program
            print(f"{type(error).__module__}.{type(error).__name__} {error}")
        rclpy.try_shutdown()


main()
