# SPDX-License-Identifier: Apache-2.0
"""Comparison with Debian's do_transform_cloud, which is that of ROS 1."""

import pickle
import subprocess
from pathlib import Path

import numpy as np
import pytest
from sensor_data import array_of, message_of, xyz

import coframe
from coframe.sensors import transform_cloud

DEBIAN_PYTHON = ("/usr/bin/python3", "-E")  # whatever PYTHONPATH names is for another Python


def debian_is_there():
    try:
        probe = subprocess.run([*DEBIAN_PYTHON, "-c", "import tf2_sensor_msgs"], capture_output=True, check=False)
    except FileNotFoundError:
        return False
    return probe.returncode == 0


@pytest.mark.parametrize("kind", ["f4", "f8"])
def test_points_equal_those_of_debian(kind, random):
    if not debian_is_there():
        pytest.skip("no tf2_sensor_msgs in /usr/bin/python3 (apt-get install python3-tf2-sensor-msgs)")
    points = np.zeros(500, [(axis, kind) for axis in "xyz"] + [("intensity", "f4"), ("ring", "u2")])
    for name in points.dtype.names:
        points[name] = random.normal(size=500) * 10 if name in "xyzintensity" else random.integers(0, 64, 500)
    cloud = message_of(points)
    transform = coframe.Transform.from_rpy([1, -2, 3], [0.4, 1.5, -2.6], target="base", source="lidar")
    given = {
        "transform": transform.values,
        "fields": [(field.name, field.offset, field.datatype) for field in cloud.fields],
        "data": bytes(cloud.data),
        **{name: getattr(cloud, name) for name in ("height", "width", "point_step", "row_step", "is_bigendian")},
    }
    answer = subprocess.run(
        [*DEBIAN_PYTHON, Path(__file__).with_name("debian_clouds.py")],
        input=pickle.dumps(given, protocol=4),
        capture_output=True,
        check=True,
    )
    theirs = pickle.loads(answer.stdout)
    result = transform_cloud(cloud, transform)
    ours, expected = array_of(result)[0], np.frombuffer(theirs["data"], points.dtype)
    assert (result.header.frame_id, result.point_step) == (theirs["frame"], theirs["point_step"])
    assert np.allclose(xyz(ours), xyz(expected), rtol=0, atol=1e-5 if kind == "f4" else 1e-12)
    assert np.array_equal(ours["intensity"], expected["intensity"])
    assert np.array_equal(ours["ring"], expected["ring"])
