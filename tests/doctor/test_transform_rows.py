# SPDX-License-Identifier: Apache-2.0
"""TransformRows: the newest rows of a long observation in arrays that do not grow."""

from __future__ import annotations

import tracemalloc
from dataclasses import replace

import numpy as np

from coframe.doctor.transform_rows import TransformRows
from coframe.doctor.transforms import COLUMNS, Transforms

ROWS = 50  # per batch


def batch(number: int, publisher: str = "/robot") -> Transforms:
    """Return rows that arrive at `number`, each with a value of its own."""
    index = np.arange(ROWS, dtype=np.int64)
    return Transforms(
        arrived=np.full(ROWS, number),
        stamp=number * ROWS + index,
        parent=index,
        child=index + 1,
        publisher=np.zeros(ROWS, dtype=np.int64),
        static=np.zeros(ROWS, dtype=bool),
        values=np.repeat((number * ROWS + index)[:, np.newaxis], 7, axis=1).astype(float),
        publishers=(publisher,),
    )


def dense(number: int, count: int) -> Transforms:
    """Return a batch with a number of rows that arrive at once."""
    rows = batch(number)
    index = np.arange(count) % ROWS
    columns = {name: getattr(rows, name)[index] for name in (*COLUMNS, "publisher")}
    return replace(rows, **columns)


def test_the_newest_rows_stay_in_order_and_complete() -> None:
    rows = TransformRows()
    for number in range(1000):
        rows.append(batch(number))
        rows.forget(before=number - 9, most=10_000)
        table = rows.table()
        first = max(number - 9, 0) * ROWS
        assert table.stamp.tolist() == list(range(first, (number + 1) * ROWS))
        assert (table.values == table.stamp[:, np.newaxis]).all()


def test_rows_beyond_the_maximum_are_the_oldest() -> None:
    rows = TransformRows()
    for number in range(10):
        rows.append(batch(number))
    rows.forget(before=0, most=120)
    assert rows.table().stamp.tolist() == list(range(380, 500))


def test_all_rows_can_be_forgotten() -> None:
    rows = TransformRows()
    rows.append(batch(1))
    rows.forget(before=2, most=100)
    assert len(rows) == 0
    assert rows.publishers() == set()
    rows.append(batch(3))
    assert rows.table().arrived.tolist() == [3] * ROWS


def test_memory_does_not_grow_with_time() -> None:
    rows = TransformRows()
    tracemalloc.start()
    try:
        peaks = []
        for number in range(3000):
            rows.append(batch(number))
            if number % 50:  # Otherwise, the next rows arrive before old ones are forgotten.
                rows.forget(before=number - 99, most=10_000)
            if number > 1000 and number % 7 == 0:
                rows.append(dense(number, 20))  # The rate rises by 6 %, for which there is room.
            if number % 1000 == 999:
                peaks.append(tracemalloc.get_traced_memory()[0])
    finally:
        tracemalloc.stop()
    assert peaks[2] < 1.01 * peaks[0]


def test_publishers_that_have_left_are_forgotten() -> None:
    rows = TransformRows()
    for number in range(2500):
        rows.append(batch(number, f"/robot{number}"))
        rows.forget(before=number - 9, most=10_000)
    assert rows.publishers() == {f"/robot{number}" for number in range(2490, 2500)}
    table = rows.table()
    assert len(table.publishers) <= 1001
    names = [table.publishers[number] for number in table.publisher.tolist()]
    assert names == [f"/robot{stamp // ROWS}" for stamp in table.stamp.tolist()]
