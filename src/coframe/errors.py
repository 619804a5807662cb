"""Everything coframe raises.

    Exception
    ├── TransformException              a transform could not be given or taken
    │   ├── LookupException             a frame that nobody has mentioned; a loop in the tree
    │   ├── ConnectivityException       the frames are in different trees
    │   ├── ExtrapolationException      no sample at the requested time
    │   ├── InvalidArgumentException    a name or value that tf2 refuses
    │   │   └── FrameMismatchException  composing a<-b with c<-d where b is not c
    │   └── TimeoutException            waited in vain
    ├── WireError(RuntimeError)         the ROS graph could not be joined
    ├── ViewerError(RuntimeError)       the viewer could not be started, or a file that it was given is none of its kind
    ├── DecodeError(ValueError)         bytes that are not what they claim to be
    ├── RobotDescriptionError(ValueError)  a robot description that contradicts itself
    ├── PackageError(LookupError)       a package, or a file of one, that is not there
    ├── FrozenFileError(ValueError)     a file that is no frozen buffer, or a damaged one
    └── RecordingError(ValueError)      a recording of which nothing can be read

The names of the transform exceptions are tf2's, and so are their texts (``str(error)``). Each also carries the facts
behind its text, where they apply, and ``hint``: what to do next.
"""

from __future__ import annotations

import difflib
from typing import TYPE_CHECKING, Any, NamedTuple

from coframe import _core
from coframe.analysis.missing_edges import missing_edge
from coframe.analysis.tree import FrameTrees
from coframe.lookup_hints import hint

if TYPE_CHECKING:
    from typing_extensions import Self

    from coframe._core import Failure

__all__ = [
    "ConnectivityException",
    "DecodeError",
    "ExtrapolationException",
    "FrameMismatchException",
    "FrozenFileError",
    "InvalidArgumentException",
    "LookupException",
    "PackageError",
    "RecordingError",
    "RobotDescriptionError",
    "TimeoutException",
    "TransformException",
    "ViewerError",
    "WireError",
]


class _Facts(NamedTuple):
    target: str | None = None
    source: str | None = None
    requested: int | None = None
    earliest: int | None = None
    latest: int | None = None
    edge: tuple[str, str] | None = None
    hint: str = ""
    code: str = ""


_NO_FACTS = _Facts()


class TransformException(Exception):  # noqa: N818 - tf2's name
    """A transform could not be given or taken.

    ``str(error)`` is the text; the properties are the facts behind it, None where they do not apply.
    """

    # An exception of the core holds its Failure in `args` and has no __init__ to run: most failed look-ups are caught
    # and forgotten, and neither their text nor their facts are ever asked for.
    _told: _Facts = _NO_FACTS

    @classmethod
    def with_details(
        cls,
        reason: str,
        *,
        target: str | None = None,
        source: str | None = None,
        requested: int | None = None,
        earliest: int | None = None,
        latest: int | None = None,
        edge: tuple[str, str] | None = None,
        hint: str = "",
        code: str = "",
    ) -> Self:
        """An exception with the text ``reason`` and with these facts."""
        error = cls(reason)
        error._told = _Facts(target, source, requested, earliest, latest, edge, hint, code)
        return error

    @property
    def args(self) -> tuple[Any, ...]:
        """What the exception was made of: its text, as a tuple."""
        return self._own_args if self._failure is None else (str(self),)

    @args.setter
    def args(self, args: tuple[Any, ...]) -> None:
        Exception.args.__set__(self, args)  # type: ignore[attr-defined]

    @property
    def _own_args(self) -> tuple[Any, ...]:
        own: tuple[Any, ...] = Exception.args.__get__(self)  # type: ignore[attr-defined]
        return own

    @property
    def _failure(self) -> Failure | None:
        own = self._own_args
        return own[0] if own and isinstance(own[0], _core.Failure) else None

    @property
    def _facts(self) -> Failure | _Facts:
        return self._failure or self._told

    @property
    def code(self) -> str:
        """What went wrong in a word, ``too_new`` or ``not_connected``; "" where it was no look-up that failed."""
        return self._facts.code

    @property
    def target(self) -> str | None:
        """The frame the answer was wanted in, or None."""
        return self._facts.target

    @property
    def source(self) -> str | None:
        """The frame that was asked about, or None."""
        return self._facts.source

    @property
    def requested(self) -> int | None:
        """The time asked for, in nanoseconds; None where time plays no part."""
        return self._facts.requested

    @property
    def earliest(self) -> int | None:
        """The oldest stamp of the link without a sample at ``requested``, in nanoseconds, or None."""
        return self._facts.earliest

    @property
    def latest(self) -> int | None:
        """The newest stamp of that link, in nanoseconds, or None."""
        return self._facts.latest

    @property
    def edge(self) -> tuple[str, str] | None:
        """That link as (parent, child), or None."""
        return self._facts.edge

    @property
    def hint(self) -> str:
        """What to do next, in a sentence; may be empty."""
        failure = self._failure
        return self._told.hint if failure is None else _hint(failure)

    def __repr__(self) -> str:
        return f"{type(self).__name__}({str(self)!r})"

    def __reduce__(self) -> tuple[object, ...]:
        facts = {name: getattr(self, name) for name in _Facts._fields}
        kind = type(self)
        # By name: tf2_py calls the module of tf2's exceptions `tf2`, as tf2 does, where pickle would not find them.
        is_ours = globals().get(kind.__name__) is kind
        return _restore, (kind.__name__ if is_ours else kind, str(self), facts)


