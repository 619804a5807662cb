// SPDX-License-Identifier: Apache-2.0
/** The GridCells and VoxelGrid displays: equal cells as instances. */

import * as THREE from "three";
import { slice, type Shapes } from "../protocol/messages";
import { rgbOf } from "../util/color_scale";
import { MessageDisplay } from "./display";
import { makeSolidMaterial } from "./vectors";

const UNKNOWN_ALPHA = 0.1;

export class CellsDisplay extends MessageDisplay<Shapes, "GridCells" | "VoxelGrid"> {
  protected build({ description, payload }: Shapes): THREE.Object3D {
    const group = new THREE.Group();
    if (description.kind !== "cells") return group;
    const [x, y, z] = description.size.map((value) => value ?? 0) as [number, number, number];
    const geometry = z > 0 ? new THREE.BoxGeometry(x, y, z) : new THREE.PlaneGeometry(x, y);
    const alpha = this.options.number("Alpha");
    const voxels = this.voxelOptions;
    const known = slice(payload, description.points, 3);
    group.add(
      cells(
        geometry,
        known,
        this.material(alpha, voxels?.byHeight ?? false),
        voxels?.byHeight ? this.context.distinct() : null,
      ),
    );
    if (voxels?.unknown) {
      const faint = makeSolidMaterial("#8a949c", alpha * UNKNOWN_ALPHA);
      group.add(cells(geometry.clone(), slice(payload, description.unknown, 3), faint, null));
    }
    return group;
  }

  /** Returns the number of cells, and the corners of the bounding box. */
  protected override describe(_message: Shapes, object: THREE.Object3D): Record<string, unknown> {
    const box = new THREE.Box3().setFromObject(object);
    const counts = object.children.map((part) => (part as THREE.InstancedMesh).count);
    return { counts, min: this.toFixedFrame(box.min), max: this.toFixedFrame(box.max) };
  }

  private get voxelOptions(): { byHeight: boolean; unknown: boolean } | null {
    if (this.kind !== "VoxelGrid") return null;
    const options = this.options;
    return { byHeight: options.choice("Color By") === "Height", unknown: options.flag("Show Unknown") };
  }

  private material(alpha: number, byHeight: boolean): THREE.MeshLambertMaterial {
    const made = makeSolidMaterial(byHeight ? "#ffffff" : this.options.color("Color"), alpha);
    made.side = THREE.DoubleSide;
    return made;
  }
}

/** Cells around points; colored by their height if `distinct` selects a color scale. */
function cells(
  geometry: THREE.BufferGeometry,
  centers: Float32Array,
  material: THREE.Material,
  distinct: boolean | null,
): THREE.InstancedMesh {
  const count = Math.floor(centers.length / 3);
  const mesh = new THREE.InstancedMesh(geometry, material, count);
  const matrix = new THREE.Matrix4();
  let [low, high] = [Infinity, -Infinity];
  for (let i = 0; i < count; i++) {
    mesh.setMatrixAt(i, matrix.makeTranslation(new THREE.Vector3().fromArray(centers, i * 3)));
    low = Math.min(low, centers[i * 3 + 2] as number);
    high = Math.max(high, centers[i * 3 + 2] as number);
  }
  if (distinct !== null)
    for (let i = 0; i < count; i++) {
      const part = ((centers[i * 3 + 2] as number) - low) / Math.max(high - low, 1e-6);
      mesh.setColorAt(i, new THREE.Color().setRGB(...rgbOf(1 - part, distinct), THREE.SRGBColorSpace));
    }
  mesh.frustumCulled = false;
  return mesh;
}
