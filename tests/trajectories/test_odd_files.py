# SPDX-License-Identifier: Apache-2.0
"""Files that are no trajectories are named for what they are, and the matrices of KITTI files are checked."""

import bz2
import gzip
import lzma
import re

import numpy as np
import pytest
from click.testing import CliRunner

import coframe
from coframe.cli.app import app
from coframe.trajectories import TrajectoryError, read_trajectory

TURN = np.linspace(0.2, 2.8, 30)  # of a car that drives along an arc, in radians


def car():
    """Return matrices (N, 4, 4) of a car, whose x axis always points forward."""
    places = np.stack([5 + np.sin(TURN), 3 - np.cos(TURN), 0 * TURN], axis=1)
    return np.stack([coframe.Transform.from_rpy(p, [0.1, 0, t]).matrix for p, t in zip(places, TURN, strict=True)])


def rows(matrices, digits=9):
    return "".join(
        " ".join(f"{value:.{digits}f}" for value in row) + "\n" for row in matrices.reshape(len(matrices), -1)
    )


KITTI = rows(car()[:, :3])
TUM = "".join(f"{i}.5 {i} 0 0 0 0 0 1\n" for i in range(20))


def read(path):
    reported = []
    return read_trajectory(path, report=reported.append), reported


@pytest.mark.parametrize(
    ("content", "what"),
    [
        (b"version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\nsize 12345\n", "Git LFS pointer"),
        (gzip.compress(TUM.encode(), mtime=0), "compressed with gzip; unpack it with gunzip"),
        (bz2.compress(TUM.encode()), "compressed with bzip2"),
        (lzma.compress(TUM.encode()), "compressed with xz"),
        (b"\x28\xb5\x2f\xfd\x04\x00", "compressed with Zstandard; unpack it with unzstd"),
        (b"\x04\x22\x4d\x18\x64\x40\xa7", "compressed with LZ4"),
        (b"", r"empty \(0 bytes\)"),
        (bytes(500), "begins with zeros"),
        (b"<!DOCTYPE html><html><body>404</body></html>", "a web page"),
        (b"\x89MCAP0\r\n", "a recording"),
        (b"PAR1\x15\x04", "a Parquet file"),
        (b"\x89HDF\r\n\x1a\n", "an HDF5 file"),
    ],
)
@pytest.mark.parametrize("name", ["a.tum", "a.txt", "a.csv", "a.kitti"])
def test_other_files_are_named_for_what_they_are(tmp_path, content, what, name):
    path = tmp_path / name
    path.write_bytes(content)
    with pytest.raises(TrajectoryError, match=f"is not a trajectory: the file .*{what}"):
        read_trajectory(path)
    (tmp_path / "good.tum").write_text(TUM)
    ended = CliRunner().invoke(app, ["compare", str(tmp_path / "good.tum"), str(path)])
    assert ended.exit_code == 1
    assert re.search(what, ended.stderr)


def test_matrices_are_read(tmp_path):
    (tmp_path / "a.txt").write_text(KITTI)
    poses, said = read(tmp_path / "a.txt")
    np.testing.assert_allclose(poses.matrix, car(), rtol=0, atol=1e-8)
    assert said == []


def test_matrices_with_few_digits_become_the_nearest_rotations(tmp_path):
    (tmp_path / "a.txt").write_text(rows(car()[:, :3], digits=4))
    poses, (said,) = read(tmp_path / "a.txt")
    np.testing.assert_allclose(poses.matrix, car(), rtol=0, atol=1e-4)
    assert re.search(r"\d+ rotations differ from orthogonal matrices by up to .*; the nearest rotations are used", said)


@pytest.mark.parametrize(
    ("change", "order"),
    [
        (lambda m: m[:, :3].transpose(0, 2, 1), "with the nine numbers of the rotation first"),
        (
            lambda m: np.hstack([m[:, :3, :3].reshape(-1, 9), m[:, :3, 3]]),
            "with the nine numbers of the rotation first",
        ),
        (lambda m: np.hstack([m[:, :3, 3], m[:, :3, :3].reshape(-1, 9)]), "with x, y, z first"),
    ],
)
def test_matrices_in_another_order_are_refused_with_the_order(tmp_path, change, order):
    (tmp_path / "a.txt").write_text(rows(change(car())))
    with pytest.raises(TrajectoryError, match="rotation") as caught:
        read_trajectory(tmp_path / "a.txt")
    assert order in caught.value.hint


