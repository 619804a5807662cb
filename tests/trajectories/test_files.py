# SPDX-License-Identifier: Apache-2.0
"""Trajectory files are written and read again in every format."""

import io
import struct
import zipfile

import numpy as np
import pytest

import coframe
from coframe.trajectories import READABLE_FORMATS, TrajectoryError, read_trajectory, write_trajectory
from coframe.trajectories import _reading as reading

START = 1_700_000_000_123_456_789


@pytest.fixture
def poses():
    rng = np.random.default_rng(3)
    stamps = START + np.arange(50) * 10_000_001
    return coframe.Transform(rng.normal(size=(50, 3)), rng.normal(size=(50, 4)), stamp=stamps)


def assert_same(found, expected, *, stamps=True):
    np.testing.assert_allclose(found.matrix, expected.matrix, rtol=0, atol=1e-15)
    assert (found.stamps is None) == (not stamps)
    if stamps:
        np.testing.assert_array_equal(found.stamps, expected.stamps)


@pytest.mark.parametrize("kind", READABLE_FORMATS)
def test_a_written_trajectory_is_read_again(tmp_path, poses, kind):
    path = tmp_path / "poses.data"
    write_trajectory(poses, path, kind)
    assert_same(read_trajectory(path, kind), poses, stamps=kind != "kitti")
    assert_same(read_trajectory(path), poses, stamps=kind != "kitti")  # The format is found from the contents.
    assert [file.name for file in tmp_path.iterdir()] == ["poses.data"]


def test_euroc_ground_truth_with_velocities_and_biases(tmp_path):
    path = tmp_path / "data.csv"
    path.write_text(
        "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z [], v_RS_R_x\n"
        "1403636580838555648,4.688319,-1.786938,0.783338,0.534108,-0.153029,-0.827383,-0.082152,-0.027876\n"
    )
    poses = read_trajectory(path)
    assert poses.stamps.tolist() == [1403636580838555648]
    assert poses.translation.tolist() == [[4.688319, -1.786938, 0.783338]]
    np.testing.assert_allclose(poses.quaternion, [[-0.153029, -0.827383, -0.082152, 0.534108]], atol=1e-6)


@pytest.mark.parametrize(
    ("stamp", "expected"),
    [
        ("1.700000000123456789e+09", START),
        ("1700000000.123456789", START),
        ("12", 12_000_000_000),
        ("-0.5", -500_000_000),
        ("0.1234567894", 123_456_789),
    ],
)
def test_stamps_of_tum_files_are_exact(tmp_path, stamp, expected):
    path = tmp_path / "a.tum"
    path.write_text(f"# stamp tx ty tz qx qy qz qw\n\n{stamp} 1 2 3 0 0 0 1\r\n")
    assert read_trajectory(path).stamps.tolist() == [expected]


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("", "the file is empty"),
        ("# nothing\n", "contains no poses"),
        ("1 2 3\n", "is not a trajectory: line 1 has 3 columns separated by spaces"),
        ("1 0 0 0 0 0 0 1\n2 0 0\n", "line 2: 3 columns; the lines above have 8"),
        ("1 0 0 zero 0 0 0 1\n", "line 1: not a row of numbers"),
        ("nan 0 0 0 0 0 0 1\n", "line 1: not a row of numbers"),
        ("1e9999999 0 0 0 0 0 0 1\n", "line 1: not a row of numbers"),
        ("1e999980 0 0 0 0 0 0 1\n", "line 1: not a row of numbers"),
        ("# \n" + "7" * 10_001, "line 2 has more than 10000 characters"),
        ("1 0 0 0 0 0 0 0\n", "quaternion must not be zero"),
        ("1 0 0 nan 0 0 0 1\n", "translation must be finite"),
        ("1 0 0 0 0 1 0 0 0 0 2 0\n", "is not a rotation"),
        ("\0\xff\n", "is not a trajectory"),
    ],
)
def test_invalid_files_are_reported_with_the_line(tmp_path, text, reason):
    path = tmp_path / "a.txt"
    path.write_text(text, encoding="latin-1")
    with pytest.raises(TrajectoryError, match=reason):
        read_trajectory(path)


