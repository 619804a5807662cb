// SPDX-License-Identifier: Apache-2.0
/** The commands and the URDF element that define a static transform. */

import { rpyDegrees, type Pose } from "./math";

const FLAGS = ["x", "y", "z", "qx", "qy", "qz", "qw"];

/** A number with six decimals: micrometers, and less than a thousandth of a degree. */
function number(value: number): string {
  return String(Number(value.toFixed(6)) + 0);
}

/** Quotes a name for a shell, if necessary; control characters as escapes, because a terminal acts on them. */
export function quote(name: string): string {
  if (/^[\w./-]+$/.test(name)) return name;
  if (!/\p{Cc}/u.test(name)) return `'${name.replaceAll("'", `'\\''`)}'`;
  const escaped = name.replace(/[\\']/g, "\\$&").replace(/\p{Cc}/gu, (control) => {
    const code = (control.codePointAt(0) as number).toString(16);
    return `\\u${code.padStart(4, "0")}`;
  });
  return `$'${escaped}'`;
}

export function staticCommands(parent: string, child: string, pose: Pose): { name: string; text: string }[] {
  const values = [...pose.position, ...pose.quaternion];
  const frames = `--frame-id ${quote(parent)} --child-frame-id ${quote(child)}`;
  const flags = FLAGS.map((flag, k) => `--${flag} ${number(values[k] as number)}`).join(" ");
  const rpy = rpyDegrees(pose.quaternion).map((angle) => number((angle * Math.PI) / 180));
  return [
    { name: "coframe", text: `coframe static ${frames} ${flags}` },
    { name: "ROS 2", text: `ros2 run tf2_ros static_transform_publisher ${frames} ${flags}` },
    { name: "URDF", text: `<origin xyz="${pose.position.map(number).join(" ")}" rpy="${rpy.join(" ")}"/>` },
  ];
}
