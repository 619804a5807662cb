# SPDX-License-Identifier: Apache-2.0
"""Solutions with one typical mistake each lose the points of the right facts, and the report names the mistake.

All other criteria of a mutant keep their points, because each criterion runs one file.
"""

import shutil

import pytest
from grades import SOLUTION, lost  # of this folder

from coframe.course.checking import check_folder
from coframe.course.translation.language import Language

pytestmark = [pytest.mark.slow, pytest.mark.timeout(300)]

STATIC, DYNAMIC, LISTENER = "static_tf_broadcaster.py", "dynamic_tf_broadcaster.py", "tf_listener.py"
SENSOR, TREE, VIEW = "sensor_transform.py", "complete_tf_tree.py", "lab.rviz"
CRITERIA = {
    STATIC: "static",
    DYNAMIC: "dynamic",
    LISTENER: "listener",
    SENSOR: "sensor",
    TREE: "visualization",
    VIEW: "visualization",
}
SPIN = "        rclpy.spin(node)\n"
NOW = "self.get_clock().now().to_msg()"
LOOKUP = '"base_link", "end_effector", Time()'
SCAN_LOOKUP = "TARGET, header.frame_id, stamp, timeout=Duration(seconds=0.2)"
VALID = "np.isfinite(ranges) & (ranges >= scan.range_min) & (ranges <= scan.range_max)"
ONE_CALL = "self.broadcaster.sendTransform([self.make(*mount) for mount in MOUNTS])"
ONE_CALL_EACH = "[self.broadcaster.sendTransform(self.make(*mount)) for mount in MOUNTS]"
TIMER = "        self.create_timer(0.5, self.send)\n"
LOOP = """        import time
        while rclpy.ok():
            self.simulate()
            time.sleep(0.02)
"""
SOURCE_FRAME = '        pose.header.frame_id = "end_effector"\n'
TIME = "(now - self.start).nanoseconds / 1e9"