def npz(path, header, data=b""):
    """Write an npz file whose member `translation` has the given text as its header."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name in ("target", "source", "stamps", "quaternion"):
            content = io.BytesIO()
            np.save(content, np.zeros((1, 4)))
            archive.writestr(f"{name}.npy", content.getvalue())
        archive.writestr("translation.npy", b"\x93NUMPY\x01\0" + struct.pack("<H", len(header)) + header + data)


@pytest.mark.parametrize(
    "header",
    [
        b"{'descr': '<f8', 'fortran_order': False, 'shape': (1000000000000000, 3), }",
        b"{'descr': '<f8', 'fortran_order': False, 'shape': (10000000000000000000000, 3), }",
        b"{'descr': '<f8', 'fortran_order': False, 'shape': (1, 3), }",
        b"{'descr': '<f8', 'fortran_order': False, 'shape': (",
        b"(" * 5000,
    ],
)
def test_a_broken_npz_file_is_an_error(tmp_path, header):
    npz(tmp_path / "a.npz", header)
    with pytest.raises(TrajectoryError, match=r"a\.npz is not a trajectory: "):
        read_trajectory(tmp_path / "a.npz")


def test_an_npz_file_without_poses_is_an_error(tmp_path):
    arrays = {"stamps": np.zeros(0, int), "translation": np.zeros((0, 3)), "quaternion": np.zeros((0, 4))}
    np.savez(tmp_path / "a.npz", target="", source="", **arrays)
    with pytest.raises(TrajectoryError, match=r"a\.npz contains no poses"):
        read_trajectory(tmp_path / "a.npz")


@pytest.mark.parametrize("suffix", ["tum", "kitti", "npz"])
def test_a_file_with_more_poses_than_the_limit_is_refused(tmp_path, monkeypatch, suffix):
    monkeypatch.setattr(reading, "MAX_POSES", 100)
    path = tmp_path / f"long.{suffix}"
    for count in (100, 101):
        poses = coframe.Transform(np.zeros((count, 3)), np.tile([0.0, 0, 0, 1], (count, 1)), stamp=np.arange(count))
        write_trajectory(poses, path, suffix)
        if count == 100:
            assert read_trajectory(path).shape == (100,)
    with pytest.raises(TrajectoryError, match=r"long\.\w+ has more than the maximum of 100 poses") as caught:
        read_trajectory(path)
    assert "Split the file" in caught.value.hint


def test_a_small_npz_file_that_unpacks_to_a_large_one_is_refused(tmp_path):
    header = b"{'descr': '<f8', 'fortran_order': False, 'shape': (20000000, 3), }"
    npz(tmp_path / "a.npz", header, bytes(300_000_000))
    with pytest.raises(TrajectoryError, match=r"the archive unpacks to 3000.* bytes; the maximum is 268435456"):
        read_trajectory(tmp_path / "a.npz")


def test_another_format_than_requested_is_an_error(tmp_path, poses):
    write_trajectory(poses, tmp_path / "a.tum")
    with pytest.raises(TrajectoryError, match="is not in the format kitti: line 1 has 8 columns"):
        read_trajectory(tmp_path / "a.tum", "kitti")
    with pytest.raises(ValueError, match="No format named 'tmu'"):
        read_trajectory(tmp_path / "a.tum", "tmu")
    with pytest.raises(TrajectoryError, match="No such file"):
        read_trajectory(tmp_path / "b.tum")


@pytest.mark.parametrize("kind", ["tum", "csv", "euroc", "kitti", "npz", "parquet"])
def test_batches_are_written_like_one_trajectory(tmp_path, poses, kind):
    if kind == "parquet":
        pytest.importorskip("pyarrow")
    written = []
    write_trajectory(poses, tmp_path / "one", kind)
    write_trajectory((poses[i : i + 20] for i in (0, 20, 40)), tmp_path / "parts", kind, progress=written.append)
    assert written[-1:] == ([50] if kind != "npz" else written[-1:])
    if kind == "parquet":
        from pyarrow import parquet

        one, parts = (parquet.read_table(tmp_path / name) for name in ("one", "parts"))
        assert one.equals(parts)
    else:
        assert (tmp_path / "one").read_bytes() == (tmp_path / "parts").read_bytes()


def test_an_interrupted_writer_keeps_the_previous_file(tmp_path, poses):
    path = tmp_path / "a.csv"
    path.write_text("previous")

    def interrupted():
        yield poses
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        write_trajectory(interrupted(), path)
    assert [file.name for file in tmp_path.iterdir()] == ["a.csv"]
    assert path.read_text() == "previous"


@pytest.mark.slow
def test_long_trajectories_are_formatted_in_parts(poses):
    """The text of a trajectory takes much more memory than its numbers."""
    import tracemalloc

    long = coframe.Transform(np.tile(poses.translation, (4000, 1)), stamp=np.arange(200_000))

    class Discard(io.StringIO):
        def write(self, text):
            return len(text)

    tracemalloc.start()
    try:
        write_trajectory(long, Discard(), "csv")
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert peak < 20e6  # All at once takes 140 MB.


def test_a_trajectory_without_stamps_cannot_be_written(tmp_path):
    with pytest.raises(ValueError, match="must have shape"):
        write_trajectory(coframe.Transform(np.zeros((3, 3))), tmp_path / "a.tum")
    with pytest.raises(ValueError, match="at least one batch"):
        write_trajectory([], tmp_path / "a.tum")
