# SPDX-License-Identifier: Apache-2.0
"""The packages that scripts import, on an installation without any optional package."""

import subprocess
import sys

PROGRAM = """
import sys
HIDDEN = {"yaml", "cv2", "PyKDL", "scipy", "transforms3d"}
class Hidden:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in HIDDEN:
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)
sys.meta_path.insert(0, Hidden())
import angles, ament_index_python, cv_bridge, diagnostic_updater, image_geometry, laser_geometry, message_filters
import ros2_numpy, rosidl_runtime_py, rosidl_runtime_py.utilities, sensor_msgs_py.point_cloud2, tf_transformations
import numpy as np
from sensor_msgs.msg import Image
image = cv_bridge.CvBridge().cv2_to_imgmsg(np.zeros((2, 3), np.uint8), "mono8")
assert cv_bridge.CvBridge().imgmsg_to_cv2(image, "mono16").dtype == np.uint16
assert ros2_numpy.numpify(image).shape == (2, 3)
assert rosidl_runtime_py.message_to_csv(image).startswith("0,0,,2,3,mono8,0,3,0,")
print("imported")
"""


def test_packages_need_only_numpy():
    result = subprocess.run([sys.executable, "-c", PROGRAM], capture_output=True, text=True, check=False, timeout=60)
    assert result.stdout == "imported\n", result.stderr
