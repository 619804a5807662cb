// SPDX-License-Identifier: Apache-2.0
/** The pointer on controls of interactive markers: drags, clicks and menus, which are reported to the server. */

import * as THREE from "three";
import { MODE, VIEW_FACING, type Control, type InteractiveDisplay } from "./interactive";
import type { Model } from "../model/model";
import type { MenuItem, UseControl, Vector } from "../protocol/messages";
import { h } from "../util/dom";
import { toast } from "../util/toast";
import { dragPose, type DragStart } from "./control_drag";
import type { View } from "../scene/view";

const FEEDBACK_INTERVAL_MS = 50;
const CLICK_PX = 5;
const RIGHT_BUTTON = 2;

export class Interaction {
  private drag: { control: Control; start: DragStart; x: number; y: number; moved: boolean; sentAt: number } | null =
    null;
  private menu: HTMLElement | null = null;

  constructor(
    private readonly view: View,
    private readonly model: Model,
    private readonly displays: () => InteractiveDisplay[],
    private readonly canvas: HTMLCanvasElement,
  ) {
    // In the capture phase, so that a press does not also move the camera or select something.
    canvas.addEventListener("pointerdown", (event) => this.press(event), { capture: true });
    canvas.addEventListener("pointermove", (event) => this.move(event), { capture: true });
    canvas.addEventListener("pointerup", (event) => this.release(event), { capture: true });
    canvas.addEventListener("pointercancel", () => this.end());
    document.addEventListener("pointerdown", (event) => {
      if (this.menu && !this.menu.contains(event.target as Node)) this.closeMenu();
    });
    document.addEventListener("keydown", (event) => {
      if (event.key === "Escape") this.closeMenu();
    });
    view.onHover((event) => this.controlAt(event) !== null);
  }

  /** The control under the pointer, with the point on it; null if there is none. */
  private controlAt(event: PointerEvent): { control: Control; object: THREE.Object3D; point: THREE.Vector3 } | null {
    const shown = this.displays().filter(({ config }) => config.enabled);
    if (shown.length === 0) return null;
    const hit = this.view.findHit(
      event,
      shown.map(({ object }) => object),
    );
    for (let at: THREE.Object3D | null = hit?.object ?? null; at && hit; at = at.parent) {
      const control = at.userData.control as Control | undefined;
      if (control)
        return control.item.interaction_mode === MODE.none ? null : { control, object: at, point: hit.point };
    }
    return null;
  }

  private press(event: PointerEvent): void {
    if (this.view.tools.active || (event.button !== 0 && event.button !== RIGHT_BUTTON)) return;
    const found = this.controlAt(event);
    if (!found) return;
    const { control, object, point } = found;
    if (event.button === RIGHT_BUTTON) {
      if (control.shape.menu.length === 0) return;
      event.stopImmediatePropagation();
      this.openMenu(control, event);
      return;
    }
    event.stopImmediatePropagation();
    this.canvas.setPointerCapture(event.pointerId);
    const camera = this.view.renderer.camera.current;
    const forward = camera.getWorldDirection(new THREE.Vector3());
    const turn = camera.getWorldQuaternion(new THREE.Quaternion());
    const own = object.getWorldQuaternion(new THREE.Quaternion());
    const faces = control.item.orientation_mode === VIEW_FACING;
    const start: DragStart = {
      mode: control.item.interaction_mode,
      axis: faces ? forward.clone().negate() : new THREE.Vector3(1, 0, 0).applyQuaternion(own),
      position: control.marker.getWorldPosition(new THREE.Vector3()),
      quaternion: control.marker.getWorldQuaternion(new THREE.Quaternion()),
      grabbedPoint: point.clone(),
      camera: {
        right: new THREE.Vector3(1, 0, 0).applyQuaternion(turn),
        up: new THREE.Vector3(0, 1, 0).applyQuaternion(turn),
        forward,
      },
    };
    this.drag = { control, start, x: event.clientX, y: event.clientY, moved: false, sentAt: 0 };
    this.send(control, "down", point);
  }

