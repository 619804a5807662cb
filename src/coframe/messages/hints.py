"""What type checkers and editors should know about fields that give another type than they take."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Generic, TypeVar

import numpy as np

if TYPE_CHECKING:
    from array import array
    from collections.abc import Sequence
    from collections.abc import Set as AbstractSet

    import numpy.typing as npt

N = TypeVar("N", int, float)
D = TypeVar("D", bound=np.generic)


class NumberSequence(Generic[N]):
    """A sequence of numbers: reads as array.array, takes any sequence or set of numbers."""

    def __get__(self, message: object, owner: type) -> array[N]:
        """What a message keeps."""
        raise AttributeError

    def __set__(self, message: object, value: Sequence[N] | AbstractSet[N]) -> None:
        """What a message takes."""


class NumberArray(Generic[D]):
    """A fixed number of numbers: reads as a numpy array, takes one of the same type or a sequence of numbers."""

    def __get__(self, message: object, owner: type) -> npt.NDArray[D]:
        """What a message keeps."""
        raise AttributeError

    def __set__(self, message: object, value: npt.NDArray[Any] | Sequence[float]) -> None:
        """What a message takes."""
