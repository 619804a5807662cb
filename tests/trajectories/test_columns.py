# SPDX-License-Identifier: Apache-2.0
"""Columns of trajectory files are read by their names, and what does not fit is refused or reported."""

import warnings

import numpy as np
import pytest

import coframe
from coframe.trajectories import TrajectoryError, read_trajectory, write_trajectory

SECONDS = 1_650_000_000
TURN = np.linspace(0.2, 2.8, 30)  # of a car that drives along an arc, in radians
PLOTJUGGLER = ",".join(
    [*(f"/odom/pose/position/{axis}" for axis in "xyz"), *(f"/odom/pose/orientation/{axis}" for axis in "xyzw")]
)
STAMPS = SECONDS * 10**9 + np.arange(len(TURN)) * 50_000_000


def car():
    """Return (x, y, z, qx, qy, qz, qw) of a car whose x axis always points forward."""
    zero = np.zeros(len(TURN))
    return np.stack([np.sin(TURN), -np.cos(TURN), zero, zero, zero, np.sin(TURN / 2), np.cos(TURN / 2)], axis=1)


def write(tmp_path, header, order, name="car.csv", separator=",", unit="ns", more=""):
    """Write the car's poses with the columns in an order such as ``t x y z qw qx qy qz``."""
    values = dict(zip(("x", "y", "z", "qx", "qy", "qz", "qw"), car().T, strict=True))
    lines = [header] if header else []
    for row, stamp in enumerate(STAMPS.tolist()):
        time = str(stamp) if unit == "ns" else f"{stamp // 10**9}.{stamp % 10**9:09}"
        cells = [time if column == "t" else f"{values[column][row]:.9f}" for column in order.split()]
        lines.append(separator.join(cells) + more)
    path = tmp_path / name
    path.write_text("\n".join(lines) + "\n")
    return path


def read(path, **options):
    """Return the poses and what was reported."""
    reported = []
    return read_trajectory(path, report=reported.append, **options), reported


def assert_car(poses):
    np.testing.assert_array_equal(poses.stamps, STAMPS)
    np.testing.assert_allclose(poses.translation, car()[:, :3], atol=1e-8)
    expected = coframe.Transform(car()[:, :3], car()[:, 3:])
    np.testing.assert_allclose(poses.matrix, expected.matrix, atol=1e-8)


@pytest.mark.parametrize(
    ("header", "order", "unit"),
    [
        ("stamp_ns,x,y,z,qw,qx,qy,qz", "t x y z qw qx qy qz", "ns"),
        ("#timestamp [ns],x,y,z,qx,qy,qz,qw", "t x y z qx qy qz qw", "ns"),
        ("#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z []",
         "t x y z qw qx qy qz", "ns"),
        ("timestamp,tx,ty,tz,qx,qy,qz,qw", "t x y z qx qy qz qw", "s"),
        ("# timestamp,tx,ty,tz,qx,qy,qz,qw", "t x y z qx qy qz qw", "s"),
        ("qw,qx,qy,qz,x,y,z,time", "qw qx qy qz x y z t", "s"),
        ("Timestamp(s),Pos_X,Pos_Y,Pos_Z,Quat_X,Quat_Y,Quat_Z,Quat_W", "t x y z qx qy qz qw", "s"),
        (("%time,pose.position.x,pose.position.y,pose.position.z,pose.orientation.x,pose.orientation.y,"
         "pose.orientation.z,pose.orientation.w"), "t x y z qx qy qz qw", "ns"),
    ],
)  # fmt: skip
def test_columns_are_read_by_their_names(tmp_path, header, order, unit):
    poses, reported = read(write(tmp_path, header, order, unit=unit))
    assert_car(poses)
    assert reported == []


def test_names_in_files_with_spaces(tmp_path):
    order = "t x y z qw qx qy qz"
    poses, _ = read(write(tmp_path, "# timestamp tx ty tz qw qx qy qz", order, "car.txt", " ", "s"))
    assert_car(poses)
    poses, _ = read(write(tmp_path, "# timestamp[ns] tx ty tz qw qx qy qz", order, "car.txt", " "))
    assert_car(poses)


