// SPDX-License-Identifier: Apache-2.0
/** The CameraInfo display: the view frustum from the intrinsics, in the optical frame. */

import * as THREE from "three";
import type { CameraShape, Shapes } from "../protocol/messages";
import { MessageDisplay } from "./display";

export class CameraDisplay extends MessageDisplay<Shapes, "CameraInfo"> {
  /** The intrinsics of the newest visible message and the pose of its frame in the scene; null if there is none. */
  newest(): { intrinsics: CameraShape; pose: THREE.Matrix4 } | null {
    const { object, message } = [...this.drawnMessages.values()].filter((entry) => entry.object.visible).at(-1) ?? {};
    if (!object || message?.description.kind !== "camera") return null;
    object.updateMatrixWorld();
    return { intrinsics: message.description, pose: object.matrixWorld };
  }

  protected build({ description: camera }: Shapes): THREE.Object3D {
    const group = new THREE.Group();
    if (camera.kind !== "camera") return group;
    const [fx, fy, cx, cy] = [camera.k[0] ?? 0, camera.k[4] ?? 0, camera.k[2] ?? 0, camera.k[5] ?? 0];
    if (!(fx > 0 && fy > 0 && camera.width > 0 && camera.height > 0)) {
      this.status = {
        state: "error",
        text: "The CameraInfo contains no calibration: fx, fy, width and height must be positive.",
      };
      return group;
    }
    const { options } = this;
    const depth = options.number("Far clip");
    const corner = (u: number, v: number): THREE.Vector3 =>
      new THREE.Vector3(((u - cx) / fx) * depth, ((v - cy) / fy) * depth, depth);
    const corners = [
      corner(0, 0),
      corner(camera.width, 0),
      corner(camera.width, camera.height),
      corner(0, camera.height),
    ];
    const eye = new THREE.Vector3();
    const edges = corners.flatMap((at, i) => [eye, at, at, corners[(i + 1) % 4] as THREE.Vector3]);
    const sides = corners.flatMap((at, i) => [eye, at, corners[(i + 1) % 4] as THREE.Vector3]);
    const far = [0, 1, 2, 0, 2, 3].map((i) => corners[i] as THREE.Vector3);
    if (options.flag("Show edges"))
      group.add(
        new THREE.LineSegments(
          new THREE.BufferGeometry().setFromPoints(edges),
          new THREE.LineBasicMaterial({ color: options.color("Edge color") }),
        ),
      );
    if (options.flag("Show polygons"))
      group.add(
        new THREE.Mesh(
          new THREE.BufferGeometry().setFromPoints(options.flag("Not show side polygons") ? far : sides),
          new THREE.MeshBasicMaterial({
            color: options.color("Color"),
            transparent: true,
            opacity: options.number("Alpha"),
            side: THREE.DoubleSide,
            depthWrite: false,
          }),
        ),
      );
    return group;
  }
}
