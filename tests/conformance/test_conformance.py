# SPDX-License-Identifier: Apache-2.0
"""The conformance cases, run against coframe, the drop-in BufferCore, and Debian's real tf2 of ROS 1."""

import collections
import contextlib
import importlib.util
import io
import json
import re
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

import tf2_py
from geometry_msgs.msg import Quaternion, Vector3

FOLDER = Path(__file__).resolve().parents[2] / "conformance"
DEBIAN_PYTHON = "/usr/bin/python3"
DEBIAN_ADAPTER = Path(__file__).with_name("debian_tf2_adapter.py")
ROS1 = json.loads(Path(__file__).with_name("ros1_differences.json").read_text("utf-8"))


def load_runner():
    spec = importlib.util.spec_from_file_location("conformance_run", FOLDER / "run.py")
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


run = load_runner()
CASES = run.load_cases()
LOG_LINE = re.compile(r"^(Error|Warning): +(.*?)\n(?=Error: |Warning: |\Z)", re.MULTILINE | re.DOTALL)
every_case = pytest.mark.parametrize("case", CASES, ids=[case.id for case in CASES])


def assert_passes(case, adapter):
    outcome = run.run_case(case, adapter)
    if outcome.unsupported:
        pytest.skip(outcome.unsupported)
    for difference in outcome.differences:
        pytest.fail(
            f"{case.shows}\nstep {difference.step}: {difference.request}\n"
            f"expected {difference.expected}\nfound    {difference.found}"
        )


class BufferCoreAdapter:
    """The drop-in tf2_py.BufferCore under test, through its public interface: messages, and the log on stderr."""

    def __call__(self, step):
        try:
            return getattr(self, step["op"])(step)
        except tf2_py.TransformException as error:
            return {"raises": type(error).__name__, "text": str(error)}

    def new(self, step):
        self.core = tf2_py.BufferCore(time(step["cache"]))
        return {}

    def set(self, step):
        return self.insert(self.core.set_transform, step)

    def set_static(self, step):
        return self.insert(self.core.set_transform_static, step)

    def insert(self, insert, step):
        x, y, z, qx, qy, qz, qw = map(float, (*step["translation"], *step["rotation"]))
        stamped = SimpleNamespace(
            header=SimpleNamespace(stamp=time(step["stamp"]), frame_id=step["parent"]),
            child_frame_id=step["child"],
            transform=SimpleNamespace(translation=Vector3(x=x, y=y, z=z), rotation=Quaternion(x=qx, y=qy, z=qz, w=qw)),
        )
        with contextlib.redirect_stderr(io.StringIO()) as stderr:
            assert insert(stamped, step["authority"]) is None
        lines = LOG_LINE.findall(stderr.getvalue())
        return {"accepted": not lines, "log": [[level.lower(), text] for level, text in lines]}

    def clear(self, _):
        self.core.clear()
        return {}

    def lookup(self, step):
        return pose(self.core.lookup_transform_core(step["target"], step["source"], time(step["stamp"])))

    def lookup_full(self, step):
        return pose(self.core.lookup_transform_full_core(*legs(step)))

    def can_transform(self, step):
        possible, text = self.core.can_transform_core(step["target"], step["source"], time(step["stamp"]))
        return {"possible": bool(possible), "text": text}

    def can_transform_full(self, step):
        possible, text = self.core.can_transform_full_core(*legs(step))
        return {"possible": bool(possible), "text": text}

    def latest_common_time(self, step):
        try:
            latest = self.core.get_latest_common_time(step["target"], step["source"])
        except ValueError as error:  # rclpy's Time cannot be before 1970
            return {"unsupported": str(error)}
        return {"stamp": run.seconds(latest.nanoseconds)}

    def chain(self, step):
        return {"names": self.core._chain(*legs(step))}

    def frame_names(self, _):
        return {"names": self.core._getFrameStrings()}

    def frame_exists(self, step):
        return {"exists": self.core._frameExists(step["name"])}

    def all_frames_as_string(self, _):
        return {"text": self.core.all_frames_as_string()}

    def all_frames_as_yaml(self, _):
        return {"text": self.core.all_frames_as_yaml()}

    def all_frames_as_dot(self, step):
        return {"text": self.core._allFramesAsDot(time(step["now"]))}


