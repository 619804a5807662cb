# SPDX-License-Identifier: Apache-2.0
"""All exceptions that coframe raises by itself.

    Exception
    └── CoframeError                            base class: catch this to catch everything below
        ├── TransformException                  a transform could not be looked up or stored
        │   ├── LookupException                 a frame does not exist, or the tree contains a loop
        │   ├── ConnectivityException           the frames are in different trees
        │   ├── ExtrapolationException          no sample at the requested time
        │   ├── InvalidArgumentException        a name or value that tf2 rejects
        │   │   └── FrameMismatchException      composing a<-b with c<-d where b is not c
        │   └── TimeoutException                the transform did not become available in time
        ├── WireError(RuntimeError)             the ROS graph could not be joined or used
        ├── ViewerError(RuntimeError)           the viewer could not be started, or cannot show a file
        ├── DecodeError(ValueError)             bytes that do not match their type
        ├── RobotDescriptionError(ValueError)   a robot description that is invalid
        ├── InterfaceError(ValueError, LookupError)  a .msg, .srv, .action or .idl file that is invalid
        ├── PackageError(LookupError)           a package, or a file in one, that does not exist
        ├── FrozenFileError(ValueError)         a file that is not a frozen buffer, or is damaged
        ├── RecordingError(ValueError)          a recording without any readable data
        ├── EditError(ValueError)               a rule for editing a recording that cannot be applied
        ├── TrajectoryError(ValueError)         a trajectory that cannot be read or compared
        ├── PlotError(ValueError)               something that cannot be plotted
        ├── ContractError(ValueError)           a contract for recordings that is invalid
        ├── CameraError(ValueError)             a camera whose calibration is missing or not supported
        ├── CalibrationError(ValueError)        a calibration that cannot be read, written or estimated
        ├── CourseError(ValueError)             a folder of the lab that cannot be created or graded
        ├── PluginError(RuntimeError)           a plug-in of another package that cannot be loaded
        ├── UnsuitableFileError(OSError)        a pipe, a device, or a file that is too large (regular_files)
        └── RemoteFileError(OSError)            a file on a server that cannot be read (remote_error)

Wrong arguments of Python calls (a wrong type, shape or unit) raise TypeError and ValueError as usual.

The transform exceptions have tf2's names and messages (``str(error)``). Every exception also has a
``hint``, which suggests what to do next, and a ``doctor_code``, which names the doctor's page about the problem.
Tracebacks show the hint below the message in Python 3.11 and later, and in IPython. Transform exceptions also have the
details as attributes.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any, NamedTuple

from coframe import _core
from coframe._base_error import CoframeError, CoframeWarning
from coframe._output.escaping import display_name
from coframe._output.formatting import MAX_COMPARED_LENGTH, duration, join_names, seconds
from coframe._process.plugins import PluginError
from coframe.errors.lookup_hints import doctor_code, hint
from coframe.time import DAY, MICROSECOND, MILLISECOND, SECOND

if TYPE_CHECKING:
    from typing_extensions import Self

    from coframe._core import Failure

__all__ = [
    "CalibrationError",
    "CameraError",
    "CoframeError",
    "CoframeWarning",
    "ConnectivityException",
    "ContractError",
    "CourseError",
    "DecodeError",
    "EditError",
    "ExtrapolationException",
    "FrameMismatchException",
    "FrozenFileError",
    "InterfaceError",
    "InvalidArgumentException",
    "LookupException",
    "PackageError",
    "PlotError",
    "PluginError",
    "RecordingError",
    "RobotDescriptionError",
    "TimeoutException",
    "TrajectoryError",
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
    doctor_code: str = ""


_NO_FACTS = _Facts()


class TransformException(CoframeError):  # noqa: N818 - tf2's name
    """A transform could not be looked up or stored.

    ``str(error)`` is tf2's message; the properties contain the details, None where they do not apply.
    """

    # An exception raised by the core holds its Failure in `args` and has no __init__ to run. Most failed lookups are
    # caught and discarded, so the message and the details are computed only on access.
    _details: _Facts = _NO_FACTS

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
        doctor_code: str = "",
    ) -> Self:
        """Return an exception with the message ``reason`` and these details."""
        error = cls(reason)
        error._details = _Facts(target, source, requested, earliest, latest, edge, hint, code, doctor_code)
        return error

    @property
    def args(self) -> tuple[Any, ...]:
        """The message of the exception as a tuple with one element."""
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
        return self._failure or self._details

    @property
    def code(self) -> str:
        """The kind of failure, such as ``too_new`` or ``not_connected``, or "" if no lookup failed."""
        return self._facts.code

    @property
    def target(self) -> str | None:
        """The target frame of the lookup, or None."""
        return self._facts.target

    @property
    def source(self) -> str | None:
        """The source frame of the lookup, or None."""
        return self._facts.source

    @property
    def requested(self) -> int | None:
        """The requested time in nanoseconds, or None if the failure does not depend on time."""
        return self._facts.requested

    @property
    def earliest(self) -> int | None:
        """The oldest stamp of the edge that has no sample at ``requested``, in nanoseconds, or None."""
        return self._facts.earliest

    @property
    def latest(self) -> int | None:
        """The newest stamp of the edge that has no sample at ``requested``, in nanoseconds, or None."""
        return self._facts.latest

    @property
    def edge(self) -> tuple[str, str] | None:
        """The edge that has no sample at ``requested``, as (parent, child), or None."""
        return self._facts.edge

    @property
    def hint(self) -> str:
        """Advice on what to do next, in one or two sentences; may be empty."""
        failure = self._failure
        return self._details.hint if failure is None else _hint(failure)

    @property
    def doctor_code(self) -> str:
        """The code of the doctor's page about this problem, such as ``"TF013"``, or "" if there is none."""
        failure = self._failure
        return self._details.doctor_code if failure is None else _doctor_code(failure)

    def __repr__(self) -> str:
        return f"{type(self).__name__}({str(self)!r})"

    def __reduce__(self) -> tuple[object, ...]:
        facts = {name: getattr(self, name) for name in _Facts._fields}
        kind = type(self)
        # Pickle by name: tf2_py sets the module of these classes to `tf2`, as tf2 does, where pickle cannot find them.
        is_ours = globals().get(kind.__name__) is kind
        arguments = (kind.__name__ if is_ours else kind, str(self), facts)
        notes = self.__dict__.get("__notes__")
        return (_restore, arguments) if notes is None else (_restore, arguments, {"__notes__": notes})


