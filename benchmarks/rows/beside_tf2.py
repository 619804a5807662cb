"""Rows beside another tf2, which runs what `peers.tf2` has in a Python of its own."""

import contextlib
from collections.abc import Callable, Generator

from benchmarks.measuring import Bar, Contender, Row
from benchmarks.peers import Tf2
from benchmarks.process import RemoteStatement, Worker

TF2 = "benchmarks.peers.tf2"


def beside_tf2(
    name: str,
    mine: Callable[[], Contender],
    peer: Tf2,
    function: str,
    *arguments: object,
    bar: Bar | None = None,
    needs: tuple[str, ...] = (),
) -> Row:
    """Ours, and a function of `peers.tf2` with its arguments; `needs` are packages beyond tf2_py."""

    def contenders() -> Generator[Contender]:
        yield mine()
        with contextlib.closing(Worker(peer.python(*needs), TF2)) as worker:
            yield RemoteStatement(worker, function, *arguments)

    return Row(name, peer.name, contenders, bar)


def drop_in(
    name: str, peer: Tf2, function: str, *arguments: object, bar: Bar | None = None, needs: tuple[str, ...] = ()
) -> Row:
    """The same program on our packages and on theirs."""

    def mine() -> Contender:
        from benchmarks.peers import tf2

        made: Contender = getattr(tf2, function)(*arguments)
        return made

    return beside_tf2(name, mine, peer, function, *arguments, bar=bar, needs=needs)
