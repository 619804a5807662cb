# SPDX-License-Identifier: Apache-2.0
"""How each command is run on a hostile graph and on hostile files.

A word in braces is a file that the tests create, or a name or a folder for output. A command that runs until Ctrl-C
gets it once `until` has been printed.
"""

import shlex
from dataclasses import dataclass

from hostile_names import ESCAPE, NAMES, NEWLINE

MISSING = "nothing\x1b[2J\u202e"


@dataclass(frozen=True)
class Case:
    """The words of a command line, and what it prints when it has shown a hostile text, if it runs until Ctrl-C."""

    words: tuple[str, ...]
    until: str = ""

    @property
    def is_data(self):
        """Whether the output is for programs: its strings are escaped, but long lines are correct."""
        return not {"--json", "--sarif", "--csv", "--raw", "--full-length", "--field"}.isdisjoint(self.words)

    @property
    def is_text(self):
        """Whether the output contains the text of messages, which may have several lines."""
        return self.words[:2] == ("topic", "echo") and "--csv" not in self.words


def _cases(command, *lines, until=""):
    return [Case((*command.split(), *(shlex.split(line) if isinstance(line, str) else line)), until) for line in lines]


# What hostile nodes publish.
LIVE = {
    "frames": [*_cases("frames", "", "--json"), *_cases("frames", "--watch", until="in 1 tree")],
    "monitor": [
        *_cases("monitor", "--once", "--once --json"),
        *_cases("monitor", "", "--classic --duration 1s", ["map", ESCAPE], until="esc"),
        *_cases("monitor", ["map", NEWLINE], until="two"),
    ],
    "doctor": [
        *_cases("doctor", "", "--json", "--sarif", "--system"),
        *_cases("doctor", "--watch", until="esc"),
    ],
    "contract check": _cases("contract check", "live -c {contract} --duration 2s"),
    "why": _cases("why", *(["map", name] for name in (ESCAPE, NEWLINE, MISSING)), ["--json", "map", NEWLINE]),
    "lookup": _cases("lookup", *(["map", name] for name in (ESCAPE, NEWLINE, MISSING)), ["--json", "map", NEWLINE]),
    "echo": [
        *_cases("echo", ["map", ESCAPE], ["map", NEWLINE], ["map", ESCAPE, "--json"], until="ranslation"),
        *_cases("echo", ["map", MISSING], ["map", f"{NEWLINE}2"], until="Waiting"),
    ],
    "relay": _cases("relay", ["--from", "/tf=robot/", "--to", "/merged", "--status"], until="esc"),
    "demo": _cases("demo", "--no-browser", until="map"),
    "view": _cases("view", "--no-browser --port 0", until="http"),
    "record": _cases("record", "-o {output} --all --duration 3s"),
    "bag record": _cases("bag record", "-o {output} --all --duration 3s"),
    "robot": _cases("robot", "{urdf}", "{broken_urdf}", until="esc"),
    "joints": [
        *_cases("joints", "{urdf}", until="esc"),
        *_cases("joints", "--gui --no-browser --port 0", until="http"),
    ],
    "static": _cases("static", ["--frame-id", NEWLINE, "--child-frame-id", ESCAPE], until="two"),
    "hub": _cases("hub", "", until="hub"),
    "topic list": _cases("topic list", "", "-v", "-t"),
    "topic info": _cases("topic info", "-v /text", "-v /strange0", f"/{'m' * 240}"),
    "topic type": _cases("topic type", "/strange0", "/strange1"),
    "topic find": _cases("topic find", "std_msgs/msg/String", [f"std_msgs/msg/{NEWLINE}"]),
    "topic echo": [
        *_cases("topic echo", "/text", "/text --csv", "/text --full-length", "/text --raw", "/tf", until="esc"),
        *_cases("topic echo", "/rosout", "/rosout --csv", "/text --flow-style", "/text --field data", until="esc"),
        *_cases("topic echo", "/strange0 --once", "/strange1 --once", [MISSING, "std_msgs/msg/String", "--once"]),
    ],
    "topic hz": _cases("topic hz", "/text", until="average rate"),
    "topic bw": _cases("topic bw", "/text", until="/s"),
    "topic delay": _cases("topic delay", "/tf", until="header"),
    "topic pub": _cases("topic pub", ["/own", "std_msgs/msg/String", f"data: {ESCAPE!r}", "--once", "-w", "0"]),
    "node list": _cases("node list", "", "--all"),
    "node info": _cases("node info", "/talker", [f"/{NEWLINE}"], [f"/{ESCAPE}"], [MISSING]),
    "service list": _cases("service list", "-t"),
    "service find": _cases("service find", "std_srvs/srv/Trigger"),
    "service type": _cases("service type", "/refuse", [MISSING]),
    "service info": _cases("service info", "/refuse", "/refuse -v", [MISSING]),
    "service echo": _cases("service echo", [MISSING]),
    "service call": _cases("service call", "/refuse std_srvs/srv/Trigger"),
    "action list": _cases("action list", "-t"),
    "action info": _cases("action info", "/act -t", [MISSING]),
    "action type": _cases("action type", "/act", [MISSING]),
    "action find": _cases("action find", "tf2_msgs/action/LookupTransform"),
    "action echo": _cases("action echo", [MISSING]),
    "action send_goal": _cases("action send_goal", "/act tf2_msgs/action/LookupTransform '{{}}'"),
    "param list": _cases("param list", "", "--param-type"),
    "param get": _cases("param get", "/talker evil", ["/talker", MISSING], [MISSING, "evil"]),
    "param dump": _cases("param dump", "/talker"),
    "param describe": _cases("param describe", "/talker evil", ["/talker", MISSING]),
    "param set": _cases("param set", ["/talker", "evil", "other"], ["/talker", MISSING, "1"]),
    "param delete": _cases("param delete", ["/talker", MISSING]),
    "param load": _cases("param load", "/talker {parameters}"),
    "component list": _cases("component list", "", [MISSING]),
    "component standalone": _cases("component standalone", [MISSING, MISSING]),
    "component load": _cases("component load", [MISSING, "package", "plugin"]),
    "component unload": _cases("component unload", [MISSING, "1"]),
    "lifecycle nodes": _cases("lifecycle nodes", ""),
    "lifecycle get": _cases("lifecycle get", "/talker", [MISSING]),
    "lifecycle list": _cases("lifecycle list", "/talker", [MISSING]),
    "lifecycle set": _cases("lifecycle set", "/talker configure", [MISSING, "configure"]),
}

