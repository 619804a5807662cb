# SPDX-License-Identifier: Apache-2.0
"""``coframe doctor BAG --fix OUT``: what has one safe repair is repaired, and the rest is listed with its choices."""

import drives
import pytest
import recordings
from click.testing import CliRunner
from drives import SECOND, Drive

import coframe
from coframe.bags import Recipe
from coframe.cli.app import app
from coframe.doctor import diagnose, observe_recording
from coframe.doctor.repair_plan import plan_repair


def run(*arguments):
    return CliRunner().invoke(app, ["doctor", *map(str, arguments)])


def healthy(path):
    return run(path).exit_code == 0


def with_mount(child, pose):
    mounts = Drive().mounts
    return Drive(mounts={**mounts, child: (mounts[child][0], pose)})


SAFE = {
    "a misspelled frame": (
        Drive(mounts={("Laser" if child == "laser" else child): mount for child, mount in Drive().mounts.items()}),
        "rename-frame: Laser=laser",
    ),
    "a clock that is an hour off": (Drive(tf_shift=-3600 * SECOND), "shift: odom->base_link=+1h"),
    "a clock that is an hour ahead": (Drive(tf_shift=3600 * SECOND), "shift: odom->base_link=-1h"),
    "a clock that is two hours ahead": (Drive(tf_shift=2 * 3600 * SECOND), "shift: odom->base_link=-2h"),
    "everything twice": (Drive(repeats=True), "dedupe"),
    "an optical frame that is not turned": (
        with_mount("camera_optical", (0, 0, 0, 0, 0, 0, 1)),
        "replace-mount: camera_optical 0 0 0 -0.5 0.5 -0.5 0.5",
    ),
}


@pytest.mark.parametrize("fault", SAFE)
def test_one_safe_repair(tmp_path, fault):
    drive, rule = SAFE[fault]
    broken = drives.write(tmp_path / "broken", drive)
    result = run(broken, "--fix", tmp_path / "fixed", "--yes")
    assert result.exit_code == 0, result.output
    assert f"- {rule}" in result.stdout
    assert "healthy" in result.stdout.rpartition("fixed:")[2]
    assert healthy(tmp_path / "fixed")
    right = drives.write(tmp_path / "right", Drive())
    assert drives.contents(tmp_path / "fixed") == drives.contents(right)


CHOICES = {
    "a missing mount": (
        Drive(mounts={child: mount for child, mount in Drive().mounts.items() if child != "laser"}),
        "choose: --set-static base_link laser X Y Z ROLL PITCH YAW",
    ),
    "two publishers": (Drive(second=(0.5, 0.4)), "choose: --drop-publisher 'odom->base_link#2'"),
    "an unknown clock": (Drive(tf_shift=-12345 * SECOND), "choose: --shift 'odom->base_link=+12345001ms'"),
}


@pytest.mark.parametrize("fault", CHOICES)
def test_a_finding_that_needs_a_choice(tmp_path, fault):
    drive, choice = CHOICES[fault]
    broken = drives.write(tmp_path / "broken", drive)
    result = run(broken, "--fix", tmp_path / "fixed", "--yes")
    assert result.exit_code == 1
    assert choice in result.stdout
    assert not (tmp_path / "fixed").exists()


def test_what_can_be_repaired_is_repaired_and_the_rest_is_listed(tmp_path):
    mounts = {child: mount for child, mount in Drive().mounts.items() if child != "laser"}
    broken = drives.write(tmp_path / "broken", Drive(mounts=mounts, tf_shift=-3600 * SECOND))
    result = run(broken, "--fix", tmp_path / "fixed", "--yes")
    assert result.exit_code == 1
    end = result.stdout.rpartition("fixed:")[2]
    assert "TF009" not in end
    assert "choose: --set-static base_link laser" in end


