# SPDX-License-Identifier: Apache-2.0
"""The packets of a video that the page receives: all since the last key frame, each once."""

import struct
from array import array
from types import SimpleNamespace

import pytest

from coframe.messages import find
from coframe.viewer.displays import CannotDrawError, Options
from coframe.viewer.displays.kinds._video import codec_of
from coframe.viewer.displays.resources import Resources
from coframe.viewer.displays.rows import make_renderer
from coframe.viewer.sources.topic_messages import StampedMessage

START = b"\0\0\0\1"
KEY = {"h264": START + b"\x67\x42\xc0\x1f" + START + b"\x65\xaa", "h265": START + bytes([19 << 1, 1]) + b"\xaa"}
DELTA = {"h264": START + b"\x41\xbb", "h265": START + bytes([1 << 1, 1]) + b"\xbb"}
NAMES = {"h264": "avc1.42c01f", "h265": "hev1.1.6.L123.B0"}


class Stream:
    """A topic with one message for each letter: "k" is a key frame, "d" depends on the one before."""

    type = "sensor_msgs/msg/CompressedImage"

    def __init__(self, letters, codec):
        self.stored = []
        for key, letter in enumerate(letters, start=1):
            image = find(self.type)(format=codec)
            image.data = array("B", (KEY if letter == "k" else DELTA)[codec] + bytes([key]))
            self.stored.append(StampedMessage(key, key, lambda image=image: image))

    def after(self, key, last):
        return self.stored[key:last]


def packets(drawing):
    """Return whether the packets continue, the codec, and whether each is a key frame, with its number."""
    data = bytes(drawing.data[32:])
    continues, codec = struct.unpack_from("<I32s", data)
    found, at = [], 36
    while at < len(data):
        is_key, size = struct.unpack_from("<II", data, at)
        found.append((bool(is_key), data[at + 8 + size - 1]))
        at += 8 + size
    return bool(continues), codec.rstrip(b"\0").decode(), found


@pytest.mark.parametrize("codec", ["h264", "h265"])
def test_a_stream_begins_with_a_key_frame_and_continues_without_gaps(codec):
    stream = Stream("kddkddd", codec)
    renderer = make_renderer(stream, Options(), Resources())

    def draw(number):
        (drawing,) = renderer.draw(stream.stored[number - 1], 0, 0)
        return packets(drawing)

    assert draw(3) == (False, NAMES[codec], [(True, 1), (False, 2), (False, 3)])
    assert draw(5)[::2] == (True, [(True, 4), (False, 5)]), "skipped messages are decoded, too"
    assert draw(7)[::2] == (True, [(False, 6), (False, 7)])
    assert draw(2)[::2] == (False, [(True, 1), (False, 2)]), "a jump back begins at a key frame"


def test_a_stream_without_a_key_frame_gives_the_reason():
    stream = Stream("ddd", "h264")
    with pytest.raises(CannotDrawError, match="no key frame in the last 2 messages"):
        make_renderer(stream, Options(), Resources()).draw(stream.stored[1], 0, 0)


@pytest.mark.parametrize("encoding", ["h264", "libx264", "h264_nvenc"])
def test_packets_of_ffmpeg_image_transport(encoding):
    """Their definition is not part of coframe: recordings contain it."""
    stream = Stream("kdd", "h264")
    stream.type = "ffmpeg_image_transport_msgs/msg/FFMPEGPacket"
    for i, stored in enumerate(stream.stored):
        image = stored.read()
        packet = SimpleNamespace(header=image.header, encoding=encoding, data=image.data)
        stream.stored[i] = stored._replace(read=lambda packet=packet: packet)
    renderer = make_renderer(stream, Options(), Resources())
    (drawing,) = renderer.draw(stream.stored[2], 0, 0)
    assert packets(drawing) == (False, NAMES["h264"], [(True, 1), (False, 2), (False, 3)])
    stream.stored[0].read().encoding = "av1"
    with pytest.raises(CannotDrawError, match=r"'av1' cannot be displayed\. Known encodings: h264, h265"):
        renderer.draw(stream.stored[0], 0, 0)


def test_formats_name_their_codec():
    names = {
        "h264": "h264",
        "H.264": "h264",
        "hevc": "h265",
        "libx265; yuv420p": None,
        "jpeg": None,
        "video/avc": "h264",
    }
    assert {name: codec_of(name) for name in names} == names
