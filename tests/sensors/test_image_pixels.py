# SPDX-License-Identifier: Apache-2.0
"""Pixels of images equal those of OpenCV, and damaged depth images raise errors."""

import struct
from types import SimpleNamespace

import numpy as np
import pytest

from coframe.errors import DecodeError
from coframe.sensors.depth_images import decode_compressed_depth, decode_gray_png, decode_rvl
from coframe.sensors.image_pixels import decode_image

HEIGHT, WIDTH = 48, 64
RANDOM = np.random.default_rng(7)


def image(encoding, pixels, *, height=None, is_bigendian=False):
    return SimpleNamespace(
        encoding=encoding,
        height=height or pixels.shape[0],
        width=pixels.shape[1],
        step=pixels.strides[0],
        is_bigendian=is_bigendian,
        data=pixels.tobytes(),
    )


def smooth(dtype=np.uint8):
    """Return an image whose values differ little between neighbors, as those of cameras do."""
    coarse = RANDOM.integers(0, np.iinfo(dtype).max, (6, 8))
    rows, columns = np.linspace(0, 5, HEIGHT), np.linspace(0, 7, WIDTH)
    along = np.stack([np.interp(columns, np.arange(8), row) for row in coarse])
    return np.stack([np.interp(rows, np.arange(6), column) for column in along.T], axis=1).astype(dtype)


@pytest.mark.parametrize(("name", "opencv"), [("rggb", "BG"), ("bggr", "RG"), ("gbrg", "GR"), ("grbg", "GB")])
@pytest.mark.parametrize("bits", [8, 16])
def test_bayer_images_equal_those_of_opencv(name, opencv, bits):
    cv2 = pytest.importorskip("cv2")
    raw = smooth(np.uint8 if bits == 8 else np.uint16)
    expected = cv2.cvtColor(raw, getattr(cv2, f"COLOR_Bayer{opencv}2RGB")).astype(float)
    found = decode_image(image(f"bayer_{name}{bits}", raw)).astype(float)
    scale = 1.0 if bits == 8 else 255.0 / 65535.0
    np.testing.assert_allclose(found[1:-1, 1:-1], expected[1:-1, 1:-1] * scale, atol=1.0)


@pytest.mark.parametrize(
    ("encoding", "code"),
    [
        ("yuv422", "UYVY"),
        ("uyvy", "UYVY"),
        ("yuv422_yuy2", "YUY2"),
        ("yuyv", "YUY2"),
        ("nv12", "NV12"),
        ("nv21", "NV21"),
    ],
)
def test_yuv_images_equal_those_of_opencv(encoding, code):
    cv2 = pytest.importorskip("cv2")
    if code.startswith("NV"):
        pixels = np.vstack([smooth(), smooth()[: HEIGHT // 2]])
        made = image(encoding, pixels, height=HEIGHT)
    else:
        pixels = np.stack([smooth(), smooth()], axis=-1)
        made = image(encoding, pixels)
    expected = cv2.cvtColor(pixels, getattr(cv2, f"COLOR_YUV2RGB_{code}"))
    np.testing.assert_allclose(decode_image(made).astype(int), expected.astype(int), atol=2)


def test_measured_values_keep_their_unit():
    depths = np.array([[1.5, np.nan], [np.inf, -2.0]])
    np.testing.assert_array_equal(decode_image(image("64FC1", depths)), depths.astype(np.float32))
    big = np.array([[1, 40_000]], ">u2")
    assert decode_image(image("mono16", big, is_bigendian=True)).tolist() == [[1, 40_000]]
    assert decode_image(image("16SC1", np.array([[-5, 7]], "<i2"))).tolist() == [[-5.0, 7.0]]


@pytest.mark.parametrize(
    ("made", "reason"),
    [
        (image("8UC2", np.zeros((2, 2, 2), np.uint8)), "'8UC2' is not supported"),
        (image("h264", np.zeros((2, 2), np.uint8)), "'h264' is not supported"),
        (image("nv12", np.zeros((3, 3), np.uint8), height=2), "even size"),
        (image("nv12", np.zeros((2, 2), np.uint8)), "has only 4 bytes"),
        (image("yuv422", np.zeros((2, 3, 2), np.uint8)), "even size"),
        (image("bayer_rggb8", np.zeros((1, 4), np.uint8)), "too small"),
        (image("mono16", np.zeros((0, 4), np.uint16)), "no pixels"),
    ],
)
def test_images_that_cannot_be_decoded_raise_an_error(made, reason):
    with pytest.raises(DecodeError, match=reason):
        decode_image(made)


def compressed(content, encoding="16UC1", parameters=(0.0, 0.0)):
    header = struct.pack("<iff", 0, *parameters)
    return SimpleNamespace(format=f"{encoding}; compressedDepth", data=header + content)


def encode_rvl(depths):
    """Return depths in the format RVL: numbers in groups of three bits, lowest first."""
    groups = []

    def add(number):
        while True:
            more = number > 7
            groups.append(number & 7 | (8 if more else 0))
            number >>= 3
            if not more:
                return

    flat = depths.reshape(-1).tolist()
    at, before = 0, 0
    while at < len(flat):
        zeros = next((i for i, value in enumerate(flat[at:]) if value), len(flat) - at)
        add(zeros)
        at += zeros
        measured = next((i for i, value in enumerate(flat[at:]) if not value), len(flat) - at)
        add(measured)
        for value in flat[at : at + measured]:
            change = value - before
            add(2 * change if change >= 0 else -2 * change - 1)
            before = value
        at += measured
    groups += [0] * (-len(groups) % 8)
    words = [
        sum(group << (28 - 4 * i) for i, group in enumerate(groups[at : at + 8])) for at in range(0, len(groups), 8)
    ]
    return struct.pack("<ii", depths.shape[1], depths.shape[0]) + np.array(words, "<u4").tobytes()


def depths_with_holes():
    depths = smooth(np.uint16) // 16
    depths[5:9, 10:30] = 0
    return depths


def test_depths_in_rvl_are_decoded():
    depths = depths_with_holes()
    np.testing.assert_array_equal(decode_compressed_depth(compressed(encode_rvl(depths))), depths)


@pytest.mark.parametrize("level", [1, 9])
def test_depths_in_png_equal_those_that_opencv_has_written(level):
    cv2 = pytest.importorskip("cv2")
    depths = depths_with_holes()
    _, png = cv2.imencode(".png", depths, [cv2.IMWRITE_PNG_COMPRESSION, level])
    np.testing.assert_array_equal(decode_compressed_depth(compressed(png.tobytes())), depths)
    meters = decode_compressed_depth(compressed(png.tobytes(), "32FC1", (100.0, 2.0)))
    assert np.isnan(meters[6, 20])
    np.testing.assert_allclose(meters[20, 20], 100.0 / (float(depths[20, 20]) - 2.0), rtol=1e-6)


def test_damaged_depth_images_raise_an_error():
    whole = encode_rvl(depths_with_holes())
    for length in range(0, len(whole), 7):
        with pytest.raises(DecodeError):
            decode_rvl(whole[:length])
    with pytest.raises(DecodeError, match="no header"):
        decode_compressed_depth(SimpleNamespace(format="16UC1; compressedDepth", data=b"1"))
    for size in (-1, 0, 1 << 30):
        with pytest.raises(DecodeError):
            decode_rvl(struct.pack("<ii", size, 1 << 20) + bytes(400))
    with pytest.raises(DecodeError):
        decode_gray_png(b"\x89PNG\r\n\x1a\n" + b"\0\0\0\rIHDR" + struct.pack(">IIBBBBB", 4, 4, 16, 0, 0, 0, 0))
