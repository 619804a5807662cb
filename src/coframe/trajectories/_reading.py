# SPDX-License-Identifier: Apache-2.0
"""Read trajectory files: TUM, KITTI, EuRoC, CSV and NumPy's npz."""

from __future__ import annotations

import decimal
import io
import re
import warnings
import zipfile
from array import array
from functools import partial
from typing import TYPE_CHECKING, BinaryIO

import numpy as np

from coframe._files.os_errors import reason
from coframe._files.other_files import BEGINNING_SIZE, describe_other_kind
from coframe._output.formatting import count
from coframe._sources.sources import as_source, open_file
from coframe.errors import InvalidArgumentException, TrajectoryError
from coframe.time import SECOND
from coframe.trajectories._checks import findings, likely_unit, looks_like_seconds
from coframe.trajectories._columns import Columns, header_columns, is_separated_by_spaces, split
from coframe.trajectories.formats import POSE_COLUMNS
from coframe.transform.transform import Transform

if TYPE_CHECKING:
    import os
    from collections.abc import Callable, Iterable, Sequence

    from numpy.typing import NDArray

    from coframe._sources.sources import Readable

__all__ = ["READABLE_FORMATS", "read_trajectory"]

READABLE_FORMATS = ("tum", "kitti", "euroc", "csv", "npz")
MAX_LINE = 10_000  # characters
MAX_POSES = 1_000_000  # 2.7 hours at 100 Hz
MAX_UNPACKED = 256 << 20  # bytes of an npz file after decompression
_ZIP_MAGIC = b"PK"
_UTF_16 = (b"\xff\xfe", b"\xfe\xff")  # as PowerShell writes text
_COMMAND_HINT = "`coframe trajectory BAG TARGET SOURCE -o FILE` writes the trajectory of a frame in a recording."
_SECONDS = re.compile(r"(-?)(\d+)(?:\.(\d*))?", re.ASCII)
_MAX_STAMP = 1 << 63
# The columns of files without a header line.
_W_LAST_COLUMNS, _W_FIRST_COLUMNS = (Columns(0, pose, None) for pose in ((1, 2, 3, 4, 5, 6, 7), (1, 2, 3, 5, 6, 7, 4)))
_OPENVINS_COLUMNS = 20  # TUM, and twelve values of the covariance
_MAX_DIGITS = 40  # of a time that a message quotes
MIN_MATRIX_ERROR, MAX_MATRIX_ERROR = 1e-5, 1e-3  # of numbers with five, and with three decimals
MAX_SECONDS = 1e11  # of a time; in nanoseconds this is 100 s
_NAMED_UNIT = (
    "Name the columns and the unit in the first line: 'timestamp[ns] x y z qx qy qz qw' or "
    "'timestamp[s],x,y,z,qx,qy,qz,qw'."
)
_Poses = tuple[Transform, list[str]]  # with what is suspicious
# The differences between the formats, for error messages.
_LAYOUTS = (
    "TUM has 8 columns separated by spaces (seconds x y z qx qy qz qw), KITTI has 12 (a 3x4 matrix), EuRoC has at "
    "least 8 separated by commas (ns, x, y, z, qw, qx, qy, qz), and CSV begins with a header line: "
    f"stamp_ns,{','.join(POSE_COLUMNS)}."
)


# What other numbers of columns may be.
_OTHER_LAYOUTS = {
    3: "positions without rotations",
    4: "times and positions without rotations",
    7: "poses without times",
    13: "times and 3x4 matrices",
    16: "4x4 matrices",
    17: "times and 4x4 matrices",
}


class _UnitError(ValueError):
    """A time that cannot be in its unit."""


