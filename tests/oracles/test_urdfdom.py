# SPDX-License-Identifier: Apache-2.0
"""Robot descriptions that ROS accepts, by urdfdom itself: `check_urdf` is part of Pinocchio's wheel."""

import os
import random
import subprocess
import sysconfig
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

from coframe.robots import RobotDescriptionError, parse_urdf

pytestmark = pytest.mark.slow
PREFIX = Path(sysconfig.get_path("purelib"), "cmeel.prefix")
CHECK = PREFIX / "bin" / "check_urdf"
if not CHECK.exists():
    pytest.skip("urdfdom (pip install --group oracle) is not installed", allow_module_level=True)
pinocchio = pytest.importorskip("pinocchio", reason="Pinocchio (pip install --group oracle) is not installed")

COUNT = 3000
SHAPES = [
    "<box size='1 1 1'/>",
    "<cone/>",
    "<box/>",
    "<mesh filename='a&amp;b.stl' scale='2'/>",
    "<sphere radius='x'/>",
    "",
]
MASSES = [
    "<mass value='1'/>",
    "<mass/>",
    "<inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/>",
    "<inertia ixx='1'/>",
]
ORIGINS = [
    *("<origin xyz='1 2 3'/>", "<origin rpy='0.1 -0.2 0.3'/>", "<origin xyz=' .5  -1e-1 +2. '/>", "<origin/>"),
    *("<origin xyz='0 0'/>", "<origin xyz='1,2,3'/>", "<origin xyz='nan 0 0'/>", "<origin xyz='1e400 0 0'/>"),
    *("<origin quat_xyzw='0 0 3 4'/>", "<origin quat_xyzw='0 0 0 0'/>", "<origin rpy='1 0 0' quat_xyzw='0 0 3 4'/>"),
]
AXES = ["<axis xyz='0 0 2'/>", "<axis xyz='1 1 0'/>", "<axis/>", "<axis xyz='0 0 0'/>", "<axis xyz='0 1'/>"]
LIMITS = [
    *("<limit lower='-1' upper='1' effort='1' velocity='1'/>", "<limit effort='1' velocity='1'/>", "<limit/>"),
    *("<limit lower='1' upper='-1' effort='1' velocity='1'/>", "<limit lower='x' upper='1' effort='1' velocity='1'/>"),
]
MIMICS = [
    "<mimic joint='j1'/>",
    "<mimic joint='nobody'/>",
    "<mimic joint='j2' multiplier='2'/>",
    "<mimic/>",
    "<mimic joint='j1' offset='x'/>",
]
TYPES = ["fixed", "revolute", "continuous", "prismatic", "planar", "floating", "Fixed"]
WEIGHTS = [4, 4, 4, 2, 1, 1, 0.1]
NOISE = [
    "<!-- a -- b -->",
    "<gazebo reference='l1'><a><b/></a></gazebo>",
    "<transmission name='t'><joint name='j1'/></transmission>",
]
NOISE += [
    "<sensor:ray/>",
    "<![CDATA[<link name='x'/>]]>",
    "text & more",
    "<material name='m'><color rgba='1 0 0'/></material>",
]


def document(rng: random.Random) -> str:
    """Return a robot of up to five links, most of whose parts are valid."""
    count = rng.randrange(1, 6)
    fault = rng.choice([0.0, 0.05, 0.3])

    def some(parts: list[str], likely: int) -> str:
        """Return one of the first parts, or rarely any."""
        return rng.choice(parts if rng.random() < fault else parts[:likely])

    def several(*parts: str) -> str:
        return "".join(part for part in parts for _ in range(rng.choice([0, 1, 1, 1, 1, 1, 2])))

    links = [
        f"<link name='l{i}'>"
        + several(f"<visual>{several(some(ORIGINS, 4), f'<geometry>{some(SHAPES, 1)}</geometry>')}</visual>")
        + several(f"<inertial>{several(*rng.sample(MASSES, 2))}</inertial>")
        + "</link>"
        for i in range(count)
    ]
    joints = [
        f"<joint name='j{i}' type='{rng.choices(TYPES, WEIGHTS)[0]}'>"
        f"<parent link='l{rng.randrange(i) if rng.random() > fault / 5 else rng.randrange(9)}'/><child link='l{i}'/>"
        + several(some(ORIGINS, 4), some(AXES, 3), some(LIMITS, 1))
        + (some(MIMICS, 3) if rng.random() < 0.2 else "")
        + "</joint>"
        for i in range(1, count)
    ]
    parts = [*links, *joints, *(rng.choice(NOISE) for _ in range(rng.randrange(3)))]
    rng.shuffle(parts)
    version = rng.choice(["", "", " version='1.0'", " version='1.1'", " version='1.2'"])
    return f"<?xml version='1.0'?>\n<robot name='r'{version}>\n" + "\n".join(parts) + "\n</robot>"


def accepts(path: Path) -> bool:
    # check_urdf prints the tree without end if there is a loop.
    environment = {**os.environ, "LD_LIBRARY_PATH": str(PREFIX / "lib"), "DYLD_LIBRARY_PATH": str(PREFIX / "lib")}
    with subprocess.Popen([CHECK, path], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, env=environment) as check:
        assert check.stdout is not None
        answer = check.stdout.read(2000)
        check.kill()
    return b"Successfully Parsed" in answer


@pytest.fixture(scope="module")
def robots(tmp_path_factory) -> list[tuple[str, bool]]:
    """Return generated descriptions, and whether urdfdom accepts them."""
    folder = tmp_path_factory.mktemp("robots")
    rng = random.Random(33)
    paths = [folder / f"{i}.urdf" for i in range(COUNT)]
    for path in paths:
        path.write_text(document(rng))
    with ThreadPoolExecutor(2) as pool:
        return [(path.read_text(), accepted) for path, accepted in zip(paths, pool.map(accepts, paths), strict=True)]


def test_what_urdfdom_accepts_is_loaded_except_loops_and_swapped_limits(robots):
    accepted = [text for text, is_accepted in robots if is_accepted]
    assert len(accepted) > COUNT / 4
    assert len(accepted) < COUNT * 0.95
    refused = {}
    for text in accepted:
        try:
            parse_urdf(text)
        except RobotDescriptionError as error:
            refused[str(error)] = text
    deliberate = ("above the upper limit", "form a loop", "to itself", "has two parents")
    assert [error for error in refused if not any(reason in error for reason in deliberate)] == []
    assert len(refused) < len(accepted) / 20


def test_origins_are_those_of_urdfdom(robots):
    compared = 0
    for text, is_accepted in robots:
        if not is_accepted:
            continue
        try:
            robot = parse_urdf(text)
            model = pinocchio.buildModelFromXML(robot.text)
        except (RobotDescriptionError, ValueError, RuntimeError):  # Pinocchio refuses some that urdfdom accepts
            continue
        data = model.createData()
        pinocchio.framesForwardKinematics(model, data, pinocchio.neutral(model))
        frames = robot.frames()
        for link, pose in frames.items():
            theirs = data.oMf[model.getFrameId(link, pinocchio.FrameType.BODY)].homogeneous
            np.testing.assert_allclose(pose.matrix, theirs, rtol=0, atol=1e-12, err_msg=text)
        compared += len(frames) > 1
    assert compared > COUNT / 10
