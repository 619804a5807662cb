// SPDX-License-Identifier: Apache-2.0
/** The points of the scene under the pointer: on the ground plane, and on the surfaces that are drawn. */

import * as THREE from "three";

/** A point of a cloud is hit if the pointer is within this many pixels of it. */
const CLOUD_POINT_PX = 5;
/** A line is hit if the pointer is within this many pixels of it. */
const LINE_PX = 4;
/** Points have the same depth if it differs by at most this many times the tolerance of a hit. */
const SAME_DEPTH = 4;
/** A ray that is nearly parallel to the ground would hit it at a distance that the user cannot mean. */
const MAX_GROUND_DISTANCE_M = 1e4;

export type SceneCamera = THREE.PerspectiveCamera | THREE.OrthographicCamera;

export interface Hit {
  object: THREE.Object3D;
  /** In scene coordinates. */
  point: THREE.Vector3;
  /** The index of the point, the line or the triangle; null for other objects. */
  index: number | null;
}

export class Picker {
  private readonly raycaster = new THREE.Raycaster();

  /** Points the ray at a pixel of a view of this size. */
  aim(camera: SceneCamera, x: number, y: number, width: number, height: number): void {
    camera.updateMatrixWorld();
    this.raycaster.setFromCamera(new THREE.Vector2((x / width) * 2 - 1, 1 - (y / height) * 2), camera);
    this.pixels = (distance) =>
      camera instanceof THREE.OrthographicCamera
        ? 1 / camera.zoom
        : (2 * distance * Math.tan((camera.fov * Math.PI) / 360)) / height;
  }

  /** The ray through the pixel, in the scene. */
  get ray(): THREE.Ray {
    return this.raycaster.ray;
  }

  /** The size in meters of a pixel at a distance. */
  private pixels: (distance: number) => number = () => 0;

  /** The point of the horizontal plane at a height; null if the ray does not hit it. */
  ground(height: number): THREE.Vector3 | null {
    const { ray } = this.raycaster;
    const point = ray.intersectPlane(new THREE.Plane(new THREE.Vector3(0, 0, 1), -height), new THREE.Vector3());
    return point && point.distanceTo(ray.origin) < MAX_GROUND_DISTANCE_M ? point : null;
  }

  /** The nearest point on a visible mesh or cloud; null if the ray hits none. */
  surface(roots: readonly THREE.Object3D[]): THREE.Vector3 | null {
    return this.findHit(roots, false)?.point ?? null;
  }

  /**
   * The nearest visible mesh, cloud, sprite or line that the ray hits, with the point on it; null if it hits none.
   */
  findHit(roots: readonly THREE.Object3D[], sprites = true, lines = false): Hit | null {
    const hits: THREE.Intersection[] = [];
    for (const root of roots)
      forEachVisible(root, (object) => {
        const isCloud = object instanceof THREE.Points;
        const isLine = object instanceof THREE.Line;
        if (isLine && !lines) return;
        if (!isCloud && !isLine && !(object instanceof THREE.Mesh) && !(sprites && object instanceof THREE.Sprite))
          return;
        if (isLine) this.raycaster.params.Line.threshold = LINE_PX * this.pixels(this.distance(object));
        if (isCloud) this.raycaster.params.Points.threshold = CLOUD_POINT_PX * this.pixels(this.distance(object));
        object.raycast(this.raycaster, hits);
      });
    hits.sort((a, b) => a.distance - b.distance);
    const nearest = hits[0];
    if (!nearest) return null;
    const { object, index, faceIndex } = this.bestOf(hits, nearest);
    if (!(object instanceof THREE.Points) || index === undefined)
      return { object, point: nearest.point, index: faceIndex ?? null };
    // The hit is the nearest point of the ray; the point of the cloud is what the user means.
    const position = (object as THREE.Points<THREE.BufferGeometry>).geometry.getAttribute("position");
    const point = new THREE.Vector3().fromBufferAttribute(position, index).applyMatrix4(object.matrixWorld);
    return { object, point, index };
  }

  /** Of the points of a cloud that are about as near as the nearest one, the one that is nearest to the pointer. */
  private bestOf(hits: readonly THREE.Intersection[], nearestHit: THREE.Intersection): THREE.Intersection {
    const depth = nearestHit.distance + SAME_DEPTH * CLOUD_POINT_PX * this.pixels(nearestHit.distance);
    const off = (hit: THREE.Intersection): number => hit.distanceToRay ?? Infinity;
    const near = hits.filter(({ object, distance }) => object === nearestHit.object && distance <= depth);
    return near.reduce((best, hit) => (off(hit) < off(best) ? hit : best), nearestHit);
  }

  private distance(cloud: THREE.Points | THREE.Line): number {
    cloud.geometry.boundingSphere ?? cloud.geometry.computeBoundingSphere();
    const { center } = cloud.geometry.boundingSphere as THREE.Sphere;
    const distance = center.clone().applyMatrix4(cloud.matrixWorld).distanceTo(this.raycaster.ray.origin);
    return Number.isFinite(distance) ? distance : 0;
  }
}

function forEachVisible(object: THREE.Object3D, callback: (object: THREE.Object3D) => void): void {
  if (!object.visible) return;
  callback(object);
  for (const child of object.children) forEachVisible(child, callback);
}