def test_scaled_and_mirrored_matrices_are_refused(tmp_path):
    scaled = car()[:, :3] * (2, 2, 2, 1)
    (tmp_path / "a.txt").write_text(rows(scaled))
    with pytest.raises(TrajectoryError, match=r"pose \d+: .*not a rotation"):
        read_trajectory(tmp_path / "a.txt")
    (tmp_path / "a.txt").write_text(rows(car()[:, :3] * (1, -1, 1, 1)))
    with pytest.raises(TrajectoryError, match="reflection"):
        read_trajectory(tmp_path / "a.txt")


@pytest.mark.parametrize("value", ["nan", "inf"])
def test_matrices_with_a_row_of_nan_are_refused_because_the_pairs_would_shift(tmp_path, value):
    lines = KITTI.splitlines()
    lines[4] = " ".join([value] * 12)
    (tmp_path / "a.txt").write_text("\n".join(lines))
    with pytest.raises(TrajectoryError, match=r"1 row with NaN or infinite numbers; the first one is pose 5"):
        read_trajectory(tmp_path / "a.txt")


def test_inverted_poses_are_reported(tmp_path):
    headings = 1.2 * np.sin(np.arange(60) / 8)  # left and right
    places = np.cumsum(np.stack([np.cos(headings), np.sin(headings), 0 * headings], axis=1), axis=0)
    slalom = [coframe.Transform.from_rpy(p, [0, 0, h]) for p, h in zip(places, headings, strict=True)]
    (tmp_path / "b.txt").write_text(rows(np.stack([pose.matrix for pose in slalom])[:, :3]))
    assert read(tmp_path / "b.txt")[1] == []
    (tmp_path / "a.txt").write_text(rows(np.stack([pose.inverse().matrix for pose in slalom])[:, :3]))
    _, (said,) = read(tmp_path / "a.txt")
    assert "the path is smoother if the poses are inverted: 99 % instead of" in said


@pytest.mark.parametrize(
    ("matrices", "what"),
    [
        (car().reshape(-1, 16), "16 columns separated by spaces, like 4x4"),
        (
            np.hstack([TURN[:, None], car()[:, :3].reshape(-1, 12)]),
            "13 columns separated by spaces, like times and",
        ),
        (car()[:, :3, 3], "3 columns separated by spaces, like positions without rotations"),
    ],
)
def test_other_numbers_of_columns_are_named(tmp_path, matrices, what):
    (tmp_path / "a.txt").write_text(rows(matrices))
    with pytest.raises(TrajectoryError, match=what):
        read_trajectory(tmp_path / "a.txt")


@pytest.mark.parametrize("separator", [";", "; ", "\t", " "])
@pytest.mark.parametrize("header", ["", "timestamp;x;y;z;qx;qy;qz;qw\n"])
def test_decimal_commas(tmp_path, separator, header):
    """Spreadsheets of many countries write them."""
    if header and separator != ";":
        header = header.replace(";", separator)
    lines = [separator.join(cell.replace(".", ",") for cell in line.split()) for line in TUM.splitlines()]
    name = "a.csv" if header else "a.tum"
    (tmp_path / name).write_text(header + "\n".join(lines) + "\n", encoding="utf-8-sig")
    poses, _ = read(tmp_path / name)
    assert poses.stamps.tolist() == [i * 10**9 + 500_000_000 for i in range(20)]
    assert poses.translation[:, 0].tolist() == list(range(20))


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16", "utf-16-le", "utf-16-be"])
@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_encodings_and_line_ends(tmp_path, encoding, end):
    text = TUM.replace("\n", end)
    mark = "\ufeff" if encoding in {"utf-16-le", "utf-16-be"} else ""
    (tmp_path / "a.tum").write_bytes((mark + text).encode(encoding))
    assert read(tmp_path / "a.tum")[0].stamps[-1] == 19_500_000_000
