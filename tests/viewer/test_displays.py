# SPDX-License-Identifier: Apache-2.0
"""Displays of a tab: messages published over DDS and drawn at their own stamps, or the reason why they cannot be."""

import threading
import time
from array import array

import numpy as np
import pytest

pytest.importorskip("dds_library", reason="live displays need DDS")

import coframe
from coframe.messages import find
from coframe.viewer.displays import CannotDrawError, Options
from coframe.viewer.displays.kinds.grids import draw_grid
from coframe.viewer.displays.kinds.images import draw_compressed_image, draw_image
from coframe.viewer.displays.kinds.points import draw_cloud, draw_scan
from coframe.viewer.protocol.client_messages import DEFAULT_IMAGE_PIXELS
from coframe.wire.qos import QoS

SECOND = 1_000_000_000


def message(ros_type, frame, stamp, **fields):
    made = find(ros_type)(**fields)
    made.header.frame_id = frame
    made.header.stamp.sec, made.header.stamp.nanosec = divmod(stamp, SECOND)
    return made


def scan(frame, stamp, ranges):
    made = message("sensor_msgs/msg/LaserScan", frame, stamp, ranges=ranges, range_max=50.0)
    made.angle_increment = np.pi / 2
    return made


def cloud(frame, stamp, columns, dtypes=None):
    """Return a PointCloud2 with float32 fields, or those in `dtypes`."""
    dtypes = dtypes or {}
    layout = np.dtype([(name, dtypes.get(name, "<f4")) for name in columns])
    values = np.empty(len(next(iter(columns.values()))), layout)
    for name, column in columns.items():
        values[name] = column
    made = message("sensor_msgs/msg/PointCloud2", frame, stamp)
    made.height, made.width = 1, len(values)
    made.point_step, made.row_step = values.itemsize, values.nbytes
    numbers = {"<f4": 7, "<u4": 6}
    point_field = find("sensor_msgs/msg/PointField")
    made.fields = [
        point_field(name=name, offset=layout.fields[name][1], datatype=numbers[dtypes.get(name, "<f4")], count=1)
        for name in columns
    ]
    made.data = array("B", values.tobytes())
    return made


@pytest.fixture
def ros(domain_id):
    with coframe.connect("viewer_test", domain=domain_id) as connection:
        yield connection


@pytest.fixture
def robot(ros):
    """Move base along the x axis of map at 1 m/s for the last ten seconds; the lidar is one meter above it."""
    now = time.time_ns()
    for tenth in range(101):
        ros.buffer.set(
            "map", "base", coframe.Transform([tenth / 10, 0.0, 0.0]), now - 10 * SECOND + tenth * SECOND // 10
        )
    ros.buffer.set("base", "lidar", coframe.Transform([0.0, 0.0, 1.0]), static=True)
    return now


class RepeatingPublisher:
    """Publishes a message repeatedly while a tab waits."""

    def __init__(self, ros, tab, topic, made, qos=None):
        self.publisher = ros.publisher(topic, type(made), qos)
        self.tab, self.made = tab, made

    def until(self, kind, condition=lambda _message: True):
        ended = threading.Event()
        publishing = threading.Thread(target=self._publish, args=(ended,))
        publishing.start()
        try:
            return self.tab.wait(kind, condition)
        finally:
            ended.set()
            publishing.join()

    def _publish(self, ended):
        while not ended.is_set():
            self.publisher.publish(self.made)
            ended.wait(0.05)


def subscribe(tab, topic, number=1, **options):
    tab.send("subscribe", id=number, topic=topic, options=options)


