# SPDX-License-Identifier: Apache-2.0
"""Checks of arguments: each returns the value as the viewer uses it, or raises an error that names the argument."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from coframe.transform.transform import Transform
from coframe.viewer.scripting.errors import SceneError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from coframe.viewer.protocol.common import Pose

__all__ = [
    "MAX_COORDINATE",
    "MAX_NAME",
    "MAX_TEXT",
    "number_of",
    "parse_faces",
    "parse_flag",
    "parse_name",
    "parse_quaternion",
    "parse_text",
    "parse_vector",
    "parse_vertices",
    "pose_of",
]

MAX_NAME = 200  # characters
MAX_TEXT = 1000  # characters
MAX_COORDINATE = 1e9  # meters
_KINDS = {"b": "booleans", "O": "objects", "S": "bytes", "U": "text", "c": "complex numbers"}


def parse_name(value: Any) -> str:
    """Return the name of a node without slashes at its ends: the path of the node."""
    if not isinstance(value, str):
        raise SceneError(f"name: expected a string such as 'camera/cloud', not {_quote_shortened(value)}")
    name = value.strip("/")
    if not all(part.strip() for part in name.split("/")):
        raise SceneError(
            f"name: {_quote_shortened(value)} has an empty part", hint="Use a name such as 'camera/cloud'."
        )
    if len(name) > MAX_NAME:
        raise SceneError(f"name: {len(name)} characters exceed the maximum of {MAX_NAME}")
    return name


def parse_text(value: Any, argument: str, most: int = MAX_TEXT) -> str:
    """Return a string of limited length."""
    if not isinstance(value, str):
        raise SceneError(f"{argument}: expected a string, not {_quote_shortened(value)}")
    if len(value) > most:
        raise SceneError(f"{argument}: {len(value)} characters exceed the maximum of {most}")
    return value.encode(errors="replace").decode()  # Half of a surrogate pair is not a character.


def parse_flag(value: Any, argument: str) -> bool:
    """Return a boolean."""
    if not isinstance(value, bool | np.bool_):
        raise SceneError(f"{argument}: expected True or False, not {_quote_shortened(value)}")
    return bool(value)


def number_of(value: Any, argument: str, low: float = -math.inf, high: float = math.inf) -> float:
    """Return a finite number between two limits."""
    if isinstance(value, bool | np.bool_ | str | bytes):
        raise SceneError(f"{argument}: expected a number, not {_quote_shortened(value)}")
    try:
        number = float(value)
    except (TypeError, ValueError, OverflowError):
        raise SceneError(f"{argument}: expected a number, not {_quote_shortened(value)}") from None
    if not math.isfinite(number):
        raise SceneError(f"{argument}: expected a finite number, not {number}")
    if not low <= number <= high:
        wanted = f"from {low:g} to {high:g}" if math.isfinite(high) else f"of at least {low:g}"
        raise SceneError(f"{argument}: expected a number {wanted}, not {number:g}")
    return number


def parse_vector(value: Any, argument: str) -> tuple[float, float, float]:
    """Return a position in meters, (3,)."""
    x, y, z = _parse_array(value, argument, [(3,)], "three numbers, in meters").tolist()
    return x, y, z


def parse_radii(value: Any, argument: str = "radius") -> NDArray[np.float64]:
    """Return one radius, or three along x, y and z, in meters."""
    radii = np.asarray(value) if isinstance(value, list | tuple | np.ndarray) else np.empty(())
    numbers = [value] if radii.ndim == 0 else parse_vector(value, argument)
    return np.array([number_of(number, argument, 0.0, MAX_COORDINATE) for number in numbers])


def parse_quaternion(value: Any, argument: str = "quaternion") -> tuple[float, float, float, float]:
    """Return a normalized quaternion x, y, z, w, (4,)."""
    numbers = _parse_array(value, argument, [(4,)], "a quaternion x, y, z, w")
    length = float(np.linalg.norm(numbers))
    if length < 1e-6:
        raise SceneError(f"{argument}: a quaternion of length {length:g} is not a rotation", hint="Use (0, 0, 0, 1).")
    x, y, z, w = (numbers / length).tolist()
    return x, y, z, w


def pose_of(value: Any, argument: str = "pose") -> Pose:
    """Return the numbers x, y, z, qx, qy, qz, qw of a single transform."""
    if not isinstance(value, Transform):
        raise SceneError(
            f"{argument}: expected a coframe.Transform, not {_quote_shortened(value)}",
            hint="Pass position=(x, y, z) and quaternion=(x, y, z, w), or coframe.Transform(position, quaternion).",
        )
    if value.shape:
        raise SceneError(f"{argument}: expected one transform, not a batch of shape {value.shape}")
    return *parse_vector(value.translation, argument), *parse_quaternion(value.quaternion, argument)


def parse_vertices(value: Any, argument: str, shapes: Sequence[tuple[int | None, ...]]) -> NDArray[np.float64]:
    """Return positions in meters of one of the given shapes; None stands for any number."""
    return _parse_array(value, argument, shapes, "positions in meters")


def parse_faces(value: Any, argument: str, vertices: int) -> NDArray[np.uint32]:
    """Return indices of vertices, (N, 3)."""
    faces = _numbers(value, argument)
    if faces.ndim != 2 or faces.shape[1] != 3:
        raise SceneError(f"{argument}: expected the shape (N, 3), three indices for each triangle, not {faces.shape}")
    if faces.dtype.kind not in "iu":
        raise SceneError(f"{argument}: expected whole numbers, the indices of vertices, not {faces.dtype}")
    if faces.size and not (int(faces.min()) >= 0 and int(faces.max()) < vertices):
        wrong = int(faces.min()) if int(faces.min()) < 0 else int(faces.max())
        raise SceneError(f"{argument}: no vertex has the index {wrong}; there are {vertices} vertices")
    return faces.astype(np.uint32)


def _parse_array(
    value: Any, argument: str, shapes: Sequence[tuple[int | None, ...]], meaning: str
) -> NDArray[np.float64]:
    numbers = _numbers(value, argument)
    if not any(_matches(numbers.shape, shape) for shape in shapes):
        wanted = " or ".join(_shape(shape) for shape in shapes)
        raise SceneError(f"{argument}: expected the shape {wanted}, {meaning}, not {numbers.shape}")
    finite = np.isfinite(numbers)
    if not finite.all():
        rows = int((~finite.reshape(len(numbers), -1).all(axis=1)).sum()) if numbers.ndim > 1 else 1
        where = f"{rows} of {len(numbers)} rows contain" if numbers.ndim > 1 else f"{numbers.tolist()} contains"
        hint = f"Keep the others: {argument}[np.isfinite({argument}).all(axis=1)]" if numbers.ndim == 2 else ""
        raise SceneError(f"{argument}: {where} NaN or infinity", hint=hint)
    if numbers.size and float(np.abs(numbers).max()) > MAX_COORDINATE:
        raise SceneError(f"{argument}: {np.abs(numbers).max():g} exceeds the maximum of {MAX_COORDINATE:g}")
    return numbers.astype(np.float64)


def _numbers(value: Any, argument: str) -> NDArray[Any]:
    try:
        numbers = np.asarray(value)
    except (TypeError, ValueError):  # rows of different lengths
        raise SceneError(f"{argument}: expected an array of numbers, not {_quote_shortened(value)}") from None
    if numbers.dtype.kind not in "iuf":
        kind = _KINDS.get(numbers.dtype.kind, str(numbers.dtype))
        raise SceneError(f"{argument}: expected an array of numbers, not of {kind}")
    return numbers


def _matches(shape: tuple[int, ...], wanted: tuple[int | None, ...]) -> bool:
    return len(shape) == len(wanted) and all(
        size is None or size == actual for actual, size in zip(shape, wanted, strict=True)
    )


def _shape(shape: tuple[int | None, ...]) -> str:
    sizes = ["N" if size is None else str(size) for size in shape]
    return f"({sizes[0]},)" if len(sizes) == 1 else f"({', '.join(sizes)})"


def _quote_shortened(value: Any) -> str:
    try:
        text = repr(value)
    except Exception:  # noqa: BLE001 - the value may be anything
        text = type(value).__name__
    return text if len(text) <= 60 else f"{text[:57]}..."
