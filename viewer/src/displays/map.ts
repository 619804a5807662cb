// SPDX-License-Identifier: Apache-2.0
/** The Map display: an occupancy grid as a texture. */

import * as THREE from "three";
import type { DisplayMessage, Grid } from "../protocol/messages";
import type { PickedPart } from "../model/picked";
import type { Hit } from "../scene/picking";
import { MessageDisplay } from "./display";

const MAX_TEXTURE_SIZE = 8192;

export class MapDisplay extends MessageDisplay<Grid, "Map"> {
  /** Changes the cells of a grid that was received, for a part of a grid. */
  override receive(message: DisplayMessage): void {
    if (message.kind !== "grid_part") {
      super.receive(message);
      return;
    }
    const entry = this.drawnMessages.get(message.sequence);
    if (!entry) return;
    const { width, height, cells } = entry.message;
    if (message.x + message.width > width || message.y + message.height > height) return;
    for (let row = 0; row < message.height; row++)
      cells.set(
        message.cells.subarray(row * message.width, (row + 1) * message.width),
        (message.y + row) * width + message.x,
      );
    const texture = entry.object.userData.texture as THREE.Texture | undefined;
    if (texture) texture.needsUpdate = true;
    this.context.redraw();
  }

  /** Returns the number of cells with each value. */
  protected override describe({ width, height, cells }: Grid): Record<string, unknown> {
    const counts: Record<number, number> = {};
    for (const cell of cells) counts[cell] = (counts[cell] ?? 0) + 1;
    return { width, height, counts };
  }

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
    group.userData.texture = texture;
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
        threshold: { value: this.options.flag("Binary representation") ? this.options.number("Binary threshold") : -1 },
        scheme: { value: ["map", "costmap", "raw"].indexOf(this.options.choice("Color Scheme")) },
      },
      vertexShader: `
        varying vec2 at;
        void main() { at = uv; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }`,
      fragmentShader: `
        uniform sampler2D cells;
        uniform float alpha;
        uniform float threshold;
        uniform int scheme;
        varying vec2 at;
        void main() {
          float cell = floor(texture2D(cells, at).r * 255.0 + 0.5);
          if (threshold >= 0.0 && cell <= 127.0) cell = cell >= threshold ? 100.0 : 0.0;
          float part = cell / 100.0;
          if (scheme == 2) { gl_FragColor = vec4(vec3(cell / 255.0), alpha); return; }
          vec3 color = vec3(1.0 - part);
          if (scheme == 1) {
            if (cell == 0.0) discard;
            color = cell == 100.0 ? vec3(1.0, 0.0, 1.0) : cell == 99.0 ? vec3(0.0, 1.0, 1.0) : vec3(part, 0.0, 1.0 - part);
          }
          // Illegal values, as in RViz: 101 to 127 are green, -128 to -2 red to yellow; -1 is unknown.
          if (cell > 100.0) color = vec3(0.0, 1.0, 0.0);
          if (cell > 127.0) color = vec3(1.0, (cell - 128.0) / 126.0, 0.0);
          if (cell == 255.0) color = vec3(0.44, 0.54, 0.53);
          gl_FragColor = vec4(color, alpha);
        }`,
    });
  }
}
