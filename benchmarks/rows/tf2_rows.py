# SPDX-License-Identifier: Apache-2.0
"""Rows that compare coframe with another tf2, which runs the functions of `peers.tf2` in its own Python."""

import contextlib
from collections.abc import Callable, Generator

from benchmarks.measuring import Contender, Row, Target
from benchmarks.peers import Tf2
from benchmarks.process import RemoteStatement, Worker

TF2 = "benchmarks.peers.tf2"


def versus_tf2(
    name: str,
    mine: Callable[[], Contender],
    peer: Tf2,
    function: str,
    *arguments: object,
    target: Target | None = None,
    needs: tuple[str, ...] = (),
) -> Row:
    """Return a row for coframe and a function of `peers.tf2`; `needs` are the packages it needs besides tf2_py."""

    def contenders() -> Generator[Contender]:
        yield mine()
        with contextlib.closing(Worker(peer.python(*needs), TF2)) as worker:
            yield RemoteStatement(worker, function, *arguments)

    return Row(name, peer.name, contenders, target)


def drop_in(
    name: str, peer: Tf2, function: str, *arguments: object, target: Target | None = None, needs: tuple[str, ...] = ()
) -> Row:
    """Return a row for the same program with coframe's packages and with the peer's."""

    def mine() -> Contender:
        from benchmarks.peers import tf2

        made: Contender = getattr(tf2, function)(*arguments)
        return made

    return versus_tf2(name, mine, peer, function, *arguments, target=target, needs=needs)
