// SPDX-License-Identifier: Apache-2.0
/** The colors of a cloud's points as its shader computes them, for drawings without the shader. */

import * as THREE from "three";
import { css, scaleColor } from "../util/color_scale";

/** The colors of a cloud's points, from the attributes and uniforms of its shader. */
export function cloudColors(cloud: THREE.Points, useDistinctColors: boolean): (i: number) => string {
  const { geometry } = cloud;
  const { uniforms, defines } = cloud.material as THREE.ShaderMaterial;
  const value = <T>(name: string): T | undefined => uniforms[name]?.value as T | undefined;
  const [rgba, scalar] = [geometry.getAttribute("rgba"), geometry.getAttribute("scalar")];
  if (rgba) return (i) => css([rgba.getX(i), rgba.getY(i), rgba.getZ(i)]);
  const range = value<THREE.Vector2>("range") ?? new THREE.Vector2(0, 1);
  const spread = Math.max(range.y - range.x, 1e-6);
  const [low, high] = [value<THREE.Vector3>("low"), value<THREE.Vector3>("high")];
  if (value<boolean>("plain")) {
    const color = css(value<THREE.Vector3>("topicColor")?.toArray() ?? [1, 1, 1]);
    return () => color;
  }
  const scaled = (found: number): string => {
    const t = (found - range.x) / spread;
    if (defines && "TWO_COLORS" in defines && low && high)
      return css(
        low
          .clone()
          .lerp(high, Math.max(0, Math.min(1, t)))
          .toArray(),
      );
    return scaleColor(defines && "INVERTED" in defines ? t : 1 - t, useDistinctColors);
  };
  if (scalar) return (i) => scaled(scalar.getX(i));
  const flat = value<THREE.Vector3>("flatColor")?.toArray() ?? [1, 1, 1];
  if (!defines || !("BY_AXIS" in defines)) {
    const color = css(flat);
    return () => color;
  }
  const axis = value<number>("axis") ?? 2;
  const pose = "OWN_AXIS" in defines ? new THREE.Matrix4() : cloud.matrixWorld;
  const positions = geometry.getAttribute("position");
  const point = new THREE.Vector3();
  return (i) => scaled(point.fromBufferAttribute(positions, i).applyMatrix4(pose).getComponent(axis));
}
