"""What is wrong with the transforms of a robot, why that matters, and what to do: on the wire or in a recording.

How it is made, from bottom to top:

- An `Observation` is all that the checks know: every transform as it was sent (a table of columns), who is on which
  topic with which QoS, the stamps and arrivals of sensor messages, joint states, descriptions, the clock, the log.
  `recorded` makes it of a recording, `coframe.doctor.live` of what arrives; from there on the path is the same for
  both. It gives the links (`Edge`) with their statistics, which are calculated when they are first asked for.
- A check is a module of `checks`: its CODE and ``find``, a pure function from an observation to findings. `diagnosis`
  finds the modules by itself: a new check is one file there, one page, and one test.
- `coframe.doctor.codes` has a page for every code: the one text that `--explain`, the documentation, SARIF and the
  line "why" below a finding are made of.
- `causes` says as data which finding explains which; consequences stand below their cause.
- `rendering` has text, plain data for JSON, and SARIF.

Statistics are taken from the table at diagnosis time, with numpy: nothing is counted at ingest but the transforms.

Example:
    >>> from coframe.doctor import page
    >>> page("TF001").title
    'Separate trees'
"""

from coframe.doctor.codes import Page, codes, page
from coframe.doctor.diagnosis import Report, SensorFacts, diagnose
from coframe.doctor.finding import Finding, Severity
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
