# SPDX-License-Identifier: Apache-2.0
"""tf2 support for the vectors, frames, twists and wrenches of PyKDL.

Importing this package registers these types for `tf2_ros.Buffer.transform` and `tf2_ros.convert`. It needs PyKDL, which
Linux distributions have as `python3-pykdl`. The Python package index does not have it for current versions of Python.
"""

from tf2_kdl.tf2_kdl import (
    do_transform_frame,
    do_transform_twist,
    do_transform_vector,
    do_transform_wrench,
    from_msg_frame,
    from_msg_twist,
    from_msg_vector,
    from_msg_wrench,
    to_msg_frame,
    to_msg_twist,
    to_msg_vector,
    to_msg_wrench,
    transform_to_kdl,
)

__all__ = [
    "do_transform_frame",
    "do_transform_twist",
    "do_transform_vector",
    "do_transform_wrench",
    "from_msg_frame",
    "from_msg_twist",
    "from_msg_vector",
    "from_msg_wrench",
    "to_msg_frame",
    "to_msg_twist",
    "to_msg_vector",
    "to_msg_wrench",
    "transform_to_kdl",
]
