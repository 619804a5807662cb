# SPDX-License-Identifier: Apache-2.0
"""Finds coframe's ROS packages after all others, and imports users' interface packages without a build step.

The file ``coframe_ros.pth`` puts the folder of coframe's ROS packages on `sys.path` when Python starts, and adds one
condition to the finder of that folder, which Python asks for each package that it has not found in an earlier one. It
calls `find_last` in this module if the name is one of coframe's ROS packages, or if ``X.msg``, ``X.srv`` or
``X.action`` of the missing package X is being imported: Python has a lock for each module during its import. All other
imports, including failing ones, load no module of coframe and read no file.

`install` adds finders to `sys.meta_path` as soon as a ROS package of coframe or a user's interface package is imported.
They create modules only from definitions: no Python code is imported from a folder that is not on `sys.path`.
"""

from __future__ import annotations

import re
import sys
from functools import partial
from importlib.machinery import ModuleSpec, PathFinder
from pathlib import Path
from typing import TYPE_CHECKING, Any

from coframe.workspace.ros_folders import folders_after_ros, foreign_packages, imported_packages, is_coframes

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from types import ModuleType

__all__ = ["find_last", "find_module", "find_package", "install"]

_FINDER = "CoframeInterfaces"  # class name of the finders
_KINDS = ("msg", "srv", "action")
_PACKAGE = r"[a-z](?:_?[a-z0-9])*"
# Packages of messages and services that many programs import, and whose names do not show what they are.
_INTERFACES = {"unitree_api", "unitree_hg"}
# Packages that many programs import, and of which no package registry has the definitions.
_SOURCES = {
    "px4_msgs": "PX4/px4_msgs",
    "unitree_api": "unitreerobotics/unitree_ros2",
    "unitree_hg": "unitreerobotics/unitree_ros2",
}
_INTERFACE_PACKAGE_NAME = r".*_(?:msgs?|srvs?|actions?|interfaces?)"


def install() -> None:
    """Add the finders to `sys.meta_path` if they are not there."""
    if any(type(finder).__name__ == _FINDER for finder in sys.meta_path):
        return
    sys.meta_path.insert(0, _finder(find_module))
    sys.meta_path.append(_finder(find_package))


def find_last(name: str, own: ModuleSpec | None) -> ModuleSpec | None:
    """Find a package that Python did not find in the folders before coframe's ROS packages.

    Args:
        name: The name of the package.
        own: Coframe's ROS package with this name, if there is one.
    """
    if own is None:
        install()
        return find_package(name)
    if any(map(is_coframes, imported_packages())):
        return own
    # In a virtual environment with --system-site-packages, the system's folders come after its own.
    later = PathFinder.find_spec(name, folders_after_ros(sys.path))
    return own if later is None or later.loader is None else later


def find_module(name: str, path: Sequence[str] | None = None, _target: object = None) -> ModuleSpec | None:
    """Find ``my_msgs.msg``, ``my_msgs.srv`` or ``my_msgs.action``, or ``my_msgs.msg._num`` as rosidl names its modules.

    Args:
        name: The full name of any module that is being imported.
        path: The folders of its parent package.
    """
    package, _, rest = name.partition(".")
    kind, _, definition = rest.partition(".")
    if kind not in _KINDS:
        return None
    spec = PathFinder.find_spec(name, path)
    if spec is not None and spec.has_location:
        return spec  # A module with code: of a real ROS, of coframe, or of the user.
    if definition:
        return _spec(name, _DefinitionLoader()) if re.fullmatch(r"_[a-z0-9_]+", definition) else None
    if _is_foreign():
        return None
    return _search_guarded(partial(_find_kind, package, kind, list(path or ())))


def find_package(name: str, path: Sequence[str] | None = None, _target: object = None) -> ModuleSpec | None:
    """Find an interface package that no other finder has found, while one of its modules is imported.

    Args:
        name: The full name of the module.
        path: None for a package.
    """
    if path is not None or not re.fullmatch(_PACKAGE, name) or name in sys.stdlib_module_names or _is_foreign():
        return None
    return _search_guarded(partial(_find_package, name)) if _is_wanted(name) else None


def _find_package(name: str) -> ModuleSpec | None:
    from coframe.interfaces.sources import find_folder  # noqa: PLC0415 - this module is imported with every ROS package

    if find_folder(name) is not None:
        return _spec(name, _PackageLoader())
    if re.fullmatch(_INTERFACE_PACKAGE_NAME, name) or name in _INTERFACES:
        raise ModuleNotFoundError(_advice(name), name=name)
    return None