# Name: file, replacements, points that remain, and words of the only cause that is named.
MUTANTS = {
    # Step 1
    "whole angle": (STATIC, [("HALF, 0.0, HALF)", "1.0, 0.0, 0.0)")], 17, "half"),
    "degrees": (STATIC, [("HALF, 0.0, HALF)", "math.sin(45), 0.0, math.cos(45))")], 17, "degrees"),
    "w first": (STATIC, [("(0.0, HALF, 0.0, HALF)", "(HALF, 0.0, HALF, 0.0)")], 17, "w, x, y, z"),
    "rounded": (STATIC, [("math.sqrt(0.5)", "0.707")], 19, "rounded"),
    "zeros": (STATIC, [("0.5), (0.0, 0.0, 0.0, 1.0)", "0.5), (0.0, 0.0, 0.0, 0.0)")], 17, "0, 0, 0, 0"),
    "inverted rotation": (STATIC, [("(0.0, HALF, 0.0, HALF)", "(0.0, -HALF, 0.0, HALF)")], 17, "is inverted"),
    "no rotation": (STATIC, [("        q.x, q.y, q.z, q.w = rotation\n", "")], 17, "rotation is missing"),
    "millimeters": (STATIC, [("(0.05, 0.0, 0.02)", "(50.0, 0.0, 20.0)")], 17, "millimeters"),
    "other number": (STATIC, [("0.0, 0.5), (0", "0.0, 0.6), (0")], 17, ""),
    "other parent": (STATIC, [('"end_effector", "camera', '"base_link", "camera')], 19, "'base_link' instead of"),
    "misspelled parent": (STATIC, [('"end_effector", "camera', '"end_efector", "camera')], 19, "misspelling"),
    "misspelled child": (STATIC, [('"imu_link"', '"imu_lnik"')], 16, "misspelling of 'imu_link'"),
    "slash": (STATIC, [('"base_link", "imu_link"', '"/base_link", "/imu_link"')], 16, "begins with a slash"),
    "capital letters": (STATIC, [('"imu_link"', '"IMU_link"')], 16, "letter by letter"),
    "parent for child": (STATIC, [('"end_effector", "camera_link"', '"camera_link", "end_effector"')], 16, "swapped"),
    "static on /tf": (STATIC, [("StaticTransformBroad", "TransformBroad")], 14, "StaticTransformBroadcaster"),
    "ends at once": (STATIC, [(SPIN, "        pass\n")], 16, "rclpy.spin(node)"),
    "one call each": (STATIC, [(ONE_CALL, ONE_CALL_EACH)], 19, "Send one list"),
    "repeated": (
        STATIC,
        [("        self.broadcaster.send", f"{TIMER}\n    def send(self):\n        self.broadcaster.send")],
        19,
        "repeatedly",
    ),
    "integer": (STATIC, [("(0.05, 0.0, 0.02)", "(0.05, 0, 0.02)")], 0, "AssertionError: The 'y' field must be of type"),
    "syntax": (STATIC, [("position, rotation):", "position, rotation)")], 0, "SyntaxError"),
    # Step 2
    "sin(q)": (DYNAMIC, [("sin(yaw / 2)", "sin(yaw)"), ("cos(yaw / 2)", "cos(yaw)")], 20, "sin(q / 2) and cos(q / 2)"),
    "angle in degrees": (
        DYNAMIC,
        [("sin(yaw / 2)", "sin(math.degrees(yaw) / 2)"), ("cos(yaw / 2)", "cos(math.degrees(yaw) / 2)")],
        20,
        "degrees",
    ),
    "wrong sign": (DYNAMIC, [("math.sin(yaw / 2)", "-math.sin(yaw / 2)")], 20, "sign of the angle"),
    "about x": (DYNAMIC, [("rotation.z =", "rotation.x =")], 20, "about x instead of z"),
    "lengths exchanged": (DYNAMIC, [("(0.5, 0.4)", "(0.4, 0.5)")], 21, "exchanged"),
    "other height": (DYNAMIC, [("RATE = 0.1", "RATE = 0.2")], 24, ""),
    "no 2 pi": (DYNAMIC, [("2 * math.pi * 0.2", "0.2"), ("2 * math.pi * 0.3", "0.3")], 20, "2 pi is missing"),
    "no phase": (DYNAMIC, [(" + math.pi / 4", "")], 22.5, "phase is missing"),
    "joints exchanged": (DYNAMIC, [("self.publish_arm(q1, q2)", "self.publish_arm(q2, q1)")], 20, "exchanged"),
    "other amplitude": (DYNAMIC, [("0.5 * math.sin", "0.6 * math.sin")], 22.5, ""),
    "counted": (DYNAMIC, [(f"t = {TIME}", "self.n = getattr(self, 'n', -1) + 1; t = self.n * 0.02")], 20, "counted"),
    "stands still": (DYNAMIC, [(f"t = {TIME}", "t = 0.0")], 20, "does not advance"),
    "wrong parent of link2": (DYNAMIC, [('"link1", "link2"', '"base_link", "link2"')], 24, "instead of 'link1'"),
    "slow": (DYNAMIC, [("50.0", "5.0")], 22, "the period of the timer is 0.2 s"),
    "period in milliseconds": (DYNAMIC, [("1.0 / RATE", "20")], 22, "takes seconds"),
    "no stamp": (DYNAMIC, [("        t.header.stamp = stamp\n", "")], 23, "header.stamp is not set"),
    "one stamp only": (
        DYNAMIC,
        [(f"stamp = {NOW}", f"stamp = self.stamp = getattr(self, 'stamp', None) or {NOW}")],
        23,
        "read once",
    ),
    "three stamps": (DYNAMIC, [("t.header.stamp = stamp", f"t.header.stamp = {NOW}")], 24, "read for each transform"),
    "ignores joint states": (
        DYNAMIC,
        [('        self.create_subscription(JointState, "/joint_states", self.follow, 10)\n', "")],
        19,
        "no subscription",
    ),
    "other topic of joint states": (DYNAMIC, [('"/joint_states"', '"/joint_state"')], 19, "/joint_state"),
    "two sources": (DYNAMIC, [("self.followed = True\n", "pass\n")], 22, "simulation continues"),
    "by position": (
        DYNAMIC,
        [('publish_arm(angles["joint1"], angles["joint2"])', "publish_arm(*message.position)")],
        24,
        "by position",
    ),
    "dynamic on /tf_static": (
        DYNAMIC,
        [("import TransformBroadcaster", "import StaticTransformBroadcaster as TransformBroadcaster")],
        22,
        "use TransformBroadcaster",
    ),
    "loop in the constructor": (
        DYNAMIC,
        [("        self.followed = False\n", f"        self.followed = False\n{LOOP}")],
        9,
        "does not run its callbacks",
    ),
    # Step 3
    "target for source": (LISTENER, [(LOOKUP, '"end_effector", "base_link", Time()')], 10, "swapped"),
    "lookup at now": (LISTENER, [("Time()", "self.get_clock().now()")], 0, "current time"),
    "misspelled source": (LISTENER, [('"end_effector", Time', '"end_efector", Time')], 0, "does not exist"),
    "no listener": (LISTENER, [("self.listener = TransformListener(self.buffer, self)", "")], 0, "TransformListener"),
    "stamp is now": (
        LISTENER,
        [("        pose.pose.position.x", f"        pose.header.stamp = {NOW}\n        pose.pose.position.x")],
        16.5,
        "not now()",
    ),
    "uncaught": (LISTENER, [("except TransformException", "except ZeroDivisionError")], 0, "LookupException"),
    "other topic": (LISTENER, [('"/end_effector_pose"', '"/ee_pose"')], 18.5, "/ee_pose instead of"),
    "other node": (LISTENER, [('__init__("tf_listener")', '__init__("listener")')], 18.5, "named listener"),
    "frame of the pose": (
        LISTENER,
        [("        pose.pose.position.x", f"{SOURCE_FRAME}        pose.pose.position.x")],
        17,
        "target of the lookup",
    ),
    "no orientation": (
        LISTENER,
        [("        pose.pose.orientation = transform.transform.rotation\n", "")],
        13,
        "orientation is not set",
    ),
    "rarely": (LISTENER, [("create_timer(0.1", "create_timer(0.2")], 16, "the period of the timer is 0.2 s"),
    "constant height": (LISTENER, [("= transform.transform.translation.z", "= 0.1")], 13, "position.z"),
    # Step 4
    "latest transform": (SENSOR, [("header.frame_id, stamp", "header.frame_id, Time()")], 17, "latest transform"),
    "no waiting": (SENSOR, [(", timeout=Duration(seconds=0.2)", "")], 15, "does not wait"),
    "one thread": (SENSOR, [(", executor=MultiThreadedExecutor()", "")], 15, "only thread"),
    "fixed frame name": (SENSOR, [("TARGET, header.frame_id", 'TARGET, "lidar_link"')], 17, "always 'lidar_link'"),
    "scan target for source": (SENSOR, [("TARGET, header.frame_id", "header.frame_id, TARGET")], 13, "swapped"),
    "cloud stamp is now": (SENSOR, [("stamp=header.stamp,", f"stamp={NOW},")], 17, "stamp is now()"),
    "nothing dropped": (
        SENSOR,
        [(VALID, "np.full(len(ranges), True)")],
        17,
        "no beam is dropped",
    ),
    "only finite": (SENSOR, [(VALID, "np.isfinite(ranges)")], 17, "only inf and NaN"),
    "angles not filtered": (
        SENSOR,
        [("ranges, angles = ranges[valid], angles[valid]", "ranges = ranges[valid]; angles = angles[:len(ranges)]")],
        13,
        "not filtered with the ranges",
    ),
    "R": (SENSOR, [("rotation.T", "rotation")], 13, "transpose"),
    "no translation": (SENSOR, [(" + [moved.x, moved.y, moved.z]", "")], 13, "translation of the transform"),
    "angles from zero": (SENSOR, [("scan.angle_min + ", "")], 13, "angle_min"),
    "degrees of beams": (SENSOR, [("np.cos(angles)", "np.cos(np.degrees(angles))")], 13, "converted to degrees"),
    "header copied": (SENSOR, [("frame_id=TARGET)", "frame_id=header.frame_id)")], 18, "header of the scan is copied"),
    "never published": (SENSOR, [("        self.publisher.publish(", "        (")], 0, ""),
    # Steps 5 and 6
    "other link length": (TREE, [('"link2", (0.5', '"link2", (0.9')], 14.71, ""),
    "drift too fast": (TREE, [("(0.001 * t", "(0.1 * t")], 14, "0.1 m/s instead of 0.001 m/s"),
    "unrotated camera": (TREE, [(", (0.0, HALF, 0.0, HALF)", "")], 14.71, "rotation is missing"),
    "inverted edge": (TREE, [('"odom", "base_link"', '"base_link", "odom"')], 11.78, ""),
    "two parents": (
        TREE,
        [('self.make("map", "odom"', 'self.make("world", "odom", (0.0, 0.0, 0.0)), self.make("map", "odom"')],
        13,
        "same child_frame_id",
    ),
    "time stands still": (TREE, [(f"t = {TIME}", "t = 0.0")], 12, "does not advance"),
    "disconnected": (TREE, [('"map", "odom"', '"mapp", "odom"')], 11.78, "misspelling"),
    "fixed frame missing": (VIEW, [("base_link", "base_lnk")], 14, "misspelling of 'base_link'"),
    "topic of a display": (VIEW, [("/scan_base_frame", "/cloud")], 14, ""),
}  # fmt: skip


