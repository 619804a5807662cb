# SPDX-License-Identifier: Apache-2.0
"""No module opens files from outside by itself without a reason: `coframe._files.regular_files` does it."""

import ast
from pathlib import Path

import pytest

SOURCES = Path(__file__).resolve().parents[2] / "src"
READING_METHODS = {"read_text", "read_bytes"}
# Functions of libraries that open a file by its name.
READING_FUNCTIONS = {
    "ET.parse",
    "Image.open",
    "codecs.open",
    "gzip.open",
    "io.open",
    "linecache.getline",
    "linecache.getlines",
    "minidom.parse",
    "mmap.mmap",
    "np.fromfile",
    "np.genfromtxt",
    "np.load",
    "np.loadtxt",
    "np.memmap",
    "os.open",
    "runpy.run_path",
    "sqlite3.connect",
    "tarfile.open",
    "zipfile.ZipFile",
}
OWN_DATA = "files of the package itself"
OWN_FILES = "files that this process or its children have just written"
PROC = "files of the kernel with a fixed name"
ALLOWED = {
    "coframe._files.regular_files": "the owner of the rule",
    "coframe.bags._cloud_files": OWN_FILES,
    "coframe.bags._sqlite_database": "checks the file and its journals before SQLite opens them by name",
    "coframe.bags._sqlite_writer": "writes a new file",
    "coframe.bags.editing._sqlite_editor": "writes a new file",
    "coframe.cli.hub": "opens shared memory",
    "coframe.cli.shell_completion": PROC,
    "coframe.cli.ros2.installing": "the list of files of the installed package",
    "coframe.course.autograder": "writes a new archive",
    "coframe.course.checking": OWN_FILES,
    "coframe.course.class_folder": "gives zipfile a file that is open",
    "coframe.course.folders": OWN_DATA,
    "coframe.course.handbook": OWN_DATA,
    "coframe.course._notebooks": OWN_DATA,
    "coframe.course._processes": PROC,
    "coframe.course._program": OWN_FILES,
    "coframe.course.sandbox.landlock": "opens no content (O_PATH)",
    "coframe.course.sandbox.mounts": "creates a file",
    "coframe.course.sandbox.start": PROC,
    "coframe.course.sandbox.users": PROC,
    "coframe.course.translation.catalogue": OWN_DATA,
    "coframe.course._view": PROC,
    "coframe.doctor.codes": OWN_DATA,
    "coframe.workspace.entry_point": "runs the program that the user names, as Python does",
    "coframe.buffer.frozen": "maps a file that `coframe.buffer._frozen_file` has opened",
    "coframe.lab.launcher": OWN_FILES,
    "coframe.messages.packages": OWN_DATA,
    "coframe.plotting._html_page": OWN_DATA,
    "coframe.ros2.__main__": "runs the program that the user names, as Python does",
    "coframe.connection.shared_transforms": "files in a folder that only this user can write",
    "coframe.system.network": PROC,
    "coframe._files.temporary_folders": "locks, opened without following links and without waiting",
    "coframe.trajectories._reading": "gives NumPy and zipfile a file that is open",
    "coframe.viewer.clients._panels": "opens panels",
    "coframe.viewer._page_files": OWN_DATA,
    "coframe.viewer.server._http": OWN_DATA,
}


def name_of(expression):
    """Return a dotted name such as ``np.load``, with "?" for a part that is not a name."""
    if isinstance(expression, ast.Name):
        return expression.id
    return f"{name_of(expression.value)}.{expression.attr}" if isinstance(expression, ast.Attribute) else "?"


def opens_for_reading(call, mode):
    """Return whether a call of open() may read: its mode is a constant, or it has none."""
    modes = [*call.args[mode : mode + 1], *(word.value for word in call.keywords if word.arg == "mode")]
    if not modes:
        return not call.args[mode:]
    return not isinstance(modes[0], ast.Constant) or not str(modes[0].value).startswith(("w", "x", "a"))


def reads_a_file(call):
    name = name_of(call.func)
    method = call.func.attr if isinstance(call.func, ast.Attribute) else ""
    if name == "open":
        return opens_for_reading(call, mode=1)
    if name == "os.open":
        return name_of(call.args[0]) != "os.devnull"
    if name in READING_FUNCTIONS or method in READING_METHODS:
        return True
    # A method open() with another argument than a mode opens something else, such as a topic.
    modes = [arg for arg in call.args if isinstance(arg, ast.Constant) and str(arg.value).strip("brt+") == ""]
    return method == "open" and len(modes) == len(call.args) and opens_for_reading(call, mode=0)


def readings(text):
    """Return the lines of a source file that open files for reading."""
    return [node.lineno for node in ast.walk(ast.parse(text)) if isinstance(node, ast.Call) and reads_a_file(node)]


def test_modules_open_files_through_the_owner_of_the_rule():
    found = []
    for path in sorted(SOURCES.rglob("*.py")):
        relative = path.relative_to(SOURCES)
        parts = relative.parts[1:] if relative.parts[0] == "ros" else relative.parts
        module = ".".join(parts).removesuffix(".py").removesuffix(".__init__")
        if module not in ALLOWED:
            found += [f"src/{relative}:{line}" for line in readings(path.read_text(encoding="utf-8"))]
    assert not found, "use coframe._files.regular_files, or add the module to ALLOWED with a reason"


@pytest.mark.parametrize(
    "text",
    [
        "open(path)",
        "open(path, 'rb')",
        "open(path, mode=mode)",
        "path.open()",
        "path.open('rb')",
        "Path(name).open(encoding='utf-8')",
        "path.read_text()",
        "(folder / name).read_bytes()",
        "np.load(path)",
        "sqlite3.connect(path)",
        "os.open(path, os.O_RDONLY)",
    ],
)
def test_calls_that_read_are_found(text):
    assert readings(text) == [1]


@pytest.mark.parametrize(
    "text",
    [
        "open(path, 'w')",
        "path.open('xb', buffering=0)",
        "open_regular(path)",
        "viewer.open(topic)",
        "os.open(os.devnull, 1)",
    ],
)
def test_calls_that_do_not_read_are_not(text):
    assert not readings(text)