def test_a_scan_is_drawn_at_the_pose_of_its_sensor_at_its_stamp(ros, robot, view, open_tab):
    tab = open_tab(view(ros, fixed="map"))
    subscribe(tab, "/scan")
    stamp = robot - 5 * SECOND
    publisher = RepeatingPublisher(
        ros, tab, "/scan", scan("lidar", stamp, [2.0, 3.0, float("inf"), float("nan")]), QoS(5, reliable=False)
    )
    update = publisher.until("frames", lambda update: update.displays)
    ((number, sequence), pose), *others = update.displays.items()
    assert (number, others) == (1, [])
    np.testing.assert_allclose(pose[:3] + update.origin, [5.0, 0.0, 1.0], atol=1e-5)
    drawn = tab.drawings[1, sequence]
    np.testing.assert_allclose(drawn.points, [[2.0, 0.0, 0.0], [0.0, 3.0, 0.0]], atol=1e-6)
    np.testing.assert_allclose(drawn.scalars, [2.0, 3.0])
    assert drawn.range == [2.0, 3.0]
    assert drawn.stamp == stamp - int(tab.last["hello"]["origin"])
    assert tab.last["display"]["state"] == "ok"
    tab.send("fixed", frame="base")
    update = tab.frame_update(lambda update: tab.last["tree"]["fixed"] == "base" and update.displays)
    np.testing.assert_allclose(next(iter(update.displays.values()))[:3], [0.0, 0.0, 1.0], atol=1e-5)
    tab.send("unsubscribe", id=1)
    tab.frame_update(lambda update: not update.displays)


def test_a_display_without_a_transform_shows_the_reason(ros, robot, view, open_tab):
    tab = open_tab(view(ros, fixed="map"))
    subscribe(tab, "/early", 1)
    subscribe(tab, "/lost", 2)
    early = RepeatingPublisher(ros, tab, "/early", scan("lidar", robot - 60 * SECOND, [1.0]))
    received = early.until("display", lambda received: received["id"] == 1 and received["state"] == "error")
    assert "extrapolation into the past" in received["text"]
    assert "map -> base no longer has a sample" in received["text"], "the hint"
    lost = RepeatingPublisher(ros, tab, "/lost", scan("lider", robot, [1.0]))
    received = lost.until("display", lambda received: received["id"] == 2 and received["state"] == "error")
    assert "Did you mean 'lidar'?" in received["text"]
    assert not tab.frame_update().displays


def test_a_message_waits_for_its_transform(ros, robot, view, open_tab):
    tab = open_tab(view(ros, fixed="map"))
    subscribe(tab, "/scan")
    later = robot + SECOND // 2
    publisher = RepeatingPublisher(ros, tab, "/scan", scan("base", later, [1.0]), QoS(transient_local=True))
    publisher.until("frames", lambda _update: publisher.publisher.matched)
    ros.buffer.set("map", "base", coframe.Transform([20.0, 0.0, 0.0]), later)
    update = tab.frame_update(lambda update: update.displays)
    np.testing.assert_allclose(next(iter(update.displays.values()))[:3] + update.origin, [20.0, 0.0, 0.0], atol=1e-5)


@pytest.mark.parametrize(
    ("first", "second"),
    [
        (QoS(), QoS(reliable=False)),
        (QoS(transient_local=True), QoS()),
        (QoS(transient_local=True), QoS(reliable=False, transient_local=True)),
        (QoS(), QoS(transient_local=True)),
    ],
)
def test_messages_of_later_publishers_are_received_whatever_they_offer(
    ros, robot, view, open_tab, caplog, first, second
):
    tab = open_tab(view(ros, fixed="map"))
    subscribe(tab, "/pose")
    made = message("geometry_msgs/msg/PoseStamped", "map", robot - 4 * SECOND)
    made.pose.position.x = 1.0
    assert RepeatingPublisher(ros, tab, "/pose", made, first).until("shapes").payload[0] == 1.0
    made.header.stamp.sec += 1
    made.pose.position.x = 2.0
    later = RepeatingPublisher(ros, tab, "/pose", made, second)
    if second.transient_local and second.reliable:
        later.publisher.publish(made)  # Once, before the viewer has subscribed to it.
        assert tab.wait("shapes", lambda shown: shown.payload[0] == 2.0)
    else:
        assert later.until("shapes", lambda shown: shown.payload[0] == 2.0)
    assert "this subscription requests" not in caplog.text


