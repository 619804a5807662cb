# SPDX-License-Identifier: Apache-2.0
"""Users' own .msg, .srv, .action and .idl files: found, imported, serialized, and refused with a clear sentence."""

import importlib.util
import os
import random
import re
import subprocess
import sys
import textwrap
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from rosbags.typesys import get_types_from_idl, get_types_from_msg

import coframe
from coframe.interfaces.definition_files import Definition
from coframe.messages import deserialize, find, packages, registry, serialize
from coframe.workspace import _finders as interface_imports

NUM = """
# A number with a name.
uint8 RED=1
string MOTTO="say \\"#1\\""
byte FLAG = 0x10
int64 num 5
string<=5[<=3] names ["a,b", 'c']
wstring wide "wörld"
float32[3] v [1.0, 2, 3]
bool on true
Part part
geometry_msgs/Point[] points
"""

FILES = {
    "package.xml": "<package><name>demo_msgs</name></package>",
    "msg/Num.msg": NUM,
    "msg/Part.msg": "uint8 c 7\n",
    "msg/Nothing.msg": "# no fields\n",
    "srv/Add.srv": "int64 a\nPart part\n---\nint64 sum\n",
    "srv/Ping.srv": "---\n",
    "action/Num.action": "int64 order\n---\nint64[] sequence\n---\nNum[] parts\n",
}


def write(folder: Path, files: dict[str, str]) -> Path:
    for name, text in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text, encoding="utf-8")
    return folder


