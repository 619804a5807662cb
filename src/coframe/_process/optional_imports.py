# SPDX-License-Identifier: Apache-2.0
"""Import optional packages, and name the extra of coframe that installs each of them."""

from __future__ import annotations

import importlib
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, Final

if TYPE_CHECKING:
    from collections.abc import Container, Iterator

__all__ = ["CLI_PACKAGES", "EXTRAS", "extra_of", "import_optional", "importing_matplotlib", "pip_install"]

# The modules that the extras install; yaml is in three of them.
EXTRAS: Final[dict[str, tuple[str, ...]]] = {
    "bags": ("zstandard", "lz4", "yaml"),
    "cli": ("click", "rich", "markdown_it"),
    "dds": ("cyclonedds",),
    "opencv": ("cv2",),
    "calibration": ("scipy",),
    "params": ("yaml",),
    "parquet": ("pyarrow",),
    "pdf": ("pydyf",),
    "plot": ("matplotlib",),
    "protobuf": ("google",),
    "remote": ("s3fs", "gcsfs", "adlfs", "fsspec"),
    "robots": ("xacro",),
    "viewer": ("websockets", "yaml"),
    "zenoh": ("zenoh", "xxhash"),
}
CLI_PACKAGES: Final = EXTRAS["cli"][:2]


def pip_install(extra: str) -> str:
    """Return the command that installs an extra of coframe.

    Args:
        extra: The name of the extra, such as ``bags``.
    """
    if extra not in EXTRAS:
        raise ValueError(f"coframe has no extra {extra!r}. Extras: {', '.join(EXTRAS)}.")
    return f"pip install 'coframe[{extra}]'"


def extra_of(module: str, preferred: Container[str] = ()) -> str | None:
    """Return the extra that installs a module, or None if none does.

    Args:
        module: The name of the module.
        preferred: The extras to choose from if several install it.
    """
    extras = [extra for extra, modules in EXTRAS.items() if module in modules]
    return next((extra for extra in extras if extra in preferred), extras[0] if extras else None)


def import_optional(module: str, purpose: str, extra: str) -> Any:
    """Import an optional module.

    Args:
        module: Name of the module.
        purpose: The feature that needs the module; the subject of the error message.
        extra: The extra that installs it.

    Raises:
        ModuleNotFoundError: The module is not installed. The message says how to install it.
    """
    try:
        return importlib.import_module(module)
    except ModuleNotFoundError as error:
        if error.name != module.partition(".")[0]:
            raise  # The module is installed, but one of its dependencies is not.
        raise ModuleNotFoundError(
            f"{purpose} needs the module {module}, which is not installed: {pip_install(extra)}", name=error.name
        ) from None


@contextmanager
def importing_matplotlib() -> Iterator[None]:
    """Return a context manager that imports matplotlib without its warnings.

    With a read-only home folder, matplotlib caches its fonts in a temporary folder automatically, but prints two
    warnings.
    """
    import logging  # noqa: PLC0415 - takes 5 ms, and `coframe --help` imports this module

    log = logging.getLogger("matplotlib")
    level = log.level
    log.setLevel(logging.ERROR)
    try:
        yield
    finally:
        log.setLevel(level)
