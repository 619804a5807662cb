# SPDX-License-Identifier: Apache-2.0
"""Markers, maps, covariances, clouds and images are drawn at the correct poses."""

import base64
import struct
import zlib
from array import array

import numpy as np
import pytest

import coframe
from coframe.messages import find, serialize

pytest.importorskip("mcap", reason="recordings need mcap")

from recordings import write_mcap

SECOND = 1_000_000_000
BEGIN = 1_700_000_000 * SECOND
ADD, DELETE, DELETE_ALL = 0, 2, 3
ARROW, CUBE, SPHERE, CYLINDER, LINE_STRIP, LINE_LIST, CUBE_LIST, _, POINTS, TEXT, _, TRIANGLES = range(12)


def stamped(ros_type, frame, stamp, **fields):
    made = find(ros_type)(**fields)
    made.header.frame_id = frame
    made.header.stamp.sec, made.header.stamp.nanosec = divmod(stamp, SECOND)
    return made


def marker(number, kind, *, at=(0.0, 0.0, 0.0), size=(1.0, 1.0, 1.0), stamp=BEGIN, frame="map", **fields):
    points = [find("geometry_msgs/msg/Point")(x=x, y=y, z=z) for x, y, z in fields.pop("points", [])]
    made = stamped("visualization_msgs/msg/Marker", frame, stamp, id=number, type=kind, points=points, **fields)
    made.pose.position.x, made.pose.position.y, made.pose.position.z = at
    made.pose.orientation.w = 1.0
    made.scale.x, made.scale.y, made.scale.z = size
    made.color.r = made.color.a = 1.0
    return made


def markers(*all_of_them, second=0):
    """Return a (topic, time, message) with markers."""
    for one in all_of_them:
        one.header.stamp.sec += second
    made = find("visualization_msgs/msg/MarkerArray")(markers=list(all_of_them))
    return "/markers", BEGIN + second * SECOND, made


def recording(path, *messages):
    """Write ten seconds in which base moves from x = 0 to x = 10 in map, with messages as (topic, time, message)."""
    rows, types = [], {}
    for tenth in range(101):
        at = BEGIN + tenth * SECOND // 10
        one = coframe.Buffer(None)
        one.set("map", "base", coframe.Transform([tenth / 10, 0.0, 0.0]), at)
        rows.append(("/tf", at, one.encode(static=False)))
    for topic, at, message in messages:
        types[topic] = (message.ROS_TYPE, "ros2msg", b"", "cdr")
        rows.append((topic, at, serialize(message)))
    return write_mcap(path / "shapes.mcap", rows=sorted(rows, key=lambda row: row[1]), types=types)


def display(topic):
    return f"Object.values(coframe.displays).find((one) => one.topic === '{topic}')"


def drawn_markers(page, topic="/markers"):
    """Return the drawn markers by (namespace, id)."""
    messages = page.evaluate(f"{display(topic)}?.messages ?? []")
    return {(one["ns"], one["id"]): one for message in messages for one in message["markers"]}


def go_to(page, second):
    """Move the playhead."""
    page.scrub(second / 10)
    page.settle()


