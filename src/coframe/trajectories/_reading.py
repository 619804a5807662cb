# SPDX-License-Identifier: Apache-2.0
"""Read trajectory files: TUM, KITTI, EuRoC, CSV and NumPy's npz."""

from __future__ import annotations

import decimal
import io
import re
import zipfile
from array import array
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, BinaryIO

import numpy as np

from coframe._files.regular_files import open_regular
from coframe.errors import InvalidArgumentException, TrajectoryError
from coframe.time import SECOND
from coframe.trajectories.formats import POSE_COLUMNS
from coframe.transform.transform import Transform

if TYPE_CHECKING:
    import os
    from collections.abc import Iterable, Sequence

    from numpy.typing import NDArray

__all__ = ["READABLE_FORMATS", "read_trajectory"]

READABLE_FORMATS = ("tum", "kitti", "euroc", "csv", "npz")
MAX_LINE = 10_000  # characters
MAX_POSES = 1_000_000  # 2.7 hours at 100 Hz
MAX_UNPACKED = 256 << 20  # bytes of an npz file after decompression
_SECONDS = re.compile(r"(-?)(\d+)(?:\.(\d*))?", re.ASCII)
_LATEST = 1 << 63
# The differences between the formats, for error messages.
_LAYOUTS = (
    "TUM has 8 columns separated by spaces (seconds x y z qx qy qz qw), KITTI has 12 (a 3x4 matrix), EuRoC has at "
    "least 8 separated by commas (ns, x, y, z, qw, qx, qy, qz), and CSV begins with a header line: "
    f"stamp_ns,{','.join(POSE_COLUMNS)}."
)


def read_trajectory(path: str | os.PathLike[str], format_: str | None = None) -> Transform:
    """Read the poses in a trajectory file.

    Args:
        path: The file.
        format_: ``tum``, ``kitti``, ``euroc``, ``csv`` or ``npz``; None detects it from the contents, because EuRoC and
            CSV have the same suffix.

    Returns:
        A batch of shape (N,), with stamps except for KITTI. Stamps are exact to the nanosecond. Only npz files contain
        the names of the frames.

    Raises:
        TrajectoryError: The file cannot be read, or its contents do not match the format.
        ValueError: The format is unknown.

    Example:
        >>> import tempfile
        >>> from pathlib import Path
        >>> file = Path(tempfile.mkdtemp()) / "run.tum"
        >>> _ = file.write_text("1700000000.000000001 1 2 3 0 0 0 1")
        >>> read_trajectory(file).stamps.tolist()
        [1700000000000000001]
    """
    if format_ is not None and format_ not in READABLE_FORMATS:
        raise ValueError(f"No format named {format_!r} that can be read. Formats: {', '.join(READABLE_FORMATS)}.")
    file = Path(path)
    try:
        with open_regular(file) as stream:
            is_zip = stream.read(2) == b"PK"
            stream.seek(0)
            if format_ == "npz" or (format_ is None and is_zip):
                return _read_npz(file, stream)
            text = io.TextIOWrapper(stream, encoding="utf-8-sig")
            return _read_text(file, iter(partial(text.readline, MAX_LINE + 1), ""), format_)
    except OSError as error:
        raise TrajectoryError(f"{file} cannot be read: {error.strerror or error}") from None
    except UnicodeDecodeError:
        raise TrajectoryError(f"{file} is not a trajectory: it is not a text file", hint=_LAYOUTS) from None
    except InvalidArgumentException as error:
        raise TrajectoryError(f"{file}: {error}", hint=error.hint) from None


def _read_text(file: Path, lines: Iterable[str], kind: str | None) -> Transform:
    numbers, stamps, columns, poses = array("d"), array("q"), 0, 0
    for number, line in enumerate(lines, start=1):
        if len(line) > MAX_LINE:
            raise TrajectoryError(f"{file} is not a trajectory: line {number} has more than {MAX_LINE} characters")
        text = line.strip()
        if text.startswith("stamp_ns,") and kind in {None, "csv"} and not columns:
            kind = "csv"
        if not text or text.startswith(("#", "stamp_ns,")):
            continue
        cells = [cell.strip() for cell in text.split(",")] if "," in text else text.split()
        if not columns:
            kind, columns = _checked_kind(file, number, kind, cells, "," in text), len(cells)
        poses += 1
        _check_number(file, poses)
        if len(cells) != columns:
            raise TrajectoryError(f"{file}, line {number}: {len(cells)} columns; the lines above have {columns}")
        try:
            if kind == "kitti":
                numbers.extend(map(float, cells))
            else:
                stamps.append(_nanoseconds(cells[0], SECOND if kind == "tum" else 1))
                numbers.extend(map(float, cells[1:8]))
        except (ValueError, OverflowError, decimal.DecimalException):
            raise TrajectoryError(f"{file}, line {number}: not a row of numbers: {text[:80]!r}") from None
    if not columns:
        raise TrajectoryError(f"{file} contains no poses", hint=_LAYOUTS)
    return _poses(file, str(kind), np.frombuffer(numbers), np.array(stamps, dtype=np.int64))


