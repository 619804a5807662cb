# SPDX-License-Identifier: Apache-2.0
"""Type hints for fields whose type on reading differs from the types that they accept."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Generic, TypeVar

if TYPE_CHECKING:
    from array import array
    from collections.abc import Sequence
    from collections.abc import Set as AbstractSet

    import numpy as np
    import numpy.typing as npt

N = TypeVar("N", int, float)
D = TypeVar("D", bound="np.generic")


class NumberSequence(Generic[N]):
    """A sequence of numbers: returns array.array, accepts any sequence or set of numbers."""

    def __get__(self, message: object, owner: type) -> array[N]:
        """Return the stored value."""
        raise AttributeError

    def __set__(self, message: object, value: Sequence[N] | AbstractSet[N]) -> None:
        """Check and store a value."""


class NumberArray(Generic[D]):
    """An array of numbers: returns a NumPy array, accepts one of the same type or a sequence of numbers."""

    def __get__(self, message: object, owner: type) -> npt.NDArray[D]:
        """Return the stored value."""
        raise AttributeError

    def __set__(self, message: object, value: npt.NDArray[Any] | Sequence[float]) -> None:
        """Check and store a value."""
