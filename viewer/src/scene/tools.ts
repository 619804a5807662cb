// SPDX-License-Identifier: Apache-2.0
/**
 * The tools of the pointer: measuring, selecting, focusing, and points and poses that are published.
 *
 * A pose is set as in RViz: press at the position, drag in the direction, release. Other buttons move the camera.
 */

import * as THREE from "three";
import { PUBLISHING_TOOLS, type PublishingTool } from "../model/tools";
import type { Vector } from "../protocol/messages";
import { h } from "../util/dom";

export type Tool = PublishingTool | "measure" | "select" | "focus";

/** A rectangle of the canvas in pixels; a click gives one without an area. */
export interface PixelBox {
  left: number;
  top: number;
  right: number;
  bottom: number;
}

export function isPublishingTool(tool: Tool | null): tool is PublishingTool {
  return tool !== null && Object.hasOwn(PUBLISHING_TOOLS, tool);
}

export interface ToolScene {
  /** The point of the ground plane z = 0 of the fixed frame at a pixel, in the scene; null if there is none. */
  groundAt(event: PointerEvent): THREE.Vector3 | null;
  /** Converts a point of the scene to the fixed frame. */
  inFixedFrame(point: THREE.Vector3): Vector;
  refresh(): void;
}

const COLOR: Record<PublishingTool, string> = { estimate: "#30a46c", goal: "#e93d82", point: "#3f7bf5" };
const MIN_LENGTH_M = 0.01;
/** Movements of the pointer below this distance are not a drag. */
const DRAG_PX = 5;

export class PointerTools {
  active: Tool | null = null;
  readonly object = new THREE.Group();
  private start: { point: THREE.Vector3; x: number; y: number } | null = null;
  private yaw = 0;
  private readonly arrow = new THREE.ArrowHelper();
  private readonly listeners: ((tool: Tool | null) => void)[] = [];
  private readonly boxListeners: ((event: PointerEvent, box: PixelBox | null) => void)[] = [];
  /** Where the drag of a rectangle began, and the rectangle. */
  private corner: { x: number; y: number } | null = null;
  private readonly box = h("div", { class: "selection-box", hidden: true, aria: { hidden: "true" } });
  private readonly poseListeners: ((tool: PublishingTool, position: Vector, yaw: number) => void)[] = [];

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly scene: ToolScene,
  ) {
    this.arrow.visible = false;
    for (const part of [this.arrow.line, this.arrow.cone]) {
      (part.material as THREE.Material).depthTest = false;
      part.renderOrder = 12;
      part.frustumCulled = false;
    }
    this.object.add(this.arrow);
    canvas.parentElement?.append(this.box);
    // In the capture phase, so that a press does not also rotate the camera or select a frame.
    canvas.addEventListener("pointerdown", (event) => this.press(event), { capture: true });
    canvas.addEventListener("pointermove", (event) => this.move(event));
    canvas.addEventListener("pointerup", (event) => this.release(event), { capture: true });
    canvas.addEventListener("pointercancel", () => this.cancel());
  }

  /** Calls the listener when another tool is chosen. */
  onChange(listener: (tool: Tool | null) => void): void {
    this.listeners.push(listener);
  }

  /** Calls the listener with each pose that the user has set, in the fixed frame. */
  onPose(listener: (tool: PublishingTool, position: Vector, yaw: number) => void): void {
    this.poseListeners.push(listener);
  }

  /** Calls the listener with each rectangle that the user has drawn with the tool for selecting; null for a click. */
  onBox(listener: (event: PointerEvent, box: PixelBox | null) => void): void {
    this.boxListeners.push(listener);
  }

  choose(tool: Tool | null): void {
    this.cancel();
    if (this.active === tool) return;
    this.active = tool;
    this.canvas.style.cursor = tool ? "crosshair" : "";
    for (const listener of this.listeners) listener(tool);
    this.scene.refresh();
  }

  toggle(tool: Tool): void {
    this.choose(this.active === tool ? null : tool);
  }

  private get setsPose(): boolean {
    return this.active === "estimate" || this.active === "goal";
  }

  private press(event: PointerEvent): void {
    if (this.active === "select" && event.button === 0 && !event.shiftKey) {
      event.stopImmediatePropagation();
      this.canvas.setPointerCapture(event.pointerId);
      this.corner = { x: event.clientX, y: event.clientY };
      return;
    }
    if (!this.setsPose || event.button !== 0) return;
    event.stopImmediatePropagation();
    const point = this.scene.groundAt(event);
    if (!point) return;
    this.canvas.setPointerCapture(event.pointerId);
    this.start = { point, x: event.clientX, y: event.clientY };
    this.yaw = 0;
    this.arrow.setColor(COLOR[this.active as PublishingTool]);
    this.point(point.clone().add(new THREE.Vector3(1, 0, 0)));
  }

  private move(event: PointerEvent): void {
    if (this.corner) this.drawBox(event);
    if (!this.start || Math.hypot(event.clientX - this.start.x, event.clientY - this.start.y) < DRAG_PX) return;
    const end = this.scene.groundAt(event);
    if (end && end.distanceTo(this.start.point) > MIN_LENGTH_M) this.point(end);
  }

  /** Shows the rectangle from the corner to the pointer, and returns it; null before the pointer has moved. */
  private drawBox(event: PointerEvent): PixelBox | null {
    const { x, y } = this.corner as { x: number; y: number };
    if (this.box.hidden && Math.hypot(event.clientX - x, event.clientY - y) < DRAG_PX) return null;
    const bounds = this.canvas.getBoundingClientRect();
    const [xs, ys] = [[x, event.clientX].sort((a, b) => a - b), [y, event.clientY].sort((a, b) => a - b)];
    const box = {
      left: (xs[0] as number) - bounds.left,
      right: (xs[1] as number) - bounds.left,
      top: (ys[0] as number) - bounds.top,
      bottom: (ys[1] as number) - bounds.top,
    };
    this.box.hidden = false;
    Object.assign(this.box.style, {
      left: `${box.left}px`,
      top: `${box.top}px`,
      width: `${box.right - box.left}px`,
      height: `${box.bottom - box.top}px`,
    });
    return box;
  }

  private release(event: PointerEvent): void {
    if (this.corner && event.button === 0) {
      event.stopImmediatePropagation();
      const box = this.drawBox(event);
      this.cancel();
      for (const listener of this.boxListeners) listener(event, box);
      return;
    }
    if (!this.start || event.button !== 0) return;
    event.stopImmediatePropagation();
    this.move(event);
    const tool = this.active as PublishingTool;
    const position = this.scene.inFixedFrame(this.start.point);
    const { yaw } = this;
    this.choose(null);
    for (const listener of this.poseListeners) listener(tool, position, yaw);
  }

  /** Draws the arrow to a point of the ground plane. */
  private point(end: THREE.Vector3): void {
    const { point } = this.start as { point: THREE.Vector3 };
    const direction = end.clone().sub(point);
    const length = direction.length();
    this.yaw = Math.atan2(direction.y, direction.x);
    this.arrow.position.copy(point);
    this.arrow.setDirection(direction.divideScalar(length));
    this.arrow.setLength(length, length * 0.3, length * 0.15);
    this.arrow.visible = true;
    this.scene.refresh();
  }

  private cancel(): void {
    this.corner = null;
    this.box.hidden = true;
    this.start = null;
    this.arrow.visible = false;
    this.scene.refresh();
  }
}
