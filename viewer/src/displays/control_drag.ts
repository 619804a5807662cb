// SPDX-License-Identifier: Apache-2.0
/** How a dragged control moves its marker: the mathematics of each mode of interaction, in the scene. */

import * as THREE from "three";
import { MODE } from "./interactive";

/** The state at the beginning of a drag. */
export interface DragStart {
  mode: number;
  /** The x axis of the control. */
  axis: THREE.Vector3;
  /** The pose of the marker. */
  position: THREE.Vector3;
  quaternion: THREE.Quaternion;
  /** The point at which the control was grabbed. */
  grabbedPoint: THREE.Vector3;
  /** The axes of the camera: right, up and the direction in which it looks. */
  camera: { right: THREE.Vector3; up: THREE.Vector3; forward: THREE.Vector3 };
}

/** The position of the pointer during a drag. */
export interface DragPointer {
  ray: THREE.Ray;
  /** Pixels since the beginning, to the right and down. */
  moved: readonly [number, number];
  shift: boolean;
}

export interface DraggedPose {
  position: THREE.Vector3;
  quaternion: THREE.Quaternion;
}

const RADIANS_PER_PIXEL = 0.01;
/** Rays that are nearly parallel to a plane or an axis would move a marker very far. */
const MIN_ANGLE_SINE = 0.02;

/** The pose of the marker; null if the pointer is at no valid point. */
export function dragPose(start: DragStart, pointer: DragPointer): DraggedPose | null {
  const { mode, axis, grabbedPoint: grabbed, camera } = start;
  switch (mode) {
    case MODE.moveAxis:
      return movePose(start, alongAxis(grabbed, axis, pointer.ray));
    case MODE.movePlane:
      return movePose(start, projectToPlane(grabbed, axis, pointer.ray));
    case MODE.rotateAxis:
      return turnPose(start, projectToPlane(grabbed, axis, pointer.ray), false);
    case MODE.moveRotate:
      return turnPose(start, projectToPlane(grabbed, axis, pointer.ray), true);
    case MODE.move3d:
      return movePose(start, projectToPlane(grabbed, camera.forward, pointer.ray));
    case MODE.rotate3d:
      return rollPose(start, pointer.moved);
    case MODE.moveRotate3d:
      return pointer.shift
        ? rollPose(start, pointer.moved)
        : movePose(start, projectToPlane(grabbed, camera.forward, pointer.ray));
    default:
      return null;
  }
}

function movePose(
  { position, quaternion, grabbedPoint: grabbed }: DragStart,
  to: THREE.Vector3 | null,
): DraggedPose | null {
  return to && { position: position.clone().add(to).sub(grabbed), quaternion: quaternion.clone() };
}

/** The point of the axis through the grabbed point that is nearest to the ray. */
function alongAxis(grabbed: THREE.Vector3, axis: THREE.Vector3, ray: THREE.Ray): THREE.Vector3 | null {
  const cosine = axis.dot(ray.direction);
  const sine2 = 1 - cosine * cosine;
  if (sine2 < MIN_ANGLE_SINE ** 2) return null;
  const between = ray.origin.clone().sub(grabbed);
  const distance = (between.dot(axis) - cosine * between.dot(ray.direction)) / sine2;
  return grabbed.clone().addScaledVector(axis, distance);
}

function projectToPlane(grabbed: THREE.Vector3, normal: THREE.Vector3, ray: THREE.Ray): THREE.Vector3 | null {
  if (Math.abs(normal.dot(ray.direction)) < MIN_ANGLE_SINE) return null;
  const plane = new THREE.Plane().setFromNormalAndCoplanarPoint(normal, grabbed);
  return ray.intersectPlane(plane, new THREE.Vector3());
}

/** Turns the marker about the axis so that the grabbed point follows; `follows` also moves it there. */
function turnPose(start: DragStart, to: THREE.Vector3 | null, follows: boolean): DraggedPose | null {
  if (!to) return null;
  const { axis, position, quaternion, grabbedPoint: grabbed } = start;
  const flat = (point: THREE.Vector3): THREE.Vector3 => point.clone().sub(position).projectOnPlane(axis);
  const [from, now] = [flat(grabbed), flat(to)];
  if (from.length() === 0 || now.length() === 0) return null;
  const angle = Math.atan2(axis.dot(from.clone().cross(now)), from.dot(now));
  const turn = new THREE.Quaternion().setFromAxisAngle(axis, angle);
  const moves = follows ? now.sub(from.applyQuaternion(turn)) : new THREE.Vector3();
  return { position: position.clone().add(moves), quaternion: turn.multiply(quaternion) };
}

/** Turns the marker like a ball under the pointer. */
function rollPose({ position, quaternion, camera }: DragStart, [right, down]: readonly [number, number]): DraggedPose {
  const turn = new THREE.Quaternion()
    .setFromAxisAngle(camera.up, right * RADIANS_PER_PIXEL)
    .multiply(new THREE.Quaternion().setFromAxisAngle(camera.right, down * RADIANS_PER_PIXEL));
  return { position: position.clone(), quaternion: turn.multiply(quaternion) };
}