def read_trajectory(
    path: str | os.PathLike[str] | Readable,
    format_: str | None = None,
    *,
    report: Callable[[str], object] | None = None,
) -> Transform:
    """Read the poses in a trajectory file.

    The names in a header line, such as ``timestamp[ns],x,y,z,qw,qx,qy,qz``, determine the columns.

    Args:
        path: The file, or its URL.
        format_: ``tum``, ``kitti``, ``euroc``, ``csv`` or ``npz``; None detects it from the contents, because EuRoC and
            CSV have the same suffix.
        report: Called with a sentence for each suspicious property: times that do not increase, quaternions whose norm
            is not 1, rotations that fit the path better in another order, and rows of NaN, which are skipped. None:
            a Python warning.

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
    try:
        file = as_source(path)
        with open_file(file) as stream:
            beginning = stream.read(BEGINNING_SIZE)
            stream.seek(0)
            is_zip = beginning.startswith(_ZIP_MAGIC)
            if format_ == "npz" or (format_ is None and is_zip):
                poses, sentences = _read_npz(file, stream)
            elif what := describe_other_kind(beginning):
                raise TrajectoryError(
                    f"{file} is not a trajectory: {what}", hint=_COMMAND_HINT if "rec" in what else ""
                )
            else:
                encoding = "utf-16" if beginning.startswith(_UTF_16) else "utf-8-sig"
                text = io.TextIOWrapper(stream, encoding=encoding)
                poses, sentences = _read_text(file, iter(partial(text.readline, MAX_LINE + 1), ""), format_)
    except OSError as error:
        name = getattr(error, "filename", None) or path
        raise TrajectoryError(f"{name} cannot be read: {reason(error)}", hint=getattr(error, "hint", "")) from None
    except UnicodeError:
        raise TrajectoryError(f"{file} is not a trajectory: it is not a text file", hint=_LAYOUTS) from None
    except InvalidArgumentException as error:
        raise TrajectoryError(f"{file}: {error}", hint=error.hint) from None
    for sentence in sentences:
        (report or partial(warnings.warn, stacklevel=2))(f"{file}: {sentence}")
    return poses


def _read_text(file: Readable, lines: Iterable[str], kind: str | None) -> _Poses:
    rows = _Rows(file, kind)
    for number, line in enumerate(lines, start=1):
        if len(line) > MAX_LINE:
            raise TrajectoryError(f"{file} is not a trajectory: line {number} has more than {MAX_LINE} characters")
        rows.add(number, line.strip())
    return rows.poses()


class _Rows:
    """The rows of a text file. A header line or the first row determines the columns."""

    def __init__(self, file: Readable, kind: str | None) -> None:
        self._file = file
        self._kind = kind
        self._named_columns: Columns | None = None
        self._columns: Columns | None = None  # None for KITTI
        self._cells = 0  # of a row
        self._times = _Times(1)
        self._numbers = array("d")
        self._count = 0

    def add(self, line: int, text: str) -> None:
        """Add a line of the file, without spaces at its ends."""
        if not self._cells and self._kind != "kitti" and (named := self._header(line, text)) is not None:
            self._named_columns = named
        elif text and not text.startswith("#"):
            self._add_row(line, text)

    def _header(self, line: int, text: str) -> Columns | None:
        try:
            return header_columns(text)
        except ValueError as error:
            raise TrajectoryError(f"{self._file}, line {line}: {error}") from None

    def _add_row(self, line: int, text: str) -> None:
        cells = split(text)
        if not self._cells:
            self._begin(line, text, cells)
        self._count += 1
        _check_number(self._file, self._count)
        if len(cells) != self._cells:
            where = f"{self._file}, line {line}"
            raise TrajectoryError(f"{where}: {len(cells)} columns; the lines above have {self._cells}")
        try:
            if self._columns is None:
                self._numbers.extend(map(float, cells))
            else:
                columns = self._columns
                self._times.add(cells[columns.stamp], cells[columns.nanoseconds] if columns.nanoseconds >= 0 else "")
                x, y, z, *rotation = [float(cells[index]) for index in columns.pose]
                self._numbers.extend([x * columns.scale, y * columns.scale, z * columns.scale, *rotation])
        except _UnitError as error:
            raise TrajectoryError(f"{self._file}, line {line}: {error}", hint=_NAMED_UNIT) from None
        except (ValueError, OverflowError, decimal.DecimalException):
            raise TrajectoryError(f"{self._file}, line {line}: not a row of numbers: {text[:80]!r}") from None

    def _begin(self, line: int, text: str, cells: Sequence[str]) -> None:
        """Determine the format from the header line and the first row."""
        has_commas = not is_separated_by_spaces(text)
        self._cells = len(cells)
        if self._named_columns is not None and self._cells > max(self._named_columns.stamp, *self._named_columns.pose):
            self._columns = self._named_columns
            self._times = _Times(self._named_columns.unit or (None if has_commas else SECOND))
            return
        kind = _layout(self._file, self._kind, self._cells, has_commas)
        if not kind:
            separator = "commas" if has_commas else "spaces"
            other = _OTHER_LAYOUTS.get(self._cells, "")
            expected = f"is not in the format {self._kind}" if self._kind else "is not a trajectory"
            raise TrajectoryError(
                f"{self._file} {expected}: line {line} has {self._cells} columns separated by {separator}"
                + (f", like {other}" if other else ""),
                hint=_LAYOUTS,
            )
        self._columns = {"kitti": None, "euroc": _W_FIRST_COLUMNS}.get(kind, _W_LAST_COLUMNS)
        self._times = _Times(SECOND if kind == "tum" else 1)

    def poses(self) -> _Poses:
        """Return the poses and their suspicious properties."""
        if not self._cells:
            raise TrajectoryError(f"{self._file} contains no poses", hint=_LAYOUTS)
        numbers = np.frombuffer(self._numbers)
        if self._columns is None:
            return _matrices(self._file, numbers)
        return _checked_poses(self._file, numbers.reshape(-1, 7), self._times.nanoseconds(self._file))


class _Times:
    """The times of the rows.

    Args:
        unit: Their unit in nanoseconds; None: seconds if they have a fraction or are too dense for nanoseconds.
    """

    def __init__(self, unit: int | None) -> None:
        self._unit = unit or 1
        self._is_open = unit is None
        self._values = array("q")

    def add(self, text: str, nanoseconds: str = "") -> None:
        """Add a time as written, with the nanoseconds that are added to it."""
        if self._is_open and "." in text and abs(float(text)) < MAX_SECONDS:
            self._values = array("q", [value * SECOND for value in self._values])
            self._unit, self._is_open = SECOND, False
        if self._unit == SECOND and MAX_SECONDS <= abs(float(text)) < _MAX_STAMP and len(text) <= _MAX_DIGITS:
            raise _UnitError(f"the time {text} looks like nanoseconds, but times in this format are seconds")
        self._values.append(_nanoseconds(text, self._unit) + (int(nanoseconds) if nanoseconds else 0))

    def nanoseconds(self, file: Readable) -> NDArray[np.int64]:
        """Return all times in nanoseconds."""
        times = np.array(self._values, dtype=np.int64)
        if self._is_open and (unit := likely_unit(times)) != 1:
            return times * unit
        if self._unit == 1 and looks_like_seconds(times):
            raise TrajectoryError(
                f"{file}: the times look like seconds, but this format has nanoseconds: the first one is {times[0]}",
                hint=_NAMED_UNIT,
            )
        return times


def _layout(file: Readable, kind: str | None, cells: int, has_commas: bool) -> str:
    """Return the format of a file without names of columns, or "" if it is in none, or not in the requested one."""
    if has_commas and cells >= 8:
        is_tum = kind == "tum" or (kind is None and file.suffix.lower() == ".tum")
        found = "tum" if is_tum else kind if kind in {"csv", "euroc"} else "euroc"
    else:
        found = "" if has_commas else {8: "tum", _OPENVINS_COLUMNS: "tum", 12: "kitti"}.get(cells, "")
    if (kind is not None and kind != found) or (found == "csv" and cells != 8):
        return ""
    return found


def _checked_poses(
    file: Readable,
    rows: NDArray[np.float64],
    stamps: NDArray[np.int64],
    target: str | None = None,
    source: str | None = None,
) -> _Poses:
    """Return the poses and their suspicious properties, without rows of NaN."""
    without = np.isnan(rows[:, :3]).all(axis=1)
    rows, stamps = rows[~without], stamps[~without]
    if not len(rows):
        raise TrajectoryError(f"{file} contains no poses", hint="All its rows are NaN.")
    sentences = [f"{count(int(without.sum()), 'row')} of NaN skipped"] if without.any() else []
    sentences += findings(stamps, rows[:, :3], rows[:, 3:])
    return Transform(rows[:, :3], rows[:, 3:], target=target, source=source, stamp=stamps), sentences


def _matrices(file: Readable, numbers: NDArray[np.float64]) -> _Poses:
    """Return the poses of rows with 3x4 matrices, and what is suspicious about them."""
    rows = numbers.reshape(-1, 3, 4)
    if (bad := np.flatnonzero(~np.isfinite(rows).all(axis=(1, 2)))).size:
        raise TrajectoryError(
            f"{file} has {count(len(bad), 'row')} with NaN or infinite numbers; the first one is pose {bad[0] + 1}",
            hint="The poses of KITTI files are paired by their order, so no pose can be omitted.",
        )
    matrices = np.zeros((len(rows), 4, 4))
    matrices[:, :3] = rows
    matrices[:, 3, 3] = 1.0
    sentences = []
    errors = _orthogonality_errors(rows[:, :, :3])
    if MIN_MATRIX_ERROR < errors.max() <= MAX_MATRIX_ERROR:
        left, _, right = np.linalg.svd(rows[:, :, :3])
        matrices[:, :3, :3] = left @ right
        sentences.append(
            f"{count(int((errors > MIN_MATRIX_ERROR).sum()), 'rotation')} differ from orthogonal matrices by up to "
            f"{errors.max():.2g}; the nearest rotations are used"
        )
    try:
        poses = Transform.from_matrix(matrices)
    except ValueError as error:
        raise TrajectoryError(
            f"{file}, pose {int(errors.argmax()) + 1}: {error}", hint=_other_order_hint(rows)
        ) from None
    return poses, [*sentences, *findings(None, poses.translation, poses.quaternion)]


def _orthogonality_errors(rotations: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return how far matrices (N, 3, 3) are from orthogonal ones: the largest element of R R^T - I of each."""
    products = rotations @ rotations.transpose(0, 2, 1)
    errors: NDArray[np.float64] = np.abs(products - np.eye(3)).max(axis=(1, 2))
    return errors