# What a recording or another file contains.
RECORDED = {
    "frames": _cases("frames", "{bag}", "{bag} --json"),
    "doctor": _cases("doctor", "{bag}", "{bag} --json", "{bag} --sarif"),
    "contract init": _cases("contract init", "{bag} -o {output}.yaml"),
    "contract check": _cases("contract check", "{bag} -c {contract}", "{bag} -c {contract} --github", "{bag} -c {bag}"),
    "calib show": _cases("calib show", "{bag}", [MISSING]),
    "calib convert": _cases(
        "calib convert", "{bag} -o {output}.urdf", ["{bag}", "-o", "{output}.yaml", "--camera", MISSING]
    ),
    "calib diff": _cases(
        "calib diff", "{bag} {bag}", "{bag} {bag} --json", ["{bag}", "{bag}", "--rename", f"{MISSING}=x"]
    ),
    "calib history": _cases("calib history", "{bag}", ["{bag}", "--pair", MISSING, f"/{MISSING}"]),
    "calibrate rigid": _cases("calibrate rigid", ["{bag}", f"map:{MISSING}", "map:x"], ["{bag}", MISSING, "a:b"]),
    "calibrate hand-eye": _cases("calibrate hand-eye", ["{bag}", MISSING, "x", "/tag"]),
    "why": _cases("why", *(["{bag}", "map", name] for name in (*NAMES[:-1], MISSING))),
    "lookup": _cases("lookup", *(["{bag}", "map", name] for name in (*NAMES[:-1], MISSING, f"{NEWLINE}2"))),
    "bag info": _cases("bag info", "{bag}", "{bag} --json"),
    "bag fix": _cases("bag fix", "{bag} -o {output}"),
    "bag edit": _cases(
        "bag edit",
        "{bag} -o {output} --rename-frame nothing=else --dedupe",
        ["{bag}", "--dry-run", "--rename-frame", f"{MISSING}=x", "--drop-topic", MISSING, "--shift", f"{NEWLINE}=1s"],
    ),
    "bag reindex": _cases("bag reindex", "{bag}"),
    "bag convert": _cases("bag convert", "{bag} {output}.mcap"),
    "bag slice": _cases("bag slice", "{bag} {output}.mcap --start 1s"),
    "bag merge": _cases("bag merge", "{bag} {bag} -o {output}.mcap"),
    "batch": _cases("batch", *([NEWLINE, name, "{bag}", "-o", "{output}"] for name in ("map", MISSING))),
    "cloud": _cases("cloud", ["{bag}", "/points", "--frame", NEWLINE, "-o", "{output}.ply"]),
    "compare": _cases("compare", "{bag} {bag}", ["{bag}", MISSING]),
    "plot": _cases("plot", ["{bag}", f"/tf/{NEWLINE}.x", "-o", "{output}.svg"], ["{bag}", "/log.msg"]),
    "table": _cases(
        "table",
        "{bag} /tf --at /tf",
        ["{bag}", f"map:{NEWLINE}", "--rate", "1", "-o", "{output}.csv"],
        ["{bag}", f"map:{MISSING}", "--rate", "1"],
    ),
    "trajectory": _cases(
        "trajectory", *(["{bag}", "map", name, "-o", "{output}.tum"] for name in (ESCAPE, NEWLINE, MISSING))
    ),
    "view": _cases("view", "{bag} --output {output}.html"),
    "robot": _cases("robot", "{broken_urdf}"),
    "joints": _cases("joints", "{broken_urdf}"),
    "launch": _cases("launch", "{launch_file} --print"),
}

# Commands that show no text of a peer or of a file that a peer can choose.
OWN_TEXT_ONLY = {
    "bag burst": "the same command as bag play",
    "bag list": "the formats of this installation",
    "bag play": "prints the path of the recording and numbers",
    "play": "the same command",
    "component types": "prints entry points of installed packages",
    "interface list": "prints types of installed packages",
    "interface package": "prints types of installed packages",
    "interface packages": "prints types of installed packages",
    "interface proto": "prints types of installed packages",
    "interface show": "prints types of installed packages",
    "interface add": "the user's own folder",
    "interface check": "the user's own folder",
    "interface remove": "the user's own folder",
    "interface stubs": "the user's own folder",
    "lab autograder": "coframe's own files",
    "lab break": "coframe's own nodes",
    "lab check": "tests/course runs it on hostile programs",
    "lab handbook": "coframe's own text",
    "lab new": "the user's own folder",
    "lab run": "the user's own program",
    "pkg create": "the user's own folder",
    "pkg executables": "installed packages",
    "pkg list": "installed packages",
    "pkg prefix": "installed packages",
    "pkg xml": "installed packages",
    "ros2 install": "the user's own environment",
    "ros2 remove": "the user's own environment",
    "router": "starts the router of Zenoh",
    "run": "runs a program of an installed package",
}
