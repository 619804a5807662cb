# SPDX-License-Identifier: Apache-2.0
"""Kinematics of real robots, compared with Pinocchio. `make test-slow` installs both."""

import importlib.metadata
import re
from pathlib import Path

import numpy as np
import pytest

from coframe.robots import RobotDescriptionError, load

pytestmark = pytest.mark.slow
pinocchio = pytest.importorskip("pinocchio", reason="Pinocchio (pip install --group oracle) is not installed")

BROKEN = {
    "ur3.urdf": "the robot has no links",
}


def robots():
    try:
        files = importlib.metadata.files("example-robot-data") or []
    except importlib.metadata.PackageNotFoundError:
        return []
    return sorted(file.locate() for file in files if file.suffix == ".urdf")


def test_all_valid_example_robots_are_loaded():
    if not robots():
        pytest.skip("example-robot-data is not installed")
    refused = {}
    for path in robots():
        try:
            load(path)
        except RobotDescriptionError as error:
            refused[path.name] = str(error)
    assert refused.keys() == BROKEN.keys()
    assert all(BROKEN[name] in text for name, text in refused.items())


@pytest.mark.parametrize("path", [p for p in robots() if p.name not in BROKEN], ids=lambda p: p.stem)
def test_a_hundred_configurations_agree_with_pinocchio(path):
    robot = load(path)
    model = pinocchio.buildModelFromUrdf(str(path))
    data = model.createData()
    rng = np.random.default_rng(1)
    moving = [joint for joint in robot.joints.values() if joint.size]
    positions = {joint.name: rng.uniform(-np.pi, np.pi, 100) for joint in moving}
    batch = robot.frames(positions)
    frames = {
        link: (model.getFrameId(link, pinocchio.FrameType.BODY), np.broadcast_to(batch[link].matrix, (100, 4, 4)))
        for link in robot.links
    }
    some = list(robot.links)[-1]
    follows_nothing = all(joint.mimic is None for joint in moving)
    for i in range(100):
        q = pinocchio.neutral(model)
        for joint in moving:
            theirs = model.joints[model.getJointId(joint.name)]
            angle = positions[joint.name][i]
            q[theirs.idx_q : theirs.idx_q + theirs.nq] = angle if theirs.nq == 1 else (np.cos(angle), np.sin(angle))
        pinocchio.framesForwardKinematics(model, data, q)
        for frame, computed in frames.values():
            np.testing.assert_allclose(computed[i], data.oMf[frame].homogeneous, rtol=0, atol=1e-12)
        if follows_nothing and i < 10:
            jacobian = pinocchio.computeFrameJacobian(
                model, data, q, frames[some][0], pinocchio.ReferenceFrame.LOCAL_WORLD_ALIGNED
            )
            columns = [model.joints[model.getJointId(name)].idx_v for name in robot.free_joints]
            given = {name: values[i] for name, values in positions.items()}
            computed = robot.jacobian(some, given)
            np.testing.assert_allclose(computed, jacobian[:, columns], rtol=0, atol=1e-12)
            local = pinocchio.computeFrameJacobian(model, data, q, frames[some][0], pinocchio.ReferenceFrame.LOCAL)
            point = np.array([0.1, -0.2, 0.3])
            moved = pinocchio.SE3(np.eye(3), point).inverse().action @ local  # of a frame at the point
            computed = robot.jacobian(some, given, point=point, expressed_in=some)
            np.testing.assert_allclose(computed, moved[:, columns], rtol=0, atol=1e-12)


@pytest.mark.parametrize("path", [p for p in robots() if p.stem in {"panda", "ur5_robot", "talos_full_v2"}], ids=str)
def test_a_robot_is_the_same_in_pinocchio(path):
    robot = load(path)
    model = robot.to_pinocchio()
    assert model.name == robot.name
    assert set(robot.free_joints) <= set(model.names)
    assert all(model.existFrame(link) for link in robot.links)


def test_the_page_about_pinocchio_says_what_it_does(capsys):
    page = (Path(__file__).parents[2] / "docs/how-to/pinocchio.md").read_text(encoding="utf-8")
    source = "\n".join(re.findall(r"```python\n(.*?)```", page, re.DOTALL))
    exec(compile(source, "pinocchio.md", "exec"), {"__name__": "page"})
    assert capsys.readouterr().out.splitlines() == re.findall(r"print\(.*\) +# (.*)", source)
