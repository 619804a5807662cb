# SPDX-License-Identifier: Apache-2.0
"""Run the conformance cases of tf2's semantics against coframe or any other implementation.

    python conformance/run.py                                   all cases, against coframe.Buffer
    python conformance/run.py interpolation reparenting         the cases of two rules
    python conformance/run.py --adapter "node my_adapter.js"    another implementation, with JSON lines

README.md in the same folder describes the format of the cases and of the JSON lines.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import shlex
import subprocess
import sys
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from decimal import Decimal
from pathlib import Path
from typing import Any

CASES = Path(__file__).with_name("cases")
DEFAULT_CACHE = "10"
DEFAULT_TOLERANCE = 1e-12
NANOSECONDS_PER_SECOND = 1_000_000_000

Step = dict[str, Any]
Answer = dict[str, Any]
Adapter = Callable[[Step], Answer]
"""An implementation under test: returns the answer to a step, the first of which is `{"op": "new", "cache": "10"}`."""

STEP_DEFAULTS: dict[str, Step] = {
    "set": {"stamp": "0", "translation": [0, 0, 0], "rotation": [0, 0, 0, 1], "authority": "test"},
    "set_static": {"stamp": "0", "translation": [0, 0, 0], "rotation": [0, 0, 0, 1], "authority": "test"},
    "lookup": {"stamp": "0"},
    "can_transform": {"stamp": "0"},
    "all_frames_as_dot": {"now": "0"},
}
EXPECTED_DEFAULTS: dict[str, Answer] = {
    "set": {"accepted": True, "log": []},
    "set_static": {"accepted": True, "log": []},
}


@dataclass(frozen=True)
class Case:
    """A case: what it shows, the steps to run, and a reference to the rule."""

    id: str
    rule: str
    shows: str
    reference: str
    cache: str
    steps: tuple[Step, ...]


@dataclass(frozen=True)
class Difference:
    """A step whose answer is not the expected one; `step` counts from 0 and includes scenes and repetitions."""

    step: int
    request: Step
    expected: Answer
    found: Answer


@dataclass(frozen=True)
class Outcome:
    """The result of a case; `unsupported` is the reason why it could not be run, or empty."""

    case: Case
    differences: tuple[Difference, ...]
    unsupported: str = ""


def nanoseconds(seconds: str) -> int:
    """Return a stamp of a case in nanoseconds: "1.5" is 1500000000."""
    return int(Decimal(seconds) * NANOSECONDS_PER_SECOND)


def seconds(stamp: int) -> str:
    """Return nanoseconds as a stamp of a case: 1500000000 is "1.5"."""
    return format(Decimal(stamp).scaleb(-9).normalize(), "f")


def load_cases(folder: Path = CASES) -> list[Case]:
    """Return all cases of a folder in the order of the file names, with scenes and repetitions expanded."""
    return [case for path in sorted(folder.glob("*.json")) for case in _cases_of(json.loads(path.read_text("utf-8")))]


def run_case(case: Case, adapter: Adapter) -> Outcome:
    """Run all steps of a case and compare every answer."""
    adapter({"op": "new", "cache": case.cache})
    differences = []
    for number, step in enumerate(case.steps):
        request = {key: value for key, value in step.items() if key != "expect"}
        found = adapter(request)
        if "unsupported" in found:
            return Outcome(case, (), found["unsupported"])
        expected = step.get("expect", EXPECTED_DEFAULTS.get(step["op"], {}))
        if not matches(expected, found):
            differences.append(Difference(number, request, expected, found))
    return Outcome(case, tuple(differences))


def matches(expected: Answer, found: Answer) -> bool:
    """Return whether an answer is the expected one; keys without an expectation are not compared."""
    if "raises" in found and "raises" not in expected:
        return False
    tolerance = expected.get("tolerance", DEFAULT_TOLERANCE)
    return all(_same(key, value, found.get(key), tolerance) for key, value in expected.items() if key != "tolerance")


class CoframeAdapter:
    """coframe.Buffer under test."""

    def __init__(self) -> None:
        import coframe  # noqa: PLC0415 - other implementations can be tested without coframe

        self._coframe = coframe
        self._buffer = coframe.Buffer()

    def __call__(self, step: Step) -> Answer:
        """Return the answer to one step."""
        try:
            answer: Answer = getattr(self, "_" + step["op"])(step)
        except self._coframe.TransformException as error:
            return {"raises": type(error).__name__, "text": str(error)}
        return answer

    def _new(self, step: Step) -> Answer:
        self._buffer = self._coframe.Buffer(nanoseconds(step["cache"]))
        return {}

    def _set(self, step: Step, *, static: bool = False) -> Answer:
        x, y, z, qx, qy, qz, qw = (float(value) for value in (*step["translation"], *step["rotation"]))
        facts = (step["parent"], step["child"], nanoseconds(step["stamp"]), x, y, z, qx, qy, qz, qw)
        refusals = self._buffer._set_values(*facts, static, step["authority"])
        log = self._coframe._core.insert_texts(refusals, *facts, step["authority"])  # noqa: SLF001 - tf2's log lines
        return {"accepted": refusals == 0, "log": [list(line) for line in log]}

    def _set_static(self, step: Step) -> Answer:
        return self._set(step, static=True)

    def _clear(self, _: Step) -> Answer:
        self._buffer.clear()
        return {}

    def _lookup(self, step: Step) -> Answer:
        return _pose(self._buffer.lookup(*_query(step)))

    def _lookup_full(self, step: Step) -> Answer:
        return _pose(self._buffer._lookup_full(*_full_query(step)))

    def _can_transform(self, step: Step) -> Answer:
        text = self._buffer._why_not(*_query(step))
        return {"possible": self._buffer.can_transform(*_query(step)), "text": text}

    def _can_transform_full(self, step: Step) -> Answer:
        text = self._buffer._why_not_full(*_full_query(step))
        return {"possible": self._buffer._can_transform_full(*_full_query(step)), "text": text}

    def _latest_common_time(self, step: Step) -> Answer:
        return {"stamp": seconds(self._buffer.latest_common_time(step["target"], step["source"]))}

    def _chain(self, step: Step) -> Answer:
        return {"names": self._buffer.chain(*_full_query(step))}

    def _frame_names(self, _: Step) -> Answer:
        return {"names": self._buffer.frame_names()}

    def _frame_exists(self, step: Step) -> Answer:
        return {"exists": self._buffer.frame_exists(step["name"])}

    def _all_frames_as_string(self, _: Step) -> Answer:
        return {"text": self._buffer.all_frames_as_string()}

    def _all_frames_as_yaml(self, _: Step) -> Answer:
        return {"text": self._buffer.all_frames_as_yaml()}

    def _all_frames_as_dot(self, step: Step) -> Answer:
        return {"text": self._buffer.all_frames_as_dot(nanoseconds(step["now"]))}


class AdapterError(RuntimeError):
    """The program under test does not return valid answers."""


class ProcessAdapter:
    """Another implementation under test: a program that replies to each line of JSON with a line of JSON."""

    def __init__(self, command: Sequence[str]) -> None:
        self._command = command
        try:
            self._process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, encoding="utf-8")  # noqa: S603
        except OSError as error:
            raise AdapterError(f"the adapter {shlex.join(command)} cannot be started: {error.strerror}") from None

    def __call__(self, step: Step) -> Answer:
        """Return the answer to one step."""
        stdin, stdout = self._process.stdin, self._process.stdout
        assert stdin is not None
        assert stdout is not None
        try:
            stdin.write(json.dumps(step) + "\n")
            stdin.flush()
            line = stdout.readline()
        except BrokenPipeError:
            line = ""
        if not line:
            raise AdapterError(f"the adapter {shlex.join(self._command)} has exited; the last step was {step}")
        try:
            answer: Answer = json.loads(line)
        except ValueError:
            raise AdapterError(f"the adapter replied {line.strip()!r} to {step}, which is not JSON") from None
        return answer

    def close(self) -> None:
        """Close the standard input of the program, which ends it."""
        with contextlib.suppress(BrokenPipeError):
            self._process.communicate()


def _cases_of(file: dict[str, Any]) -> Iterator[Case]:
    for case in file["cases"]:
        steps = [*file.get("scenes", {}).get(case.get("scene"), []), *case["steps"]]
        yield Case(
            id=case["id"],
            rule=file["rule"],
            shows=case["shows"],
            reference=case["reference"],
            cache=case.get("cache", DEFAULT_CACHE),
            steps=tuple({**STEP_DEFAULTS.get(step["op"], {}), **step} for each in steps for step in _repeated(each)),
        )


def _repeated(step: Step) -> Iterator[Step]:
    """Expand a step with "for": [first, last] into one step per number, which replaces {i}; {i+1} is the next one."""
    step = dict(step)
    if "for" not in step:
        yield step
        return
    first, last = step.pop("for")
    text = json.dumps(step)
    for i in range(first, last + 1):
        yield json.loads(text.replace("{i}", str(i)).replace("{i+1}", str(i + 1)))


def _same(key: str, expected: Any, found: Any, tolerance: float) -> bool:
    if key in {"accepted", "log"} and found is None:
        return True  # The implementation does not report this value.
    if key == "stamp":
        return found is not None and nanoseconds(expected) == nanoseconds(found)
    if key in {"translation", "rotation"}:
        return (
            found is not None
            and len(expected) == len(found)
            and all(_close(float(a), float(b), tolerance) for a, b in zip(expected, found, strict=True))
        )
    if key == "log":
        return _same_log(expected, found)
    if key == "text":
        return _same_text(expected, found)
    return bool(expected == found)


def _close(expected: float, found: float, tolerance: float) -> bool:
    return expected == found or abs(expected - found) <= tolerance


def _same_log(expected: list[list[Any]], found: list[list[str]]) -> bool:
    return len(expected) == len(found) and all(
        level == found_level and _same_text(text, found_text)
        for (level, text), (found_level, found_text) in zip(expected, found, strict=True)
    )


def _same_text(expected: str | dict[str, str], found: str | None) -> bool:
    if isinstance(expected, dict):
        return found is not None and found.startswith(expected["begins"])
    return expected == found


def _query(step: Step) -> tuple[str, str, int]:
    return step["target"], step["source"], nanoseconds(step["stamp"])


def _full_query(step: Step) -> tuple[str, int, str, int, str]:
    return (
        step["target"],
        nanoseconds(step["target_stamp"]),
        step["source"],
        nanoseconds(step["source_stamp"]),
        step["fixed"],
    )


def _pose(transform: Any) -> Answer:
    values = transform.values
    return {"translation": list(values[:3]), "rotation": list(values[3:]), "stamp": seconds(transform.stamp)}


def _run(cases: list[Case], command: str | None) -> list[Outcome]:
    if command is None:
        adapter = CoframeAdapter()
        return [run_case(case, adapter) for case in cases]
    process = ProcessAdapter(shlex.split(command))
    try:
        return [run_case(case, process) for case in cases]
    finally:
        process.close()


def _report(outcomes: list[Outcome]) -> None:
    for outcome in outcomes:
        for difference in outcome.differences:
            print(f"FAILED {outcome.case.id} ({outcome.case.reference}): {outcome.case.shows}")
            print(f"  step {difference.step}  {json.dumps(difference.request, ensure_ascii=False)}")
            print(f"  expected {json.dumps(difference.expected, ensure_ascii=False)}")
            print(f"  found    {json.dumps(difference.found, ensure_ascii=False)}")
    total = Counter(outcome.case.rule for outcome in outcomes)
    failed = Counter(outcome.case.rule for outcome in outcomes if outcome.differences)
    unsupported = Counter(outcome.case.rule for outcome in outcomes if outcome.unsupported)
    print(f"{'rule':24}{'passed':>8}{'failed':>8}{'unsupported':>13}")
    for rule in total:
        passed = total[rule] - failed[rule] - unsupported[rule]
        print(f"{rule:24}{passed:>8}{failed[rule]:>8}{unsupported[rule]:>13}")
    passed = total.total() - failed.total() - unsupported.total()
    print(f"{'all':24}{passed:>8}{failed.total():>8}{unsupported.total():>13}")


def main() -> int:
    """Run the command; return 0 if all cases pass."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("rules", nargs="*", metavar="rule", help="only these rules or case ids; default: all")
    parser.add_argument(
        "--adapter", metavar="COMMAND", help="a program that reads and writes the JSON lines; default: coframe"
    )
    options = parser.parse_args()
    cases = load_cases()
    chosen = [case for case in cases if not options.rules or {case.rule, case.id} & set(options.rules)]
    unknown = set(options.rules) - {name for case in cases for name in (case.rule, case.id)}
    if unknown:
        rules = ", ".join(dict.fromkeys(case.rule for case in cases))
        parser.error(f"no rule or case named {', '.join(sorted(unknown))}. Rules: {rules}")
    try:
        outcomes = _run(chosen, options.adapter)
    except AdapterError as error:
        parser.error(str(error))
    _report(outcomes)
    return int(any(outcome.differences for outcome in outcomes))


if __name__ == "__main__":
    sys.exit(main())
