# SPDX-License-Identifier: Apache-2.0
"""Verify coframe.ros2 with the ROS 2 that is sourced.

    source /opt/ros/jazzy/setup.bash
    python3 tests/process/inside_ros2/verify.py

coframe must be installed for the Python of that ROS. The script runs talker.py and listener.py with each installed
middleware, with remapped topics, natively, with shared transforms and through rclpy, as an import and as
``python -m coframe.ros2``. It prints one line for each and fails if one of them fails. With rmw_zenoh_cpp, start its
router before; native subscriptions then need coframe[zenoh].
"""

import os
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

FOLDER = Path(__file__).parent
REMAPPED = ["--ros-args", "-r", "__ns:=/robot1", "-r", "/tf:=/robot1/tf", "-r", "/tf_static:=/robot1/tf_static"]
MIDDLEWARES = ("rmw_fastrtps_cpp", "rmw_cyclonedds_cpp", "rmw_connextdds", "rmw_zenoh_cpp")


def listen(environment: dict[str, str], wire: str, *, as_import: bool) -> subprocess.CompletedProcess[str]:
    """Run the talker and the listener, and return how the listener ended."""
    runner = [] if as_import else ["-m", "coframe.ros2", "--wire", wire]
    environment = {**environment, **({"TF2": "coframe.ros2", "COFRAME_ROS2_WIRE": wire} if as_import else {})}
    talking = [sys.executable, str(FOLDER / "talker.py"), *REMAPPED]
    with subprocess.Popen(talking, env=environment, stdout=subprocess.PIPE, text=True) as talker:
        try:
            assert talker.stdout is not None
            assert talker.stdout.readline() == "talking\n"
            command = [sys.executable, *runner, str(FOLDER / "listener.py"), wire, *REMAPPED]
            return subprocess.run(command, env=environment, capture_output=True, text=True, timeout=60, check=False)
        finally:
            talker.kill()


def main() -> int:
    """Run all combinations. Return the number of failures."""
    prefixes = os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep)
    if not prefixes[0]:
        sys.exit("No ROS 2 is sourced: AMENT_PREFIX_PATH is not set. Run: source /opt/ros/DISTRO/setup.bash")
    failures = 0
    for middleware in MIDDLEWARES:
        if not any((Path(prefix) / "share" / middleware).is_dir() for prefix in prefixes):
            print(f"{middleware}: not installed")
            continue
        is_native = middleware != "rmw_zenoh_cpp" or find_spec("zenoh") is not None
        ways = [("native", "0"), ("native", "1"), ("rclpy", "0")] if is_native else [("rclpy", "0")]
        for wire, shared in ways:
            for as_import in (True, False):
                environment = {**os.environ, "RMW_IMPLEMENTATION": middleware, "COFRAME_SHARED": shared}
                result = listen(environment, wire, as_import=as_import)
                failed = result.stdout != "passed\n"
                failures += failed
                how = "import" if as_import else "python -m coframe.ros2"
                how = f"shared, {how}" if shared == "1" else how
                print(f"{middleware}, {wire}, {how}: {result.stderr if failed else 'passed'}", flush=True)
    return failures


if __name__ == "__main__":
    sys.exit(main())