def time(stamp):
    return SimpleNamespace(nanoseconds=run.nanoseconds(stamp))


def legs(step):
    return step["target"], time(step["target_stamp"]), step["source"], time(step["source_stamp"]), step["fixed"]


def pose(message):
    t, r, stamp = message.transform.translation, message.transform.rotation, message.header.stamp
    return {
        "translation": [t.x, t.y, t.z],
        "rotation": [r.x, r.y, r.z, r.w],
        "stamp": run.seconds(stamp.sec * run.NANOSECONDS_PER_SECOND + stamp.nanosec),
    }


@every_case
def test_coframe(case):
    assert_passes(case, run.CoframeAdapter())


@every_case
def test_buffer_core(case):
    assert_passes(case, BufferCoreAdapter())


@pytest.fixture(scope="module")
def debian():
    probe = subprocess.run([DEBIAN_PYTHON, "-c", "import tf2_py, genpy"], capture_output=True, check=False)
    if probe.returncode != 0:
        pytest.skip("Debian's tf2 is not installed (apt-get install python3-tf2-ros)")
    process = run.ProcessAdapter([DEBIAN_PYTHON, str(DEBIAN_ADAPTER)])
    yield process
    process.close()


def in_words_of_ros2(answer):
    """Return an answer of ROS 1 with the texts that always differ replaced by those of ROS 2."""

    def put(text):
        for rule in ROS1["texts"]:
            text = re.sub(rule["ros1"], rule["ros2"], text)
        return text

    answer = dict(answer)
    if "text" in answer:
        answer["text"] = put(answer["text"])
    if "log" in answer:
        answer["log"] = [[level, put(text)] for level, text in answer["log"]]
    return answer


LISTED = {case_id: answers for group in ROS1["cases"] for case_id, answers in group["answers"].items()}


@every_case
def test_ros1(case, debian):
    outcome = run.run_case(case, lambda step: in_words_of_ros2(debian(step)))
    assert bool(outcome.unsupported) == (case.id in ROS1["unsupported"]["cases"]), outcome.unsupported
    found = {str(difference.step): difference.found for difference in outcome.differences}
    listed = LISTED.get(case.id, {})
    assert found.keys() == listed.keys(), f"ROS 1 answers {found}, listed is {listed}"
    for step, answer in listed.items():
        assert run.matches(answer, found[step]), f"step {step}: ROS 1 answers {found[step]}, listed is {answer}"


def test_every_listed_difference_belongs_to_a_case_and_has_a_reason():
    assert {*LISTED, *ROS1["unsupported"]["cases"]} <= {case.id for case in CASES}
    assert all(rule["reason"] for rule in [*ROS1["texts"], *ROS1["cases"], ROS1["unsupported"]])
    assert len(LISTED) == sum(len(group["answers"]) for group in ROS1["cases"])


def test_every_listed_text_of_ros1_occurs(debian):
    texts = set()

    def listen(step):
        answer = debian(step)
        texts.update([answer.get("text", ""), *(text for _, text in answer.get("log") or [])])
        return answer

    for case in CASES:
        run.run_case(case, listen)
    assert [rule["ros1"] for rule in ROS1["texts"] if not any(re.search(rule["ros1"], text) for text in texts)] == []


def test_cases_have_unique_ids_and_refer_to_a_rule():
    rules = {}
    for path in sorted((FOLDER / "cases").glob("*.json")):
        file = json.loads(path.read_text("utf-8"))
        assert file["rule"] == path.stem
        assert all(case["id"].startswith(f"{path.stem}-") for case in file["cases"])
        rules.update({f"{path.stem}.{number}": rule for number, rule in file["rules"].items()})
    assert [case_id for case_id, count in collections.Counter(case.id for case in CASES).items() if count > 1] == []
    assert {case.reference for case in CASES} == rules.keys()
    assert all(case.shows.endswith((".", ":")) for case in CASES)
    assert len(CASES) >= 300