def _other_order_hint(rows: NDArray[np.float64]) -> str:
    """Return a hint if the numbers are rotation matrices in another order, or "" otherwise."""
    flat = rows.reshape(-1, 12)
    orders = {
        "with the nine numbers of the rotation first, and then x, y, z": flat[:, :9].reshape(-1, 3, 3),
        "with x, y, z first": flat[:, 3:].reshape(-1, 3, 3),
    }
    for order, matrices in orders.items():
        if _orthogonality_errors(matrices).max() < MAX_MATRIX_ERROR:
            return f"The numbers are rotations if they are read {order}; KITTI has r11 r12 r13 x r21 r22 r23 y ..."
    return ""


def _nanoseconds(text: str, unit: int) -> int:
    """Return a time in nanoseconds. A float would round it."""
    match = _SECONDS.fullmatch(text)
    if match and unit == 1 and (match[3] or "").strip("0"):
        raise _UnitError(f"the time {text} has a fraction, so it cannot be in nanoseconds")
    if match and unit == SECOND and len(match[3] or "") <= 9:
        size = int(match[2]) * SECOND + int((match[3] or "").ljust(9, "0"))
        return -size if match[1] else size
    if match and unit == 1:
        return int(match[1] + match[2])
    time = decimal.Decimal(text) * unit
    if abs(time) > _MAX_STAMP:
        raise OverflowError  # before int(), which takes half a minute for 1e999999
    if unit == 1 and time != time.to_integral_value():
        raise _UnitError(f"the time {text[:_MAX_DIGITS]} has a fraction, so it cannot be in nanoseconds")
    return int(time.to_integral_value())


