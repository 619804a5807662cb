# SPDX-License-Identifier: Apache-2.0
"""Import of users' interface packages: ``from my_msgs.msg import Num`` without a build step.

Python asks the finders on `sys.meta_path` for each module. Two of them are for interface packages. The first handles
``my_msgs.msg`` before Python takes the folder of the definitions for a package without code. The last is only asked for
packages that are found nowhere else, so other imports cost nothing and a real ROS takes precedence.

The file ``coframe_ros.pth`` adds both when Python starts, as two functions of one line each that import this module
when they are needed. `install` adds them where there is no such file.
"""

from __future__ import annotations

import re
import sys
from importlib.machinery import ModuleSpec, PathFinder
from pathlib import Path
from typing import TYPE_CHECKING, Any

from coframe.ros_folders import foreign_packages

if TYPE_CHECKING:
    from collections.abc import Sequence
    from types import ModuleType

__all__ = ["find_module", "find_package", "install"]

_FINDER = "CoframeInterfaces"  # The class name of the finders, here and in coframe_ros.pth.
_KINDS = ("msg", "srv", "action")
_PACKAGE = re.compile(r"[a-z](?:_?[a-z0-9])*")
_LOOKS_LIKE_INTERFACES = re.compile(r".*_(?:msgs?|srvs?|actions?|interfaces?)")


def install() -> None:
    """Add the finders to `sys.meta_path` if they are not there."""
    if any(type(finder).__name__ == _FINDER for finder in sys.meta_path):
        return
    sys.meta_path.insert(0, _finder(find_module))
    sys.meta_path.append(_finder(find_package))


def find_module(name: str, path: Sequence[str] | None = None, _target: object = None) -> ModuleSpec | None:
    """Find ``my_msgs.msg``, ``my_msgs.srv`` or ``my_msgs.action``.

    Args:
        name: The full name of any module that is being imported.
        path: The folders of its parent package.
    """
    package, _, kind = name.partition(".")
    if kind not in _KINDS:
        return None
    spec = PathFinder.find_spec(name, path)
    if spec is not None and spec.has_location:
        return spec  # A module with code: of a real ROS, of coframe, or of the user.
    if _is_foreign():
        return None
    above = [Path(entry) for entry in path or ()]  # Where Python has found the package, if its folder has no code.
    for folder in filter(None, [_folder_of(package), *above]):
        if any(file.startswith(f"{kind}/") for file in _definitions(folder)):
            return _spec(name, _KindLoader(folder))
    return None


def find_package(name: str, path: Sequence[str] | None = None, _target: object = None) -> ModuleSpec | None:
    """Find an interface package that no other finder has found, or ``my_msgs.msg._num`` as rosidl names its modules.

    Args:
        name: The full name of the module.
        path: None for a package.
    """
    if path is not None:
        _, _, rest = name.partition(".")
        return _spec(name, _DefinitionLoader()) if re.fullmatch(r"(msg|srv|action)\._[a-z0-9_]+", rest) else None
    if not _PACKAGE.fullmatch(name) or name in sys.stdlib_module_names or _is_foreign():
        return None
    folder = _folder_of(name)
    if folder is not None:
        return _spec(name, _PackageLoader(folder))
    if _LOOKS_LIKE_INTERFACES.fullmatch(name) and _is_import():
        from coframe.interfaces.sources import ENVIRONMENT, sources  # noqa: PLC0415 - as in _folder_of

        searched = dict.fromkeys(str(source.folder) for source in sources())
        raise ModuleNotFoundError(
            f"No module named {name!r}. coframe does not contain this package, and found no definitions of it in "
            f"{', '.join(searched)}. If you have its .msg, .srv or .action files, run `coframe interfaces add FOLDER`, "
            f"or set {ENVIRONMENT} to the folder of the package or of its workspace.",
            name=name,
        )
    return None


def _folder_of(package: str) -> Path | None:
    from coframe.interfaces.sources import find_folder  # noqa: PLC0415 - this module is imported with every ROS package

    return find_folder(package)


def _is_foreign() -> bool:
    """Return whether a ROS installation provides rclpy, which has no use for coframe's classes."""
    return bool(foreign_packages(tuple(sys.path)))


def _definitions(folder: Path) -> dict[str, Path]:
    from coframe.interfaces.definition_files import definitions_in  # noqa: PLC0415

    return definitions_in(folder)


def _is_import() -> bool:
    """Return whether an import statement asks; ``importlib.util.find_spec`` returns None for a missing module."""
    frame = sys._getframe(1)  # noqa: SLF001 - the import system has no other way to tell
    while frame.f_back is not None:
        if frame.f_code.co_name == "_find_and_load_unlocked":
            return True
        if frame.f_code.co_filename.endswith("util.py>") or frame.f_globals.get("__name__") == "importlib.util":
            return False
        frame = frame.f_back
    return False


def _spec(name: str, loader: Any) -> ModuleSpec:
    return ModuleSpec(name, loader, origin="coframe", is_package=not isinstance(loader, _DefinitionLoader))


def _finder(find_spec: Any) -> Any:
    return type(_FINDER, (), {"find_spec": staticmethod(find_spec)})()


class _Loader:
    """Base class of loaders; Python creates the module."""

    def create_module(self, spec: ModuleSpec) -> ModuleType | None:
        """Let Python create the module."""


class _PackageLoader(_Loader):
    """Loader of ``my_msgs``."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def exec_module(self, module: ModuleType) -> None:
        """Let the modules of a package that has Python code as well be found in the folder with its name."""
        module.__doc__ = f"ROS package {module.__name__}."
        module.__path__ = [str(self._folder / module.__name__)]


class _KindLoader(_Loader):
    """Loader of ``my_msgs.msg``."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def exec_module(self, module: ModuleType) -> None:
        """Give the module its names; its classes are created when they are first used."""
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
