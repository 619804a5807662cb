# SPDX-License-Identifier: Apache-2.0
"""Recordings and buffers in worker processes, as those of a PyTorch DataLoader: spawned, forked, and long-lived."""

import multiprocessing
import pickle
import sys

import numpy as np
import pytest
from file_server import FileServer
from recordings import COUNT, SECOND, START, expected, write_mcap, write_rosbag1, write_sqlite

import coframe

METHODS = ["spawn", *(["fork"] if sys.platform == "linux" else [])]
pytestmark = pytest.mark.filterwarnings("ignore:.*multi-threaded.*:DeprecationWarning")


class Poses:
    """A dataset as PyTorch wants it: a length, and items by number. It holds an open recording."""

    def __init__(self, bag):
        self.bag = bag
        self.stamps = bag.stamps("/tf")

    def __len__(self):
        return len(self.stamps)

    def __getitem__(self, number):
        stamp = int(self.stamps[number])
        message = self.bag.message_at("/tf", stamp)
        return stamp, self.bag.buffer.lookup("odom", "lidar", stamp).translation, message.data


def load(dataset, numbers, results):
    """Send items of a dataset, as a worker of a DataLoader does."""
    try:
        results.put([(number, *dataset[number]) for number in numbers])
    except (coframe.CoframeError, OSError, ValueError) as error:
        results.put(f"{type(error).__name__}: {error}")


def loaded(method, dataset, workers=3):
    """Return the items of a dataset that several workers have loaded."""
    context = multiprocessing.get_context(method)
    results = context.Queue()
    parts = [range(worker, len(dataset), workers) for worker in range(workers)]
    processes = [context.Process(target=load, args=(dataset, part, results)) for part in parts]
    for process in processes:
        process.start()
    found = [results.get(timeout=90) for _ in processes]
    for process in processes:
        process.join()
    assert not [part for part in found if isinstance(part, str)]
    return sorted((item for part in found for item in part), key=lambda item: item[0])


def assert_items(items):
    assert [item[0] for item in items] == list(range(COUNT))
    reference = expected()
    for _, stamp, translation, data in items:
        np.testing.assert_allclose(translation, reference.lookup("odom", "lidar", stamp).translation, atol=1e-12)
        assert int.from_bytes(data[8:12], "little") * SECOND + int.from_bytes(data[12:16], "little") == stamp


@pytest.mark.parametrize(
    ("method", "name"),
    [
        *((method, "run.mcap") for method in METHODS),
        *((METHODS[-1], name) for name in ("run.bag", "run.db3")),
        *(pytest.param("spawn", name, marks=pytest.mark.slow) for name in ("run.bag", "run.db3")),
    ],
)
def test_workers_read_a_recording(tmp_path, method, name):
    writers = {".mcap": write_mcap, ".bag": write_rosbag1, ".db3": lambda path: write_sqlite(path, 4)}
    path = writers[name[name.index(".") :]](tmp_path / name)
    with coframe.open_bag(path) as bag:
        items = loaded(method, Poses(bag))
        assert len(items) == COUNT
        if name != "run.bag":
            assert_items(items)
        assert len(list(bag.messages("/tf"))) == COUNT


@pytest.mark.parametrize("method", METHODS)
def test_workers_read_a_recording_on_a_server(tmp_path, method):
    data = write_mcap(tmp_path / "run.mcap").read_bytes()
    with FileServer({"/run.mcap": data}) as server, coframe.open_bag(server.url()) as bag:
        assert_items(loaded(method, Poses(bag)))
        assert_items([(number, *Poses(bag)[number]) for number in range(COUNT)])


def look_up(buffer, stamps):
    return buffer.lookup_many("odom", "lidar", stamps)


@pytest.mark.parametrize("method", METHODS)
def test_workers_use_a_buffer(method):
    buffer = expected()
    stamps = START + np.arange(0, 2 * SECOND, SECOND // 10)
    with multiprocessing.get_context(method).Pool(2) as pool:
        for poses in pool.starmap(look_up, [(buffer, stamps), (buffer.snapshot(), stamps)]):
            assert poses == look_up(buffer, stamps)


def test_a_pickled_buffer_is_equal_and_frozen():
    buffer = expected()
    buffer.set("odom", "car", coframe.Transform([1, 2, 3]), START, covariance=np.eye(6))
    for original in (buffer, buffer.snapshot(), buffer.snapshot(interpolation="screw"), coframe.Buffer("2s")):
        copy = pickle.loads(pickle.dumps(original))
        assert copy.edges(now=0) == original.edges(now=0)
        assert (copy.interpolation, copy.cache_ns) == (original.interpolation, original.cache_ns)
        with pytest.raises(coframe.InvalidArgumentException, match="frozen"):
            copy.set("a", "b", coframe.Transform(), 1)
    copy = pickle.loads(pickle.dumps(pickle.loads(pickle.dumps(buffer))))
    assert copy.lookup("odom", "car", START, covariance=True).covariance.tolist() == np.eye(6).tolist()


def test_a_damaged_pickle_of_a_buffer_is_refused():
    data = pickle.dumps(expected())
    place = data.index(b"\x89CFZ") + 20
    with pytest.raises(coframe.CoframeError, match="a pickled buffer is damaged"):
        pickle.loads(data[:place] + bytes([data[place] ^ 1]) + data[place + 1 :])


def test_the_file_of_a_frozen_buffer_is_gone(tmp_path):
    expected().save(tmp_path / "run.cfz")
    data = pickle.dumps(coframe.load(tmp_path / "run.cfz"))
    (tmp_path / "run.cfz").unlink()
    with pytest.raises(coframe.FrozenFileError, match=r"run\.cfz cannot be opened: No such file"):
        pickle.loads(data)
