"""What the doctor says of recordings."""

import pytest

from coframe.doctor import diagnose, observe_recording


@pytest.fixture
def examine(tmp_path):
    """From a run, or the path of a recording, to a report."""

    def examine(run, **options):
        path = run.write(tmp_path) if hasattr(run, "write") else run
        (observation,) = observe_recording(path).values()
        return diagnose(observation, **options)

    return examine


@pytest.fixture
def only(examine):
    """The one finding there is, with what it explains; fails where there are more or none."""

    def only(run, code):
        report = examine(run)
        assert [finding.code for finding in report.findings] == [code], "\n".join(map(str, report.findings))
        return report.findings[0]

    return only