def test_markers_of_many_types_have_the_correct_position_and_size(view, open_page, tmp_path):
    corners = [(0.0, 0.0, 0.0), (2.0, 0.0, 0.0), (0.0, 1.0, 0.0)]
    sent = [
        marker(0, ARROW, at=(0.0, 3.0, 0.0), size=(2.0, 0.2, 0.2)),
        marker(1, CUBE, at=(1.0, 2.0, 3.0), size=(0.5, 1.0, 2.0)),
        marker(2, SPHERE, at=(-1.0, 0.0, 0.0), size=(0.4, 0.4, 0.4)),
        marker(3, CYLINDER, at=(0.0, -2.0, 0.5), size=(0.6, 0.6, 1.0)),
        marker(4, LINE_STRIP, size=(0.01, 0.0, 0.0), points=corners),
        marker(5, LINE_LIST, size=(0.01, 0.0, 0.0), points=corners[:2]),
        marker(6, CUBE_LIST, size=(0.2, 0.2, 0.2), points=[(4.0, 0.0, 0.0), (4.0, 2.0, 0.0)]),
        marker(8, POINTS, size=(0.1, 0.1, 0.0), points=[(5.0, 0.0, 0.0), (5.0, 4.0, 0.0)]),
        marker(9, TEXT, at=(0.0, 0.0, 2.0), size=(0.0, 0.0, 0.3), text="<b>pallet</b>"),
        marker(11, TRIANGLES, points=corners),
    ]
    page = open_page(view(recording(tmp_path, markers(*sent)), fixed="map").url).drawn()
    page.wait(lambda: len(drawn_markers(page)) == len(sent), "all markers")
    expected = {  # center and size
        0: ((1.0, 3.0, 0.0), (2.0, 0.2, 0.2)),
        1: ((1.0, 2.0, 3.0), (0.5, 1.0, 2.0)),
        2: ((-1.0, 0.0, 0.0), (0.4, 0.4, 0.4)),
        3: ((0.0, -2.0, 0.5), (0.6, 0.6, 1.0)),
        4: ((1.0, 0.5, 0.0), (2.0, 1.0, 0.0)),
        5: ((1.0, 0.0, 0.0), (2.0, 0.0, 0.0)),
        6: ((4.0, 1.0, 0.0), (0.2, 2.2, 0.2)),
        8: ((5.0, 2.0, 0.0), (0.0, 4.0, 0.0)),  # squares that face the camera
        11: ((1.0, 0.5, 0.0), (2.0, 1.0, 0.0)),
    }
    shown = drawn_markers(page)
    for number, (center, size) in expected.items():
        np.testing.assert_allclose(shown["", number]["center"], center, atol=0.02, err_msg=f"marker {number}")
        np.testing.assert_allclose(shown["", number]["size"], size, atol=0.03, err_msg=f"marker {number}")


def test_markers_are_deleted_expire_and_move_with_their_frames(view, open_page, tmp_path):
    short = marker(3, CUBE)
    short.lifetime.sec = 2
    messages = (
        markers(marker(1, CUBE, ns="a"), marker(2, CUBE, ns="a"), marker(1, CUBE, ns="b"), short),
        markers(marker(2, CUBE, ns="a", action=DELETE), second=4),
        markers(marker(0, CUBE, action=DELETE_ALL), marker(9, CUBE), second=6),
        ("/locked", BEGIN, marker(1, CUBE, frame="base", frame_locked=True)),
        ("/loose", BEGIN, marker(1, CUBE, frame="base")),
    )
    page = open_page(view(recording(tmp_path, *messages), fixed="map").url).drawn()
    every = {("a", 1), ("a", 2), ("b", 1), ("", 3)}
    for second, expected in ((1, every), (3, every - {("", 3)}), (5, {("a", 1), ("b", 1)}), (7, {("", 9)}), (1, every)):
        go_to(page, second)
        page.wait(lambda expected=expected: set(drawn_markers(page)) == expected, f"markers at {second} s")
    go_to(page, 8)
    x = page.evaluate("coframe.frames.base.position[0]")
    for topic, expected in (("/locked", x), ("/loose", 0.0)):
        page.until(f"x => Math.abs(({display(topic)}.messages[0]?.markers[0]?.center[0] ?? NaN) - x) < 1e-3", expected)


def test_namespaces_are_hidden_in_the_panel(view, open_page, tmp_path):
    hostile = "<img src=x onerror=alert(1)>"
    sent = markers(marker(1, CUBE, ns="walls"), marker(1, CUBE, ns=hostile))
    page = open_page(view(recording(tmp_path, sent), fixed="map").url).drawn()
    page.wait(lambda: len(drawn_markers(page)) == 2, "both markers")
    page.tab("displays")
    page.click("#body-displays .card[data-display=MarkerArray] .card-title")
    page.wait(lambda: sorted(page.texts(".namespaces label")) == sorted(["walls", hostile]), "a checkbox per namespace")
    page.raw.locator(".namespaces label", has_text="walls").locator("input").focus()
    page.key("Space")
    page.wait(lambda: set(drawn_markers(page)) == {(hostile, 1)}, "the remaining marker")
    page.tab("rviz")
    with page.raw.expect_download() as download:
        page.click("#save-rviz")
    assert "Namespaces:\n      walls: false" in download.value.path().read_text()


