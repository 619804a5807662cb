# SPDX-License-Identifier: Apache-2.0
"""Generator of the message classes from the definitions in ``interfaces/``.

python scripts/generate_messages.py            write src/coframe/messages/generated and the packages in src/ros
python scripts/generate_messages.py --check    exit with code 1 if the committed files differ
"""

from __future__ import annotations

import re
import sys
from pathlib import Path
from typing import NamedTuple

from coframe.distributions import REMOVED
from coframe.messages import _archive as archive
from coframe.messages._constructors import default_assignments
from coframe.messages._fields import number_of
from coframe.messages._parser import Field, MessageStructure, parse
from coframe.messages._stubs import field_hint, parameter_hint, stub, value_type
from coframe.messages.compounds import NUMBER_OF_PARTS, member_messages
from coframe.messages.definition import Array, NamespacedType

ROOT = Path(__file__).resolve().parents[1]
INTERFACES = ROOT / "interfaces"
VARIANTS = ROOT / "distributions"  # The definitions of other distributions than the default one.
GENERATED = ROOT / "src/coframe/messages/generated"
SHIPPED = ROOT / "src/coframe/messages/shipped"
ROS = ROOT / "src/ros"

# The packages that coframe or most programs use; importing Python source is faster than creating classes. The classes
# of all other packages are created from their definitions when they are first used, which keeps the install small.
WITH_SOURCE = {
    "action_msgs",
    "builtin_interfaces",
    "geometry_msgs",
    "nav_msgs",
    "rcl_interfaces",
    "rosgraph_msgs",
    "sensor_msgs",
    "std_msgs",
    "std_srvs",
    "tf2_msgs",
    "unique_identifier_msgs",
    "visualization_msgs",
}

NOTICE = "# Written by scripts/generate_messages.py from interfaces/{package}/{kind}; do not edit.\n"
KINDS = {"msg": "Messages", "srv": "Services", "action": "Actions"}


class Message(NamedTuple):
    """A message class to generate."""

    package: str
    kind: str
    name: str
    structure: MessageStructure

    @property
    def ros_type(self) -> str:
        """The ROS type name."""
        return f"{self.package}/{self.kind}/{self.name}"


def main() -> int:
    """Write all files, or compare them with the existing ones."""
    files = generate()
    if "--check" not in sys.argv[1:]:
        for path, text in files.items():
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        return 0
    stale = [path for path, text in files.items() if not path.is_file() or path.read_text("utf-8") != text]
    stale += [path for path in (*GENERATED.rglob("*.py"), *SHIPPED.rglob("*.txt")) if path not in files]
    for path in stale:
        print(f"{path.relative_to(ROOT)} is out of date. Run scripts/generate_messages.py.")
    return 1 if stale else 0


def generate() -> dict[Path, str]:
    """Return the text of every file."""
    files = {GENERATED / "__init__.py": '"""The message classes of each ROS package."""\n'}
    for folder in sorted(path for path in INTERFACES.iterdir() if path.is_dir()):
        package = folder.name
        definitions = {path.relative_to(folder).with_suffix("").as_posix(): path for path in sorted(folder.glob("*/*"))}
        texts = {name: path.read_text("utf-8") for name, path in definitions.items()}
        for path in sorted(VARIANTS.glob(f"*/{package}/*/*")):
            distribution, _, kind, _ = path.relative_to(VARIANTS).parts
            texts[f"{kind}/{path.stem} {distribution}"] = path.read_text("utf-8")
        files[SHIPPED / f"{package}.txt"] = archive.pack(texts)
        files[ROS / package / "py.typed"] = ""
        files[ROS / package / "__init__.py"] = (
            f'"""ROS package {package}."""\n\nfrom coframe.workspace import ros_side\n\nros_side.check("{package}")\n'
        )
        modules = _classes_as_source if package in WITH_SOURCE else _classes_at_first_use
        for kind in sorted(path.name for path in folder.iterdir()):
            files |= modules(package, kind, sorted((folder / kind).iterdir()))
    return files


def _classes_as_source(package: str, kind: str, paths: list[Path]) -> dict[Path, str]:
    module = Module(package, kind)
    for path in paths:
        module.add(path)
    return {
        GENERATED / package / "__init__.py": f'"""ROS package {package}."""\n',
        GENERATED / package / f"{kind}.py": module.text(),
        ROS / package / kind / "__init__.py": module.public_text(),
    }


def _classes_at_first_use(package: str, kind: str, paths: list[Path]) -> dict[Path, str]:
    notice = NOTICE.format(package=package, kind=kind)
    definitions = {path.stem: parse(path.read_text("utf-8"), package, NUMBER_OF_PARTS[kind]) for path in paths}
    folder = ROS / package / kind
    return {
        folder / "__init__.pyi": notice + stub(package, kind, definitions),
        folder / "__init__.py": notice
        + f'''"""{KINDS[kind]} of {package}. Each class is created when it is first used."""

from coframe.messages.packages import shipped_exports

__all__, __getattr__, __dir__ = shipped_exports("{package}", "{kind}")
''',
    }


