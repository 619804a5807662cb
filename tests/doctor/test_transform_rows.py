# SPDX-License-Identifier: Apache-2.0
"""TransformRows: the newest rows of a long observation in arrays that do not grow."""

from __future__ import annotations

import tracemalloc

import numpy as np

from coframe.doctor._transform_rows import TransformRows
from coframe.doctor._transforms import Transforms

ROWS = 50  # per batch


def batch(number: int, publisher: str = "/robot", rows: int = ROWS) -> Transforms:
    """Return rows that arrive at `number`; the first ROWS of all batches have values of their own."""
    index = np.arange(rows, dtype=np.int64)
    return Transforms(
        arrived=np.full(rows, number),
        stamp=number * ROWS + index,
        parent=index,
        child=index + 1,
        publisher=np.zeros(rows, dtype=np.int64),
        static=np.zeros(rows, dtype=bool),
        values=np.repeat((number * ROWS + index)[:, np.newaxis], 7, axis=1).astype(float),
        publishers=(publisher,),
    )


def test_the_newest_rows_stay_in_order_and_complete() -> None:
    rows = TransformRows()
    for number in range(1000):
        rows.append(batch(number))
        rows.forget(cutoff=number - 9, limit=10_000)
        table = rows.table()
        first = max(number - 9, 0) * ROWS
        assert table.stamp.tolist() == list(range(first, (number + 1) * ROWS))
        assert (table.values == table.stamp[:, np.newaxis]).all()


def test_rows_beyond_the_maximum_are_the_oldest() -> None:
    rows = TransformRows()
    for number in range(10):
        rows.append(batch(number))
    rows.forget(cutoff=2, limit=500)
    assert rows.forgotten_until == 0, "what is too old is not missing"
    rows.forget(cutoff=2, limit=120)
    assert rows.table().stamp.tolist() == list(range(380, 500))
    assert rows.forgotten_until == 7


def test_all_rows_can_be_forgotten() -> None:
    rows = TransformRows()
    rows.append(batch(1))
    rows.forget(cutoff=2, limit=100)
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
                rows.forget(cutoff=number - 99, limit=10_000)
            if number > 1000 and number % 7 == 0:
                rows.append(batch(number, rows=20))  # The rate rises by 6 %, for which there is room.
            if number % 1000 == 999:
                peaks.append(tracemalloc.get_traced_memory()[0])
    finally:
        tracemalloc.stop()
    assert peaks[2] < 1.01 * peaks[0]


def test_rows_are_moved_without_a_copy_of_all() -> None:
    rows = TransformRows()
    tracemalloc.start()
    try:
        for number in range(1000):
            rows.append(batch(number))
            rows.forget(cutoff=number - 99, limit=10_000)
            if number == 500:
                before = tracemalloc.get_traced_memory()[0]
                tracemalloc.reset_peak()
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert peak - before < 0.1 * rows.table().values.nbytes


def test_rows_that_arrive_after_a_pause_take_the_place_of_old_ones() -> None:
    rows = TransformRows()
    tracemalloc.start()
    try:
        for number in range(1000):
            rows.forget(cutoff=number - 99, limit=10_000)
            rows.append(batch(number))
        before = tracemalloc.get_traced_memory()[0]
        rows.forget(cutoff=1060 - 99, limit=10_000)
        rows.append(batch(1060, rows=60 * ROWS))
        assert tracemalloc.get_traced_memory()[0] < 1.01 * before
    finally:
        tracemalloc.stop()


def test_publishers_that_have_left_are_forgotten() -> None:
    rows = TransformRows()
    for number in range(2500):
        rows.append(batch(number, f"/robot{number}"))
        rows.forget(cutoff=number - 9, limit=10_000)
    assert rows.publishers() == {f"/robot{number}" for number in range(2490, 2500)}
    table = rows.table()
    assert len(table.publishers) <= 1001
    names = [table.publishers[number] for number in table.publisher.tolist()]
    assert names == [f"/robot{stamp // ROWS}" for stamp in table.stamp.tolist()]
