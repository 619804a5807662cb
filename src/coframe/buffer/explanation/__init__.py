# SPDX-License-Identifier: Apache-2.0
"""Explanations of why a transform between two frames exists or not: which edge is missing, late or early, by how much.

`facts` defines the explanation as a value, `explaining` builds it from a buffer, `advice` gives the recommended fix,
and `drawing` formats it as text.

Example:
    >>> import coframe
    >>> buffer = coframe.Buffer()
    >>> for second in (1, 2):
    ...     _ = buffer.set("odom", "base", coframe.Transform(), second * 1_000_000_000)
    >>> why = buffer.why("odom", "base", 2_500_000_000)
    >>> why.possible, why.broken[0].name, why.broken[0].state, why.broken[0].by
    (False, 'odom -> base', 'too_new', 500000000)
"""

from coframe.buffer.explanation._advice import no_common_time
from coframe.buffer.explanation._explaining import explain
from coframe.buffer.explanation._facts import ChainEdge, Explanation

__all__ = ["ChainEdge", "Explanation", "explain", "no_common_time"]
