# SPDX-License-Identifier: Apache-2.0
# ruff: noqa: E501 - tables of rigs
"""Cameras: each usual mistake in a mount or a CameraInfo is named with its number, and right rigs have no finding."""

import re

import numpy as np
import pytest
from recordings import START
from runs import MS, Run, stamp_message
from scipy.spatial.transform import Rotation

from coframe.messages import find

OPTICAL = Rotation.from_euler("xyz", [-90, 0, -90], True)
LEFT_PLACE = np.array([0.6, 0.13, 0.4])
BASELINE = 0.26
LEFT = Rotation.from_euler("xyz", [0.4, 2.1, -1.3], True) * OPTICAL
WITHIN = Rotation.from_rotvec([0.011, -0.006, 0.008])  # of the right camera relative to the left one
K = np.array([[700.0, 0.0, 640.0], [0.0, 700.0, 360.0], [0.0, 0.0, 1.0]])
PLUMB_BOB = [-0.28, 0.07, 0.0002, 0.0001, 0.0]
FISHEYE = [0.05, -0.01, 0.003, -0.0005]


def info(frame, *, model="plumb_bob", d=PLUMB_BOB, tx=0.0, k=K, r=None, size=(1280, 720)):
    message = find("sensor_msgs/msg/CameraInfo")(width=size[0], height=size[1], distortion_model=model)
    message.header.frame_id = frame
    message.k, message.d = np.ravel(k).tolist(), list(d)
    message.r = np.ravel(np.eye(3) if r is None else r.as_matrix()).tolist()
    message.p = np.column_stack([k, [tx, 0.0, 0.0]]).ravel().tolist()
    return message


def rig(edges, infos):
    run = Run.healthy(seconds=2, skip={"static", "scan"})
    for parent, child, turn, place in edges:
        run.tf(parent, child, START, place, turn.as_quat(), static=True)
    for topic, message in infos.items():
        for number in range(4):
            at = START + (200 + 400 * number) * MS
            message.header.stamp = stamp_message(at)
            run.message(topic, "sensor_msgs/msg/CameraInfo", message, at + 30 * MS)
    return run


def single(turn=LEFT, place=LEFT_PLACE, frame="front_optical_frame", **fields):
    return rig([("base_link", frame, turn, place)], {"/front/camera_info": info(frame, **fields)})


def right_mount():
    """Return the pose of the right camera on the base, which the calibration below states exactly."""
    return LEFT * WITHIN, LEFT_PLACE + LEFT.apply(BASELINE * baseline_axis())


def baseline_axis():
    return np.array([0.9998, 0.011, -0.0166]) / np.linalg.norm([0.9998, 0.011, -0.0166])


def rectifying():
    """Return R of both cameras: the x axis of the rectified frame is the baseline."""
    x = baseline_axis()
    y = np.cross([0.0, 0.0, 1.0], x)
    y /= np.linalg.norm(y)
    first = Rotation.from_matrix([x, y, np.cross(x, y)])
    return first, first * WITHIN


def stereo(*, left=None, right=None, tx=-700.0 * BASELINE, swap=False, chained=False):
    turn, place = right_mount()
    mounts = [(LEFT, LEFT_PLACE) if left is None else left, (turn, place) if right is None else right]
    edges = [
        ("base_link", f"{side}_optical_frame", *mount) for side, mount in zip(("left", "right"), mounts, strict=True)
    ]
    if chained:
        inside = LEFT.inv() * turn, LEFT.inv().apply(place - LEFT_PLACE)
        edges[1] = ("left_optical_frame", "right_optical_frame", *(inside if right is None else right))
    first, second = rectifying()
    infos = [info("left_optical_frame", r=first), info("right_optical_frame", r=second, tx=tx)]
    if swap:
        infos = [info("left_optical_frame", r=first, tx=tx), info("right_optical_frame", r=second)]
    return rig(edges, dict(zip(("/left/camera_info", "/right/camera_info"), infos, strict=True)))


def order(turn, shift):
    return Rotation.from_quat(np.roll(turn.as_quat(), shift))