def test_the_requested_quality_of_service_is_that_of_the_subscription(ros, robot, view, open_tab):
    tab = open_tab(view(ros, fixed="map"))
    made = message("geometry_msgs/msg/PoseStamped", "map", robot - SECOND)
    kept = ros.publisher("/pose", type(made), QoS(transient_local=True))
    kept.publish(made)

    def requested():  # The doctor subscribes, too.
        return [one.qos for one in ros.participant.subscribers("/pose") if one.node == "viewer_test"]

    for number, options, expected in (
        (1, {}, [(True, True)]),
        (2, {"reliability": "best_effort"}, [(False, False)]),
        (3, {"durability": "volatile", "depth": 3}, [(True, False)]),
        (4, {"reliability": "best_effort", "durability": "transient_local"}, [(True, True)]),
    ):
        subscribe(tab, "/pose", number, **options)
        tab.frame_update(lambda _update: requested())
        assert [(qos.reliable, qos.transient_local) for qos in requested()] == expected, options
        if expected == [(True, True)]:
            assert tab.frame_update(lambda update, number=number: (number, 1) in update.displays)
        tab.send("unsubscribe", id=number)
        tab.frame_update(lambda _update: not requested())


def test_a_display_says_that_a_publisher_offers_less_than_requested(ros, robot, view, open_tab):
    tab = open_tab(view(ros, fixed="map"))
    subscribe(tab, "/scan", reliability="reliable")
    publisher = RepeatingPublisher(ros, tab, "/scan", scan("base", robot - SECOND, [1.0]), QoS(5, reliable=False))
    status = publisher.until("display", lambda status: status["state"] == "ok")
    assert status["note"].startswith("a publisher offers only best effort")


def test_earlier_messages_are_received_although_another_publisher_keeps_none(ros, view, open_tab):
    marker = find("visualization_msgs/msg/Marker")

    def one(number):
        made = marker(ns="test", id=number, type=marker.CUBE)
        made.header.frame_id = "map"
        return made

    publisher = RepeatingPublisher(ros, None, "/markers", one(1), QoS(reliable=False))
    kept = ros.publisher("/markers", marker, QoS(transient_local=True))
    kept.publish(one(2))
    tab = publisher.tab = open_tab(view(ros, fixed="map"))
    subscribe(tab, "/markers")
    shown = publisher.until("shapes", lambda shown: len(shown.head["items"]) == 2)
    assert {item["id"] for item in shown.head["items"]} == {1, 2}


def test_time_travel_shows_the_messages_of_that_time(ros, robot, view, open_tab):
    tab = open_tab(view(ros, fixed="map"))
    subscribe(tab, "/pose")
    made = message("geometry_msgs/msg/PoseStamped", "map", robot - 4 * SECOND)
    made.pose.position.x = 1.0
    publisher = RepeatingPublisher(ros, tab, "/pose", made)
    publisher.until("frames", lambda update: update.displays)
    publisher.made.header.stamp.sec += 3
    publisher.made.pose.position.x = 2.0
    shown = publisher.until("shapes", lambda received: received.payload[0] == 2.0)
    assert shown.head["kind"] == "poses"
    assert shown.head["poses"] == [0, 1]
    np.testing.assert_allclose(shown.payload, [2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0])
    origin = int(tab.last["hello"]["origin"])
    tab.send("time", mode="at", at=robot - 2 * SECOND - origin)
    tab.wait("shapes", lambda received: received.payload[0] == 1.0)  # the newest one may be shown again before
    tab.send("time", mode="at", at=robot - 9 * SECOND - origin)
    assert tab.wait("display")["text"] == "no message before this time"
    tab.send("time", mode="at", at=robot - 2 * SECOND - origin)
    assert tab.wait("shapes").payload[0] == 1.0
    tab.send("step", direction=1)
    tab.frame_update(lambda update: update.time > robot - 2 * SECOND - origin)


