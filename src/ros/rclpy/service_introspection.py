# SPDX-License-Identifier: Apache-2.0
"""States of the introspection of services, which publishes requests and responses on a topic."""

from enum import Enum

__all__ = ["ServiceIntrospectionState"]


class ServiceIntrospectionState(Enum):
    """The published information about the requests and responses of a service. coframe has only OFF."""

    OFF = 0
    METADATA = 1
    CONTENTS = 2


def check_introspection(state: ServiceIntrospectionState) -> None:
    """Raise an error unless the introspection is off.

    Raises:
        NotImplementedError: The state is not OFF.
    """
    if state is not ServiceIntrospectionState.OFF:
        raise NotImplementedError(
            f"Service introspection ({state.name}) does not exist in coframe. Log the requests in the service's "
            "callback, or record the service's DDS topics."
        )
