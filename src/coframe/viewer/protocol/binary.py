"""What travels between the viewer's server and its page, over one WebSocket.

Text messages are JSON objects with a ``type``. Binary messages are little endian and begin with their kind as uint32.
Times are nanoseconds relative to the ``origin`` that ``hello`` names (the decimal text of an int64), so that a
float64 holds them exactly. Frame names, topics and robot descriptions are data and never HTML. Poses are x, y, z in
metres and a quaternion x, y, z, w; NaN where there is none.

Server to page, text:

* ``hello`` {version, mode: "live" | "recording" | "buffer", title, origin, span: [first, last] | null, fixed, rviz,
  topics, can_publish}. Sent first, and again where the origin has to be another one: all times start anew.
* ``tree`` {revision, fixed, frames: [{name, parent: index or -1, static, component: index}], components: [{root,
  size}]}. Whenever the structure or the chosen fixed frame has changed. Ticks and statistics keep its order and name
  its revision.
* ``stats`` {revision, span, frames: [{rate: Hz, age: s, last: ns, publisher, samples, longest_gap: s, state: "static"
  | "fresh" | "stale" | "gone"}]}, once a second, of very many frames less often; null for what does not apply. Of roots
  the state is "static".
* ``topics`` {topics: [{topic, type, display}]}: what can be displayed, whenever that has changed.
* ``robot`` {id, name, source, urdf, meshes: {as written: URL}, problems: [text], warnings: [text],
  joints: [{name, type, lower, upper, value}], description_topic}: problems are what cannot be drawn, warnings what is
  odd about the description.
* ``display`` {id, state: "ok" | "waiting" | "error", text}: what became of a subscribed display.
* ``rviz`` {displays: [{class, name, enabled, options}], global, view, unknown: [{path, class, name}]}.
* ``relation`` {id, ok, target, source, stamp, translation, quaternion, rpy_deg, matrix, static_command, chain, error,
  hint, broken_at}: the answer to ``relate``.
* ``timeline`` {revision, bins, from, to, edges: [{frame, counts: base64 of uint16[bins], gaps: [[from, to]]}]}.
* ``findings`` {state: "none" | "waiting" | "told" | "failed", text, findings: [{code, severity: "error" | "warning" |
  "note", title, subject, frames, text, why, fix, publishers, first: ns | null, namespace, explains: [likewise]}]}: what
  the doctor says, whenever that has changed; frames are those whose rows it concerns, text is why it says nothing.
* ``page`` {code, title, text}: the page of a code, Markdown.
* ``saved`` {text}, ``problem`` {text, hint}, ``replay`` {looks}: what to fetch the announced replay by, as
  ``/replay?from=&to=&rate=&fixed=&looks=``.

Server to page, binary:

* 1, tick: uint32 kind, revision; float64 time (NaN: nothing yet), origin x, y, z; uint32 frames, entries; for each
  frame float32[7]; for each frame uint8 state (0 as asked, 1 stale, 2 gone, 3 not connected: seen from its own root);
  padding to four bytes; for each entry uint32 display, sequence, float32[7] pose of the message's frame, uint32 1
  where it cannot be told. A position in the world is the origin plus what is told. Entries are all messages that are
  to be seen: several of one display where it decays, or where its markers are in several frames. What is not listed
  any more is gone.
* 2, cloud: uint32 kind, display, sequence, n, flags (1 scalars, 2 colours, 256 k: every k-th point); float64 stamp;
  float32 least and largest
  scalar; float32[n * 3] in the message's frame; float32[n] scalars or uint8[n * 4] colours.
* 3, grid: uint32 kind, display, sequence, width, height; float32 resolution; float32[7] pose of the corner; int8
  cells.
* 4, shapes: uint32 kind, display, sequence, length of the JSON; the JSON, padded by spaces to four bytes; float32
  payload. The JSON has kind: "poses" | "path" | "odometry" | "markers" | "range" | "camera", frame, stamp and, where
  numbers are many, [offset, count] in the payload, both in floats.
* 5, image: uint32 kind, display, sequence, width, height, format (0 grey, 1 red, green and blue, 2 JPEG, 3 PNG; 256 k:
  every k-th row and column); float64 stamp; the bytes. It is shown beside the scene: its pose means nothing.

Page to server, text: ``fixed`` {frame}; ``time`` {mode: "live"} or {mode: "at", at, playing, speed, loop: [from, to]
| null}; ``step`` {direction}; ``subscribe`` {id, topic, display, options}; ``unsubscribe`` {id}; ``relate`` {id,
target, source}; ``timeline`` {from, to, bins}; ``joints`` {robot, positions, publish}; ``load_rviz`` {text};
``save_rviz`` {displays, global, view}; ``replay`` {displays: [{topic, options}], rviz: {displays, global, view}}:
how a replay is to look; ``frame_timeout`` {seconds}; ``frame_rate`` {hertz}: ticks a second, 1 to 60, as a .rviz file's
Frame Rate; ``explain`` {code}; ``ready`` {drawn}: the last tick is drawn, the next may come.

What is unknown or malformed is answered by a ``problem``; a message of more than 1 MiB ends the connection.
"""