class LookupException(TransformException):
    """A frame that nobody has mentioned, or a loop in the tree."""


class ConnectivityException(TransformException):
    """The frames are in different trees."""


class ExtrapolationException(TransformException):
    """No sample at the requested time, and tf2 never extrapolates."""


class InvalidArgumentException(TransformException):
    """A frame name or a transform that tf2 refuses."""


class FrameMismatchException(InvalidArgumentException):
    """Two transforms were composed whose inner frames differ."""


class TimeoutException(TransformException):
    """Something was waited for in vain."""


class _Hinting(Exception):  # noqa: N818 - what the errors below have in common
    """An error that says what to do next.

    Attributes:
        hint: What to do next, in a sentence; may be empty.
    """

    def __init__(self, text: str, *, hint: str = "") -> None:
        super().__init__(text)
        self.hint = hint


class WireError(_Hinting, RuntimeError):
    """The ROS graph could not be joined or used."""


class ViewerError(_Hinting, RuntimeError):
    """The viewer could not be started, or a file that it was given is none of its kind."""


class DecodeError(_Hinting, ValueError):
    """Bytes that are not what they claim to be; the text says which type, where, and what was expected."""


class RobotDescriptionError(_Hinting, ValueError):
    """A robot description that contradicts itself, or is none.

    Attributes:
        line: Where in the text, counted from 1; None where no line is to blame.
        file: The file's name; None for a text.
        hint: What to do next, in a sentence; may be empty.
    """

    def __init__(self, text: str, *, line: int | None = None, file: str | None = None, hint: str = "") -> None:
        super().__init__(text, hint=hint)
        self.line = line
        self.file = file

    def __str__(self) -> str:
        places = [self.file or "", f"line {self.line}" if self.line is not None else ""]
        return ": ".join(filter(None, [", ".join(filter(None, places)), str(self.args[0])]))


class PackageError(_Hinting, LookupError):
    """A package or a file of it that is not there, or a file that is not inside its package."""


class FrozenFileError(_Hinting, ValueError):
    """A file that is no frozen buffer, or one that is damaged or cannot be written."""


class RecordingError(_Hinting, ValueError):
    """A recording of which nothing can be read."""


def _restore(kind: str | type[TransformException], text: str, facts: dict[str, object]) -> TransformException:
    chosen: type[TransformException] = globals()[kind] if isinstance(kind, str) else kind
    return chosen.with_details(text, **facts)  # type: ignore[arg-type]


_MOST_GUESSES = 3


def _hint(failure: Failure) -> str:
    if failure.code == "too_old" and looks_like_seconds(failure):
        return hint("in_seconds", requested=str(failure.requested))
    parent, child = failure.edge or ("", "")
    return hint(
        failure.code,
        target=failure.target,
        source=failure.source,
        parent=parent,
        child=child,
        timeout="0.1",
        bare=failure.name.lstrip("/"),
        guess=_guess(failure) if failure.code == "unknown_frame" else "",
        trees=_trees(failure) if failure.code == "not_connected" else "",
    )


def looks_like_seconds(failure: Failure | TransformException) -> bool:
    """Whether the time asked for, taken as seconds, is one that the link has."""
    if failure.requested is None or failure.earliest is None or failure.latest is None:
        return False
    return failure.earliest <= failure.requested * 1_000_000_000 <= failure.latest


def _guess(failure: Failure) -> str:
    known = sorted(failure.parents)
    if not known:
        return "No transforms have arrived yet: is a broadcaster running, in the same ROS domain?"
    close = _alike(failure.name, known)
    if not close:
        return f"The frames are: {', '.join(known)}."
    asked = (failure.target, failure.source)
    target, source = (name if name in failure.parents else (_alike(name, known) or [name])[0] for name in asked)
    line = f" In a node: lookup_transform({target!r}, {source!r}, ...)." if failure.name in asked else ""
    return f"Did you mean {' or '.join(map(repr, close))}? The frames are: {', '.join(known)}.{line}"


def _alike(name: str, known: list[str]) -> list[str]:
    """The frames that may be meant: with a prefix or without, or spelt nearly like it."""
    bare = name.rpartition("/")[2]
    same = [frame for frame in known if frame.rpartition("/")[2] == bare]
    return same[:_MOST_GUESSES] or difflib.get_close_matches(name, known, n=1)


def _trees(failure: Failure) -> str:
    roots = failure.roots or ("", "")
    structure = FrameTrees.from_parents(failure.parents)
    trees = [structure.tree(root) for root in roots]
    told = " and ".join(f"{root!r} with {', '.join(below)}" if below else f"{root!r} alone" for root, *below in trees)
    target_root, source_root = roots
    link = missing_edge(*sorted(trees, key=len, reverse=True))
    return (
        f"The trees are {told}. The missing link is a transform with the child {source_root!r} (or {target_root!r})."
        + (f" {link.fix}" if link else "")
    )