def test_the_readme_describes_every_operation():
    readme = (FOLDER / "README.md").read_text("utf-8")
    for operation in {step["op"] for case in CASES for step in case.steps}:
        assert f"| `{operation}`" in readme


class WithError:
    """coframe with a small error."""

    def __init__(self, change):
        self.adapter, self.change = run.CoframeAdapter(), change

    def __call__(self, step):
        return self.change(self.adapter(step))


@pytest.mark.parametrize(
    ("rule", "change"),
    [
        ("interpolation", lambda answer: answer | {"translation": [1e-9 + x for x in answer.get("translation", [])]}),
        ("quaternions", lambda answer: answer | {"rotation": [-x for x in answer.get("rotation", [])]}),
        ("static", lambda answer: answer | {"stamp": "1.5"}),
        ("precedence", lambda answer: answer | {"text": answer.get("text", "") + " "}),
        ("precedence", lambda answer: answer | ({"raises": "TransformException"} if "raises" in answer else {})),
        ("old-data", lambda answer: answer | {"log": []}),
        ("insert", lambda answer: answer | {"accepted": True}),
        ("names", lambda answer: answer | {"names": answer.get("names", [])[::-1]}),
        ("can-transform", lambda answer: answer | {"possible": True}),
    ],
)
def test_small_errors_are_detected(rule, change):
    outcomes = [run.run_case(case, WithError(change)) for case in CASES if case.rule == rule]
    assert any(outcome.differences for outcome in outcomes)


def command(*arguments):
    return subprocess.run(
        [sys.executable, FOLDER / "run.py", *arguments], capture_output=True, text=True, check=False, timeout=60
    )


def test_the_command_prints_a_summary_by_rule():
    result = command()
    assert result.returncode == 0, result.stdout
    assert result.stdout.splitlines()[-1].split() == ["all", str(len(CASES)), "0", "0"]


def test_the_command_prints_expected_and_actual_answers_of_another_implementation(tmp_path):
    adapter = tmp_path / "adapter.py"
    adapter.write_text('import sys\nfor line in sys.stdin: print(\'{"stamp": "7"}\', flush=True)')
    result = command("latest-one-link", "--adapter", f"{sys.executable} {adapter}")
    assert result.returncode == 1
    assert 'expected {"stamp": "4"}\n  found    {"stamp": "7"}' in result.stdout


def test_the_command_counts_unsupported_cases(tmp_path):
    adapter = tmp_path / "adapter.py"
    adapter.write_text('import sys\nfor line in sys.stdin: print(\'{"unsupported": "no"}\', flush=True)')
    result = command("dumps", "--adapter", f"{sys.executable} {adapter}")
    assert result.returncode == 0
    assert result.stdout.splitlines()[-1].split()[1:3] == ["0", "0"]


def test_the_command_names_an_adapter_that_has_exited():
    result = command("dumps", "--adapter", f"{sys.executable} -c pass")
    assert result.returncode == 2
    assert "has exited" in result.stderr
    assert "Traceback" not in result.stderr


def test_the_command_names_an_adapter_that_does_not_start():
    result = command("dumps", "--adapter", "no-such-program --fast")
    assert result.returncode == 2
    assert "the adapter no-such-program --fast cannot be started: No such file" in result.stderr


def test_the_command_shows_a_reply_that_is_not_json(tmp_path):
    adapter = tmp_path / "adapter.py"
    adapter.write_text("import sys\nfor line in sys.stdin: print('hello', flush=True)")
    result = command("dumps", "--adapter", f"{sys.executable} {adapter}")
    assert result.returncode == 2
    assert "replied 'hello' to {'op': 'new', 'cache': '10'}, which is not JSON" in result.stderr


def test_the_command_lists_the_rules_for_an_unknown_name():
    result = command("interpolatoin")
    assert result.returncode == 2
    assert "no rule or case named interpolatoin. Rules: can-transform, chain, clear" in result.stderr


def test_help_shows_an_example():
    assert 'python conformance/run.py --adapter "' in command("--help").stdout