def mutate(folder, file, replacements):
    """Copy the solution to a folder, with replacements in a file."""
    shutil.copytree(SOLUTION, folder)
    text = (folder / file).read_text()
    for old, new in replacements:
        assert old in text, old
        text = text.replace(old, new)
    (folder / file).write_text(text)


def examine(folder, criterion):
    """Return the points of a criterion, and the causes of its lost points."""
    (found,) = check_folder(folder, only=(criterion,))["criteria"]
    facts = lost(found)
    assert all(fact["observed"] for fact in facts.values()), facts
    shown = [
        fact[key] for fact in facts.values() for key in ("name", "expected", "observed", "cause", "read") if fact[key]
    ]
    assert [text for text in shown if not Language("de").has(text)] == [], "not in German"
    return found["earned"], {fact["cause"] for fact in facts.values()} - {""}, facts


@pytest.mark.parametrize("name", MUTANTS)
def test_a_mistake_loses_its_points_and_is_named(name, tmp_path):
    file, replacements, points, words = MUTANTS[name]
    mutate(tmp_path / "lab", file, replacements)
    earned, causes, facts = examine(tmp_path / "lab", CRITERIA[file])
    assert earned == points, facts
    if words:
        assert causes, facts
        unrelated = [cause for cause in causes if words not in cause]
        assert not unrelated, unrelated
    elif name != "inverted edge":
        assert not causes, "no mistake of the list explains it, so no cause may be printed"