@pytest.fixture
def grid():
    """Return 4 x 3 cells of 0.5 m with the corner at (1, 2), rotated by 90 degrees; one occupied, one unknown."""
    made = stamped("nav_msgs/msg/OccupancyGrid", "map", BEGIN)
    made.info.resolution, made.info.width, made.info.height = 0.5, 4, 3
    made.info.origin.position.x, made.info.origin.position.y = 1.0, 2.0
    made.info.origin.orientation.z = made.info.origin.orientation.w = np.sqrt(0.5)
    cells = np.zeros((3, 4), np.int8)
    cells[1, 3], cells[2, 0] = 100, -1
    made.data = array("b", cells.tobytes())
    return made


def test_map_cells_are_drawn_at_their_positions(grid, view, open_page, tmp_path):
    page = open_page(view(recording(tmp_path, ("/map", BEGIN, grid)), fixed="map").url).drawn()
    page.until(f"{display('/map')}?.messages?.length")
    go_to(page, 6)  # so that the frames extend as far as the map
    page.tab("displays")
    for other in ("Grid", "TF"):
        page.raw.uncheck(f"#body-displays input[aria-label='Show {other}']")
    page.click("#body-displays .card[data-display=Map] .card-title")
    page.raw.fill("#body-displays input[aria-label='Alpha']", "1")
    page.raw.press("#body-displays input[aria-label='Alpha']", "Tab")
    page.click("#overlay button:text('Top')")

    def brightness():
        """Return the brightness of each cell on the screen; row v, column u is at x = 1 - v / 2, y = 2 + u / 2."""
        centers = [[1 - (v + 0.5) / 2, 2 + (u + 0.5) / 2, 0.0] for v in range(3) for u in range(4)]
        return np.array(colors(page, centers)).mean(axis=1).reshape(3, 4)

    def is_painted():
        shown = brightness()
        free = np.delete(shown.ravel(), [7, 8])
        return shown[1, 3] < 20 and (free > 240).all() and 80 < shown[2, 0] < 180

    page.click("#overlay button[title^='Show everything']")
    page.wait(is_painted, "the cells")


def colors(page, points):
    """Return the RGB values of the canvas at points of the fixed frame."""
    image = base64.b64encode(page.raw.locator("#canvas").screenshot()).decode()
    return page.evaluate(
        """async ([data, points]) => {
            const image = new Image();
            image.src = 'data:image/png;base64,' + data;
            await image.decode();
            const canvas = document.createElement('canvas');
            [canvas.width, canvas.height] = [image.width, image.height];
            const context = canvas.getContext('2d', {willReadFrequently: true});
            context.drawImage(image, 0, 0);
            return points.map((point) => [...context.getImageData(...coframe.pixel(point), 1, 1).data].slice(0, 3));
        }""",
        [image, points],
    )


@pytest.mark.slow
def test_the_covariance_of_a_pose_is_drawn_if_enabled(view, open_page, tmp_path):
    pose = stamped("geometry_msgs/msg/PoseWithCovarianceStamped", "map", BEGIN)
    pose.pose.pose.position.x = 5.0
    pose.pose.pose.orientation.w = 1.0
    covariance = np.zeros((6, 6))
    covariance[0, 0], covariance[1, 1], covariance[2, 2] = 4.0, 0.25, 0.01  # 2 m, 0.5 m and 0.1 m
    covariance[5, 5] = np.arctan(0.75) ** 2
    pose.pose.covariance = covariance.ravel()
    page = open_page(view(recording(tmp_path, ("/pose", BEGIN, pose)), fixed="map").url).drawn()
    page.until(f"{display('/pose')}?.messages?.length")
    page.tab("displays")
    page.click("#body-displays .card[data-display=PoseWithCovariance] .card-title")

    def extent():
        shown = page.evaluate(f"{display('/pose')}.messages[0]")
        return np.array([shown["min"], shown["max"]])

    assert extent()[1, 0] < 5.6, "an arrow alone"
    box = "#body-displays input[aria-label='{}']"
    assert not page.raw.locator(box.format("Position")).is_visible()
    page.raw.check(box.format("Covariance"))
    page.raw.uncheck(box.format("Orientation"))
    page.wait(lambda: np.allclose(extent()[:, :2], [[3.0, -0.5], [7.0, 0.5]], atol=0.02), "the ellipsoid")
    page.raw.check(box.format("Orientation"))
    page.raw.uncheck(box.format("Position"))
    page.wait(lambda: np.allclose(extent()[:, :2], [[5.0, -0.75], [6.0, 0.75]], atol=0.02), "the cone")


