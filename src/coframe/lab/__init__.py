"""The nodes of the tf2 lab.

They import ROS names only, so each of these files also runs as it is where a real ROS 2 is installed.
"""
