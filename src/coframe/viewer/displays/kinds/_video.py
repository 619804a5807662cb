# SPDX-License-Identifier: Apache-2.0
"""Encoded video: each message is a part of a stream, which the browser decodes from the last key frame on."""

from __future__ import annotations

import struct
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from coframe.time import stamp_ns
from coframe.viewer.displays._drawing import CannotDrawError, Drawing, Options
from coframe.viewer.protocol.binary_messages import ImageFormat
from coframe.viewer.protocol.encoding import encode_image

if TYPE_CHECKING:
    from collections.abc import Iterator

    from coframe.viewer.sources.topic_messages import StampedMessage, TopicMessages

__all__ = ["VideoStream", "codec_of"]

MAX_PACKETS = 600
"""A key frame is searched in this many messages before the displayed one."""
MAX_STREAM_BYTES = 16 << 20
_H264, _H265 = "h264", "h265"
_NAMES = {"h264": _H264, "avc": _H264, "x264": _H264, "h265": _H265, "hevc": _H265, "x265": _H265}
_H264_KEY, _H264_PARAMETERS = 5, 7  # types of NAL units: an IDR picture, and the parameters of a sequence
_H265_KEYS = range(16, 22)  # types of NAL units at which decoding can begin
# HEVC Main profile, level 4.1; decoders accept other levels with it.
_H265_CODEC = "hev1.1.6.L123.B0"
_DEFAULT_H264_CODEC = "avc1.640028"


class _Packet(NamedTuple):
    data: bytes
    is_key: bool
    codec: str


def codec_of(name: str) -> str | None:
    """Return "h264" or "h265" for the format of a message, or None if it is not a video."""
    words = name.lower().replace(".", "").replace("_", " ").replace(";", " ").replace("/", " ").split()
    return next((_NAMES[word] for word in words if word in _NAMES), None)


class VideoStream:
    """Draws the parts of a stream that the page does not have."""

    def __init__(self, messages: TopicMessages, options: Options) -> None:
        self._messages = messages
        self._options = options
        self._last: int | None = None

    def draw(self, message: StampedMessage, newest: Any, codec: str) -> Drawing:
        """Return the packets since the previous call, or since the last key frame after a jump.

        Raises:
            CannotDrawError: There is no key frame.
        """
        continues = self._last is not None and 0 <= message.key - self._last <= MAX_PACKETS
        begin = self._last if continues and self._last is not None else max(0, message.key - MAX_PACKETS)
        found = [one.read() for one in self._messages.after(begin, message.key)] or [newest]
        packets = [_packet(bytes(one.data), codec) for one in found]
        if not continues:
            keys = [index for index, packet in enumerate(packets) if packet.is_key]
            if not keys:
                self._last = None
                raise CannotDrawError(f"the {codec} stream has no key frame in the last {len(packets)} messages")
            packets = packets[keys[-1] :]
        self._last = message.key
        if sum(len(packet.data) for packet in packets) > MAX_STREAM_BYTES:
            raise CannotDrawError(f"the packets since the last key frame have more than {MAX_STREAM_BYTES} bytes")
        stamp = stamp_ns(newest.header.stamp)
        content = np.frombuffer(_encode_packets(packets, continues=continues), np.uint8)
        data = encode_image(ImageFormat.VIDEO, 0, 0, content, float(stamp - self._options.origin))
        return Drawing(newest.header.frame_id, stamp, data, placed=False)


def _encode_packets(packets: list[_Packet], *, continues: bool) -> bytes:
    """Return the packets for the page: whether they continue, the codec, and each with its kind and size."""
    codec = next((packet.codec for packet in packets if packet.codec), "")
    parts = [struct.pack("<I32s", continues, codec.encode())]
    for packet in packets:
        parts += [struct.pack("<II", packet.is_key, len(packet.data)), packet.data]
    return b"".join(parts)


def _packet(data: bytes, codec: str) -> _Packet:
    """Return a packet; the codec is known only for packets with parameters."""
    is_key, name = False, ""
    for at in _units(data):
        if codec == _H264:
            kind = data[at] & 31
            is_key = is_key or kind == _H264_KEY
            if kind == _H264_PARAMETERS and at + 4 <= len(data):
                name = f"avc1.{data[at + 1 : at + 4].hex()}"
        elif (data[at] >> 1) & 63 in _H265_KEYS:
            is_key, name = True, _H265_CODEC
    return _Packet(data, is_key, name or (_DEFAULT_H264_CODEC if is_key else ""))


def _units(data: bytes) -> Iterator[int]:
    """Yield the positions of the NAL units, each of which follows the bytes 0, 0, 1."""
    at = data.find(b"\0\0\1")
    while 0 <= at < len(data) - 3:
        yield at + 3
        at = data.find(b"\0\0\1", at + 3)
