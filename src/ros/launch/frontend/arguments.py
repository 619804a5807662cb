# SPDX-License-Identifier: Apache-2.0
"""The arguments of substitutions such as ``$(env NAME DEFAULT)``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Sequence

__all__ = ["check_arguments"]


def check_arguments(name: str, data: Sequence[Any], least: int, most: int) -> None:
    """Check the number of arguments.

    Raises:
        TypeError: There are too few or too many.
    """
    if not least <= len(data) <= most:
        number = str(least) if least == most else f"{least} to {most}"
        raise TypeError(
            f"$({name} ...) takes {number} argument{'' if number == '1' else 's'}, not {len(data)}; "
            "put quotes around an argument that contains spaces"
        )