def test_markers_are_added_deleted_and_grouped_by_frame(ros, robot, view, open_tab):
    marker = find("visualization_msgs/msg/Marker")
    array_type = find("visualization_msgs/msg/MarkerArray")

    def one(number, frame, **fields):
        made = marker(ns="test", id=number, type=marker.CUBE, **fields)
        made.header.frame_id = frame
        made.header.stamp.sec, made.header.stamp.nanosec = divmod(robot - SECOND, SECOND)
        return made

    point = find("geometry_msgs/msg/Point")
    strip = one(2, "base", points=[point(x=1.0), point(x=2.0, y=3.0)])
    mesh = one(3, "lidar", frame_locked=True, mesh_resource="package://../../etc/passwd")
    tab = open_tab(view(ros, fixed="map"))
    subscribe(tab, "/markers")
    publisher = RepeatingPublisher(
        ros, tab, "/markers", array_type(markers=[one(1, "map"), strip, mesh]), QoS(transient_local=True)
    )
    update = publisher.until("frames", lambda update: len(update.displays) == 3)
    drawn = {tab.drawings[key].head["frame"]: (tab.drawings[key], pose) for key, pose in update.displays.items()}
    assert set(drawn) == {"map", "base", "lidar"}
    np.testing.assert_allclose(drawn["base"][1][:3] + update.origin, [9.0, 0.0, 0.0], atol=1e-5)
    np.testing.assert_allclose(drawn["lidar"][1][:3] + update.origin, [10.0, 0.0, 1.0], atol=1e-5)
    (item,) = drawn["base"][0].head["items"]
    assert (item["ns"], item["id"], item["points"], item["colors"]) == ("test", 2, [0, 2], None)
    np.testing.assert_allclose(drawn["base"][0].payload, [1.0, 0.0, 0.0, 2.0, 3.0, 0.0])
    (item,) = drawn["lidar"][0].head["items"]
    assert item["mesh"] is None
    assert "ROS package" in item["mesh_problem"]

    publisher.made = array_type(markers=[one(2, "base", action=marker.DELETE)])
    left = publisher.until("frames", lambda update: len(update.displays) == 2).displays.keys()
    publisher.made = array_type(markers=[one(4, "base"), one(5, "base", action=marker.DELETE)])
    update = publisher.until("frames", lambda update: len(update.displays) == 3)
    assert left < update.displays.keys(), "unchanged drawings are not sent again"
    publisher.made = array_type(markers=[one(0, "map", action=marker.DELETEALL)])
    publisher.until("frames", lambda update: not update.displays)


def test_drawings_beyond_the_limit_are_counted(ros, robot, view, open_tab, monkeypatch):
    monkeypatch.setattr("coframe.viewer.displays.display.MAX_DRAWINGS", 2)
    marker = find("visualization_msgs/msg/Marker")
    markers = [marker(id=number, type=marker.CUBE) for number in range(3)]
    for made, frame in zip(markers, ("map", "base", "lidar"), strict=True):
        made.header.frame_id = frame
        made.header.stamp.sec, made.header.stamp.nanosec = divmod(robot - SECOND, SECOND)
    tab = open_tab(view(ros, fixed="map"))
    subscribe(tab, "/markers")
    array_type = find("visualization_msgs/msg/MarkerArray")
    publisher = RepeatingPublisher(ros, tab, "/markers", array_type(markers=markers))
    shown = publisher.until("display", lambda display: display["state"] == "error")
    assert shown["text"] == "not drawn: 1 group of markers; the maximum per message is 2"
    tab.frame_update(lambda update: len(update.displays) == 2)


def test_odometry_is_drawn_with_a_trail(ros, robot, view, open_tab):
    tab = open_tab(view(ros, fixed="map"))
    subscribe(tab, "/odom", keep=3)
    publisher = RepeatingPublisher(
        ros, tab, "/odom", message("nav_msgs/msg/Odometry", "map", robot, child_frame_id="base")
    )
    publisher.until("shapes")
    shown = None
    for x in (1.0, 2.0, 3.0, 4.0):
        publisher.made.pose.pose.position.x = x
        shown = publisher.until("shapes", lambda received, x=x: received.payload[-7] == x)
    assert shown.head["kind"] == "odometry"
    assert shown.head["child_frame"] == "base"
    assert shown.head["poses"] == [0, 3], "only the last three poses"
    assert (np.diff(shown.payload.reshape(-1, 7)[:, 0]) >= 0).all()


