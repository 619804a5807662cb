// SPDX-License-Identifier: Apache-2.0
/** What the scene contains that can be projected into an image, and the camera of an image. */

import * as THREE from "three";
import type { Model } from "../model/model";
import type { FramePoses } from "../scene/frame_poses";
import { DISPLAYS } from "../generated/displays";
import type { Display } from "./display";
import type { OverlayContent } from "./image_overlay";

/** Collects the visible parts of the scene. */
export function contentOf(
  displays: readonly Display[],
  framePoses: FramePoses,
  model: Model,
  wanted: { frames: boolean; clouds: boolean; shapes: boolean },
): Omit<OverlayContent, "axisLength"> {
  const clouds: THREE.Points[] = [];
  const shapes: THREE.Object3D[] = [];
  for (const display of displays) {
    if (!display.config.enabled) continue;
    const drawsShapes = wanted.shapes && DISPLAYS[display.kind].projected;
    display.object.updateMatrixWorld();
    display.object.traverseVisible((part) => {
      if (part instanceof THREE.Points && part.material instanceof THREE.ShaderMaterial) {
        if (wanted.clouds) clouds.push(part);
      } else if (drawsShapes) shapes.push(part);
    });
  }
  return { frames: wanted.frames ? framesOf(framePoses, model) : [], clouds, shapes };
}

function framesOf({ positions, quaternions, count, drawn }: FramePoses, model: Model): OverlayContent["frames"] {
  const frames: { name: string; pose: THREE.Matrix4 }[] = [];
  for (let i = 0; i < count; i++)
    if (drawn[i])
      frames.push({
        name: model.forest.name(i),
        pose: new THREE.Matrix4().compose(
          new THREE.Vector3().fromArray(positions, i * 3),
          new THREE.Quaternion().fromArray(quaternions, i * 4),
          new THREE.Vector3(1, 1, 1),
        ),
      });
  return frames;
}

/** The part of a baseline by which a frame may be off. */
const MAX_BASELINE_ERROR = 0.05;

/** Whether a frame is at the place (x, y, 0) of a camera. */
export function isFrameAt({ positions, count }: FramePoses, camera: THREE.Matrix4, x: number, y: number): boolean {
  const place = new THREE.Vector3(x, y, 0).applyMatrix4(camera);
  const limit = MAX_BASELINE_ERROR * Math.hypot(x, y);
  const other = new THREE.Vector3();
  for (let i = 0; i < count; i++) if (other.fromArray(positions, i * 3).distanceTo(place) < limit) return true;
  return false;
}

/**
 * The topic of the CameraInfo of an image: next to the image, or the only one in a namespace above it. Compressed
 * images are published below the topic of the raw image.
 */
export function cameraTopicOf(image: string, cameras: readonly string[]): string | null {
  for (let parts = image.split("/").slice(0, -1); parts.length > 0; parts = parts.slice(0, -1)) {
    const folder = `${parts.join("/")}/`;
    const exact = cameras.find((topic) => topic === `${folder}camera_info`);
    if (exact) return exact;
    const below = cameras.filter((topic) => topic.startsWith(folder));
    if (below.length === 1) return below[0] as string;
    if (below.length > 1) return null;
  }
  return null;
}
