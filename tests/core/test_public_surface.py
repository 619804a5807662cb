# SPDX-License-Identifier: Apache-2.0
"""The public interface: its names, where they say they are from, their documentation, and the errors."""

import ast
import importlib
import inspect
import pickle
import pkgutil
import re
import subprocess
import sys
import warnings
from pathlib import Path

import pytest

import coframe

PACKAGE = Path(coframe.__file__).parent

ERRORS = {
    "CoframeError",
    "ConnectivityException",
    "CourseError",
    "DecodeError",
    "EditError",
    "ExtrapolationException",
    "FrameMismatchException",
    "FrozenFileError",
    "InterfaceError",
    "InvalidArgumentException",
    "LookupException",
    "PackageError",
    "PlotError",
    "PluginError",
    "RecordingError",
    "RobotDescriptionError",
    "TimeoutException",
    "TrajectoryError",
    "TransformException",
    "ViewerError",
    "WireError",
}
CLASSES = {"Buffer", "CallbackHandle", "CoframeWarning", "Connection", "EdgeInfo", "FrameInfo", "Transform"}
FUNCTIONS = {"connect", "load", "open_bag", "play", "record", "relay", "show"}
MODULES = {
    "bags",
    "calibration",
    "cameras",
    "doctor",
    "frame_names",
    "messages",
    "plotting",
    "quaternion",
    "recorder",
    "robots",
    "sensors",
    "time",
    "trajectories",
    "tree_drawing",
    "viewer",
}
BUFFER = {
    "all_frames_as_dot",
    "all_frames_as_string",
    "all_frames_as_yaml",
    "frames_with_covariance",
    "cache_ns",
    "can_transform",
    "chain",
    "clear",
    "edges",
    "encode",
    "frame_exists",
    "frame_names",
    "frames",
    "freeze",
    "frozen",
    "ingest",
    "interpolation",
    "latest_common_time",
    "lookup",
    "lookup_many",
    "on_change",
    "remove_frame",
    "save",
    "set",
    "set_covariance",
    "set_many",
    "show",
    "snapshot",
    "span",
    "statistics",
    "trajectory",
    "validity",
    "wait",
    "wait_async",
    "why",
}
TRANSFORM = {
    "adjoint",
    "as_axis_angle",
    "as_covariance",
    "as_dual_quaternion",
    "as_euler",
    "as_pinocchio",
    "as_rigid_transform",
    "as_rotvec",
    "as_scipy",
    "concatenate",
    "covariance",
    "distance",
    "ellipsoid",
    "exact_edges",
    "exp",
    "extrapolated",
    "from_axis_angle",
    "from_dual_quaternion",
    "from_euler",
    "from_matrix",
    "from_pinocchio",
    "from_rotvec",
    "from_rpy",
    "from_scipy",
    "fuse",
    "interpolate",
    "inverse",
    "is_close",
    "log",
    "mahalanobis",
    "matrix",
    "mean",
    "pitch",
    "pow",
    "quaternion",
    "replace",
    "roll",
    "rotation",
    "rpy",
    "shape",
    "show",
    "source",
    "stack",
    "stamp",
    "stamps",
    "target",
    "to_msg",
    "transform_point",
    "transform_pose",
    "translation",
    "values",
    "with_covariance",
    "x",
    "y",
    "yaw",
    "z",
}


def public(thing):
    return {name for name in dir(thing) if not name.startswith("_")}


def test_dir_lists_exactly_the_public_names():
    assert public(coframe) == ERRORS | CLASSES | FUNCTIONS | MODULES
    assert set(coframe.__all__) == ERRORS | CLASSES | FUNCTIONS | {"__version__"}
    for name in dir(coframe):
        assert getattr(coframe, name) is not None


def test_an_unknown_name_is_an_attribute_error():
    with pytest.raises(AttributeError, match="module 'coframe' has no attribute 'Bufer'"):
        _ = coframe.Bufer


@pytest.mark.parametrize(("cls", "names"), [(coframe.Buffer, BUFFER), (coframe.Transform, TRANSFORM)])
def test_classes_have_only_documented_names(cls, names):
    assert public(cls) == names
    for name in names:
        docstring = getattr(cls, name).__doc__ or ""
        sentence = docstring.partition("\n\n")[2] if docstring.startswith(f"{name}(") else docstring
        assert len(sentence) > 20, f"{cls.__name__}.{name} has no docstring"


@pytest.mark.parametrize("name", sorted(ERRORS | CLASSES | FUNCTIONS))
def test_every_public_name_has_a_docstring(name):
    assert len(inspect.getdoc(getattr(coframe, name))) > 20


def test_public_names_report_coframe_as_their_module():
    """In a separate process: importing tf2_py sets the module of tf2's exceptions to tf2."""
    code = """
import traceback, coframe
for name in coframe.__all__:
    if name != "__version__":
        assert getattr(coframe, name).__module__ == "coframe", name
try:
    coframe.Buffer().lookup("map", "base_link")
except coframe.CoframeError:
    print(traceback.format_exc())
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert "\ncoframe.LookupException: " in done.stdout


def test_public_classes_and_functions_can_be_pickled():
    for name in sorted(ERRORS | CLASSES | FUNCTIONS):
        thing = getattr(coframe, name)
        if thing.__module__ != "tf2":  # the name that tf2_py gives to tf2's exceptions
            assert pickle.loads(pickle.dumps(thing)) is thing


def library_modules():
    modules = (module.name for module in pkgutil.walk_packages([str(PACKAGE)], "coframe."))
    return [name for name in modules if not re.search(r"generated|__main__|\.ros\b|_core|\.lab\b|\.cli\b", name)]


def test_every_exception_class_of_the_library_is_a_coframe_error():
    found = set()
    for name in library_modules():
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            module = importlib.import_module(name)
        for thing in vars(module).values():
            if inspect.isclass(thing) and issubclass(thing, BaseException) and thing.__module__ in {"coframe", name}:
                found.add(thing)
    others = {
        cls for cls in found if not issubclass(cls, coframe.CoframeError | Warning) and not cls.__name__.startswith("_")
    }
    assert not others
    assert len(found) > len(ERRORS)


@pytest.mark.parametrize("name", sorted(ERRORS))
def test_every_error_has_a_hint_and_a_doctor_code(name):
    error = getattr(coframe, name)("text")
    assert (str(error), error.hint, error.doctor_code) == ("text", "", "")


def test_the_doctor_code_survives_pickling_and_stands_in_the_hint():
    with pytest.raises(coframe.LookupException) as caught:
        coframe.Buffer().lookup("map", "base_link")
    error = pickle.loads(pickle.dumps(caught.value))
    assert error.doctor_code == "TF001"
    assert error.hint.endswith("See doctor code TF001.")


def raised_texts(source):
    """Return the strings inside the raise statements and the hint arguments of a module, with their lines."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Raise) or (isinstance(node, ast.keyword) and node.arg == "hint"):
            for part in ast.walk(node):
                if isinstance(part, ast.Constant) and isinstance(part.value, str):
                    yield part.lineno, part.value


def test_library_errors_do_not_name_command_line_flags():
    flags = re.compile(r"(?<![\w-])--[a-z]")
    found = [
        f"{path.relative_to(PACKAGE)}:{line}: {text}"
        for path in sorted(PACKAGE.rglob("*.py"))
        if not {"cli", "generated", "lab", "ros"} & set(path.relative_to(PACKAGE).parts)
        for line, text in raised_texts(path.read_text())
        if flags.search(re.sub(r"`coframe [^`]*`", "", text))
    ]
    assert not found