# The list that teachers have collected: points that remain, and words of the cause.
COLLECTED = {
    "st_sin_q": (17, "half"), "st_degrees": (17, "degrees"), "st_wxyz": (17, "w, x, y, z"), "st_0707": (19, "rounded"),
    "st_zero_quat": (17, "0, 0, 0, 0"), "st_typo": (19, "misspelling"), "st_swapped_parent": (16, "swapped"),
    "st_on_tf": (14, "StaticTransformBroadcaster"), "st_nospin": (16, "spin"), "st_three_calls": (19, "one list"),
    "st_timer": (19, "repeatedly"), "st_int": (0, "AssertionError"), "st_mm": (17, "millimeters"),
    "st_slash": (16, "slash"), "st_forgot_rotation": (17, "missing"), "st_syntax": (0, "SyntaxError"),
    "dy_sin_q": (20, "sin(q / 2)"), "dy_degrees": (20, "degrees"), "dy_wxyz": (20, "w, x, y, z"),
    "dy_swaplen": (21, "exchanged"), "dy_counter": (20, "counted"), "dy_timetime": (20, ""),
    "dy_two_sources": (22, "continues"), "dy_no_js": (19, "no subscription"), "dy_js_order": (24, "by position"),
    "dy_3stamps": (24, "read for each"), "dy_nostamp": (23, "not set"), "dy_20hz": (22, "0.2 s"),
    "dy_timer_ms": (22, "seconds"), "dy_on_static": (22, "TransformBroadcaster"), "dy_sign": (20, "sign"),
    "dy_nospin": (0, "spin"), "dy_swapq": (20, "exchanged"), "dy_2pi": (22.5, "2 pi"), "dy_stuck_loop": (9, ""),
    "dy_sleep_loop": (9, "callbacks"), "dy_noname_return": (22, "continues"), "li_swapped": (10, "swapped"),
    "li_now": (0, "current time"), "li_stamp_now": (16.5, "now()"), "li_nocatch": (0, "LookupException"),
    "li_typo": (0, "does not exist"), "li_topic": (18.5, "/ee_pose"), "li_frame": (17, "target"),
    "li_no_orient": (13, "orientation"), "li_except_exception": (0, "AttributeError"), "li_50hz": (16, "0.02 s"),
    "li_own_fk": (13, "position.z"), "li_nodename": (18.5, "listener"), "li_blocking": (0, "current time"),
    "li_nolistener": (0, "TransformListener"), "se_latest": (17, "latest"), "se_notimeout": (15, "wait"),
    "se_hardframe": (17, "lidar_link"), "se_swapped": (13, "swapped"), "se_stampnow": (17, "now()"),
    "se_nofilter": (17, "dropped"), "se_nanfilter_only": (17, "only inf"), "se_anglesunfiltered": (13, "filtered"),
    "se_RnotT": (13, "transpose"), "se_scanframe": (18, "copied"), "se_never": (0, ""), "se_single": (15, "thread"),
    "se_deg": (13, "degrees"), "se_float64": (20, ""), "co_wronglen": (13.43, ""), "co_inverted": (11.78, ""),
    "co_two_parents": (13, "child_frame_id"), "co_notmoving": (12, "advance"),
}  # fmt: skip