def test_the_unit_of_whole_numbers_is_found_from_their_distance(tmp_path):
    path = tmp_path / "a.csv"
    for step, unit in ((1, 10**9), (100_000_000, 1)):
        rows = [f"{SECONDS + number * step},{number},0,0,0,0,0,1" for number in range(5)]
        path.write_text("\n".join(["time,x,y,z,qx,qy,qz,qw", *rows]))
        poses, _ = read(path)
        assert poses.stamps.tolist() == [(SECONDS + number * step) * unit for number in range(5)]
    path.write_text("time,x,y,z,qx,qy,qz,qw\n0,0,0,0,0,0,0,1\n0.5,1,0,0,0,0,0,1\n")
    assert read(path)[0].stamps.tolist() == [0, 500_000_000]


@pytest.mark.parametrize(("unit", "text"), [(1, "ns"), (10**3, "us"), (10**6, "ms"), (10**9, "s")])
@pytest.mark.parametrize("is_named", [True, False])
def test_whole_numbers_that_are_dates_in_one_unit(tmp_path, unit, text, is_named):
    stamps = [SECONDS * 10**9 + number * 2 * 10**9 for number in range(5)]
    rows = [f"{stamp // unit},{row},0,0,0,0,0,1" for row, stamp in enumerate(stamps)]
    name = f"time[{text}]" if is_named else "time"
    (tmp_path / "a.csv").write_text("\n".join([f"{name},x,y,z,qx,qy,qz,qw", *rows]))
    assert read(tmp_path / "a.csv")[0].stamps.tolist() == stamps


@pytest.mark.parametrize(
    "header",
    [
        "header.stamp.sec,header.stamp.nanosec,x,y,z,qx,qy,qz,qw",
        "sec,nsec,pose.position.x,pose.position.y,pose.position.z,qx,qy,qz,qw",
        "stamp.secs,stamp.nsecs,x,y,z,qx,qy,qz,qw",
    ],
)
def test_times_in_two_columns(tmp_path, header):
    lines = [header]
    for stamp, pose in zip(STAMPS.tolist(), car(), strict=True):
        lines.append(",".join(map(str, [*divmod(stamp, 10**9), *pose.tolist()])))
    (tmp_path / "a.csv").write_text("\n".join(lines))
    assert read(tmp_path / "a.csv")[0].stamps.tolist() == STAMPS.tolist()


@pytest.mark.parametrize(
    ("header", "quote"),
    [
        (f"__time,{PLOTJUGGLER}", ""),
        ('"timestamp","x","y","z","qx","qy","qz","qw"', '"'),
    ],
)
def test_headers_and_cells_of_other_programs(tmp_path, header, quote):
    lines = [header]
    for stamp, pose in zip(STAMPS.tolist(), car(), strict=True):
        cells = [f"{stamp // 10**9}.{stamp % 10**9:09}", *map(str, pose.tolist())]
        lines.append(",".join(f"{quote}{cell}{quote}" for cell in cells))
    (tmp_path / "a.csv").write_text("\n".join(lines))
    poses, said = read(tmp_path / "a.csv")
    assert (poses.stamps.tolist(), said) == (STAMPS.tolist(), [])


@pytest.mark.parametrize(("length", "scale"), [("cm", 0.01), ("mm", 0.001), ("m", 1.0), ("km", 1000.0)])
@pytest.mark.parametrize("comment", ["", "# "])
def test_the_unit_of_positions_in_the_header_counts(tmp_path, length, scale, comment):
    header = f"{comment}timestamp x[{length}] y[{length}] z[{length}] qx qy qz qw"
    path = write(tmp_path, header, "t x y z qx qy qz qw", separator=" ", unit="s", name="a.txt")
    np.testing.assert_allclose(read(path)[0].translation, scale * car()[:, :3], atol=1e-6 * max(scale, 1))
    path.write_text(path.read_text().replace(f"[{length}]", "[ft]"))
    with pytest.raises(TrajectoryError, match="the unit of the positions is unknown"):
        read(path)