def _checked_kind(file: Path, line: int, kind: str | None, cells: Sequence[str], has_commas: bool) -> str:
    """Return the format of the file from its first row."""
    found = ""
    if has_commas and len(cells) >= 8:
        found = kind if kind in {"csv", "euroc"} else "euroc"
    elif not has_commas:
        found = {8: "tum", 12: "kitti"}.get(len(cells), "")
    if not found or (kind is not None and kind != found) or (found == "csv" and len(cells) != 8):
        separator = "commas" if has_commas else "spaces"
        expected = f"is not in the format {kind}" if kind else "is not a trajectory"
        raise TrajectoryError(
            f"{file} {expected}: line {line} has {len(cells)} columns separated by {separator}", hint=_LAYOUTS
        )
    return found


def _poses(file: Path, kind: str, numbers: NDArray[np.float64], stamps: NDArray[np.int64]) -> Transform:
    if kind == "kitti":
        matrices = np.zeros((len(numbers) // 12, 4, 4))
        matrices[:, :3] = numbers.reshape(-1, 3, 4)
        matrices[:, 3, 3] = 1.0
        try:
            return Transform.from_matrix(matrices)
        except ValueError as error:
            raise TrajectoryError(f"{file}: {error}") from None
    rows = numbers.reshape(-1, 7)
    order = (4, 5, 6, 3) if kind == "euroc" else (3, 4, 5, 6)
    return Transform(rows[:, :3], rows[:, order], stamp=stamps)


def _nanoseconds(text: str, unit: int) -> int:
    """Return a time in nanoseconds; a float would round it."""
    match = _SECONDS.fullmatch(text)
    if match and unit == SECOND and len(match[3] or "") <= 9:
        size = int(match[2]) * SECOND + int((match[3] or "").ljust(9, "0"))
        return -size if match[1] else size
    if match and unit == 1 and not match[3]:
        return int(match[1] + match[2])
    time = decimal.Decimal(text) * unit
    if abs(time) > _LATEST:
        raise OverflowError  # before int(), which takes half a minute for 1e999999
    return int(time.to_integral_value())


def _read_npz(file: Path, stream: BinaryIO) -> Transform:
    try:
        _check_unpacked_size(stream)
        with np.load(stream) as data:
            target, source = (str(data[name]) or None for name in ("target", "source"))
            poses = Transform(
                data["translation"], data["quaternion"], target=target, source=source, stamp=data["stamps"]
            )
    except OSError:
        raise
    except Exception as error:  # noqa: BLE001 - NumPy and zipfile raise ten types for broken files
        raise TrajectoryError(
            f"{file} is not a trajectory: {error}",
            hint="An .npz file needs the arrays stamps, translation, quaternion, target and source.",
        ) from None
    if not len(poses):
        raise TrajectoryError(f"{file} contains no poses", hint="Write it again, such as with coframe trajectory.")
    _check_number(file, len(poses))
    return poses


def _check_number(file: Path, poses: int) -> None:
    if poses > MAX_POSES:
        raise TrajectoryError(
            f"{file} has more than {MAX_POSES} poses, the limit",
            hint="Split the file, or write it at a lower rate, such as with `coframe trajectory --rate 100`.",
        )


def _check_unpacked_size(stream: BinaryIO) -> None:
    with zipfile.ZipFile(stream) as archive:
        size = sum(member.file_size for member in archive.infolist())
    stream.seek(0)
    if size > MAX_UNPACKED:
        raise ValueError(f"it unpacks to {size} bytes; the limit is {MAX_UNPACKED}")