@pytest.fixture
def collected(shared, tmp_path):
    """Return a function that makes a mutant of the list, and the list."""
    script = shared / "cases" / "course" / "mutate.py"
    if not script.is_file():
        pytest.skip("the list is not in this checkout")
    names = {}
    exec(script.read_text().split("def go(")[0].replace("pathlib.Path('sol')", "pathlib.Path('.')"), names)

    def make(name):
        file, criterion, replacements = names["M"][name]
        mutate_from(tmp_path / "lab", script.parent / "solution", file, replacements)
        return tmp_path / "lab", criterion

    return make


def mutate_from(folder, programs, file, replacements):
    """Copy the solution with the programs of another folder, and replace texts in one of them."""
    shutil.copytree(SOLUTION, folder)
    for program in programs.glob("*.py"):
        shutil.copy(program, folder)
    text = (folder / file).read_text()
    for old, new in replacements:
        assert old in text, old
        text = text.replace(old, new)
    (folder / file).write_text(text)


@pytest.mark.long
@pytest.mark.parametrize("name", COLLECTED)
def test_a_collected_mistake_loses_its_points_and_is_named(name, collected):
    points, words = COLLECTED[name]
    folder, criterion = collected(name)
    earned, causes, facts = examine(folder, criterion)
    assert earned == points, facts
    if words:
        assert causes
        assert all(words in cause for cause in causes), causes


def test_a_mistake_loses_points_in_its_own_criterion_only(tmp_path):
    mutate(tmp_path / "lab", DYNAMIC, [("(0.5, 0.4)", "(0.4, 0.5)")])
    found = {each["file"]: each for each in check_folder(tmp_path / "lab")["criteria"]}
    assert {file for file, criterion in found.items() if lost(criterion)} == {DYNAMIC}