def test_two_repairs_of_one_mount_are_a_choice():
    def report(*rules):
        findings = [
            coframe.doctor.Finding("TF021", coframe.doctor.Severity.WARNING, "x", "y", ("a", "b"), repairs=(rule,))
            for rule in rules
        ]
        return coframe.doctor.Report(findings, [], None)

    same = plan_repair([report("replace-mount b 1 0 0 0 0 0", "replace-mount b 1 0 0 0 0 0")])
    assert (len(same.recipe), same.choices) == (1, [])
    rules = ["replace-mount b 1 0 0 0 0 0", "replace-mount b 2 0 0 0 0 0"]
    two = plan_repair([report(*rules)])
    assert len(two.recipe) == 0
    assert [options for _, options in two.choices] == [rules, rules]


def test_names_are_changed_last(tmp_path):
    mounts = {("Laser" if child == "laser" else child): mount for child, mount in Drive().mounts.items()}
    mounts["Laser"] = ("base_link", (200.0, 0.0, 300.0, 0.0, 0.0, 0.0, 1.0))
    broken = drives.write(tmp_path / "broken", Drive(mounts=mounts))
    reports = [diagnose(one) for one in observe_recording(broken).values()]
    assert [rule.name for rule in plan_repair(reports).recipe] == ["replace-mount", "rename-frame"]
    assert run(broken, "--fix", tmp_path / "fixed", "--yes").exit_code == 0


def test_the_recipe_is_printed_and_can_be_applied(tmp_path):
    mounts = {child: mount for child, mount in Drive().mounts.items() if child != "laser"}
    broken = drives.write(tmp_path / "broken", Drive(mounts=mounts, tf_shift=-3600 * SECOND))
    result = run(broken, "--recipe")
    assert result.exit_code == 0
    assert "#   choose: --set-static base_link laser" in result.stdout
    (tmp_path / "fix.yaml").write_text(result.stdout)
    assert [str(rule) for rule in Recipe.load(tmp_path / "fix.yaml")] == ["shift odom->base_link=+1h"]
    fixed = ["bag", "edit", str(broken), "--recipe", str(tmp_path / "fix.yaml"), "-o", str(tmp_path / "fixed")]
    assert CliRunner().invoke(app, fixed).exit_code == 0
    assert "TF009" not in run(tmp_path / "fixed").stdout


def test_a_damaged_recording_is_read_as_far_as_possible_and_repaired(tmp_path):
    broken = drives.write(tmp_path / "broken", Drive(tf_shift=-3600 * SECOND))
    (file,) = broken.glob("*.mcap")
    data = file.read_bytes()
    file.write_bytes(data[: len(data) * 3 // 4])
    result = run(broken, "--fix", tmp_path / "fixed", "--yes")
    assert "damaged:" in result.stdout
    assert "truncated" in result.stdout
    assert "messages on" in result.stdout
    assert healthy(tmp_path / "fixed"), result.output


def test_a_healthy_recording_is_not_copied(tmp_path):
    drive = drives.write(tmp_path / "drive", Drive())
    result = run(drive, "--fix", tmp_path / "fixed", "--yes")
    assert (result.exit_code, "nothing to repair" in result.stdout) == (0, True)
    assert not (tmp_path / "fixed").exists()


def test_it_asks_and_never_overwrites(tmp_path):
    broken = drives.write(tmp_path / "broken", Drive(repeats=True))
    result = run(broken, "--fix", tmp_path / "fixed")
    assert (result.exit_code, "--yes" in result.stderr) == (2, True)
    assert not (tmp_path / "fixed").exists()
    result = run(broken, "--fix", broken, "--yes")
    assert (result.exit_code, "is not overwritten" in result.stderr) == (1, True)


@pytest.mark.parametrize("arguments", [["--fix", "x"], ["--recipe"]])
def test_live_systems_are_not_repaired(arguments):
    result = run(*arguments)
    assert (result.exit_code, "need a recording" in result.stderr) == (2, True)


def test_it_repairs_a_bag_of_ros1(tmp_path):
    def rows():
        for topic, at, data in recordings.messages(recordings.ros1):
            yield topic, at, data
            if topic == "/tf":
                yield topic, at + 10, data

    broken = recordings.write_rosbag1(tmp_path / "old.bag", rows=list(rows()))
    result = run(broken, "--fix", tmp_path / "fixed", "--yes", "--ignore", "TF013")
    assert result.exit_code == 0, result.output
    assert len(drives.contents(tmp_path / "fixed")) == recordings.COUNT + 1