class Module:
    """A module to generate: the messages, services or actions of one package."""

    def __init__(self, package: str, kind: str) -> None:
        self.package = package
        self.kind = kind
        self.messages: dict[str, Message] = {}
        self.variants: dict[str, tuple[str, Message]] = {}  # The distribution and message, by name of the message.
        self.compounds: dict[str, list[str]] = {}  # The lines of each service or action class.
        self.imports: dict[str, set[str]] = {}
        self.names: dict[str, set[str]] = {"definition": set(), "message": set(), "hints": set()}

    def add(self, path: Path) -> None:
        """Add one definition file."""
        parts = parse(path.read_text("utf-8"), self.package, NUMBER_OF_PARTS[self.kind])
        name = path.stem
        for message, structure in member_messages(self.package, self.kind, name, parts).items():
            self.messages[message] = Message(self.package, self.kind, message, structure)
        for variant in VARIANTS.glob(f"*/{self.package}/{self.kind}/{path.name}"):
            (structure,) = parse(variant.read_text("utf-8"), self.package)
            message = Message(self.package, self.kind, name, structure)
            self.variants[name] = (variant.relative_to(VARIANTS).parts[0], message)
        if self.kind == "srv":
            self._add_service(name)
        elif self.kind == "action":
            self._add_action(name)

    def _add_service(self, name: str) -> None:
        self.names["message"].add("Service")
        self.compounds[name] = [
            f"class {name}(Service):",
            f'    """Service {self.package}/{self.kind}/{name}."""',
            "",
            f'    ROS_TYPE = "{self.package}/{self.kind}/{name}"',
            f"    Request: TypeAlias = {name}_Request",
            f"    Response: TypeAlias = {name}_Response",
        ]

    def _add_action(self, name: str) -> None:
        self._add_service(f"{name}_SendGoal")
        self._add_service(f"{name}_GetResult")
        self._import("action_msgs", "srv", "CancelGoal")
        self._import("action_msgs", "msg", "GoalStatusArray")
        self.names["message"].add("Action")
        self.compounds[name] = [
            f"class {name}(Action):",
            f'    """Action {self.package}/{self.kind}/{name}."""',
            "",
            f'    ROS_TYPE = "{self.package}/{self.kind}/{name}"',
            f"    Goal: TypeAlias = {name}_Goal",
            f"    Result: TypeAlias = {name}_Result",
            f"    Feedback: TypeAlias = {name}_Feedback",
            "",
            "    class Impl:",
            '        """The services and messages of the action protocol."""',
            "",
            f"        SendGoalService: TypeAlias = {name}_SendGoal",
            f"        GetResultService: TypeAlias = {name}_GetResult",
            f"        FeedbackMessage: TypeAlias = {name}_FeedbackMessage",
            "        CancelGoalService: TypeAlias = CancelGoal",
            "        GoalStatusMessage: TypeAlias = GoalStatusArray",
        ]

    def _import(self, package: str, kind: str, name: str) -> None:
        if (package, kind) != (self.package, self.kind):
            self.imports.setdefault(f"{package}.{kind}", set()).add(name)

    def docstring(self) -> str:
        """Return the docstring of the module."""
        return f"{KINDS[self.kind]} of {self.package}."

    def text(self) -> str:
        """Return the text of the module with the classes."""
        self.names["message"].update(("Message", "set_fields"))
        classes = [self._classes(message) for message in self._in_order()]
        classes += ["\n".join(lines) for lines in self.compounds.values()]
        header = NOTICE.format(package=self.package, kind=self.kind)
        header += f'"""{self.docstring()}"""\n\nfrom __future__ import annotations\n\n'
        if any("array(" in text for text in classes):
            header += "from array import array\n"
        alias = ", TypeAlias" if self.compounds else ""
        header += f"from typing import TYPE_CHECKING, Any, Final{alias}\n\n"
        if any("np." in text for text in classes):
            header += "import coframe.lazy_numpy as np\n"
        if self.variants:
            header += "from coframe.distributions import follows\n"
        for module in ("definition", "message"):
            header += _import_line(f"coframe.messages.{module}", self.names[module])
        for module, names in sorted(self.imports.items()):
            header += _import_line(f"coframe.messages.generated.{module}", names)
        if hints := self._hint_imports(classes):
            header += "\nif TYPE_CHECKING:\n" + hints
        return header + "\n\n" + "\n\n\n".join(classes) + "\n"

    def _hint_imports(self, classes: list[str]) -> str:
        lines = ""
        if any(": Iterable[" in text or ": Sequence[" in text for text in classes):
            lines += "    from collections.abc import Iterable\n\n"
        if self.names["hints"]:
            lines += "    " + _import_line("coframe.messages._hints", self.names["hints"])
        return lines

    def public_text(self) -> str:
        """Return the text of the ROS package's module, from which users import the classes."""
        names = sorted([*self.messages, *self.compounds], key=_natural)
        is_reduced = any(key.startswith(f"{self.package}/") for key in REMOVED)
        lines = [
            NOTICE.format(package=self.package, kind=self.kind).rstrip(),
            f'"""{self.docstring()}"""',
            "",
            *(["from coframe.distributions import hide_removed_types"] if is_reduced else []),
            *(["from coframe.messages.events import event_attributes"] if self.compounds else []),
            f"from coframe.messages.generated.{self.package}.{self.kind} import (",
            *(f"    {name}," for name in sorted(names, key=lambda name: _natural(name.lower()))),
            ")",
            "",
            "__all__ = [",
            *(f'    "{name}",' for name in names),
            "]",
            *(["", f'hide_removed_types(globals(), "{self.package}", "{self.kind}")'] if is_reduced else []),
            *(["", f'__getattr__ = event_attributes("{self.package}", "{self.kind}")'] if self.compounds else []),
        ]
        return "\n".join(lines) + "\n"

    def _in_order(self) -> list[Message]:
        """Return the messages in an order in which each comes after the messages that it contains."""
        ordered: dict[str, Message] = {}

        def visit(message: Message) -> None:
            for field in message.structure.fields:
                inner = value_type(field.type)
                if isinstance(inner, NamespacedType) and inner.namespaces == (self.package, self.kind):
                    visit(self.messages[inner.name])
            ordered.setdefault(message.name, message)

        for message in self.messages.values():
            visit(message)
        return list(ordered.values())

    def _classes(self, message: Message) -> str:
        """Return the class of a message; if distributions differ, both classes and the choice between them."""
        lines = self._class(message)
        if message.name not in self.variants:
            return "\n".join(lines)
        distribution, variant = self.variants[message.name]
        branches = [f'if TYPE_CHECKING or not follows("{distribution}"):', *_indented(lines)]
        return "\n".join([*branches, "", "else:", *_indented(self._class(variant))])

    def _class(self, message: Message) -> list[str]:
        structure = message.structure
        # __slots__ is hidden from type checkers, because they would reject assignments to attributes without a slot.
        slots = ", ".join(f'"_{field.name}"' for field in structure.fields)
        return [
            f"class {message.name}(Message):",
            f'    """{structure.comment or f"Message {message.ros_type}."}"""',
            "",
            f'    ROS_TYPE = "{message.ros_type}"',
            *self._slot_types(structure.fields),
            *(f"    {constant.name}: Final = {constant.value!r}" for constant in structure.constants),
            *(
                f"    {field.name.upper()}__DEFAULT: Final = {field.default!r}"
                for field in structure.fields
                if field.default is not None
            ),
            "",
            *self._hints(structure.fields),
            "    else:",
            f"        __slots__ = [{slots}]",
            "",
            *_constructor(structure.fields),
        ]

    def _slot_types(self, fields: list[Field]) -> list[str]:
        if not fields:
            return ["    SLOT_TYPES = ()"]
        lines = ["    SLOT_TYPES = ("]
        for field in fields:
            lines.append(f"        {field.type!r},")
            self.names["definition"].add(type(field.type).__name__)
            inner = value_type(field.type)
            self.names["definition"].add(type(inner).__name__)
            if isinstance(inner, NamespacedType):
                package, kind = inner.namespaces
                self._import(package, kind, inner.name)
        return [*lines, "    )"]

    def _hints(self, fields: list[Field]) -> list[str]:
        lines = ["    if TYPE_CHECKING:"]
        lines += [self._attribute_hint(field) for field in fields]
        parameters = "".join(f", {field.name}: {parameter_hint(field.type, _short_name)} = ..." for field in fields)
        star = ", *" if fields else ""
        return [*lines, f"        def __init__(self{star}{parameters}) -> None: ..."]

    def _attribute_hint(self, field: Field) -> str:
        number = number_of(field.type)
        if number is None:
            return f"        {field.name}: {field_hint(field.type, _short_name)}"
        if isinstance(field.type, Array):
            self.names["hints"].add("NumberArray")
            return f"        {field.name} = NumberArray[np.{number.name}]()"
        self.names["hints"].add("NumberSequence")
        return f"        {field.name} = NumberSequence[{field_hint(value_type(field.type), _short_name)}]()"


def _constructor(fields: list[Field]) -> list[str]:
    return [
        "        def __init__(self, **fields: Any) -> None:",
        *(f"            {line}" for line in default_assignments(fields, _short_name)),
        "            if fields:",
        "                set_fields(self, fields)",
    ]


def _indented(lines: list[str]) -> list[str]:
    return [line and f"    {line}" for line in lines]


def _natural(name: str) -> list[tuple[str, int]]:
    """Return a sort key that puts Int8 before Int16, as the linter requires."""
    return [(text, int(digits or -1)) for text, digits in re.findall(r"(\D+)(\d*)", name)]


def _import_line(module: str, names: set[str]) -> str:
    return f"from {module} import {', '.join(sorted(names))}\n" if names else ""


def _short_name(type_: NamespacedType) -> str:
    return type_.name


if __name__ == "__main__":
    sys.exit(main())