def test_the_covariances_of_openvins_are_skipped(tmp_path):
    more = " 0.1" * 12
    for header in (
        "",
        "# timestamp(s) tx ty tz qx qy qz qw Pr11 Pr12 Pr13 Pr22 Pr23 Pr33 Pt11 Pt12 Pt13 Pt22 Pt23 Pt33",
    ):
        poses, _ = read(write(tmp_path, header, "t x y z qx qy qz qw", "state.txt", " ", "s", more))
        assert_car(poses)


@pytest.mark.parametrize(
    ("name", "separator", "unit", "reason"),
    [
        ("car.csv", ",", "s", "line 2: the time 1650000000.050000000 has a fraction, so it cannot be in nanoseconds"),
        ("car.txt", " ", "ns", "line 1: the time 1650000000000000000 looks like nanoseconds"),
    ],
)
def test_times_in_another_unit_than_the_format_has_are_refused(tmp_path, name, separator, unit, reason):
    path = write(tmp_path, "", "t x y z qx qy qz qw", name, separator, unit)
    with pytest.raises(TrajectoryError, match=reason) as caught:
        read_trajectory(path)
    assert "Name the columns and the unit in the first line" in caught.value.hint


def test_whole_seconds_are_not_taken_for_nanoseconds(tmp_path):
    path = tmp_path / "a.csv"
    path.write_text("".join(f"{SECONDS + number},{number},0,0,0,0,0,1\n" for number in range(5)))
    with pytest.raises(TrajectoryError, match="the times look like seconds"):
        read_trajectory(path)


def test_tum_with_commas(tmp_path):
    order = "t x y z qx qy qz qw"
    assert_car(read(write(tmp_path, "", order, "car.tum", ",", "s"))[0])
    assert_car(read(write(tmp_path, "", order, "car.csv", ",", "s"), format_="tum")[0])


@pytest.mark.parametrize("name", ["a.tum", "a.csv", "a.euroc", "a.npz"])
def test_rows_of_nan_that_coframe_wrote_are_left_out_with_a_word(tmp_path, name):
    buffer = coframe.Buffer(None)
    for second in (1, 2, 3):
        buffer.set("map", "car", coframe.Transform([second, 0, 0]), second * 10**9)
    poses = buffer.lookup_many("map", "car", np.array([1, 2, 3, 4]) * 10**9, on_error="nan")
    write_trajectory(poses, tmp_path / name)
    found, reported = read(tmp_path / name)
    assert found.translation[:, 0].tolist() == [1, 2, 3]
    [sentence] = reported
    assert sentence.endswith(": 1 row of NaN skipped")


def test_the_wrong_order_of_a_quaternion_is_reported(tmp_path):
    path = write(tmp_path, "", "t x y z qw qx qy qz", "car.txt", " ", "s")
    _, [sentence] = read(path)
    assert "the path is smoother if the quaternions are read with w first: 100 % instead of" in sentence
    path = write(tmp_path, "", "t x y z qx qy qz qw")
    _, [sentence] = read(path, format_="euroc")
    assert "w last" in sentence


def test_times_that_do_not_increase_and_wrong_norms_are_reported(tmp_path):
    path = tmp_path / "a.tum"
    path.write_text("1 0 0 0 0 0 0 1\n2 1 0 0 0 0 0 1.02\n2 2 0 0 0 0 0 1\n1.5 3 0 0 0 0 0 0.9995\n")
    _, (times, norms) = read(path)
    assert "the times do not increase at 2 poses; the first one is pose 3" in times
    assert "the quaternions of 1 pose do not have norm 1; the first one is pose 2, with norm 1.02" in norms
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        read_trajectory(path)
    assert len(caught) == 2
    assert caught[0].filename == __file__
