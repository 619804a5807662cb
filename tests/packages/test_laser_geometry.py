# SPDX-License-Identifier: Apache-2.0
"""laser_geometry, compared with a loop over the beams."""

import itertools
import math

import numpy as np
import pytest

from laser_geometry import LaserProjection
from sensor_msgs.msg import LaserScan
from sensor_msgs_py import point_cloud2

CHANNELS = LaserProjection.ChannelOption
FIELDS = {
    CHANNELS.INTENSITY: ["intensity"],
    CHANNELS.INDEX: ["index"],
    CHANNELS.DISTANCE: ["distances"],
    CHANNELS.TIMESTAMP: ["stamps"],
    CHANNELS.VIEWPOINT: ["vp_x", "vp_y", "vp_z"],
}


@pytest.fixture
def scan():
    scan = LaserScan(angle_min=-0.5, angle_increment=0.1, time_increment=0.01, range_min=0.5, range_max=5.0)
    scan.header.frame_id = "laser"
    scan.ranges = [0.4, 0.5, 1.0, 2.5, 5.0, 4.75, math.nan, math.inf]
    scan.intensities = [float(number) for number in range(8)]
    return scan


@pytest.mark.parametrize("cutoff", [-1.0, 2.5, 9.0])
def test_points_of_all_valid_beams(scan, cutoff):
    limit = 5.0 if cutoff < 0 else min(cutoff, 5.0)
    expected = [
        (r * math.cos(-0.5 + 0.1 * n), r * math.sin(-0.5 + 0.1 * n), 0.0, float(n), n, r, 0.01 * n, 0.0, 0.0, 0.0)
        for n, r in enumerate(scan.ranges)
        if 0.5 <= r < limit
    ]
    cloud = LaserProjection().projectLaser(scan, cutoff, 0x1F)
    assert cloud.header == scan.header
    found = point_cloud2.read_points(cloud)
    assert np.allclose([list(point) for point in found.tolist()], expected, atol=1e-6)


def test_fields_are_those_of_the_options(scan):
    for chosen in itertools.product((False, True), repeat=5):
        option = sum(bit for bit, wanted in zip(FIELDS, chosen, strict=True) if wanted)
        names = [name for bit, wanted in zip(FIELDS, chosen, strict=True) if wanted for name in FIELDS[bit]]
        cloud = LaserProjection().projectLaser(scan, channel_options=option)
        assert [field.name for field in cloud.fields] == [*"xyz", *names]
    scan.intensities = []
    assert [field.name for field in LaserProjection().projectLaser(scan).fields] == ["x", "y", "z", "index"]


def test_a_scan_without_a_valid_beam_gives_an_empty_cloud(scan):
    scan.ranges = [math.inf] * 8
    cloud = LaserProjection().projectLaser(scan)
    assert (cloud.width, len(cloud.data)) == (0, 0)
    assert LaserProjection().projectLaser(LaserScan()).width == 0