class LookupException(TransformException):
    """A frame does not exist, or the tree contains a loop."""


class ConnectivityException(TransformException):
    """The frames are in different trees."""


class ExtrapolationException(TransformException):
    """There is no sample at the requested time. tf2 never extrapolates."""


class InvalidArgumentException(TransformException):
    """A frame name or a transform that tf2 rejects."""


class FrameMismatchException(InvalidArgumentException):
    """Two transforms were composed whose inner frames differ."""


class TimeoutException(TransformException):
    """The transform did not become available before the timeout."""


class _HintedError(CoframeError):
    """Base class of the errors below, which take their hint as an argument."""

    def __init__(self, text: str, *, hint: str = "") -> None:
        super().__init__(text)
        self._hint = hint


class WireError(_HintedError, RuntimeError):
    """The ROS graph could not be joined or used."""


class ViewerError(_HintedError, RuntimeError):
    """The viewer could not be started, or cannot show the given file."""


class DecodeError(_HintedError, ValueError):
    """Bytes that do not match their type. The message gives the type, the position and the expected value."""


class _FileError(_HintedError, ValueError):
    """Base class of errors about the contents of a text file.

    Attributes:
        line: Line number, counted from 1, or None if the problem has no single line.
        file: Name of the file, or None for text that does not come from a file.
    """

    def __init__(self, text: str, *, line: int | None = None, file: str | None = None, hint: str = "") -> None:
        super().__init__(text, hint=hint)
        self.line = line
        self.file = file

    def __str__(self) -> str:
        places = [self.file or "", f"line {self.line}" if self.line is not None else ""]
        return ": ".join(filter(None, [", ".join(filter(None, places)), str(self.args[0])]))


class RobotDescriptionError(_FileError):
    """A robot description that is invalid or contradictory; ``file`` and ``line`` give the location, or are None."""


class InterfaceError(_FileError, LookupError):
    """An invalid definition of a message, service or action; ``file`` and ``line`` give the location, or are None.

    It is also a LookupError, because the type that the definition describes cannot be found.
    """


class PackageError(_HintedError, LookupError):
    """A package, or a file in one, that does not exist, or a file outside its package."""


class FrozenFileError(_HintedError, ValueError):
    """A file that is not a frozen buffer, is damaged, or cannot be written."""


class ContractError(_HintedError, ValueError):
    """A contract for recordings that is invalid or cannot be read; the message names the place."""


class CameraError(_HintedError, ValueError):
    """A camera whose calibration is missing, contradicts itself, or has a model that is not supported."""


class CalibrationError(_HintedError, ValueError):
    """A calibration that cannot be read, written, or estimated from the data."""


class RecordingError(_HintedError, ValueError):
    """A recording without any readable data."""


class EditError(_HintedError, ValueError):
    """A rule for editing a recording that cannot be understood, or cannot be applied to this recording."""


class TrajectoryError(_HintedError, ValueError):
    """A trajectory file that cannot be read, or two trajectories that cannot be compared."""


class PlotError(_HintedError, ValueError):
    """An expression that is not valid or has no values, or a plot that cannot be written."""


class CourseError(_HintedError, ValueError):
    """A folder of the lab that cannot be created, run or graded."""


def _restore(kind: str | type[TransformException], text: str, facts: dict[str, object]) -> TransformException:
    chosen: type[TransformException] = globals()[kind] if isinstance(kind, str) else kind
    return chosen.with_details(text, **facts)  # type: ignore[arg-type]


