# SPDX-License-Identifier: Apache-2.0
"""cv_bridge, compared with calls of OpenCV."""

import sys
from array import array

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from cv_bridge import CvBridge, CvBridgeError, cvtColorForDisplay, getCvType
from cv_bridge.boost.cv_bridge_boost import CV_MAT_CNWrap, CV_MAT_DEPTHWrap, cvtColor2
from sensor_msgs.msg import CompressedImage, Image
from std_msgs.msg import Header

BRIDGE = CvBridge()
RANDOM = np.random.default_rng(3)
COLORS = {
    **{f"{name}{bits}": (name.upper(), len(name), bits) for name in ("rgb", "bgr", "rgba", "bgra") for bits in (8, 16)},
    **{f"mono{bits}": ("GRAY", 1, bits) for bits in (8, 16)},
}


def pixels(encoding, height=6, width=8):
    dtype, channels = BRIDGE.encoding_to_dtype_with_channels(encoding)
    shape = (height, width) if channels == 1 else (height, width, channels)
    if np.issubdtype(dtype, np.floating):
        return RANDOM.normal(size=shape).astype(dtype)
    limits = np.iinfo(dtype)
    return RANDOM.integers(limits.min, limits.max, shape, dtype, endpoint=True)


def message(encoding, **size):
    return BRIDGE.cv2_to_imgmsg(pixels(encoding, **size), encoding)


@pytest.mark.parametrize("depth", ["8U", "8S", "16U", "16S", "32S", "32F", "64F"])
@pytest.mark.parametrize("channels", [1, 2, 3, 4])
def test_types_are_those_of_opencv(depth, channels):
    name = f"{depth}C{channels}"
    number = getattr(cv2, f"CV_{name}")
    assert getCvType(name) == BRIDGE.encoding_to_cvtype2(name) == number
    assert BRIDGE.cvtype_to_name[number] == name
    dtype, found = BRIDGE.cvtype2_to_dtype_with_channels(number)
    assert (found, CV_MAT_CNWrap(number), CV_MAT_DEPTHWrap(number)) == (channels, channels, number % 8)
    assert BRIDGE.dtype_with_channels_to_cvtype2(np.dtype(dtype), channels) == name
    image = pixels(name)
    sent = BRIDGE.cv2_to_imgmsg(image)
    assert (sent.encoding, sent.height, sent.width, sent.step) == (name, 6, 8, 8 * channels * image.itemsize)
    assert np.array_equal(BRIDGE.imgmsg_to_cv2(sent), image)
    assert BRIDGE.imgmsg_to_cv2(sent).dtype == image.dtype


def test_images_are_views_of_the_message():
    header = Header(frame_id="camera")
    sent = BRIDGE.cv2_to_imgmsg(pixels("bgr8"), "bgr8", header=header)
    assert sent.header == header
    image = BRIDGE.imgmsg_to_cv2(sent)
    assert np.shares_memory(image, np.frombuffer(sent.data, np.uint8))
    image[0, 0] = (1, 2, 3)
    assert list(sent.data[:3]) == [1, 2, 3]
    assert BRIDGE.imgmsg_to_cv2(sent, "bgr8") is not None
    assert BRIDGE.imgmsg_to_cv2(sent, desired_encoding="rgb8")[0, 0].tolist() == [3, 2, 1]