def test_clouds_are_colored_by_an_axis_of_the_fixed_frame_or_their_own(view, open_page, tmp_path):
    field = find("sensor_msgs/msg/PointField")
    cloud = stamped("sensor_msgs/msg/PointCloud2", "tilted", BEGIN + SECOND)
    points = np.array([[0.0, 0.0, 0.0], [3.0, 0.0, 1.0]], "<f4")
    cloud.height, cloud.width, cloud.point_step, cloud.row_step = 1, len(points), 12, points.nbytes
    cloud.fields = [field(name=name, offset=4 * i, datatype=7, count=1) for i, name in enumerate("xyz")]
    cloud.data = array("B", points.tobytes())
    with coframe.open_bag(recording(tmp_path, ("/cloud", BEGIN + SECOND, cloud))) as bag:
        # The x axis of the cloud points up: the heights in the fixed frame are 0 and 3.
        bag.buffer.set("map", "tilted", coframe.Transform.from_rpy([0, 0, 0], [0, -np.pi / 2, 0]), static=True)
        page = open_page(view(bag, fixed="map").url).drawn()
        go_to(page, 5)
        page.until(f"{display('/cloud')}?.messages?.length")
        colors_of = f"{display('/cloud')}.messages[0].colors.map((value) => Math.round(value * 1e4) / 1e4)"
        page.until(f"JSON.stringify({colors_of}) === '[0,3]'")
        page.tab("displays")
        page.click("#body-displays .card[data-display=PointCloud2] .card-title")
        page.raw.uncheck("#body-displays input[aria-label='Use Fixed Frame']")
        page.until(f"{display('/cloud')}.messages.length && JSON.stringify({colors_of}) === '[0,1]'")


IMAGES = """() => [...document.querySelectorAll('#images figure:not([hidden])')].map((figure) => {
    const canvas = figure.querySelector('canvas');
    const pixel = (x, y) => [...canvas.getContext('2d').getImageData(x, y, 1, 1).data].slice(0, 3);
    const text = figure.querySelector('figcaption').textContent;
    return {text, size: [canvas.width, canvas.height], corners: [pixel(0, 0), pixel(canvas.width - 1, 0)]};
})"""


def test_camera_images_are_shown_without_a_transform_of_the_camera(view, open_page, tmp_path):
    pixels = np.zeros((4, 6, 3), np.uint8)
    pixels[0, 0], pixels[0, 5] = [10, 20, 30], [40, 50, 60]
    raw = stamped("sensor_msgs/msg/Image", "camera", BEGIN + SECOND, height=4, width=6, step=20, encoding="bgr8")
    raw.data = array("B", np.pad(pixels.reshape(4, 18), ((0, 0), (0, 2))).tobytes())
    packed = stamped("sensor_msgs/msg/CompressedImage", "camera", BEGIN + SECOND, format="rgb8; png compressed")
    packed.data = array("B", png(pixels))
    unsupported = stamped(
        "sensor_msgs/msg/Image", "camera", BEGIN + SECOND, height=1, width=1, step=2, encoding="32SC2"
    )
    topics = {"/raw": raw, "/packed": packed, "/unsupported": unsupported}
    messages = [(topic, BEGIN + SECOND, message) for topic, message in topics.items()]
    page = open_page(view(recording(tmp_path, *messages), fixed="map").url).drawn()
    page.tab("displays")
    for topic in topics:
        page.click("#add-display")
        page.click(f".add-row[data-topic='{topic}']")
    go_to(page, 5)
    shown = page.wait(
        lambda: len(found := page.evaluate(IMAGES)) == 2 and {one["text"]: one for one in found}, "both images"
    )
    assert shown["/raw"]["size"] == shown["/packed"]["size"] == [6, 4]
    assert shown["/packed"]["corners"] == [[10, 20, 30], [40, 50, 60]]
    assert shown["/raw"]["corners"] == [[30, 20, 10], [60, 50, 40]]
    assert "32SC2" in page.until(f"{display('/unsupported')}.state === 'error' && {display('/unsupported')}.text")
    go_to(page, 0)
    page.wait(lambda: not page.evaluate(IMAGES), "no image before the first message")


def png(pixels):
    """Encode an RGB image as PNG."""
    height, width, _ = pixels.shape
    rows = b"".join(b"\0" + row.tobytes() for row in pixels)

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    head = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")