_MAX_GUESSES = 3
_UNITS = {"s": SECOND, "ms": MILLISECOND, "us": MICROSECOND}
# Clocks of one system differ by less; simulated time and the system time by decades.
_MIN_CLOCK_DIFFERENCE = 30 * DAY
_MIN_UNIT_RATIO = 100  # a time in another unit is at least this much smaller than the samples
MAX_LISTED_FRAMES = 50


def _doctor_code(failure: Failure) -> str:
    if _mistaken_unit(failure):
        return ""
    if found := re.search(r"See doctor code (TF\d+)\.$", _hint(failure)):
        return found[1]
    return doctor_code(failure.code)


def _mistaken_unit(failure: Failure | TransformException) -> str:
    """Return the unit in which the requested time lies within the samples of the edge, or "" for nanoseconds."""
    if failure.requested is None or failure.earliest is None or failure.latest is None:
        return ""
    requested, earliest, latest = failure.requested, failure.earliest, failure.latest
    if not 0 < requested < earliest // _MIN_UNIT_RATIO:
        return ""
    return next((unit for unit, size in _UNITS.items() if earliest <= requested * size <= latest), "")


def _hint_for_time(failure: Failure, parent: str, child: str) -> str:
    """Return the hint for a time on another clock, or outside the samples of a recording, or "" for other failures."""
    requested, earliest, latest = failure.requested, failure.earliest, failure.latest
    if failure.code not in {"too_old", "too_new"} or requested is None or earliest is None or latest is None:
        return ""
    apart = requested - latest if requested > latest else earliest - requested
    facts = {"parent": parent, "child": child, "first": seconds(earliest), "last": seconds(latest)}
    facts |= {"target": failure.target, "source": failure.source}
    if apart > _MIN_CLOCK_DIFFERENCE:
        direction = "after" if requested > latest else "before"
        return hint("other_clock", by=duration(apart), direction=direction, **facts)
    return hint("outside_recorded", **facts) if failure.recorded else ""


def _hint(failure: Failure) -> str:
    if unit := _mistaken_unit(failure):
        nanoseconds = f"{(failure.requested or 0) * _UNITS[unit]:_}"
        return hint("in_seconds", requested=str(failure.requested), unit=unit, nanoseconds=nanoseconds)
    parent, child = failure.edge or ("", "")
    if specific := _hint_for_time(failure, parent, child):
        return specific
    return hint(
        failure.code,
        target=failure.target,
        source=failure.source,
        parent=parent,
        child=child,
        timeout="0.1",
        bare=failure.name.lstrip("/"),
        guess=_frame_name_hint(failure) if failure.code == "unknown_frame" else "",
        trees=_trees(failure) if failure.code == "not_connected" else "",
    )


def looks_like_seconds(failure: Failure | TransformException) -> bool:
    """Return whether the requested time, in seconds, ms or us, lies within the samples of the edge."""
    return _mistaken_unit(failure) != ""


def _frame_name_hint(failure: Failure) -> str:
    known = sorted(failure.parents)
    if not known:
        return "The buffer has not received any transforms. Is a broadcaster running in the same ROS domain?"
    arguments = (failure.target, failure.source)
    # The other frame of the lookup is not a candidate.
    others = [frame for frame in known if failure.name not in arguments or frame not in arguments]
    meant = _similar_names(failure.name, others)
    frames = f"Known frames: {join_names(map(display_name, known), limit=MAX_LISTED_FRAMES)}."
    if not meant:
        return frames
    target, source = (
        name if name in failure.parents else (_similar_names(name, others) or [name])[0] for name in arguments
    )
    line = f" In a node: lookup_transform({target!r}, {source!r}, ...)." if failure.name in arguments else ""
    return f"Did you mean {' or '.join(map(repr, meant))}? {frames}{line}"


def _similar_names(name: str, known: list[str]) -> list[str]:
    """Return the frames that may have been meant: the same name with another prefix, or a similar spelling."""
    from coframe.analysis.similar_frames import similar_frames  # noqa: PLC0415 - only hints need it

    bare = name.rpartition("/")[2]
    same = [frame for frame in known if frame.rpartition("/")[2] == bare and len(frame) <= MAX_COMPARED_LENGTH]
    return same[:_MAX_GUESSES] or similar_frames(name, known)


def _trees(failure: Failure) -> str:
    from coframe.analysis.missing_edges import missing_edge  # noqa: PLC0415 - only hints need it
    from coframe.analysis.tree import FrameTrees  # noqa: PLC0415

    roots = failure.roots or ("", "")
    structure = FrameTrees.from_parents(failure.parents)
    trees = [structure.tree(root) for root in roots]
    described = " and ".join(
        f"{root!r} with {join_names(map(display_name, below), limit=MAX_LISTED_FRAMES)}" if below else f"{root!r} alone"
        for root, *below in trees
    )
    target_root, source_root = roots
    edge = missing_edge(*sorted(trees, key=len, reverse=True))
    return (
        f"The two trees are {described}. Publish a transform with the child {source_root!r} (or {target_root!r}) to "
        "connect them." + (f" {edge.hint}" if edge else "")
    )
