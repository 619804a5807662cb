// SPDX-License-Identifier: Apache-2.0
/** Rectangles that face the camera, with a size in meters. */

import * as THREE from "three";

const VIEWPORT = new THREE.Vector4();

/**
 * Draws rectangles around points, (N, 3).
 *
 * @param rgba Red, green, blue and alpha of each point, (N, 4).
 */
export function billboards(points: Float32Array, rgba: Uint8Array, width: number, height: number): THREE.Points {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(points, 3));
  geometry.setAttribute("rgba", new THREE.BufferAttribute(rgba, 4, true));
  const isTransparent = rgba.some((value, i) => i % 4 === 3 && value < 255);
  const material = new THREE.ShaderMaterial({
    transparent: isTransparent,
    depthWrite: !isTransparent,
    uniforms: { size: { value: new THREE.Vector2(width, height) }, viewport: { value: 1 } },
    vertexShader: `
      uniform vec2 size;
      uniform float viewport;
      attribute vec4 rgba;
      varying vec4 color;
      void main() {
        color = rgba;
        gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
        float meters = max(size.x, size.y);
        gl_PointSize = max(1.5, 0.5 * meters * viewport * projectionMatrix[1][1] / max(gl_Position.w, 1e-3));
      }`,
    fragmentShader: `
      uniform vec2 size;
      varying vec4 color;
      void main() {
        vec2 at = abs(gl_PointCoord - 0.5) * max(size.x, size.y);
        if (at.x > 0.5 * size.x || at.y > 0.5 * size.y) discard;
        gl_FragColor = color;
      }`,
  });
  const drawn = new THREE.Points(geometry, material);
  drawn.onBeforeRender = (renderer): void => {
    (material.uniforms.viewport as THREE.IUniform<number>).value = renderer.getCurrentViewport(VIEWPORT).w;
    material.uniformsNeedUpdate = true;
  };
  drawn.frustumCulled = false;
  return drawn;
}