from __future__ import annotations

import json
import struct
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

__all__ = ["VERSION", "EntryPose", "cloud", "grid", "image", "shapes", "stamp_drawing", "text", "tick"]

VERSION = 1
TICK, CLOUD, GRID, SHAPES, IMAGE = 1, 2, 3, 4, 5
SCALARS, COLOURS = 1, 2
GREY, RGB, JPEG, PNG = 0, 1, 2, 3


class EntryPose(NamedTuple):
    """Where a displayed message is: the pose of its frame, (7,), in the fixed frame; None if that cannot be told."""

    display: int
    sequence: int
    pose: NDArray[np.float64] | None


def text(kind: str, **fields: Any) -> str:
    """A text message."""
    return json.dumps({"type": kind, **fields}, separators=(",", ":"), allow_nan=False)


def tick(
    revision: int,
    time: float,
    origin: NDArray[np.float64],
    poses: NDArray[np.float32],
    states: NDArray[np.uint8],
    entries: Sequence[EntryPose],
) -> bytes:
    """All frames, (N, 7) relative to the origin with their states (N,), and the displayed messages, at one time."""
    head = struct.pack("<II4dII", TICK, revision, time, *origin.tolist(), len(poses), len(entries))
    parts: list[Any] = [head, poses.data, states.data, bytes(-len(states) % 4)]
    for entry in entries:
        pose = np.full(7, np.nan) if entry.pose is None else near(entry.pose, origin)
        parts.append(struct.pack("<II7fI", entry.display, entry.sequence, *pose.tolist(), int(entry.pose is None)))
    return b"".join(parts)


def near(poses: NDArray[np.float64], origin: NDArray[np.float64]) -> NDArray[np.float32]:
    """Poses as float32 without losing what is far away: (..., 7) relative to the local origin."""
    local = poses.copy()
    local[..., :3] -= origin
    with np.errstate(over="ignore"):  # what is too far for float32 is infinitely far
        small: NDArray[np.float32] = local.astype("<f4")
    return small


def cloud(
    stamp: float,
    points: NDArray[np.float32],
    scalars: NDArray[np.float32] | None,
    colours: NDArray[np.uint8] | None,
    step: int = 1,
) -> bytearray:
    """Points (N, 3) with one number (N,) or one colour (N, 4) each; every so-manieth of those that there are."""
    flags = (SCALARS if scalars is not None else 0) | (COLOURS if colours is not None else 0) | step << 8
    least, largest = _range_of(scalars)
    head = struct.pack("<IIIIIdff", CLOUD, 0, 0, len(points), flags, stamp, least, largest)
    parts: list[Any] = [head, np.ascontiguousarray(points, "<f4")]
    if scalars is not None:
        parts.append(np.ascontiguousarray(scalars, "<f4"))
    if colours is not None:
        parts.append(np.ascontiguousarray(colours))
    return _joined(parts)


def grid(resolution: float, corner: Sequence[float], cells: NDArray[np.int8]) -> bytearray:
    """The cells of an occupancy grid, (height, width), and the pose of its corner."""
    height, width = cells.shape
    head = struct.pack("<IIIII8f", GRID, 0, 0, width, height, resolution, *corner)
    return _joined([head, np.ascontiguousarray(cells)])


def shapes(description: dict[str, Any], payload: NDArray[np.float32]) -> bytearray:
    """A description with the numbers that it points to."""
    words = json.dumps(description, separators=(",", ":"), allow_nan=False).encode()
    words += b" " * (-len(words) % 4)
    return _joined([struct.pack("<IIII", SHAPES, 0, 0, len(words)), words, payload.astype("<f4")])


def image(kind: int, width: int, height: int, data: NDArray[np.uint8], stamp: float, step: int = 1) -> bytearray:
    """A picture: pixels (height, width, 1 or 3), or the bytes of a file; every so-manieth row and column of it."""
    head = struct.pack("<IIIIIId", IMAGE, 0, 0, width, height, kind | step << 8, stamp)
    return _joined([head, np.ascontiguousarray(data)])


def stamp_drawing(drawing: bytearray, display: int, sequence: int) -> None:
    """Notes in a drawing whose it is."""
    struct.pack_into("<II", drawing, 4, display, sequence)


def _joined(parts: Sequence[Any]) -> bytearray:
    return bytearray().join(parts)


def _range_of(scalars: NDArray[np.float32] | None) -> tuple[float, float]:
    """The least and the largest finite one."""
    if scalars is None or not scalars.size:
        return 0.0, 0.0
    finite = scalars[np.isfinite(scalars)]
    return (float(finite.min()), float(finite.max())) if finite.size else (0.0, 0.0)