  private move(event: PointerEvent): void {
    const { drag } = this;
    if (!drag) return;
    event.stopImmediatePropagation();
    const moved = [event.clientX - drag.x, event.clientY - drag.y] as const;
    if (!drag.moved && Math.hypot(...moved) < CLICK_PX) return;
    drag.moved = true;
    const pose = dragPose(drag.start, { ray: this.view.rayAt(event), moved, shift: event.shiftKey });
    if (!pose) return;
    const { control } = drag;
    const frame = control.marker.parent as THREE.Object3D;
    frame.updateWorldMatrix(true, false);
    const position = frame.worldToLocal(pose.position.clone());
    const turn = frame.getWorldQuaternion(new THREE.Quaternion()).invert().multiply(pose.quaternion);
    const numbers = [...position.toArray(), ...turn.normalize().toArray()];
    control.display.dragged = { name: control.shape.name, pose: numbers };
    control.display.place(control.shape.name, numbers);
    const now = performance.now();
    if (now - drag.sentAt < FEEDBACK_INTERVAL_MS) return;
    drag.sentAt = now;
    this.send(control, "pose", null, numbers);
  }

  private release(event: PointerEvent): void {
    const { drag } = this;
    if (!drag || event.button !== 0) return;
    event.stopImmediatePropagation();
    const { control, moved } = drag;
    const mode = control.item.interaction_mode;
    const pose = control.display.dragged?.pose;
    if (moved && pose) this.send(control, "pose", null, pose);
    if (!moved && mode === MODE.button) this.send(control, "button", drag.start.grabbedPoint);
    this.send(control, "up", null, pose);
    if (!moved && mode === MODE.menu) this.openMenu(control, event);
    this.end();
  }

  private end(): void {
    if (this.drag) this.drag.control.display.dragged = null;
    this.drag = null;
  }

  private send(
    { display, shape, item, marker }: Control,
    event: UseControl["event"],
    point: THREE.Vector3 | null,
    pose: readonly number[] = [...marker.position.toArray(), ...marker.quaternion.toArray()],
    menu = 0,
  ): void {
    const frame = marker.parent as THREE.Object3D;
    this.model.send({
      type: "use_control",
      id: display.id,
      marker: shape.name,
      control: item.name,
      event,
      frame: shape.frame,
      position: pose.slice(0, 3) as Vector,
      quaternion: pose.slice(3) as [number, number, number, number],
      menu,
      point: point ? (frame.worldToLocal(point.clone()).toArray() as Vector) : null,
    });
  }

  private openMenu(control: Control, event: PointerEvent): void {
    this.closeMenu();
    const entries = control.shape.menu;
    if (entries.length === 0) return;
    const choose = (entry: MenuItem): void => {
      this.closeMenu();
      if (entry.command) toast(`“${entry.title}” would run a command, which the page does not do: ${entry.command}`);
      else this.send(control, "menu", null, undefined, entry.id);
    };
    this.menu = h("div", { class: "control-menu", role: "menu" }, ...menuItems(entries, 0, choose));
    this.menu.style.left = `${event.clientX}px`;
    this.menu.style.top = `${event.clientY}px`;
    document.body.append(this.menu);
    this.menu.querySelector("button")?.focus();
  }

  private closeMenu(): void {
    this.menu?.remove();
    this.menu = null;
  }
}

/** The entries below a parent; entries with entries of their own are headings. */
function menuItems(entries: readonly MenuItem[], parent: number, choose: (entry: MenuItem) => void): HTMLElement[] {
  return entries
    .filter((entry) => entry.parent === parent && entry.id !== parent)
    .map((entry) => {
      const below = menuItems(
        entries.filter((other) => other !== entry),
        entry.id,
        choose,
      );
      if (below.length > 0) return h("div", { class: "submenu" }, h("span", {}, entry.title), ...below);
      return h("button", { type: "button", role: "menuitem", on: { click: () => choose(entry) } }, entry.title);
    });
}