@pytest.mark.parametrize("source", COLORS)
@pytest.mark.parametrize("target", COLORS)
def test_colors_and_depths_are_converted(source, target):
    (before, _, bits), (after, channels, new_bits) = COLORS[source], COLORS[target]
    image = pixels(source)
    expected = image if before == after else cv2.cvtColor(image, getattr(cv2, f"COLOR_{before}2{after}"))
    if (bits, new_bits) == (8, 16):
        expected = expected.astype(np.uint16) * 257
    elif (bits, new_bits) == (16, 8):
        expected = ((expected.astype(np.int64) * 2 + 257) // 514).astype(np.uint8)  # The nearest of 255 values.
    found = BRIDGE.imgmsg_to_cv2(BRIDGE.cv2_to_imgmsg(image, source), target)
    assert (found.dtype, found.ndim) == (f"uint{new_bits}", 2 if channels == 1 else 3)
    assert np.array_equal(found, expected)


@pytest.mark.parametrize("bits", [8, 16])
@pytest.mark.parametrize("pattern", ["rggb", "bggr", "gbrg", "grbg"])
def test_bayer_patterns(pattern, bits):
    # In an image of one color, each pixel of the sensor measures one component of the color.
    color = {"r": 200, "g": 100, "b": 50}
    tile = np.array([[color[pattern[0]], color[pattern[1]]], [color[pattern[2]], color[pattern[3]]]])
    raw = np.tile(tile, (4, 5)).astype(f"uint{bits}")
    sent = BRIDGE.cv2_to_imgmsg(raw, f"bayer_{pattern}{bits}")
    assert (BRIDGE.imgmsg_to_cv2(sent, f"rgb{bits}") == [200, 100, 50]).all()
    assert (BRIDGE.imgmsg_to_cv2(sent, f"bgr{bits}") == [50, 100, 200]).all()
    gray = cv2.cvtColor(np.array([[[50, 100, 200]]], np.uint8), cv2.COLOR_BGR2GRAY)
    assert (BRIDGE.imgmsg_to_cv2(sent, f"mono{bits}")[2:-2, 2:-2] == gray).all()
    assert BRIDGE.imgmsg_to_cv2(sent, "8UC1" if bits == 8 else "16UC1").shape == raw.shape


@pytest.mark.parametrize("target", ["mono8", "rgb8", "bgr8", "rgba8", "bgra8"])
def test_brightness_and_color_encodings(target):
    # One color, in limited range as cameras send it: brightness 81, blue difference 90, red difference 240 is red.
    y, u, v = 81, 90, 240
    height, width = 4, 6
    uyvy = np.tile(np.array([[u, y], [v, y]], np.uint8), (height, width // 2, 1))
    yuyv = np.tile(np.array([[y, u], [y, v]], np.uint8), (height, width // 2, 1))
    luma = np.full((height, width), y, np.uint8)
    nv21 = np.vstack([luma, np.tile(np.array([v, u], np.uint8), (height // 2, width // 2))])
    nv24 = np.vstack([luma, np.tile(np.array([u, v], np.uint8), (2 * height, width // 2))])
    colors = {
        "mono8": 81,
        "rgb8": [254, 0, 0],
        "bgr8": [0, 0, 254],
        "rgba8": [254, 0, 0, 255],
        "bgra8": [0, 0, 254, 255],
    }
    for names, image in (
        (("yuv422", "uyvy"), uyvy),
        (("yuv422_yuy2", "yuyv"), yuyv),
        (("nv21",), nv21),
        (("nv24",), nv24),
    ):
        for name in names:
            sent = BRIDGE.cv2_to_imgmsg(image, name)
            assert (sent.height, sent.width) == (height, width), name
            found = BRIDGE.imgmsg_to_cv2(sent, target)
            assert found.shape[:2] == (height, width)
            assert np.abs(found.astype(int) - colors[target]).max() <= 1, name
            assert np.array_equal(BRIDGE.imgmsg_to_cv2(sent), image)


@pytest.mark.parametrize("encoding", ["mono8", "bgr8", "mono16", "rgb16", "32FC1", "64FC2"])
@pytest.mark.parametrize("big", [False, True])
def test_padding_and_byte_order(encoding, big):
    image = pixels(encoding, height=5, width=7)
    swapped = image.astype(image.dtype.newbyteorder(">" if big else "<"))
    rows = [row.tobytes() + b"padding" for row in swapped]
    sent = Image(height=5, width=7, encoding=encoding, is_bigendian=big, step=len(rows[0]), data=b"".join(rows))
    found = BRIDGE.imgmsg_to_cv2(sent)
    assert np.array_equal(found, image)
    assert found.dtype.isnative
    assert found.flags.c_contiguous
    again = BRIDGE.cv2_to_imgmsg(swapped, encoding)
    assert again.is_bigendian == (big and image.itemsize > 1)
    assert np.array_equal(BRIDGE.imgmsg_to_cv2(again), image)


@given(st.sampled_from(["uint8", "int8", "uint16", "int16", "int32", "float32", "float64"]), st.data())
def test_values_are_rounded_and_limited_as_by_opencv(dtype, data):
    image = np.array(data.draw(st.lists(st.floats(-70000, 70000, width=32), min_size=4, max_size=4)), np.float32)
    found = cvtColor2(image.reshape(2, 2), "32FC1", f"{BRIDGE.numpy_type_to_cvtype[dtype]}C1").reshape(-1)
    if np.issubdtype(dtype, np.floating):
        assert np.array_equal(found, image.astype(dtype))
    else:
        limits = np.iinfo(dtype)
        assert found.tolist() == [max(limits.min, min(limits.max, round(value))) for value in image.tolist()]


@pytest.mark.parametrize("target", ["8U", "8S", "16U", "16S", "32S"])
@pytest.mark.parametrize("source", ["8U", "8S", "16U", "16S", "32S", "32F", "64F"])
def test_extreme_values_are_limited(source, target):
    before, after = (np.dtype(BRIDGE.numpy_type_to_cvtype[name]) for name in (source, target))
    limits = np.iinfo(after)
    values = [-1e30, np.inf, np.nan] if before.kind == "f" else [np.iinfo(before).min, np.iinfo(before).max, 1]
    expected = (
        [limits.min, limits.max, limits.min]
        if before.kind == "f"
        else [max(limits.min, min(limits.max, value)) for value in values]
    )
    if {source, target} == {"8U", "16U"}:
        expected = [0, limits.max, 257 if target == "16U" else 0]
    elif {source[:-1], target[:-1]} == {"8", "16"}:  # Images of 8 and 16 bits are scaled to each other.
        factor = 257 if target[:2] == "16" else 1 / 257
        expected = [max(limits.min, min(limits.max, round(value * factor))) for value in values]
    found = cvtColor2(np.array([values], before), f"{source}C1", f"{target}C1")
    assert found.dtype == after
    assert found[0].tolist() == expected


@pytest.mark.parametrize(
    ("source", "target", "text"),
    [
        ("16UC1", "mono8", r"\[16UC1\] is not a color format. but \[mono8\] is. The conversion does not make sense"),
        ("32FC1", "16UC3", r"\[32FC1\] and \[16UC3\] do not have the same number of channel"),
        ("bgr8", "32FC1", r"\[bgr8\] is a color format but \[32FC1\] is not so they must have the same OpenCV type"),
        ("mono8", "bayer_rggb8", r"Unsupported conversion from \[mono8\] to \[bayer_rggb8\]"),
        ("bayer_rggb8", "rgba8", r"Unsupported conversion from \[bayer_rggb8\] to \[rgba8\]"),
        ("bgr8", "yuv422", r"Unsupported conversion from \[bgr8\] to \[yuv422\]"),
        ("bgr8", "pink8", r"Unrecognized image encoding \[pink8\]"),
    ],
)
def test_conversions_without_meaning(source, target, text):
    with pytest.raises(CvBridgeError, match=text):
        BRIDGE.imgmsg_to_cv2(message(source), target)
    with pytest.raises(RuntimeError, match=text):
        cvtColor2(pixels(source), source, target)


def test_wrong_arrays_and_messages():
    with pytest.raises(CvBridgeError, match="encoding specified as mono8, but image has incompatible type 8UC3"):
        BRIDGE.cv2_to_imgmsg(pixels("bgr8"), "mono8")
    with pytest.raises(CvBridgeError, match=r"values of type int64. Use astype"):
        BRIDGE.cv2_to_imgmsg(np.zeros((2, 2), np.int64))
    with pytest.raises(TypeError, match="Your input type is not a numpy array"):
        BRIDGE.cv2_to_imgmsg([[1]])
    for broken in (
        Image(height=2, width=2, encoding="mono8", step=2, data=array("B", [0] * 3)),
        Image(height=2, width=2, encoding="mono8", step=1, data=array("B", [0] * 4)),
        Image(height=2**31, width=2**31, encoding="bgr8", step=2**32 - 1, data=array("B", [0] * 4)),
    ):
        with pytest.raises(CvBridgeError, match="data of the image does not have the size of the image"):
            BRIDGE.imgmsg_to_cv2(broken)
    assert BRIDGE.imgmsg_to_cv2(Image(encoding="mono8")).shape == (0, 0)
    assert len(BRIDGE.cv2_to_imgmsg(np.zeros((0, 4, 3), np.uint8), "rgb8").data) == 0
    with pytest.raises(CvBridgeError, match="OpenCV cannot convert"):
        BRIDGE.imgmsg_to_cv2(message("nv21", height=3, width=5), "bgr8")


@pytest.mark.parametrize("suffix", ["png", "jpg", "bmp"])
def test_compressed_images(suffix):
    image = cv2.GaussianBlur(pixels("bgr8", height=32, width=40), (0, 0), 5)
    sent = BRIDGE.cv2_to_compressed_imgmsg(image, dst_format=suffix)
    assert sent.format == suffix
    found = BRIDGE.compressed_imgmsg_to_cv2(sent)
    assert np.abs(found.astype(int) - image).max() <= (12 if suffix == "jpg" else 0)
    swapped = BRIDGE.compressed_imgmsg_to_cv2(sent, "rgb8")
    assert np.array_equal(swapped, found[..., ::-1])
    assert BRIDGE.compressed_imgmsg_to_cv2(sent, "mono8").shape == (32, 40)
    gray = BRIDGE.cv2_to_compressed_imgmsg(image[..., 0], suffix)
    assert BRIDGE.compressed_imgmsg_to_cv2(gray, "bgr8").shape == (32, 40, 3)


def test_compressed_images_that_cannot_be_read_or_written():
    for data in (b"", b"not an image"):
        broken = CompressedImage(format="jpeg", data=data)
        assert BRIDGE.compressed_imgmsg_to_cv2(broken) is None
        with pytest.raises(CvBridgeError, match=f"cannot read the {len(data)} bytes .* 'jpeg'"):
            BRIDGE.compressed_imgmsg_to_cv2(broken, "bgr8")
    with pytest.raises(CvBridgeError, match="cannot write the image as 'nothing'"):
        BRIDGE.cv2_to_compressed_imgmsg(pixels("bgr8"), "nothing")
    depth = pixels("mono16")
    again = BRIDGE.compressed_imgmsg_to_cv2(BRIDGE.cv2_to_compressed_imgmsg(depth, "png"))
    assert np.array_equal(again, depth)


def test_images_for_display():
    depth = np.array([[0.5, 1.0], [1.5, np.nan]], np.float32)
    assert cvtColorForDisplay(depth, "32FC1", "", True).tolist() == [[0, 128], [255, 0]]
    assert cvtColorForDisplay(depth, "32FC1", "bgr8", True, 0.0, 2.0)[0, 1].tolist() == [128, 128, 128]
    assert cvtColorForDisplay(np.array([[257 * 3]], np.uint16), "16UC1", "").tolist() == [[3]]
    assert cvtColorForDisplay(np.array([[[1, 2, 3]]], np.uint8), "rgb8", "").tolist() == [[[3, 2, 1]]]
    with pytest.raises(RuntimeError, match="dynamic scaling"):
        cvtColorForDisplay(depth, "32FC1", "")


def test_only_conversions_need_opencv(monkeypatch):
    monkeypatch.setitem(sys.modules, "cv2", None)
    sent = message("bgr8")
    assert BRIDGE.imgmsg_to_cv2(sent, "8UC3").shape == BRIDGE.imgmsg_to_cv2(sent).shape
    for action in (
        lambda: BRIDGE.imgmsg_to_cv2(sent, "rgb8"),
        lambda: BRIDGE.compressed_imgmsg_to_cv2(CompressedImage()),
        lambda: BRIDGE.cv2_to_compressed_imgmsg(pixels("bgr8")),
    ):
        with pytest.raises(ModuleNotFoundError, match=r"cv2, which is not installed: pip install 'coframe\[opencv\]'"):
            action()
