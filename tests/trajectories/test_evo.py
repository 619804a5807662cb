# SPDX-License-Identifier: Apache-2.0
"""The figures of a comparison equal those of evo."""

import copy

import numpy as np
import pytest

import coframe
from coframe import quaternion
from coframe.trajectories import Delta, associate, compare_trajectories

metrics = pytest.importorskip("evo.core.metrics", reason="evo (pip install --group oracle) is not installed")
from evo.core import sync, trajectory  # noqa: E402
from evo.main_ape import ape  # noqa: E402
from evo.main_rpe import rpe  # noqa: E402

pytestmark = [pytest.mark.slow, pytest.mark.filterwarnings("ignore")]

# (recording in the shared folder, target, source); None: generated.
RECORDINGS = {
    "turtle": ("turtlesim_tf_demo.bag", "world", "turtle1"),
    "turtlebot": ("tb3_gazebo_walker", "odom", "base_footprint"),
    "e-puck": ("epuck_webots", "odom", "base_link"),
    "generated": None,
}


@pytest.fixture(params=RECORDINGS, scope="module")
def pair(request):
    """Return a reference, and an estimate with noise, another frame, another scale, other stamps and gaps."""
    source = RECORDINGS[request.param]
    if source is None:
        t = np.linspace(0, 30, 900)
        positions = np.stack([5 * np.sin(t / 3), 4 * np.cos(t / 5), 0.2 * t], axis=1)
        reference = coframe.Transform(
            positions,
            quaternion.from_rpy(np.stack([0.1 * np.sin(t), 0.05 * t, t / 3], axis=1)),
            stamp=1_000_000_000 + (t * 1e9).astype(np.int64),
        )
    else:
        shared = request.getfixturevalue("shared")
        with coframe.open_bag(shared / "recordings" / source[0]) as bag:
            reference = bag.buffer.trajectory(*source[1:])
    rng = np.random.default_rng(7)
    keep = np.flatnonzero(rng.random(len(reference)) < 0.7)
    noise = quaternion.from_rpy(rng.normal(scale=0.05, size=(len(keep), 3)))
    motion = coframe.Transform.from_rpy([2.0, -1.0, 0.5], [0.3, -0.2, 1.0])
    estimate = motion @ coframe.Transform(
        1.3 * reference.translation[keep] + rng.normal(scale=0.02, size=(len(keep), 3)),
        quaternion.multiply(reference.quaternion[keep], noise),
        stamp=reference.stamps[keep] + rng.integers(-2_000_000, 2_000_000, len(keep)),
    )
    return reference, estimate[np.argsort(estimate.stamps, kind="stable")]


def evo_trajectory(poses, start):
    """Return evo's trajectory, whose stamps are floats: counted from `start`, they keep their nanoseconds."""
    return trajectory.PoseTrajectory3D(
        poses.translation.copy(), np.roll(poses.quaternion, 1, axis=1), (poses.stamps - start) / 1e9
    )


def assert_equal(found, metric, pair):
    metric.process_data(pair)
    for name, value in metric.get_all_statistics().items():
        assert getattr(found, name) == pytest.approx(value, rel=1e-9, abs=1e-9), name


@pytest.mark.parametrize("align", ["none", "se3", "sim3"])
@pytest.mark.parametrize("delta", [Delta(1), Delta(7), Delta(0.35, "meters")], ids=str)
def test_errors_equal_those_of_evo(pair, align, delta):
    reference, estimate = pair
    found = compare_trajectories(reference, estimate, align=align, delta=delta)
    start = int(reference.stamps[0])
    theirs = sync.associate_trajectories(*(evo_trajectory(poses, start) for poses in pair))
    assert theirs[0].num_poses == len(found.reference)
    if align != "none":
        _, _, scale = theirs[1].align(theirs[0], correct_scale=align == "sim3")
        assert found.alignment.scale == pytest.approx(scale, rel=1e-12)
    translation, rotation = metrics.PoseRelation.translation_part, metrics.PoseRelation.rotation_angle_rad
    assert_equal(found.ape.translation_statistics, metrics.APE(translation), theirs)
    assert_equal(found.ape.rotation_statistics, metrics.APE(rotation), theirs)
    unit = {"frames": metrics.Unit.frames, "meters": metrics.Unit.meters}[delta.unit]
    assert_equal(found.rpe.translation_statistics, metrics.RPE(translation, delta.value, unit), theirs)
    assert_equal(found.rpe.rotation_statistics, metrics.RPE(rotation, delta.value, unit), theirs)


def test_evo_reads_the_files_that_are_written(tmp_path, pair):
    from evo.tools import file_interface

    reference, _ = pair
    readers = {
        "tum": file_interface.read_tum_trajectory_file,
        "kitti": file_interface.read_kitti_poses_file,
        "euroc": file_interface.read_euroc_csv_trajectory,
    }
    for kind, read in readers.items():
        path = tmp_path / kind
        coframe.trajectories.write_trajectory(reference, path, kind)
        np.testing.assert_allclose(read(path).poses_se3, reference.matrix, atol=1e-12)


@pytest.mark.parametrize(
    "options",
    [
        {"t_offset": "1ms"},
        {"t_offset": "-12ms", "max_difference": "20ms"},
        {"align": "se3", "n_to_align": 0.7},
        {"align": "sim3", "n_to_align": 0.7, "project": "xy"},
        {"align": "scale"},
        {"align_origin": True},
        {"align": "scale", "align_origin": True, "project": "yz"},
        {"align": "se3", "project": "xz"},
    ],
    ids=str,
)
def test_options_equal_those_of_evo(pair, options):
    reference, estimate = pair
    if "n_to_align" in options:  # a share of the pairs
        options = options | {"n_to_align": int(options["n_to_align"] * len(associate(reference, estimate)[0]))}
    found = compare_trajectories(reference, estimate, **options)
    start = int(reference.stamps[0])
    offset = options.get("t_offset", "0ms")
    theirs = sync.associate_trajectories(
        *(evo_trajectory(poses, start) for poses in pair),
        max_diff=float(options.get("max_difference", "10ms").removesuffix("ms")) / 1e3,
        offset_2=float(offset.removesuffix("ms")) / 1e3,
    )
    assert theirs[0].num_poses == len(found.reference)
    kind = options.get("align", "none")
    project = options.get("project")
    for metric, errors in ((ape, found.ape), (rpe, found.rpe)):
        for relation, statistics in (
            (metrics.PoseRelation.translation_part, errors.translation_statistics),
            (metrics.PoseRelation.rotation_angle_rad, errors.rotation_statistics),
        ):
            delta = {} if metric is ape else {"delta": 1, "delta_unit": metrics.Unit.frames}
            result = metric(
                *copy.deepcopy(theirs),
                relation,
                align=kind in {"se3", "sim3"},
                correct_scale=kind in {"sim3", "scale"},
                n_to_align=options.get("n_to_align", -1),
                align_origin=options.get("align_origin", False),
                project_to_plane=None if project is None else trajectory.Plane(project),
                **delta,
            )
            for name, value in result.stats.items():
                # Angles near 0 are exact to the root of the resolution in evo.
                assert getattr(statistics, name) == pytest.approx(value, rel=1e-7, abs=2e-7), name