def _find_kind(package: str, kind: str, searched: list[str]) -> ModuleSpec | None:
    from coframe.interfaces.definition_files import definitions_in  # noqa: PLC0415 - as in _find_package
    from coframe.interfaces.ownership import is_own  # noqa: PLC0415
    from coframe.interfaces.sources import find_folder  # noqa: PLC0415

    # If the folder of the package has no code, the folders above are where Python found it.
    found = [find_folder(package), *(Path(folder) for folder in searched if is_own(Path(folder)))]
    for folder in filter(None, found):
        if any(file.startswith(f"{kind}/") for file in definitions_in(folder)):
            return _spec(f"{package}.{kind}", _KindLoader(folder))
    return None


def _advice(name: str) -> str:
    from coframe.interfaces.sources import ENVIRONMENT, sources  # noqa: PLC0415 - as in _find_package
    from coframe.interfaces.workspace import is_search_disabled  # noqa: PLC0415

    missing = f"No module named {name!r}. coframe does not contain this package, and "
    if is_search_disabled():
        return f"{missing}searches no other one, because Python was started with -I, -P or PYTHONSAFEPATH."
    searched = ", ".join(dict.fromkeys(str(source.folder) for source in sources())) or "any folder"
    source = f" Its source is {_SOURCES[name]} on GitHub." if name in _SOURCES else ""
    return (
        f"{missing}found no definitions of it in {searched}.{source} If you have its .msg, .srv or .action files, run "
        f"`coframe interface add FOLDER`, or set {ENVIRONMENT} to the folder of the package or of its workspace."
    )


def _is_wanted(package: str) -> bool:
    """Return whether a module with messages, services or actions of the package is being imported."""
    importing = vars(sys.modules["_frozen_importlib"]).get("_module_locks", {})
    return any(f"{package}.{kind}" in importing for kind in _KINDS)


def _search_guarded(find: Callable[[], ModuleSpec | None]) -> ModuleSpec | None:
    """Search, and report any error other than ImportError, because programs expect only ImportError from an import."""
    try:
        return find()
    except ImportError:
        raise
    except Exception as error:  # noqa: BLE001
        from coframe.interfaces.problems import report  # noqa: PLC0415 - as in _find_package

        report(f"the search for interface packages failed: {type(error).__name__}: {error}")
        return None


def _is_foreign() -> bool:
    """Return whether a ROS installation provides rclpy. It cannot use coframe's classes."""
    return bool(foreign_packages(tuple(sys.path)))


def _spec(name: str, loader: Any) -> ModuleSpec:
    return ModuleSpec(name, loader, origin="coframe", is_package=not isinstance(loader, _DefinitionLoader))


def _finder(find_spec: Any) -> Any:
    return type(_FINDER, (), {"find_spec": staticmethod(find_spec)})()


class _Loader:
    """Base class of loaders; Python creates the module."""

    def create_module(self, spec: ModuleSpec) -> ModuleType | None:
        """Return None, so that Python creates the module."""


class _PackageLoader(_Loader):
    """Loader of ``my_msgs``, a package without a search path, so Python code next to definitions is not imported."""

    def exec_module(self, module: ModuleType) -> None:
        """Set the docstring of the package."""
        module.__doc__ = f"ROS package {module.__name__}."


class _KindLoader(_Loader):
    """Loader of ``my_msgs.msg``."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def exec_module(self, module: ModuleType) -> None:
        """Set the module's names; classes are created when they are first used."""
        from coframe.messages import packages  # noqa: PLC0415 - it imports NumPy

        package, _, kind = module.__name__.partition(".")
        found = packages.load_package(package, self._folder)
        names, get, names_of = packages.exports(found, kind)
        module.__dict__.update(__all__=names, __getattr__=get, __dir__=names_of)


class _DefinitionLoader(_Loader):
    """Loader of ``my_msgs.msg._num``, from which editors import names of a real ROS."""

    def exec_module(self, module: ModuleType) -> None:
        """Import the message, service or action that the module is named after, and the messages that belong to it."""
        parent, _, own = module.__name__.rpartition(".")
        for name in dir(sys.modules[parent]):
            if f"_{_snake_case(name.partition('_')[0])}" == own:
                value = getattr(sys.modules[parent], name)
                module.__dict__[name] = value
                module.__dict__.update(
                    {part.__name__: part for part in vars(value).values() if hasattr(part, "ROS_TYPE")}
                )
        if not any(hasattr(value, "ROS_TYPE") for value in module.__dict__.values()):
            raise ModuleNotFoundError(f"No module named {module.__name__!r}", name=module.__name__)


def _snake_case(name: str) -> str:
    """Return the name that rosidl gives to the module of a definition: ``pose2_d`` for Pose2D."""
    name = re.sub(r"(.)([A-Z][a-z]+)", r"\1_\2", name)
    return re.sub(r"([a-z0-9])([A-Z])", r"\1_\2", name).lower()
