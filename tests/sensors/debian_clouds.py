# SPDX-License-Identifier: Apache-2.0
"""Transform a pickled cloud with Debian's do_transform_cloud and return it pickled; runs in Debian's Python."""

import pickle
import sys

import tf2_sensor_msgs
from geometry_msgs.msg import TransformStamped
from sensor_msgs.msg import PointCloud2, PointField

given = pickle.load(sys.stdin.buffer)
transform = TransformStamped()
transform.header.frame_id = "base"
t, r = transform.transform.translation, transform.transform.rotation
t.x, t.y, t.z, r.x, r.y, r.z, r.w = given["transform"]
fields = [PointField(name=name, offset=offset, datatype=kind, count=1) for name, offset, kind in given["fields"]]
sizes = {name: given[name] for name in ("height", "width", "point_step", "row_step", "is_bigendian", "data")}
moved = tf2_sensor_msgs.do_transform_cloud(PointCloud2(fields=fields, **sizes), transform)
result = {"data": moved.data, "point_step": moved.point_step, "frame": moved.header.frame_id}
pickle.dump(result, sys.stdout.buffer, protocol=4)