RIGHT_TURN, RIGHT_PLACE = right_mount()
GL = Rotation.from_euler("x", 180, True)
INVERSE = RIGHT_TURN.inv(), -RIGHT_TURN.inv().apply(RIGHT_PLACE)
STEREO = {
    "w first": ({"right": (order(RIGHT_TURN, 1), RIGHT_PLACE)}, "if its quaternion"),
    "inverse": ({"right": INVERSE}, "if it is inverted"),
    "OpenGL": ({"right": (RIGHT_TURN * Rotation.from_euler("x", 180, True), RIGHT_PLACE)}, "axes are those of OpenGL"),
    "upside down": (
        {"right": (RIGHT_TURN * Rotation.from_euler("z", 180, True), RIGHT_PLACE)},
        "180 degrees about its z",
    ),
    "value of P": ({"tx": -84.0}, r"P\[3\] = -84 states a baseline of 0.12 m, but by the transforms it is 0.26 m"),
    "sign of P": ({"tx": 700.0 * BASELINE}, "the sign of Tx is wrong, or the two cameras"),
    "swapped": ({"swap": True}, "the sign of Tx is wrong, or the two cameras or their frames are swapped"),
    "millimeters in P": ({"tx": -700.0 * BASELINE * 1000}, r"they agree if P\[3\] is in millimeters"),
    "centimeters in P": ({"tx": -700.0 * BASELINE * 100}, r"they agree if P\[3\] is in centimeters"),
    "body, both": (
        {"left": (LEFT * OPTICAL.inv(), LEFT_PLACE), "right": (RIGHT_TURN * OPTICAL.inv(), RIGHT_PLACE)},
        "differs from P and R of the pair by 373 mm .* both cameras: its rotation is that of the camera's body",
    ),
    "OpenGL, both": (
        {"left": (LEFT * GL, LEFT_PLACE), "right": (RIGHT_TURN * GL, RIGHT_PLACE)},
        "z axis points backward instead of forward; .* turned by 180 degrees about its x axis",
    ),
    "millimeters, one": ({"right": (RIGHT_TURN, RIGHT_PLACE * 1000)}, "agree within 0 mm .* read in millimeters"),
    "centimeters, both": (
        {"left": (LEFT, LEFT_PLACE * 100), "right": (RIGHT_TURN, RIGHT_PLACE * 100)},
        "by 25.7 m and 0 degrees; they agree within 0 mm .* both cameras: its translation is read in centimeters",
    ),
    "inches, both": (
        {"left": (LEFT, LEFT_PLACE / 0.0254), "right": (RIGHT_TURN, RIGHT_PLACE / 0.0254)},
        "both cameras: its translation is read in inches",
    ),
    "no focal length in P": (
        {"tx": -BASELINE},
        r"P\[3\] = -0.26 .* is the baseline in meters, without the focal length",
    ),
    "inches in P": ({"tx": -700.0 * BASELINE / 0.0254}, r"they agree if P\[3\] is in inches"),
}


@pytest.mark.parametrize("name", STEREO)
def test_stereo_pairs_that_contradict_their_calibration(examine, name):
    fields, text = STEREO[name]
    report = examine(stereo(**fields))
    found = [one for one in report.findings if one.code in {"TF021", "TF030"}]
    assert any(re.search(text, one.text) for one in found), "\n".join(one.text for one in found)


def test_the_corrected_mount_is_suggested(examine):
    found = [one for one in examine(stereo(right=INVERSE)).findings if one.code == "TF030"]
    x = RIGHT_PLACE[0]
    assert f"--child-frame-id right_optical_frame --x {x:.9g}" in found[0].fix


@pytest.mark.parametrize(
    ("fields", "text"),
    [
        ({"model": "plumb bob"}, "named 'plumb bob', which ROS programs do not know: 'plumb_bob' is meant"),
        ({"model": "Equidistant", "d": FISHEYE}, "'equidistant' is meant"),
        ({"model": "radtan", "d": PLUMB_BOB[:4]}, "'plumb_bob' is meant"),
        ({"model": "plump_bob"}, "'plump_bob' is unknown. Did you mean 'plumb_bob'"),
        ({"model": "equidistant"}, "with 5 coefficients, and it has 4 (k1, k2, k3, k4); 5 coefficients are those of plumb_bob"),
        ({"d": [0.3, 0.02, 0.001, -0.0005, 0.001, 0.6, 0.1, 0.01]}, "those of rational_polynomial are meant"),
        ({"d": [-0.9, 0.05, 0.0, 0.0, 0.0]}, "of the pixels have no ray"),
        ({"k": np.diag([0.5, 0.5, 1.0]) @ K}, "it is the K of an image of 640 x 360"),
        ({"k": np.diag([2.0, 2.0, 1.0]) @ K}, "it is the K of an image of 2560 x 1440"),
    ],
)  # fmt: skip
def test_calibrations_that_contradict_themselves(only, fields, text):
    finding = only(single(**fields), "TF030")
    assert text in finding.text
    assert finding.text.startswith("/front/camera_info: ")


