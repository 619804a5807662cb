# SPDX-License-Identifier: Apache-2.0
"""Real robots with their meshes in a browser; `make test-slow` installs them."""

import importlib.metadata

import numpy as np
import pytest

import coframe

pytestmark = pytest.mark.slow

ROBOTS = ("panda", "talos_reduced", "ur5_robot", "tiago")
ROBOT = "Object.values(coframe.displays).find((one) => one.class === 'RobotModel' && one.robot)"


def description(name):
    try:
        files = importlib.metadata.files("example-robot-data") or []
    except importlib.metadata.PackageNotFoundError:
        pytest.skip("example-robot-data (pip install --group oracle) is not installed")
    return next(file.locate() for file in files if file.stem == name and file.suffix == ".urdf")


@pytest.mark.parametrize("name", ROBOTS)
def test_a_real_robot_is_drawn_with_all_meshes_at_the_poses_of_its_joints(view, open_page, tmp_path, name):
    path = description(name)
    robot = coframe.robots.load(path)
    buffer = coframe.Buffer(None)
    buffer.set("map", robot.root, coframe.Transform(), static=True)
    page = open_page(view(buffer, robot=path, fixed="map").url).drawn()
    page.until(f"{ROBOT} && {ROBOT}.loading === 0 && {ROBOT}.state !== 'waiting'")
    shown = page.evaluate(ROBOT)
    page.raw.screenshot(path=tmp_path / f"{name}.png")
    print(f"{name}: {shown['meshes']} meshes, {shown['state']}: {shown['text']}; {tmp_path / name}.png")
    assert shown["visible"]
    assert shown["meshes"] >= sum(len(link.visuals) for link in robot.links.values())
    joints = page.evaluate("[...document.querySelectorAll('#body-joints .joint')].map((one) => one.dataset.joint)")
    assert joints == list(robot.free_joints)
    for link, transform in robot.frames(robot.zeros()).items():
        np.testing.assert_allclose(shown["links"][link][:3], transform.translation, atol=1e-5, err_msg=link)
        assert abs(np.dot(shown["links"][link][3:], transform.quaternion)) == pytest.approx(1.0, abs=1e-5), link