@pytest.fixture(autouse=True)
def _fresh(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Iterator[None]:
    """Search in the test's folder only, and forget its packages after the test."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    for variable in ("COFRAME_INTERFACES", "AMENT_PREFIX_PATH"):
        monkeypatch.delenv(variable, raising=False)
    interface_imports.install()
    packages.forget()
    yield
    packages.forget()
    for name in [name for name in sys.modules if name.partition(".")[0] in {"demo_msgs", "other_msgs"}]:
        del sys.modules[name]
    for name in [name for name in registry.classes if name.startswith(("demo_msgs/", "other_msgs/"))]:
        del registry.classes[name]


@pytest.fixture
def define(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Callable[..., Any]:
    """Return a function that writes definitions of demo_msgs and returns the class of a type."""

    def written(ros_type: str, **texts: str) -> Any:
        files = {f"{name.partition('_')[0]}/{name.partition('_')[2]}": text for name, text in texts.items()}
        files = {
            f"{name}.{'idl' if 'module' in text else name.partition('/')[0]}": text for name, text in files.items()
        }
        monkeypatch.setenv("COFRAME_INTERFACES", str(write(tmp_path / "demo_msgs", files)))
        packages.forget()
        return find(ros_type)

    return written


def test_all_kinds_of_definitions_are_imported(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write(tmp_path / "ws/src/group/any_folder", FILES)
    monkeypatch.syspath_prepend(tmp_path / "ws")
    from demo_msgs.action import Num as CountTo
    from demo_msgs.msg import Nothing, Num, Part
    from demo_msgs.msg._num import Num as ByFile
    from demo_msgs.srv import Add, Ping

    message = Num()
    assert (Num.RED, Num.MOTTO, Num.FLAG) == (1, 'say "#1"', b"\x10")
    assert (message.num, message.names, message.wide, message.on, message.part.c) == (5, ["a,b", "c"], "wörld", True, 7)
    assert message.v.tolist() == [1.0, 2.0, 3.0]
    assert Num.__doc__ == "A number with a name."
    assert Num.NUM__DEFAULT == 5
    with pytest.raises(AssertionError, match="not longer than 5"):
        message.names = ["too long"]
    assert ByFile is Num
    assert Num is not CountTo
    assert (CountTo.ROS_TYPE, Num.ROS_TYPE) == ("demo_msgs/action/Num", "demo_msgs/msg/Num")
    feedback = CountTo.Impl.FeedbackMessage(feedback=CountTo.Feedback(parts=[message]))
    for value in (message, Add.Request(a=1, part=Part(c=2)), feedback, Nothing(), Ping.Request()):
        assert deserialize(serialize(value), type(value)) == value
    assert serialize(Ping.Response()) == serialize(Nothing()) == b"\x00\x01\x00\x00\x00"
    from demo_msgs import msg

    assert dir(msg) == ["Nothing", "Num", "Part"]
    with pytest.raises(ImportError, match=r"cannot import name 'Nun' from 'demo_msgs\.msg'"):
        from demo_msgs.msg import Nun  # noqa: F401
    with pytest.raises(ModuleNotFoundError, match=r"No module named 'demo_msgs.msg._nun'"):
        import demo_msgs.msg._nun  # noqa: F401


def test_bytes_equal_those_of_rosbags(
    define: Callable[..., Any], random_message: Any, to_rosbags: Any, store: Any
) -> None:
    text = "string<=5[<=3] names\nfloat32[3] v\nbool on\nuint16[] u\ngeometry_msgs/Point[] points\nint8 last\n"
    cls = define("demo_msgs/msg/Mixed", msg_Mixed=text)
    store.register(get_types_from_msg(text, "demo_msgs/msg/Mixed"))
    rng = random.Random(3)
    for _ in range(20):
        message = random_message(cls, rng)
        assert serialize(message) == bytes(store.serialize_cdr(to_rosbags(message), "demo_msgs/msg/Mixed"))


def test_infinity_and_nan_are_defaults(define: Callable[..., Any]) -> None:
    text = "float64 MOST=inf\nfloat64 low -inf\nfloat32[2] both [nan, inf]\nfloat64[] more [1.0, -inf]\n"
    cls = define("demo_msgs/msg/Limits", msg_Limits=text)
    assert (cls.MOST, cls().low, cls().more.tolist()) == (float("inf"), float("-inf"), [1.0, float("-inf")])
    assert str(cls().both.tolist()) == "[nan, inf]"


def test_damaged_definitions_raise_nothing_but_interface_errors() -> None:
    rng = random.Random(5)
    pieces = [
        "[",
        "]",
        "<=",
        "=",
        "'",
        '"',
        "\\",
        "#",
        "---",
        "\n",
        "9" * 30,
        "{",
        "}",
        "::",
        "@",
        "sequence<",
        "\0",
        "inf",
    ]
    for number in range(1500):
        idl = number % 2
        text = list(IDL if idl else NUM.replace("Part part", ""))
        for _ in range(rng.randint(1, 4)):
            at = rng.randrange(len(text))
            text[at : at + rng.choice([0, 0, 1, 20])] = rng.choice([*pieces, "".join(text[at : at + 99])])
        package = packages.InterfacePackage(
            "demo_msgs",
            {f"msg/N{number}": Definition("".join(text).replace("Shape", f"N{number}"), "x.idl" if idl else None)},
        )
        try:
            package.create("msg", f"N{number}")
        except coframe.InterfaceError:
            continue
        cls = find(f"demo_msgs/msg/N{number}")
        deserialize(serialize(cls()), cls)


IDL = """
// A comment
#include "geometry_msgs/msg/Point.idl"
module demo_msgs { module msg {
  typedef double double__9[9];
  typedef geometry_msgs::msg::Point Point;
  module Shape_Constants {
    @verbatim (language="comment", text="the best")
    const uint8 RED = 1;
    const string NAME = "a\\"b" "c";
    const float GRAVITY = -9.81;
    const long MOST = 0x10;
  };
  @verbatim (language="comment", text="A shape." "\\n" "Of points.")
  struct Shape {
    @unit(value="m") @key @default (value=3)
    unsigned long long a, B;
    @default (value="(1, 2, 3)") sequence<int8, 5> steps;
    double__9 k;
    sequence<Point> points;
    @default (value="x") string<20> name;
    @default (value=TRUE) boolean on;
    wstring wide;
    octet raw[Shape_Constants::MOST];
    @default (value=2) float ratio;
  };
}; };
"""


def test_idl_files_define_messages(define: Callable[..., Any]) -> None:
    cls = define("demo_msgs/msg/Shape", msg_Shape=IDL)
    message = cls()
    assert (cls.RED, cls.NAME, cls.GRAVITY, cls.MOST) == (1, 'a"bc', -9.81, 16)
    assert cls.__doc__ == "A shape. Of points."
    assert (message.a, message.B, message.steps.tolist(), message.name, message.on) == (3, 3, [1, 2, 3], "x", True)
    assert (len(message.raw), message.ratio, message.k.shape) == (16, 2.0, (9,))
    message.B, message.wide = 9, "机"
    assert deserialize(serialize(message), cls) == message


# As rosidl writes it for a .msg file, into the folder `share` of an installed package.
INSTALLED = """
// generated from rosidl_adapter/resource/msg.idl.em
// with input from demo_msgs/msg/Report.msg
#include "geometry_msgs/msg/Point.idl"

module demo_msgs {
  module msg {
    typedef geometry_msgs::msg::Point geometry_msgs__msg__Point;
    typedef geometry_msgs__msg__Point geometry_msgs__msg__Point__2[2];
    typedef double double__36[36];
    module Report_Constants {
      const uint8 OK = 0;
      const int32 WORST = -3;
    };
    @verbatim (language="comment", text=
      "A report." "\\n"
      "Of two lines.")
    struct Report {
      @verbatim (language="comment", text=
        "Width and height")
      @unit (value="m")
      uint16 width;

      boolean done;

      double__36 covariance;

      geometry_msgs__msg__Point__2 corners;

      sequence<geometry_msgs::msg::Point, 3> path;

      sequence<octet> raw;

      string<5> unit;
    };
  };
};
"""


def test_installed_idl_files_give_the_bytes_of_rosbags(
    define: Callable[..., Any], random_message: Any, to_rosbags: Any, store: Any
) -> None:
    cls = define("demo_msgs/msg/Report", msg_Report=INSTALLED)
    assert (cls.OK, cls.WORST, cls.__doc__) == (0, -3, "A report. Of two lines.")
    store.register(get_types_from_idl(re.sub("#include.*", "", INSTALLED)))  # rosbags does not read this line here.
    rng = random.Random(4)
    for _ in range(20):
        message = random_message(cls, rng)
        assert serialize(message) == bytes(store.serialize_cdr(to_rosbags(message), "demo_msgs/msg/Report"))


def test_idl_files_define_services_and_actions(define: Callable[..., Any]) -> None:
    parts = "struct {0}_{1} {{ long a; }}; module {0}_{1}_Constants {{ const uint8 ONE = 1; }};"
    for kind, name, suffixes in (
        ("srv", "Ask", ("Request", "Response")),
        ("action", "Go", ("Goal", "Result", "Feedback")),
    ):
        body = " ".join(parts.format(name, suffix) for suffix in suffixes)
        cls = define(
            f"demo_msgs/{kind}/{name}", **{f"{kind}_{name}": f"module demo_msgs {{ module {kind} {{ {body} }}; }};"}
        )
        for suffix in suffixes:
            assert (getattr(cls, suffix)(a=2).a, getattr(cls, suffix).ONE) == (2, 1)
    empty = "module demo_msgs{module msg{struct Void{uint8 structure_needs_at_least_one_member;};};};"
    assert serialize(define("demo_msgs/msg/Void", msg_Void=empty)())[4:] == b"\0"


@pytest.mark.parametrize(
    ("text", "line", "expected"),
    [
        ("uint8 a\nfloat b", 2, "no type 'float'; use float32 or float64"),
        ("time stamp", 1, "use builtin_interfaces/Time"),
        ("uint8 a\n\nPose pose", 3, "field 'pose': no type demo_msgs/msg/Pose"),
        ("moon_msgs/Pose pose", 1, "coframe has no package moon_msgs"),
        ("uint8 A=256", 1, r"256 is not a value of type uint8 \(from 0 to 255\)"),
        ("uint8 a\nuint8 a", 2, "the name 'a' is used twice"),
        ("uint8 myField", 1, "the name of a field has small letters, digits and single underscores, not 'myField'"),
        ("uint8 color=1", 1, "the name of a constant has capital letters"),
        ("bool b maybe", 1, "'maybe' is not a value of type boolean"),
        ("int8[2] b [1, 2, 3]", 1, r"int8\[2\] needs 2 values, found 3"),
        ("int8[] b 3", 1, "must be a list"),
        ("string<=3 s 'abcd'", 1, "longer than string<3> allows"),
        ("string s 'abc", 1, "not a string in quotes"),
        ("geometry_msgs/Point p 3", 1, "cannot have a default"),
        ("float32 x 1e39", 1, "not a value of type float"),
        ("int8[0] x", 1, "a size must be from 1 to"),
        ("int8[99999999999999999999] x", 1, "a size must be from 1 to"),
        ("string SLOT_TYPES='x'", 1, "reserved"),
        ("Thing other", 1, "a message cannot contain itself: demo_msgs/msg/Thing > demo_msgs/msg/Thing"),
        ("just some words of prose", 1, "no type 'just'"),
        ("\x00\x01", 1, "not a field such as"),
        ("string[1000000000] x", 1, "the maximum is 67108864. Use a sequence"),
        ("float64[1000000000] x", 1, "the maximum is 67108864"),
        ("module demo_msgs { module msg { struct Thing { char x; }; }; };", 1, "char is not supported; use uint8"),
        ("module demo_msgs {\n enum X { A };", 2, "'enum': rosidl does not support it"),
        (
            "module demo_msgs { module msg { struct Other { long x; }; }; };",
            1,
            "expected the structure demo_msgs::msg::Th",
        ),
        (
            "module demo_msgs { module msg {\n struct Thing { long x; \n long",
            3,
            "expected a name, found the end of the",
        ),
        ("module demo_msgs {\n\n ` };", 3, "unexpected character '`'"),
        ("module a { " * 50, 1, "modules are nested more than 20 levels deep"),
        ('module demo_msgs { module msg {\n @range(1 % "") struct Thing { long x; }; }; };', 2, "cannot be applied to"),
    ],
)
def test_invalid_definitions_are_refused_with_file_and_line(
    define: Callable[..., Any], tmp_path: Path, text: str, line: int, expected: str
) -> None:
    begin = time.process_time()
    with pytest.raises(coframe.InterfaceError, match=expected) as caught:
        define("demo_msgs/msg/Thing", msg_Thing=text)
    kind = "idl" if "module" in text else "msg"
    assert (caught.value.file, caught.value.line) == (str(tmp_path / f"demo_msgs/msg/Thing.{kind}"), line)
    assert isinstance(caught.value, (ValueError, LookupError))
    assert time.process_time() - begin < 1.0


def test_definitions_that_multiply_are_refused(define: Callable[..., Any]) -> None:
    texts = {f"msg_Level{level}": f"Level{level + 1}[1000] x\n" for level in range(5)}
    with pytest.raises(coframe.InterfaceError, match="the maximum is 67108864"):
        define("demo_msgs/msg/Level0", **texts, msg_Level5="uint8 x")
    fields = {f"msg_Wide{level}": "".join(f"Wide{level + 1} f{i}\n" for i in range(10)) for level in range(5)}
    with pytest.raises(coframe.InterfaceError, match="100000 fields; the maximum is 20000"):
        define("demo_msgs/msg/Wide0", **fields, msg_Wide5="uint8 x")
    deep = {f"msg_Deep{level}": f"Deep{level + 1}[] x\n" for level in range(30)}
    with pytest.raises(coframe.InterfaceError, match="more than 16 levels deep"):
        define("demo_msgs/msg/Deep0", **deep, msg_Deep30="uint8 x")
    chain = {f"msg_Chain{level}": f"Chain{level + 1} x\n" for level in range(500)}
    with pytest.raises(coframe.InterfaceError, match="more than 64 levels deep"):
        define("demo_msgs/msg/Chain0", **chain, msg_Chain500="uint8 x")
    largest = define("demo_msgs/msg/Image", msg_Image="uint8[6000000] pixels")
    assert largest().pixels.size == 6_000_000


def test_files_that_are_not_definitions_are_refused(define: Callable[..., Any], tmp_path: Path) -> None:
    define("std_msgs/msg/String", msg_Good="uint8 a", msg_bad_name="uint8 a")
    (tmp_path / "demo_msgs/msg/Binary.msg").write_bytes(b"\xff\xfe\x00")
    (tmp_path / "demo_msgs/msg/Huge.msg").write_text("# \n" * 400_000)
    (tmp_path / "demo_msgs/msg/Windows.msg").write_bytes("\ufeffuint8 a\r\nuint8 b\r\n".encode())
    packages.forget()
    assert find("demo_msgs/msg/Windows").get_fields_and_field_types() == {"a": "uint8", "b": "uint8"}
    for name, expected in (
        ("Binary", "is not UTF-8"),
        ("Huge", "larger than the maximum of 262144 bytes"),
        ("bad_name", "must begin with a capital"),
    ):
        with pytest.raises(coframe.InterfaceError, match=expected):
            find(f"demo_msgs/msg/{name}")
    assert find("demo_msgs/msg/Good")


def test_the_sources_are_searched_in_order(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from coframe.interfaces.user_folders import set_added_paths

    def defaults(number: int) -> dict[str, str]:
        return {"msg/Num.msg": f"uint8 n {number}\n"}

    write(tmp_path / "prefix/share/demo_msgs", defaults(4))
    write(tmp_path / "ws/src/demo_msgs", {**defaults(3), "package.xml": "<package><name>demo_msgs</name></package>"})
    write(tmp_path / "added/demo_msgs", defaults(2))
    write(tmp_path / "given/deep/er/demo_msgs", defaults(1))
    write(tmp_path / "ws/src/ignored/demo_msgs", {**defaults(9), "../COLCON_IGNORE": ""})

    def number() -> int:
        packages.forget()
        registry.classes.pop("demo_msgs/msg/Num", None)
        return int(find("demo_msgs/msg/Num")().n)

    monkeypatch.delenv("COFRAME_PACKAGE_PATH", raising=False)
    with pytest.raises(LookupError, match="no package demo_msgs"):
        number()
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path / "prefix"))
    assert number() == 4
    (tmp_path / "ws/src/robot/robot").mkdir(parents=True)
    monkeypatch.chdir(tmp_path / "ws/src/robot/robot")
    monkeypatch.delenv("AMENT_PREFIX_PATH")
    with pytest.raises(LookupError, match="no package demo_msgs"):  # A program does not import from this folder.
        number()
    monkeypatch.setenv("COFRAME_PACKAGE_PATH", str(tmp_path / "ws/src"))
    assert number() == 3
    monkeypatch.delenv("COFRAME_PACKAGE_PATH")
    monkeypatch.syspath_prepend(tmp_path / "ws/src/robot/robot")
    assert number() == 3
    set_added_paths([tmp_path / "added"])
    assert number() == 2
    monkeypatch.setenv("COFRAME_INTERFACES", os.pathsep.join([str(tmp_path / "missing"), str(tmp_path / "given")]))
    assert number() == 1


def test_a_users_package_takes_precedence_over_a_shipped_one(tmp_path: Path) -> None:
    write(tmp_path / "stereo_msgs", {"msg/DisparityImage.msg": "uint8 mine\n"})
    script = "from stereo_msgs.msg import DisparityImage; print(DisparityImage())"
    assert run(tmp_path, script).stdout == "stereo_msgs.msg.DisparityImage(mine=0)\n"


def run(folder: Path, script: str, **options: Any) -> subprocess.CompletedProcess[str]:
    (folder / "script.py").write_text(textwrap.dedent(script))
    command = [sys.executable, *options.get("flags", ()), str(folder / "script.py")]
    return subprocess.run(command, capture_output=True, text=True, check=False, cwd=folder.parent)


def test_a_script_next_to_the_definitions_needs_no_other_import(tmp_path: Path) -> None:
    write(tmp_path / "demo_msgs", FILES)
    write(tmp_path / "demo_msgs/demo_msgs", {"helpers.py": "ANSWER = 42\n"})
    done = run(
        tmp_path,
        """
        from demo_msgs.msg import Part  # the very first import
        from demo_msgs.srv import Add
        import importlib.util, sys
        print(Part(), Add.Request().part.c)
        print(importlib.util.find_spec("moon_msgs"), importlib.util.find_spec("moon"))
        for name in ("moon", "moon_msgs", "demo_msgs.helpers"):
            try:
                __import__(name)
            except ModuleNotFoundError as error:
                print(error)
        import moon_msgs.msg
        """,
    )
    assert done.stdout.splitlines() == [
        "demo_msgs.msg.Part(c=7) 7",
        "None None",
        "No module named 'moon'",
        "No module named 'moon_msgs'",
        "No module named 'demo_msgs.helpers'",
    ]
    assert "ModuleNotFoundError: No module named 'moon_msgs'. coframe does not contain this package" in done.stderr
    assert f"found no definitions of it in {tmp_path}" in done.stderr
    assert "coframe interface add FOLDER" in done.stderr


def test_other_imports_do_not_load_coframe_or_numpy(tmp_path: Path) -> None:
    done = run(
        tmp_path,
        """
        import sys
        print([name for name in sys.modules if name.startswith(("coframe", "numpy"))])
        import json, email.message
        print([name for name in sys.modules if name.startswith(("coframe", "numpy"))])
        try:
            import not_installed
        except ImportError:
            print("numpy" in sys.modules, "coframe._core" in sys.modules)
        """,
    )
    assert done.stdout.splitlines() == ["[]", "[]", "False False"], done.stderr


def test_a_sourced_ros_is_left_alone(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write(tmp_path / "ros/rclpy", {"__init__.py": ""})
    write(tmp_path / "demo_msgs", FILES)
    monkeypatch.setenv("PYTHONPATH", str(tmp_path / "ros"))
    done = run(tmp_path, "import rclpy, other_msgs")
    assert done.stderr.endswith("ModuleNotFoundError: No module named 'other_msgs'\n")
    done = run(tmp_path, "import rclpy; from demo_msgs.msg import Part")
    assert "ImportError: cannot import name 'Part' from 'demo_msgs.msg' (unknown location)" in done.stderr


def test_a_module_with_code_wins(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    write(tmp_path / "code/other_msgs/msg", {"__init__.py": "whose = 'theirs'\n"})
    write(tmp_path / "code/other_msgs", {"__init__.py": ""})
    write(tmp_path / "other_msgs", {"msg/Num.msg": "uint8 n\n"})
    monkeypatch.syspath_prepend(str(tmp_path / "code"))
    assert importlib.import_module("other_msgs.msg").whose == "theirs"