def test_angles_that_are_round_only_with_w_first(only):
    right = Rotation.from_euler("xyz", [0.004, 0.03, 0.02]) * OPTICAL
    finding = only(single(order(right, 1)), "TF021")
    assert "2.95 degrees from one with round angles: roll 0.2292, pitch 1.719, yaw 1.146 degrees" in finding.text


def test_values_of_the_optical_frame_on_the_body_of_a_camera(only):
    edges = [
        ("camera_link", "camera_optical_frame", OPTICAL, np.zeros(3)),
        ("base_link", "camera_link", LEFT, LEFT_PLACE),
    ]
    finding = only(rig(edges, {"/camera/camera_info": info("camera_optical_frame")}), "TF021")
    assert "'camera_link' is the body of a camera, and is rotated like its optical frame" in finding.text
    assert finding.edge == ("base_link", "camera_link")
    driver = [("color_frame", "color_optical_frame", OPTICAL, np.zeros(3)),
              ("camera_link", "color_frame", body(0.1, 0.2, -0.1), [0.0, 0.015, 0.0]), edges[1]]  # fmt: skip
    assert only(rig(driver, {"/camera/camera_info": info("color_optical_frame")}), "TF021").edge == finding.edge
    hand = [("camera_link", "camera_optical_frame", OPTICAL, np.zeros(3)),
            ("tool0", "camera_link", Rotation.from_euler("xyz", [2, -1, 88], True), [0.05, 0.0, 0.04]),
            ("base_link", "tool0", Rotation.from_euler("x", 170, True), [0.4, 0.0, 0.5])]  # fmt: skip
    assert only(rig(hand, {"/camera/camera_info": info("camera_optical_frame")}), "TF021").edge[1] == "camera_link"


@pytest.mark.parametrize(
    ("frame", "yaw", "wrong", "text"),
    [
        ("rear_optical_frame", 178, lambda turn: turn * GL, "looks backward if it is turned by 180 degrees about its x axis"),
        ("CAM_BACK", 181, lambda turn: turn * OPTICAL.inv(), "/front/camera_info, and therefore optical, but its z axis points up instead of backward"),
        ("left_side_optical", 92, lambda turn: turn * GL, "looks left if "),
        ("cam_right", -91, lambda turn: turn * OPTICAL.inv(), "its z axis points up instead of right"),
        ("cam0", 1, lambda turn: turn * OPTICAL.inv(), "therefore optical, but is not rotated relative to 'base_link'"),
    ],
)  # fmt: skip
def test_names_of_frames_say_where_cameras_look(only, frame, yaw, wrong, text):
    turn = body(0.3, 1.2, yaw) * OPTICAL
    assert text in only(single(wrong(turn), frame=frame), "TF021").text


def test_camera_info_in_the_frame_of_the_body(only):
    edges = [("camera_link", "camera_optical_frame", OPTICAL, [0.0, 0.015, 0.0]),
             ("base_link", "camera_link", body(0.3, 2.0, -0.4), LEFT_PLACE)]  # fmt: skip
    finding = only(rig(edges, {"/camera/camera_info": info("camera_link")}), "TF030")
    assert "its frame 'camera_link' is the body of the camera, and pixels are in its optical frame" in finding.text


def body(*degrees):
    return Rotation.from_euler("xyz", degrees, True)


