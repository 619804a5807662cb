"""Why there is a transform between two frames, or why not: which link is missing, late or early, and by how much.

`facts` is the answer as a value, `explaining` makes it of a buffer, `advice` says what to do, `drawing` draws it.

Example:
    >>> import coframe
    >>> buffer = coframe.Buffer()
    >>> for second in (1, 2):
    ...     _ = buffer.set("odom", "base", coframe.Transform(), second * 1_000_000_000)
    >>> why = buffer.why("odom", "base", 2_500_000_000)
    >>> why.possible, why.broken[0].name, why.broken[0].state, why.broken[0].by
    (False, 'odom -> base', 'too_new', 500000000)
"""

from coframe.explanation.explaining import explain
from coframe.explanation.facts import Explanation, Link

__all__ = ["Explanation", "Link", "explain"]
