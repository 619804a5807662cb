# SPDX-License-Identifier: Apache-2.0
"""Each package of the repository is in one storey of the import contract: programs, ROS packages or library."""

import ast
import re
from pathlib import Path

import pytest

tomllib = pytest.importorskip("tomllib", reason="Python 3.10 has no TOML parser")

ROOT = Path(__file__).parents[1]


@pytest.fixture(scope="module")
def storeys():
    """The parts of each storey, from the top, as pyproject.toml lists them."""
    settings = tomllib.loads((ROOT / "pyproject.toml").read_text())
    contract = settings["tool"]["importlinter"]["contracts"][0]
    assert contract["name"].startswith("Three storeys")
    return [set(re.split(r"\s*:\s*", layer)) for layer in contract["layers"]]


def test_each_ros_package_is_a_program_or_a_ros_package(storeys):
    programs, packages, _library = storeys
    found = {path.name for path in (ROOT / "src" / "ros").iterdir() if next(path.rglob("*.py"), None)}
    assert {name for name in programs | packages if not name.startswith("coframe.")} == found


def test_each_part_of_coframe_is_a_program_or_of_the_library(storeys):
    programs, _packages, library = storeys
    parts = {
        path.stem
        for path in (ROOT / "src" / "coframe").iterdir()
        if path.suffix == ".py" or (path / "__init__.py").exists()
    }
    assert {name for name in programs | library if name.startswith("coframe.")} == {
        f"coframe.{part}" for part in parts - {"__init__"}
    }


def test_no_module_imports_a_name_from_the_face_of_coframe():
    """They import it from the module that defines it; the package itself re-exports names for users only."""
    face = re.compile(r"^\s*from coframe import (?!_core\b|time\b|quaternion\b|frame_names\b|errors\b)\w", re.MULTILINE)
    sources = [path for path in (ROOT / "src").rglob("*.py") if path != ROOT / "src" / "coframe" / "__init__.py"]
    assert [path.relative_to(ROOT).as_posix() for path in sources if face.search(path.read_text())] == []


# Each module of these packages is one of many of a kind, which a table or a search finds by its name.
KINDS = re.compile(
    r"coframe\.(cli|lab|nodes|ros2|doctor\.checks|viewer\.displays\.kinds|messages\.generated"
    r"|course\.(criteria|faults|sandbox|templates)|bags\.editing\.rules)\b"
)


@pytest.fixture(scope="module")
def imports():
    """The modules that import each module of coframe."""
    files = {path: _module(path) for path in (ROOT / "src").rglob("*.py")}
    found = {name: set() for name in files.values() if name.startswith("coframe.")}
    for path, importer in files.items():
        for name in _imported(path.read_text(encoding="utf-8")) & found.keys():
            found[name].add(importer)
    return found


def _module(path):
    parts = path.relative_to(ROOT / "src").with_suffix("").parts
    return ".".join(parts).removesuffix(".__init__")


def _imported(source):
    names = set()
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            names |= {one.name for one in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            names |= {node.module, *(f"{node.module}.{one.name}" for one in node.names)}
    return names


def test_a_private_module_is_imported_only_in_its_own_package(imports):
    wrong = {
        (name, importer)
        for name, importers in imports.items()
        for importer in importers
        if (parts := re.match(r"(.*?)\._", name))
        and parts[1] != "coframe"
        and not f"{importer}.".startswith(f"{parts[1]}.")
    }
    assert not wrong