def right_rigs():
    for name, degrees in {"front": (0.4, 2.1, -1.3), "rear": (0.3, 1.0, 178.2), "left": (0.1, 2.0, 91.2), "right": (1, 3, -88),
                          "nadir": (0.2, 88.5, 1.0), "down": (-1, 60, 2), "up": (1, -75, 3), "pitched": (0.5, 25.3, 0.7),
                          "corner": (-0.6, 10, 44), "aligned": (0, 0, 0), "hanging": (180, 0.3, 0.2),
                          "rear_aligned": (0, 0, 180)}.items():  # fmt: skip
        yield name, single(body(*degrees) * OPTICAL, frame=f"{name}_optical_frame")
    for name, yaw in {"rear": 179, "back": 185, "left": 88, "right": -93, "BACK_LEFT": 110, "zed_left": 1}.items():
        yield f"{name}, not named optical", single(body(0.6, 12.0, yaw) * OPTICAL, frame=f"cam_{name}")
    yield "rear, hanging", single(body(179.0, 2.0, 181.0) * OPTICAL, frame="rear_optical_frame")
    for name, fields in {
        "fisheye": {"model": "equidistant", "d": FISHEYE}, "fisheye, zeros": {"model": "equidistant", "d": [0.0] * 4},
        "fisheye, other name": {"model": "fisheye", "d": FISHEYE}, "kb4": {"model": "kannala_brandt4", "d": FISHEYE},
        "double sphere": {"model": "double_sphere", "d": [-0.2, 0.6]}, "no distortion": {"d": []}, "zeros": {"d": [0.0] * 5},
        "empty name": {"model": "", "d": []}, "four": {"d": PLUMB_BOB[:4]},
        "rational": {"model": "rational_polynomial", "d": [0.51, -2.72, 0.0003, -0.0002, 1.6, 0.39, -2.54, 1.52]},
        "uncalibrated": {"k": np.zeros((3, 3)), "d": []}, "off center": {"k": K + np.array([[0, 0, 60], [0, 0, -40], [0, 0, 0]])},
        "simulated fisheye with five zeros": {"model": "equidistant", "d": [0.0] * 5},
    }.items():  # fmt: skip
        yield name, single(**fields)
    yield "stereo", stereo()
    yield "stereo with one mount on the other", stereo(chained=True)
    yield "baseline in P only", stereo(right=(LEFT, LEFT_PLACE))
    turn, place = right_mount()
    yield (
        "stereo, calibrated again",
        stereo(right=(turn * body(0.2, -0.1, 0.3), place + np.array([0.002, 0.001, -0.001]))),
    )
    both = [
        ("base_link", f"{side}_optical_frame", LEFT, LEFT_PLACE + LEFT.apply([x, 0, 0]))
        for side, x in (("l", 0), ("r", 0.5))
    ]
    yield (
        "rectified pair",
        rig(both, {"/l/camera_info": info("l_optical_frame"), "/r/camera_info": info("r_optical_frame", tx=-350.0)}),
    )
    three = [*both, ("base_link", "wide_optical_frame", body(0, 5, 90) * OPTICAL, [0.2, 0.4, 0.4])]
    yield "pair and a third camera", rig(three, {
        "/l/camera_info": info("l_optical_frame"), "/r/camera_info": info("r_optical_frame", tx=-350.0),
        "/wide/camera_info": info("wide_optical_frame")})  # fmt: skip
    driver = [
        ("base_link", "camera_link", body(0.3, 2.0, -0.4), [0.3, 0.0, 0.4]),
        ("camera_link", "camera_optical_frame", OPTICAL, [0.0, 0.015, 0.0]),
    ]
    yield "camera of a driver", rig(driver, {"/camera/camera_info": info("camera_optical_frame")})
    hand = [
        ("tool0", "camera_link", body(1.2, -90.4, 2.0), [0.05, 0.0, 0.04]),
        ("camera_link", "camera_optical_frame", OPTICAL, [0, 0, 0]),
    ]
    yield (
        "on a gripper",
        rig(
            [*hand, ("base_link", "tool0", body(170, 3, 10), [0.4, 0.0, 0.5])],
            {"/c/camera_info": info("camera_optical_frame")},
        ),
    )


def test_right_rigs_have_no_finding(examine):
    rigs = dict(right_rigs())
    assert len(rigs) >= 30
    for number, (name, run) in enumerate(rigs.items()):
        report = examine(run, folder=str(number))
        assert report.findings == [], f"{name}: " + "\n".join(one.text for one in report.findings)
