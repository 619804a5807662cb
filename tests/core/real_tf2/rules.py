# SPDX-License-Identifier: Apache-2.0
"""The rules for differences between ROS 1 and ROS 2, and which rule explains that two answers differ.

The list is data: ros1_rules.json, and the wordings of ../../conformance/ros1_differences.json. Its parts:

    insertions  results of an insertion into equal histories, as histories.py describes them
    adapted     operations that differ for ROS 1, and the sign of quaternions
    logs        the log lines of such insertions
    words       texts that ROS 1 phrases differently, in all answers
    numbers     numbers in texts that are printed differently
    answers     whole answers, ours and ROS 1's, to certain questions; ROS 1's may refer to groups in ours
"""

import json
import re
from pathlib import Path

_FOLDER = Path(__file__).parent
_RULES = json.loads((_FOLDER / "ros1_rules.json").read_text("utf-8"))
_SHARED = json.loads((_FOLDER.parents[1] / "conformance" / "ros1_differences.json").read_text("utf-8"))
_WORDS = [(re.compile(rule["ros1"]), rule["ros2"], rule["reason"]) for rule in (*_SHARED["texts"], *_RULES["words"])]
LOGS = _RULES["logs"]
ADAPTED = {name: rule["reason"] for name, rule in _RULES["adapted"].items()}
REASONS = [
    *(reason for *_, reason in _WORDS),
    *(rule["reason"] for rule in (*_RULES["insertions"], *_RULES["numbers"], *_RULES["answers"])),
    *ADAPTED.values(),
]

TOLERANCE = 1e-11  # meters, and of quaternions of unit length


def explain_insertion(ours, theirs):
    """Return the rule by which an insertion into equal histories has another result in ROS 1."""
    for rule in _RULES["insertions"]:
        if re.search(rule["ros2"], ours) and re.search(rule["ros1"], theirs):
            return rule["reason"]
    raise LookupError(f"no rule explains that ROS 2 returns {ours!r} and ROS 1 {theirs!r}")


def explain(operation, ours, theirs):
    """Return the rules that explain the difference of two answers; empty if they are equal, None if no rule does."""
    if ours == theirs:
        return []
    if ours[0] == "pose" or theirs[0] == "pose":
        return _explain_pose(ours, theirs)
    used = []
    our_text, their_text = _text(ours, str), _text(theirs, lambda text: _in_our_words(text, used))
    for rule in _RULES["numbers"]:
        aligned = _with_our_numbers(rule, our_text, their_text)
        if aligned != their_text:
            used.append(rule["reason"])
        their_text = aligned
    if our_text == their_text:
        return used
    for rule in _RULES["answers"]:
        asked = re.fullmatch(rule["asked"], json.dumps(operation, ensure_ascii=False))
        if asked and re.fullmatch(_pattern(rule, asked.groupdict()), f"{our_text}\0{their_text}"):
            return [*used, rule["reason"]]
    return None


def is_close(expected, found):
    """Return whether a pose equals the expected one, including the sign of the quaternion."""
    return expected[:2] == found[:2] and _close(expected[2], found[2])


def _explain_pose(ours, theirs):
    if ours[:2] != theirs[:2]:
        return None
    if _close(ours[2], theirs[2]):
        return []
    return [ADAPTED["sign"]] if _close(ours[2], (*theirs[2][:3], *(-x for x in theirs[2][3:]))) else None


def _close(ours, theirs):
    return all(abs(a - b) <= TOLERANCE for a, b in zip(ours, theirs, strict=True))


def _text(answer, say):
    """Return an answer as one text; `say` formats the texts of tf2."""
    if answer[0] == "log":
        return "\n".join(f"{level}: {say(line)}" for level, line in answer[1])
    *head, last = answer
    return ": ".join((*map(str, head), say(str(last))))


def _in_our_words(text, used):
    for pattern, ours, reason in _WORDS:
        text, count = pattern.subn(ours, text)
        if count:
            used.append(reason)
    return text


def _with_our_numbers(rule, ours, theirs):
    """Return their text with our numbers where the rule allows a difference within its tolerance."""
    numbers = iter(re.findall(rule["number"], ours))

    def ours_if_close(match):
        number = next(numbers, "nan")
        allowed = rule["tolerance"] + rule.get("relative", 0) * float(number)
        return match[0].replace(match[1], number) if abs(float(number) - float(match[1])) <= allowed else match[0]

    return re.sub(rule["number"], ours_if_close, theirs)


def _pattern(rule, names):
    """Return both answers as one text, ours first; {target} is the requested name."""
    pattern = f"(?:{rule['ros2']})\0(?:{rule['ros1']})"
    return re.sub(r"\{(\w+)\}", lambda match: re.escape(names.get(match[1], match[0])), pattern)
