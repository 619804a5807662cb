// SPDX-License-Identifier: Apache-2.0
/** The Map display: an occupancy grid as a texture. */

import * as THREE from "three";
import type { Grid } from "../protocol/messages";
import type { PickedPart } from "../model/picked";
import type { Hit } from "../scene/picking";
import { MessageDisplay } from "./display";

const MAX_TEXTURE_SIZE = 8192;

export class MapDisplay extends MessageDisplay<Grid, "Map"> {
  protected build(message: Grid): THREE.Object3D {
    const { width, height, resolution } = message;
    const group = new THREE.Group();
    if (width === 0 || height === 0) return group;
    if (Math.max(width, height) > MAX_TEXTURE_SIZE) {
      this.status = {
        state: "error",
        text: `The map has ${width} × ${height} cells. At most ${MAX_TEXTURE_SIZE} × ${MAX_TEXTURE_SIZE} can be drawn.`,
      };
      return group;
    }
    const cells = new Uint8Array(message.cells.buffer, message.cells.byteOffset, message.cells.length);
    const texture = new THREE.DataTexture(cells, width, height, THREE.RedFormat, THREE.UnsignedByteType);
    texture.unpackAlignment = 1;
    texture.needsUpdate = true;
    const plane = new THREE.PlaneGeometry(width * resolution, height * resolution);
    plane.translate((width * resolution) / 2, (height * resolution) / 2, 0);
    const mesh = new THREE.Mesh(plane, this.material(texture));
    if (this.options.flag("Draw Behind")) mesh.renderOrder = -1;
    mesh.position.set(...(message.origin.subarray(0, 3) as unknown as [number, number, number]));
    mesh.quaternion.fromArray(message.origin, 3);
    group.add(mesh);
    return group;
  }

  protected override partAt(message: Grid, object: THREE.Object3D, hit: Hit): PickedPart {
    const part = super.partAt(message, object, hit);
    const { width, height, resolution, cells } = message;
    const { x, y } = hit.object.worldToLocal(hit.point.clone());
    const [column, row] = [Math.floor(x / resolution), Math.floor(y / resolution)];
    if (!(column >= 0 && column < width && row >= 0 && row < height)) return part;
    const value = cells[row * width + column] as number;
    const meaning = value < 0 ? "unknown" : value === 0 ? "free" : value === 100 ? "occupied" : "";
    return {
      ...part,
      title: "Cell",
      rows: [
        ["cell", `${column}, ${row}`],
        ["value", meaning ? `${value} (${meaning})` : String(value)],
        ["resolution", `${Number(resolution.toPrecision(6))} m`],
      ],
    };
  }

  private material(texture: THREE.Texture): THREE.ShaderMaterial {
    return new THREE.ShaderMaterial({
      transparent: true,
      depthWrite: false,
      side: THREE.DoubleSide,
      polygonOffset: true,
      polygonOffsetFactor: 1,
      polygonOffsetUnits: 1,
      uniforms: {
        cells: { value: texture },
        alpha: { value: this.options.number("Alpha") },
        scheme: { value: ["map", "costmap", "raw"].indexOf(this.options.choice("Color Scheme")) },
      },
      vertexShader: `
        varying vec2 at;
        void main() { at = uv; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }`,
      fragmentShader: `
        uniform sampler2D cells;
        uniform float alpha;
        uniform int scheme;
        varying vec2 at;
        void main() {
          float cell = floor(texture2D(cells, at).r * 255.0 + 0.5);
          float part = cell / 100.0;
          if (scheme == 2) { gl_FragColor = vec4(vec3(cell / 255.0), alpha); return; }
          if (scheme == 1) {
            if (cell == 0.0) discard;
            vec3 cost = cell == 100.0 ? vec3(1.0, 0.0, 1.0) : cell == 99.0 ? vec3(0.0, 1.0, 1.0) : vec3(part, 0.0, 1.0 - part);
            gl_FragColor = vec4(cell > 100.0 ? vec3(0.44, 0.54, 0.53) : cost, alpha);
            return;
          }
          vec3 color = cell <= 100.0 ? vec3(1.0 - part) : vec3(0.44, 0.54, 0.53);
          gl_FragColor = vec4(color, alpha);
        }`,
    });
  }
}