@pytest.mark.parametrize(
    ("ros_type", "fields", "kind", "facts"),
    [
        ("geometry_msgs/msg/PoseArray", {"poses": [find("geometry_msgs/msg/Pose")()] * 3}, "poses", {"poses": [0, 3]}),
        ("nav_msgs/msg/Path", {"poses": [find("geometry_msgs/msg/PoseStamped")()] * 2}, "path", {"poses": [0, 2]}),
        (
            "sensor_msgs/msg/Range",
            {"range": float("inf"), "max_range": 4.0},
            "range",
            {"range": None, "max_range": 4.0},
        ),
        (
            "sensor_msgs/msg/CameraInfo",
            {"width": 640, "k": [float("nan")] * 9},
            "camera",
            {"width": 640, "k": [None] * 9},
        ),
    ],
)
def test_other_messages_become_shapes(ros, robot, view, open_tab, ros_type, fields, kind, facts):
    tab = open_tab(view(ros, fixed="map"))
    subscribe(tab, "/thing")
    shown = RepeatingPublisher(ros, tab, "/thing", message(ros_type, "map", robot, **fields)).until("shapes")
    assert shown.head["kind"] == kind
    assert {name: shown.head[name] for name in facts} == facts
    assert shown.head["stamp"] == robot - int(tab.last["hello"]["origin"])


def test_a_cloud_of_a_million_points(ros, robot, view, open_tab):
    generator = np.random.default_rng(1)
    points = generator.normal(size=(1_000_000, 3)).astype(np.float32)
    made = cloud("map", robot, {"x": points[:, 0], "y": points[:, 1], "z": points[:, 2]})
    tab = open_tab(view(ros, fixed="map"))
    subscribe(tab, "/cloud", color_by="axis", axis="z")
    publisher = RepeatingPublisher(ros, tab, "/cloud", made, QoS(1, transient_local=True))
    shown = publisher.until("cloud")
    assert len(shown.points) == 1_000_000
    np.testing.assert_array_equal(shown.points[::1000], points[::1000])
    np.testing.assert_array_equal(shown.scalars[::1000], points[::1000, 2])


def test_the_colors_of_a_cloud(decoded):
    columns = {"x": [1.0, np.nan], "y": [0.0, 0.0], "z": [2.0, 0.0], "intensity": [5.0, 6.0]}
    made = cloud("map", 0, {**columns, "rgb": [0x00FF8001, 0]}, {"rgb": "<u4"})
    shown = decoded(draw_cloud(made, Options()).data)
    assert shown.points.tolist() == [[1.0, 0.0, 2.0]], "points that are not finite are omitted"
    assert shown.colors.tolist() == [[0xFF, 0x80, 0x01, 255]]
    for color_by, expected in (("intensity", [5.0]), ("axis", [2.0]), ("distance", [5**0.5])):
        shown = decoded(draw_cloud(made, Options(color_by=color_by, axis="z")).data)
        np.testing.assert_allclose(shown.scalars, expected)
    assert decoded(draw_cloud(made, Options(color_by="flat")).data).scalars is None


def test_an_occupancy_grid(decoded):
    grid = message("nav_msgs/msg/OccupancyGrid", "map", 0, data=[-1, 0, 100, 50, 0, 0])
    grid.info.width, grid.info.height, grid.info.resolution = 3, 2, 0.5
    grid.info.origin.position.x = -4.0
    shown = decoded(draw_grid(grid, Options()).data)
    assert shown.cells.tolist() == [[-1, 0, 100], [50, 0, 0]]
    assert (shown.resolution, shown.corner) == (0.5, [-4.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0])
    for number in (float("nan"), 1e300):
        grid.info.origin.position.x = number
        with pytest.raises(CannotDrawError, match="is not a finite 32-bit number"):
            draw_grid(grid, Options())
    grid.info.width = 4_000_000_000
    with pytest.raises(CannotDrawError, match="4000000000 x 2 cells has data for 6"):
        draw_grid(grid, Options())


def test_invalid_clouds_and_scans_are_not_drawn():
    made = cloud("map", 0, {"x": [1.0], "y": [1.0], "z": [1.0]})
    made.width = 4_000_000_000
    with pytest.raises(CannotDrawError, match="too few"):
        draw_cloud(made, Options())
    made = cloud("map", 0, {"x": [1.0], "y": [1.0]})
    with pytest.raises(CannotDrawError, match="no field 'z'"):
        draw_cloud(made, Options())
    nothing = scan("map", 0, [])
    nothing.angle_increment = float("nan")
    assert draw_scan(nothing, Options()).frame == "map"


