# SPDX-License-Identifier: Apache-2.0
"""Check the transforms of a robot, live or in a recording: what is wrong, why it matters, and what to do.

The package is built in layers:

- An `Observation` contains all data that the checks examine: every transform as published (a table of columns), the
  publishers and subscriptions of the topics with their QoS, the stamps and arrivals of sensor messages, joint states,
  descriptions, the clock and the log. `recorded` builds it from a recording, `coframe.doctor.live` from a running
  system; all later steps are the same for both. It provides the edges (`Edge`) with statistics that are computed when
  they are first used.
- A check is a module of `checks`: its CODE and ``find``, a pure function from an observation to findings. `diagnosis`
  finds the modules automatically: a new check is a module, a page and a test.
- `coframe.doctor.codes` reads the page of a code, which is used by `--explain`, the documentation, SARIF and the line
  "why" below a finding.
- `causes` defines as data which findings are consequences of which; consequences are listed below their cause.
- `rendering` formats reports as text, as plain data for JSON, and as SARIF.

Statistics are computed from the table with numpy when they are needed; while transforms are received, only the
transforms themselves are stored.

Example:
    >>> from coframe.doctor import page
    >>> page("TF001").title
    'Separate trees'
"""

from coframe.doctor._diagnosis import Report, SensorFacts, diagnose
from coframe.doctor._finding import Finding, Severity
from coframe.doctor.codes import Page, codes, page
from coframe.doctor.observation import Observation
from coframe.doctor.recorded import observe_recording

__all__ = [
    "Finding",
    "Observation",
    "Page",
    "Report",
    "SensorFacts",
    "Severity",
    "codes",
    "diagnose",
    "observe_recording",
    "page",
]


def __dir__() -> list[str]:
    return sorted(__all__)