def _read_npz(file: Readable, stream: BinaryIO) -> _Poses:
    try:
        _check_unpacked_size(stream)
        with np.load(stream) as data:
            target, source = (str(data[name]) or None for name in ("target", "source"))
            rows = np.concatenate([data["translation"], data["quaternion"]], axis=1)
            _check_number(file, len(rows))
            return _checked_poses(file, rows, data["stamps"], target, source)
    except (OSError, TrajectoryError):
        raise
    except Exception as error:  # noqa: BLE001 - NumPy and zipfile raise ten types for broken files
        raise TrajectoryError(
            f"{file} is not a trajectory: {error}",
            hint="An .npz file needs the arrays stamps, translation, quaternion, target and source.",
        ) from None


def _check_number(file: Readable, poses: int) -> None:
    if poses > MAX_POSES:
        raise TrajectoryError(
            f"{file} has more than the maximum of {MAX_POSES} poses",
            hint="Split the file, or write it at a lower rate, such as with `coframe trajectory --rate 100`.",
        )


def _check_unpacked_size(stream: BinaryIO) -> None:
    with zipfile.ZipFile(stream) as archive:
        size = sum(member.file_size for member in archive.infolist())
    stream.seek(0)
    if size > MAX_UNPACKED:
        raise ValueError(f"the archive unpacks to {size} bytes; the maximum is {MAX_UNPACKED}")