def test_a_large_cloud_is_thinned_to_what_the_page_can_draw(decoded):
    made = cloud("map", SECOND, {axis: np.arange(1000.0) for axis in "xyz"} | {"intensity": np.arange(1000.0)})
    shown = decoded(draw_cloud(made, Options(color_by="intensity", max_points=300)).data)
    np.testing.assert_array_equal(shown.points[:, 0], np.arange(0, 1000, 4))
    np.testing.assert_array_equal(shown.scalars, np.arange(0, 1000, 4))
    assert shown.step == 4
    assert len(decoded(draw_cloud(made, Options()).data).points) == 1000


def image(encoding, height, width, step, data):
    made = message("sensor_msgs/msg/Image", "camera", SECOND, height=height, width=width, step=step)
    made.encoding, made.data = encoding, array("B", data)
    return made


def test_images_are_thinned_to_the_pixels_that_a_page_needs(decoded):
    received = decoded(draw_image(image("mono8", 2, 3, 4, [1, 2, 3, 0, 4, 5, 6, 0]), Options()).data)
    assert (received.width, received.height, received.format, received.step) == (3, 2, 0, 1)
    assert received.data.tolist() == [1, 2, 3, 4, 5, 6]
    received = decoded(draw_image(image("bgra8", 1, 2, 8, range(8)), Options(origin=SECOND)).data)
    assert (received.format, received.stamp, received.data.tolist()) == (1, 0.0, [2, 1, 0, 6, 5, 4])
    large = np.arange(1000 * 2000, dtype=np.uint32).astype(np.uint8).reshape(1000, 2000)
    received = decoded(draw_image(image("mono8", 1000, 2000, 2000, large.tobytes()), Options()).data)
    assert received.width * received.height <= DEFAULT_IMAGE_PIXELS
    blocks = large[:999, :1998].reshape(333, 3, 666, 3).astype(int).sum(axis=(1, 3)) // 9
    np.testing.assert_array_equal(received.data.reshape(received.height, received.width), blocks)


def jpeg(width, height, before=b""):
    size = b"\xff\xc2\x00\x11\x08" + height.to_bytes(2, "big") + width.to_bytes(2, "big") + bytes(10)
    return b"\xff\xd8" + before + size


def compressed(data, image_format="jpeg"):
    made = message("sensor_msgs/msg/CompressedImage", "camera", SECOND, format=image_format)
    made.data = array("B", data)
    return made


def test_a_compressed_image_is_sent_unchanged(decoded):
    data = jpeg(640, 480, before=b"\xff\xe0\x00\x06abcd\xff\xff")
    received = decoded(draw_compressed_image(compressed(data), Options()).data)
    assert (received.width, received.height, received.format) == (640, 480, 2)
    assert received.data.tobytes() == data


@pytest.mark.parametrize(
    ("draw", "made", "reason"),
    [
        (draw_image, image("32SC2", 1, 1, 8, bytes(8)), "image encoding '32SC2'"),
        (draw_image, image("rgb8", 2, 2, 6, bytes(11)), "has only 11 bytes"),
        (draw_image, image("rgb8", 2, 2, 5, bytes(12)), "5 per row"),
        (draw_image, image("mono8", 4_000_000_000, 4_000_000_000, 4_000_000_000, bytes(4)), "has only 4 bytes"),
        (draw_image, image("mono8", 0, 0, 0, b""), "no pixels"),
        (draw_compressed_image, compressed(b"GIF89a", "gif"), "image format 'gif'"),
        (draw_compressed_image, compressed(b""), "image format 'jpeg'"),
        (draw_compressed_image, compressed(jpeg(60_000, 60_000)), "is too large"),
        (draw_compressed_image, compressed(b"\x89PNG\r\n\x1a\n"), "is incomplete"),
        (draw_compressed_image, compressed(b"\xff\xd8\xff\xe0\x00\x00" * 9), "contains no image size"),
    ],
)
def test_an_image_that_cannot_be_drawn_gives_the_reason(draw, made, reason):
    with pytest.raises(CannotDrawError, match=reason):
        draw(made, Options())
