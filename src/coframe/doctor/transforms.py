"""Transforms as they were sent, a row each: the table that everything else is taken from."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from numpy.typing import NDArray

__all__ = ["NORM_TOLERANCE", "Transforms", "bare", "numbered"]

# tf2 refuses a quaternion whose squared length differs from 1 by so much.
NORM_TOLERANCE = 0.01
_DENSE = 1_000_000  # keys up to here are counted rather than sorted
_COLUMNS = ("arrived", "stamp", "parent", "child", "static", "values")


@dataclass(frozen=True, eq=False)
class Transforms:
    """Transforms as they were sent, a row each, in the order in which they came.

    Attributes:
        arrived: (N,) when the message came, by the listener's clock.
        stamp: (N,) of the header.
        parent: (N,) number of the parent's name.
        child: (N,) number of the child's name.
        publisher: (N,) number of who sent it.
        static: (N,) bool, whether it came on a topic of static transforms.
        values: (N, 7) x, y, z in metres and qx, qy, qz, qw.
        names: Of frames, as they were sent or as a prefix makes them; one that was sent with a slash and without is
            there twice.
        sent: The same, as they were sent; empty where they are the same.
        publishers: Full names of nodes; "" where nobody says who it was.
    """

    arrived: NDArray[np.int64]
    stamp: NDArray[np.int64]
    parent: NDArray[np.int64]
    child: NDArray[np.int64]
    publisher: NDArray[np.int64]
    static: NDArray[np.bool_]
    values: NDArray[np.float64]
    names: tuple[str, ...] = ()
    publishers: tuple[str, ...] = ()
    sent: tuple[str, ...] = ()

    @staticmethod
    def joined(batches: Sequence[Transforms], names: tuple[str, ...], sent: tuple[str, ...] = ()) -> Transforms:
        """The rows of all batches, whose frames' numbers are those of these names, in the order in which they came."""
        columns: dict[str, Any] = {
            name: np.concatenate([getattr(batch, name) for batch in (_NONE, *batches)]) for name in _COLUMNS
        }
        publishers: dict[str, int] = {}
        columns["publisher"] = np.concatenate(
            [_NO_NUMBERS, *(numbered(publishers, batch.publishers)[batch.publisher] for batch in batches)]
        )
        arrived = columns["arrived"]
        if (arrived[1:] < arrived[:-1]).any():
            order = np.argsort(arrived, kind="stable")
            columns = {name: column[order] for name, column in columns.items()}
        return Transforms(**columns, names=names, publishers=tuple(publishers), sent=sent)

    def __len__(self) -> int:
        return len(self.stamp)

    @cached_property
    def finite(self) -> NDArray[np.bool_]:
        """(N,) whether all numbers are numbers."""
        return np.asarray(np.isfinite(self.values).all(axis=1))

    @cached_property
    def squared_norms(self) -> NDArray[np.float64]:
        """(N,) of the quaternions."""
        squares: NDArray[np.float64] = np.einsum("ij,ij->i", self.values[:, 3:], self.values[:, 3:])
        return squares

    @cached_property
    def taken(self) -> NDArray[np.bool_]:
        """(N,) whether tf2 takes the row."""
        with np.errstate(invalid="ignore", over="ignore"):
            unit = np.abs(self.squared_norms - 1.0) < NORM_TOLERANCE
        named = np.array([_is_link(self.pair(link)) for link in range(len(self.links))], dtype=bool)
        return np.asarray(self.finite & unit & (named[self.link] if len(self) else np.zeros(0, dtype=bool)))

    @cached_property
    def _numbered(self) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        keys = self.child * len(self.names) + self.parent
        if not len(keys) or keys.max() > _DENSE:
            links, link = np.unique(keys, return_inverse=True)
            return links, link
        links = np.flatnonzero(np.bincount(keys))  # a tenth of the time
        place = np.zeros(int(links[-1]) + 1, dtype=np.int64)
        place[links] = np.arange(len(links))
        return links, place[keys]

    @property
    def links(self) -> NDArray[np.int64]:
        """The pairs of names that occur; see :meth:`pair`."""
        return self._numbered[0]

    @property
    def link(self) -> NDArray[np.int64]:
        """(N,) which of the :attr:`links` each row tells of."""
        return self._numbered[1]

    def pair(self, link: int) -> tuple[str, str]:
        """The names of parent and child."""
        child, parent = divmod(int(self.links[link]), len(self.names))
        return self.names[parent], self.names[child]

    def senders(self, rows: NDArray[np.intp]) -> tuple[str, ...]:
        """Who sent some of the rows, as far as that is known."""
        numbers = np.unique(self.publisher[rows]).tolist()
        return tuple(self.publishers[number] for number in numbers if self.publishers[number])


def numbered(known: dict[str, int], names: Iterable[str]) -> NDArray[np.int64]:
    """The numbers of names; new ones get the next and are known from then on."""
    return np.array([known.setdefault(name, len(known)) for name in names], dtype=np.int64)


def bare(names: tuple[str, str]) -> tuple[str, str]:
    """Parent and child as tf2 reads them: without a slash in front."""
    parent, child = names
    return parent.lstrip("/"), child.lstrip("/")


def _is_link(names: tuple[str, str]) -> bool:
    parent, child = bare(names)
    return bool(parent and child) and parent != child


_NO_NUMBERS = np.zeros(0, dtype=np.int64)
_NONE = Transforms(
    arrived=_NO_NUMBERS,
    stamp=_NO_NUMBERS,
    parent=_NO_NUMBERS,
    child=_NO_NUMBERS,
    publisher=_NO_NUMBERS,
    static=np.zeros(0, dtype=bool),
    values=np.zeros((0, 7)),
)
