# SPDX-License-Identifier: Apache-2.0
"""Coordinates far from the origin of their frame, as in UTM, are drawn within a millimeter by a page with float32."""

from array import array

import numpy as np
import pytest

import coframe
from coframe.messages import find
from coframe.viewer.displays import Options
from coframe.viewer.displays.display import _Entry
from coframe.viewer.displays.kinds.grids import draw_grid
from coframe.viewer.displays.kinds.markers import MarkerSet
from coframe.viewer.displays.kinds.paths import draw_path
from coframe.viewer.displays.kinds.points import draw_cloud
from coframe.viewer.displays.kinds.poses import draw_pose_array
from coframe.viewer.protocol.encoding import relative_to

UTM = np.array([691_234.5678, 5_334_567.8912, 519.4])  # meters, in Munich
NEAR = np.array([[0.0, 0.0, 0.0], [0.1, -0.2, 0.05], [40.0, 30.0, -2.0]])
PLACES = UTM + NEAR
LINES, CUBES = 4, 6


def header(message):
    message.header.frame_id = "utm"
    return message


def pose(place):
    made = find("geometry_msgs/msg/Pose")()
    made.position.x, made.position.y, made.position.z = map(float, place)
    made.orientation.w = 1.0
    return made


def cloud():
    field = find("sensor_msgs/msg/PointField")
    fields = [field(name=name, offset=8 * i, datatype=8, count=1) for i, name in enumerate("xyz")]
    made = find("sensor_msgs/msg/PointCloud2")(height=1, width=3, point_step=24, row_step=72, fields=fields)
    made.data = array("B", PLACES.astype("<f8").tobytes())
    drawing = draw_cloud(header(made), Options())
    return drawing, lambda decoded: decoded(drawing.data).points


def path():
    made = header(find("nav_msgs/msg/Path")())
    made.poses = [find("geometry_msgs/msg/PoseStamped")(pose=pose(place)) for place in PLACES]
    drawing = draw_path(made, Options())
    return drawing, lambda decoded: decoded(drawing.data).payload.reshape(-1, 7)[:, :3]


def poses():
    made = header(find("geometry_msgs/msg/PoseArray")(poses=[pose(place) for place in PLACES]))
    drawing = draw_pose_array(made, Options())
    return drawing, lambda decoded: decoded(drawing.data).payload.reshape(-1, 7)[:, :3]


def markers(*, points):
    """Three cubes at their poses, or one marker with three points."""
    shown = MarkerSet(lambda _url: (None, None))
    for number, place in enumerate([PLACES] if points else PLACES):
        made = header(find("visualization_msgs/msg/Marker")(type=LINES if points else 1, id=number))
        made.pose = pose((0, 0, 0) if points else place)
        if points:
            made.points = [find("geometry_msgs/msg/Point")(x=x, y=y, z=z) for x, y, z in place.tolist()]
        shown.apply(made, 0)
    (drawing,) = shown.draw(Options())

    def places(decoded):
        found = decoded(drawing.data)
        items = np.array([item["pose"][:3] for item in found.head["items"]])
        return items[0] + found.payload[:9].reshape(3, 3) if points else items

    return drawing, places


def grid():
    made = header(find("nav_msgs/msg/OccupancyGrid")())
    made.info.width = made.info.height = 1
    made.info.resolution, made.info.origin, made.data = 0.05, pose(PLACES[0]), array("b", [0])
    drawing = draw_grid(made, Options())
    return drawing, lambda decoded: np.array(decoded(drawing.data).corner)[None, :3]


@pytest.mark.parametrize(
    "make",
    [cloud, path, poses, grid, lambda: markers(points=True), lambda: markers(points=False)],
    ids=["cloud", "path", "poses", "grid", "points of a marker", "poses of markers"],
)
def test_far_coordinates_are_drawn_within_a_millimeter(decoded, make):
    buffer = coframe.Buffer(None)
    turned = coframe.Transform.from_rpy(UTM, [0.1, 0.2, 0.7]).inverse()
    buffer.set("map", "utm", turned, static=True)  # The robot is near the origin of the map.
    drawing, places = make()
    entry = _Entry(drawing, 1, drawing.frame)
    assert entry.place(buffer, "map", 0)
    # What the page receives are float32 numbers, relative to an origin near the robot.
    x, y, z, *rotation = relative_to(np.zeros(3), entry.pose).astype(float).tolist()
    seen = coframe.Transform([x, y, z], rotation) @ places(decoded).astype(np.float32).astype(float)
    np.testing.assert_allclose(seen, (turned @ PLACES)[: len(seen)], rtol=0, atol=1e-3)


def test_near_coordinates_have_no_offset(decoded):
    made = header(find("nav_msgs/msg/Path")())
    made.poses = [find("geometry_msgs/msg/PoseStamped")(pose=pose(place)) for place in NEAR]
    drawing = draw_path(made, Options())
    assert drawing.offset == (0.0, 0.0, 0.0)
    np.testing.assert_allclose(decoded(drawing.data).payload.reshape(-1, 7)[:, :3], NEAR, atol=1e-6)
