# SPDX-License-Identifier: Apache-2.0
"""Hand-eye calibration, compared with OpenCV, and with GTSAM where it is installed: `pip install gtsam`."""

import cv2
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from coframe import Transform, quaternion
from coframe.calibration import calibrate_hand_eye, calibrate_rigid
from coframe.time import SECOND

MOUNT = Transform([0.08, -0.03, 0.12], Rotation.from_euler("xyz", [0.2, -1.1, 1.7]).as_quat())
TAG = Transform([1.4, 0.3, 0.2], Rotation.from_euler("xyz", [0.1, 0.4, -2.0]).as_quat())  # in the base
NOISE = np.array([0.001, 0.001, 0.001, 0.002, 0.002, 0.002])  # radians and meters, in the order of GTSAM


def gripper_and_tag(seed, noise=NOISE):
    """Return the poses of a gripper in its base, and of a tag in the camera on it, at the same times."""
    random = np.random.default_rng(seed)
    times = np.arange(0.0, 30.0, 0.1)
    waves = np.sin(times[:, None] * random.uniform(0.3, 1.4, 6) + random.uniform(0.0, 6.0, 6))
    right = Transform(0.4 * waves[:, :3], Rotation.from_euler("xyz", 0.6 * waves[:, 3:]).as_quat())
    stamps = np.rint(times * SECOND).astype(np.int64)

    def noisy(poses):
        turns = quaternion.from_rotvec(random.normal(0.0, 1.0, (len(times), 3)) * noise[:3])
        places = poses.translation + random.normal(0.0, 1.0, (len(times), 3)) * noise[3:]
        return Transform(places, quaternion.multiply(poses.quaternion, turns), stamp=stamps)

    camera = noisy(right @ MOUNT)
    return noisy(right), camera.inverse() @ TAG


def difference(found, other):
    turn = quaternion.multiply(found.quaternion, quaternion.inverse(other.quaternion))
    return np.concatenate([found.translation - other.translation, quaternion.to_rotvec(turn)])


@pytest.mark.parametrize("method", [cv2.CALIB_HAND_EYE_PARK, cv2.CALIB_HAND_EYE_DANIILIDIS], ids=["Park", "Daniilidis"])
def test_opencv_finds_the_same_mount(method):
    gripper, tag = gripper_and_tag(1)
    some = slice(None, None, 6)
    poses = [np.asarray(part) for each in (gripper[some], tag[some]) for part in (each.rotation, each.translation)]
    turn, place = cv2.calibrateHandEye(*poses, method=method)
    theirs = Transform(place[:, 0], Rotation.from_matrix(turn).as_quat())
    found = calibrate_hand_eye(gripper, tag, time_offset=0.0)
    assert np.abs(difference(found.transform, MOUNT) / found.deviations).max() < 4.0
    assert found.transform.is_close(theirs, translation=4e-3, rotation=2e-3)


@pytest.mark.slow
def test_gtsam_finds_the_same_mount_with_a_factor_for_each_pose():
    gtsam = pytest.importorskip("gtsam", reason="GTSAM (pip install gtsam) is not installed")

    def pose3(pose):
        return gtsam.Pose3(gtsam.Rot3(pose.rotation), pose.translation)

    def factor(gripper, camera):
        """Return the factor of gripper @ mount == reference @ camera; the keys are the mount and the reference."""
        noise = gtsam.noiseModel.Diagonal.Sigmas(np.sqrt(2.0) * NOISE)

        def error(mount, reference):
            return reference.compose(camera).localCoordinates(gripper.compose(mount))

        def evaluate(_, values, jacobians):
            mount, reference = values.atPose3(0), values.atPose3(1)
            at = error(mount, reference)
            if jacobians is not None:
                steps = 1e-6 * np.eye(6)
                jacobians[0] = np.array([(error(mount.retract(step), reference) - at) / 1e-6 for step in steps]).T
                jacobians[1] = np.array([(error(mount, reference.retract(step)) - at) / 1e-6 for step in steps]).T
            return at

        return gtsam.CustomFactor(noise, [0, 1], evaluate)

    for seed in range(3):
        gripper, tag = gripper_and_tag(seed)
        camera = tag.inverse()
        found = calibrate_rigid(gripper, camera, time_offset=0.0)
        graph, start = gtsam.NonlinearFactorGraph(), gtsam.Values()
        for own, other in zip(gripper[::2], camera[::2], strict=True):
            graph.add(factor(pose3(own), pose3(other)))
        start.insert(0, pose3(found.transform))
        start.insert(1, pose3(found.reference))
        result = gtsam.LevenbergMarquardtOptimizer(graph, start).optimize()
        theirs = Transform.from_matrix(result.atPose3(0).matrix())
        spread = np.sqrt(np.diag(gtsam.Marginals(graph, result).marginalCovariance(0)))[[3, 4, 5, 0, 1, 2]]
        assert np.abs(difference(found.transform, theirs) / found.deviations).max() < 4.0
        # GTSAM uses absolute poses, which determine the mount better than motions as long as nothing drifts.
        assert spread.max() < 2.0 * found.deviations.max()
        assert found.deviations.max() < 20.0 * spread.max()
