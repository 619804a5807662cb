// SPDX-License-Identifier: Apache-2.0
/** The Wrench, TwistStamped, AccelStamped and Imu displays: arrows at the origin of a frame. */

import * as THREE from "three";
import { axesGeometry } from "../scene/frames";
import type { ImuShape, ScrewShape, Shapes } from "../protocol/messages";
import { arrowGeometry } from "./arrows";
import { axesMaterial } from "./axes";
import { MessageDisplay } from "./display";

/** The part of an arrow's length that is its head, and its radii as parts of the width; as in RViz. */
const HEAD = 0.23;
const SHAFT_RADIUS = 0.05;
const HEAD_RADIUS = 0.1;
/** The circle of a rotation: points on a full turn, and the point at which it begins. */
const CIRCLE_POINTS = 32;
const CIRCLE_BEGIN = 4;

type ScrewClass = "Wrench" | "TwistStamped" | "AccelStamped";

export class ScrewDisplay extends MessageDisplay<Shapes, ScrewClass> {
  protected build({ description }: Shapes): THREE.Object3D {
    const group = new THREE.Group();
    if (description.kind !== "screw") return group;
    const linear = vector(description.linear);
    const angular = vector(description.angular);
    if (linear) this.add(group, linear, this.part("linear"), false);
    if (angular) this.add(group, angular, this.part("angular"), true);
    return group;
  }

  /** The length of each arrow in meters; 0 for hidden ones. */
  protected override describe({ description }: Shapes, object: THREE.Object3D): Record<string, unknown> {
    const lengths = object.children.map(({ userData }) => userData.length as number);
    return { lengths, vectors: [(description as ScrewShape).linear, (description as ScrewShape).angular] };
  }

  private part(which: "linear" | "angular"): { color: string; scale: number } {
    const options = this.options as unknown as { color(key: string): string; number(key: string): number };
    const names = {
      Wrench: ["Force", "Torque"],
      TwistStamped: ["Linear", "Angular"],
      AccelStamped: ["Linear", "Angular"],
    };
    const name = names[this.kind][which === "linear" ? 0 : 1] as string;
    return { color: options.color(`${name} Color`), scale: options.number(`${name} Arrow Scale`) };
  }

  private add(
    group: THREE.Group,
    direction: THREE.Vector3,
    { color, scale }: { color: string; scale: number },
    turns: boolean,
  ): void {
    const width = this.options.number("Arrow Width");
    const length = direction.length() * scale;
    if (length === 0 || (this.options.flag("Hide Small Values") && length <= width)) return;
    const alpha = this.options.number("Alpha");
    const part = turns ? makeTurnArrow(length, width, color, alpha) : arrowAlong(length, width, color, alpha);
    part.quaternion.setFromUnitVectors(new THREE.Vector3(1, 0, 0), direction.clone().normalize());
    part.userData.length = length;
    group.add(part);
  }
}

export class ImuDisplay extends MessageDisplay<Shapes, "Imu"> {
  protected build({ description }: Shapes): THREE.Object3D {
    const group = new THREE.Group();
    if (description.kind !== "imu") return group;
    const o = this.options;
    const turned = new THREE.Group();
    const orientation = quaternion(description);
    if (orientation) turned.quaternion.copy(orientation);
    if (o.flag("Axes properties/Enable axes") && orientation) {
      const axes = new THREE.Mesh(axesGeometry(this.context.palette(), 0.06), axesMaterial(1));
      axes.scale.setScalar(o.number("Axes properties/Axes scale"));
      turned.add(axes);
    }
    if (o.flag("Box properties/Enable box")) {
      const sizes = ["x_scale", "y_scale", "z_scale"].map((key) =>
        o.number(`Box properties/${key}` as "Box properties/x_scale"),
      );
      const color = o.color("Box properties/Box color");
      turned.add(
        new THREE.Mesh(new THREE.BoxGeometry(...sizes), makeSolidMaterial(color, o.number("Box properties/Box alpha"))),
      );
    }
    group.add(turned);
    const acceleration = vector(description.acceleration);
    if (o.flag("Acceleration properties/Enable acceleration") && acceleration && acceleration.length() > 0) {
      const length = acceleration.length() * o.number("Acceleration properties/Acc. vector scale");
      const color = o.color("Acceleration properties/Acc. vector color");
      const arrow = arrowAlong(length, length, color, o.number("Acceleration properties/Acc. vector alpha"));
      arrow.quaternion.setFromUnitVectors(new THREE.Vector3(1, 0, 0), acceleration.normalize());
      group.add(arrow);
    }
    return group;
  }

  protected override describe({ description }: Shapes, object: THREE.Object3D): Record<string, unknown> {
    const turned = object.children[0] as THREE.Object3D;
    const { acceleration } = description as ImuShape;
    return {
      orientation: turned.quaternion.toArray(),
      acceleration,
      parts: turned.children.length + object.children.length - 1,
    };
  }
}

/** An arrow along x. */
export function arrowAlong(length: number, width: number, color: string, alpha: number): THREE.Mesh {
  const shape = {
    shaftLength: length * (1 - HEAD),
    shaftRadius: width * SHAFT_RADIUS,
    headLength: length * HEAD,
    headRadius: width * HEAD_RADIUS,
  };
  return new THREE.Mesh(arrowGeometry(shape), makeSolidMaterial(color, alpha));
}

/** An arrow along x, and an arrow in a circle around it, whose direction is that of a positive rotation about x. */
function makeTurnArrow(length: number, width: number, color: string, alpha: number): THREE.Object3D {
  const group = new THREE.Group();
  const points: THREE.Vector3[] = [];
  for (let i = CIRCLE_BEGIN; i <= CIRCLE_POINTS; i++) {
    const angle = (i * 2 * Math.PI) / CIRCLE_POINTS;
    points.push(new THREE.Vector3(length / 2, (length / 4) * Math.cos(angle), (length / 4) * Math.sin(angle)));
  }
  const circle = new THREE.TubeGeometry(new THREE.CatmullRomCurve3(points), 64, width * SHAFT_RADIUS * 0.5, 6);
  group.add(arrowAlong(length, width, color, alpha), new THREE.Mesh(circle, makeSolidMaterial(color, alpha)));
  const head = new THREE.Mesh(
    new THREE.ConeGeometry(width * HEAD_RADIUS, width * HEAD, 16),
    makeSolidMaterial(color, alpha),
  );
  head.position.copy(points.at(-1) as THREE.Vector3);
  head.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), new THREE.Vector3(0, 0, 1));
  group.add(head);
  return group;
}

export function makeSolidMaterial(color: string, alpha: number): THREE.MeshLambertMaterial {
  return new THREE.MeshLambertMaterial({ color, transparent: alpha < 1, opacity: alpha, depthWrite: alpha >= 1 });
}

function vector(numbers: readonly (number | null)[]): THREE.Vector3 | null {
  const found = numbers.filter((value) => value !== null);
  return found.length === 3 ? new THREE.Vector3().fromArray(found) : null;
}

function quaternion({ orientation }: ImuShape): THREE.Quaternion | null {
  const found = (orientation ?? []).filter((value) => value !== null);
  return found.length === 4 ? new THREE.Quaternion().fromArray(found).normalize() : null;
}
