# SPDX-License-Identifier: Apache-2.0
"""The states of a lifecycle node and the transitions between them, as in rcl_lifecycle."""

from __future__ import annotations

import threading
from enum import Enum
from functools import partial
from typing import TYPE_CHECKING, Final, NamedTuple

from lifecycle_msgs.msg import State, Transition
from rclpy import _absent
from rclpy.exceptions import RCLError, _with_hint

if TYPE_CHECKING:
    from collections.abc import Callable

StateTuple = tuple[int, str]


class TransitionCallbackReturn(Enum):
    """Result of a transition's callback."""

    SUCCESS = Transition.TRANSITION_CALLBACK_SUCCESS
    FAILURE = Transition.TRANSITION_CALLBACK_FAILURE
    ERROR = Transition.TRANSITION_CALLBACK_ERROR

    def to_label(self) -> str:
        """Return the label of the transition that the result triggers, for example `transition_success`."""
        return f"transition_{self.name.lower()}"


class Edge(NamedTuple):
    """A transition between two states."""

    transition: int
    label: str
    start: int
    goal: int


STATES: Final = {
    State.PRIMARY_STATE_UNKNOWN: "unknown",
    State.PRIMARY_STATE_UNCONFIGURED: "unconfigured",
    State.PRIMARY_STATE_INACTIVE: "inactive",
    State.PRIMARY_STATE_ACTIVE: "active",
    State.PRIMARY_STATE_FINALIZED: "finalized",
    State.TRANSITION_STATE_CONFIGURING: "configuring",
    State.TRANSITION_STATE_CLEANINGUP: "cleaningup",
    State.TRANSITION_STATE_SHUTTINGDOWN: "shuttingdown",
    State.TRANSITION_STATE_ACTIVATING: "activating",
    State.TRANSITION_STATE_DEACTIVATING: "deactivating",
    State.TRANSITION_STATE_ERRORPROCESSING: "errorprocessing",
}


def _edges() -> list[Edge]:
    edges: list[Edge] = []

    def add(label: str, starts: dict[int, int], during: int, after: tuple[int, int, int], first_result: int) -> None:
        """Add the edges into the state `during`, and those to the states after success, failure and error."""
        edges.extend(Edge(transition, label, start, during) for transition, start in starts.items())
        edges.extend(
            Edge(first_result + index, result.to_label(), during, goal)
            for index, (result, goal) in enumerate(zip(TransitionCallbackReturn, after, strict=True))
        )

    unconfigured, inactive = State.PRIMARY_STATE_UNCONFIGURED, State.PRIMARY_STATE_INACTIVE
    active, finalized = State.PRIMARY_STATE_ACTIVE, State.PRIMARY_STATE_FINALIZED
    error = State.TRANSITION_STATE_ERRORPROCESSING
    add(
        "configure",
        {Transition.TRANSITION_CONFIGURE: unconfigured},
        State.TRANSITION_STATE_CONFIGURING,
        (inactive, unconfigured, error),
        Transition.TRANSITION_ON_CONFIGURE_SUCCESS,
    )
    add(
        "cleanup",
        {Transition.TRANSITION_CLEANUP: inactive},
        State.TRANSITION_STATE_CLEANINGUP,
        (unconfigured, inactive, error),
        Transition.TRANSITION_ON_CLEANUP_SUCCESS,
    )
    add(
        "activate",
        {Transition.TRANSITION_ACTIVATE: inactive},
        State.TRANSITION_STATE_ACTIVATING,
        (active, inactive, error),
        Transition.TRANSITION_ON_ACTIVATE_SUCCESS,
    )
    add(
        "deactivate",
        {Transition.TRANSITION_DEACTIVATE: active},
        State.TRANSITION_STATE_DEACTIVATING,
        (inactive, active, error),
        Transition.TRANSITION_ON_DEACTIVATE_SUCCESS,
    )
    add(
        "shutdown",
        {
            Transition.TRANSITION_UNCONFIGURED_SHUTDOWN: unconfigured,
            Transition.TRANSITION_INACTIVE_SHUTDOWN: inactive,
            Transition.TRANSITION_ACTIVE_SHUTDOWN: active,
        },
        State.TRANSITION_STATE_SHUTTINGDOWN,
        (finalized, finalized, error),
        Transition.TRANSITION_ON_SHUTDOWN_SUCCESS,
    )
    add("error", {}, error, (unconfigured, finalized, finalized), Transition.TRANSITION_ON_ERROR_SUCCESS)
    return edges


EDGES: Final = _edges()


class StateMachine:
    """State of a lifecycle node.

    Args:
        on_transition: Function that is called with each transition after it took place.
    """

    def __init__(self, on_transition: Callable[[Edge], None]) -> None:
        self._on_transition = on_transition
        self._lock = threading.Lock()
        self._state: int = State.PRIMARY_STATE_UNCONFIGURED

    @property
    def current_state(self) -> StateTuple:
        """Number and label of the current state."""
        return self._state, STATES[self._state]

    @property
    def available_states(self) -> list[StateTuple]:
        """Numbers and labels of all states."""
        return list(STATES.items())

    @property
    def available_transitions(self) -> list[Edge]:
        """The transitions from the current state."""
        return [edge for edge in EDGES if edge.start == self._state]

    @property
    def transition_graph(self) -> list[Edge]:
        """All transitions."""
        return EDGES

    def get_transition_by_label(self, label: str) -> int:
        """Return the number of the transition with this label from the current state.

        Raises:
            RCLError: There is no such transition.
        """
        return self._find(label).transition

    def trigger_transition_by_id(self, transition: int) -> None:
        """Change the state.

        Raises:
            RCLError: The transition does not start in the current state.
        """
        self._trigger(transition)

    def trigger_transition_by_label(self, label: str) -> None:
        """Change the state.

        Raises:
            RCLError: The transition does not start in the current state.
        """
        self._trigger(label)

    def _trigger(self, transition: int | str) -> None:
        with self._lock:
            edge = self._find(transition)
            self._state = edge.goal
        self._on_transition(edge)

    def _find(self, transition: int | str) -> Edge:
        for edge in self.available_transitions:
            if transition in {edge.transition, edge.label}:
                return edge
        available = ", ".join(f"{edge.label} [{edge.transition}]" for edge in self.available_transitions)
        raise _with_hint(
            RCLError("Failed to trigger lifecycle state machine transition: Transition is not registered."),
            f"{transition!r} is not a transition from the state {self.current_state[1]!r}. "
            f"Available: {available or 'none'}.",
        )


__getattr__ = partial(_absent.find, __name__)  # names that upstream's module imports
