// SPDX-License-Identifier: Apache-2.0
/** The displays of detected objects: boxes in the scene, and rectangles that Image displays draw above their images. */

import * as THREE from "three";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";
import { slice, type BoxItem, type RectanglesShape, type Shapes } from "../protocol/messages";
import { textSprite } from "../scene/text_sprite";
import { MessageDisplay } from "./display";
import type { DisplayClass } from "../generated/displays";
import { makeSolidMaterial } from "./vectors";

type BoxClass = "BoundingBox3DArray" | "Detection3D" | "Detection3DArray";
type RectangleClass = "Detection2D" | "Detection2DArray";

const LABEL_HEIGHT_M = 0.2;
/** Degrees between the hues of two classes that follow each other, so that they differ. */
const HUE_STEP = 137.5;

export class BoxesDisplay extends MessageDisplay<Shapes, BoxClass> {
  protected build({ description, payload }: Shapes): THREE.Object3D {
    const group = new THREE.Group();
    if (description.kind !== "boxes") return group;
    const poses = slice(payload, description.poses, 7);
    description.items.forEach((item, i) => {
      const pose = poses.subarray(i * 7, i * 7 + 7);
      const size = item.size.filter((value) => value !== null);
      if (pose.length !== 7 || !pose.every(Number.isFinite) || size.length !== 3) return;
      const box = this.box(item, size as [number, number, number]);
      box.position.fromArray(pose);
      box.quaternion.fromArray(pose, 3).normalize();
      group.add(box);
    });
    return group;
  }

  /** Returns the center, size and label of each box. */
  protected override describe({ description }: Shapes, object: THREE.Object3D): Record<string, unknown> {
    const items = description.kind === "boxes" ? description.items : [];
    const boxes = object.children.map((part, i) => ({
      center: this.toFixedFrame(part.getWorldPosition(new THREE.Vector3())),
      size: items[i]?.size,
      label: labelOf(items[i] as BoxItem, true),
    }));
    return { boxes };
  }

  private box(item: BoxItem, size: [number, number, number]): THREE.Object3D {
    const group = new THREE.Group();
    const color = this.options.color("Color") || classColor(item.label);
    const geometry = new THREE.BoxGeometry(...size);
    if (!this.options.flag("Only Edge"))
      group.add(new THREE.Mesh(geometry, makeSolidMaterial(color, this.options.number("Alpha"))));
    const edges = new THREE.EdgesGeometry(geometry).getAttribute("position").array as Float32Array;
    const width = this.options.number("Line Width");
    const material = new LineMaterial({ color, worldUnits: true, linewidth: width });
    group.add(new LineSegments2(new LineSegmentsGeometry().setPositions(edges), material));
    if (this.kind !== "BoundingBox3DArray") {
      const options = this.options;
      const label = options.flag("Show Labels") ? labelOf(item, options.flag("Show Score")) : "";
      const sprite = label ? textSprite(label, new THREE.Color(color), LABEL_HEIGHT_M, 1) : null;
      sprite?.position.set(0, 0, size[2] / 2 + LABEL_HEIGHT_M);
      if (sprite) group.add(sprite);
    }
    return group;
  }
}

export class RectanglesDisplay extends MessageDisplay<Shapes, RectangleClass> {
  protected build(): THREE.Object3D {
    return new THREE.Group();
  }

  /** The rectangles of the newest visible message; null if there is none. */
  newest(): RectanglesShape | null {
    const { message } = [...this.drawnMessages.values()].filter((entry) => entry.object.visible).at(-1) ?? {};
    return message?.description.kind === "rectangles" ? message.description : null;
  }

  /** Draws the rectangles; the context is scaled to pixels of the full image, `pixel` is the size of one on the screen. */
  draw(context: CanvasRenderingContext2D, pixel: number): number {
    const shape = this.newest();
    if (!shape) return 0;
    let count = 0;
    shape.rectangles.forEach((rectangle, i) => {
      const item = shape.items[i] as BoxItem;
      const [x, y, angle, width, height] = rectangle;
      if (x == null || y == null || width == null || height == null) return;
      const color = this.options.color("Color") || classColor(item.label);
      context.save();
      context.translate(x, y);
      context.rotate(angle ?? 0);
      context.strokeStyle = color;
      context.lineWidth = this.options.number("Line Width") * pixel;
      context.strokeRect(-width / 2, -height / 2, width, height);
      const label = this.options.flag("Show Labels") ? labelOf(item, this.options.flag("Show Score")) : "";
      if (label) {
        context.font = `${12 * pixel}px sans-serif`;
        context.lineWidth = 3 * pixel;
        context.strokeStyle = "#000000";
        context.strokeText(label, -width / 2, -height / 2 - 3 * pixel);
        context.fillStyle = color;
        context.fillText(label, -width / 2, -height / 2 - 3 * pixel);
      }
      context.restore();
      count++;
    });
    return count;
  }

  protected override describe({ description }: Shapes): Record<string, unknown> {
    return { rectangles: description.kind === "rectangles" ? description.rectangles : [] };
  }
}

export function isRectangles(display: { kind: DisplayClass }): display is RectanglesDisplay {
  return display instanceof RectanglesDisplay;
}

function labelOf({ label, score, id }: BoxItem, withScore: boolean): string {
  const scored = withScore && score !== null ? `${label} ${Math.round(score * 100)} %` : label;
  return [scored, id && `#${id}`].filter(Boolean).join(" ");
}

/** A color for each class, the same in all messages. */
function classColor(label: string): string {
  let hash = 0;
  for (const character of label) hash = (hash * 31 + (character.codePointAt(0) as number)) % 997;
  return `#${new THREE.Color().setHSL(((hash * HUE_STEP) % 360) / 360, 0.75, 0.55).getHexString()}`;
}
