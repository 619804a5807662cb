// SPDX-License-Identifier: Apache-2.0
/** The InteractiveMarkers display: markers with controls, which `control_drag.ts` moves. */

import * as THREE from "three";
import type { Meshes } from "../scene/meshes";
import type { ControlItem, DisplayMessage, InteractiveShape, Shapes } from "../protocol/messages";
import { axesGeometry } from "../scene/frames";
import { textSprite } from "../scene/text_sprite";
import { axesMaterial } from "./axes";
import { arrowGeometry } from "./arrows";
import { MessageDisplay, type Context, type DisplayConfig } from "./display";
import { markerObject, type MarkerTools } from "./markers";
import { makeSolidMaterial } from "./vectors";

/** The modes of controls, as in visualization_msgs/InteractiveMarkerControl. */
export const MODE = {
  none: 0,
  menu: 1,
  button: 2,
  moveAxis: 3,
  movePlane: 4,
  rotateAxis: 5,
  moveRotate: 6,
  move3d: 7,
  rotate3d: 8,
  moveRotate3d: 9,
} as const;
const FIXED = 1;
export const VIEW_FACING = 2;
/** The sizes of controls without markers, as parts of the scale; as in the library of the servers. */
const [RING_INNER, RING_OUTER, ARROW_BEGIN, ARROW_LENGTH] = [0.5, 0.65, 0.5, 0.25];
const TEXT_HEIGHT_M = 0.15;
const DEFAULT_ALPHA = 0.7;

/** A control in the scene. */
export interface Control {
  display: InteractiveDisplay;
  shape: InteractiveShape;
  item: ControlItem;
  /** The object with the pose of the marker in its frame; its parent has the pose of the frame. */
  marker: THREE.Object3D;
}

export class InteractiveDisplay extends MessageDisplay<Shapes, "InteractiveMarkers"> {
  /** The marker that the user drags, whose pose on the page is newer than that of the server. */
  dragged: { name: string; pose: number[] } | null = null;

  constructor(
    id: number,
    config: DisplayConfig,
    context: Context,
    private readonly meshes: Meshes,
  ) {
    super(id, config, context);
  }

  override receive(message: DisplayMessage): void {
    super.receive(message);
    if (message.kind !== "shapes" || message.description.kind !== "interactive") return;
    if (message.description.name === this.dragged?.name) this.place(this.dragged.name, this.dragged.pose);
  }

  /** Moves a marker to a pose in its frame. */
  place(name: string, pose: readonly number[]): void {
    for (const { object, message } of this.drawnMessages.values()) {
      if (message.description.kind !== "interactive" || message.description.name !== name) continue;
      const marker = object.children[0] as THREE.Object3D;
      marker.position.fromArray(pose);
      marker.quaternion.fromArray(pose, 3);
      for (const control of marker.children) orient(control);
    }
    this.context.redraw();
  }

  protected build({ description, payload }: Shapes): THREE.Object3D {
    const group = new THREE.Group();
    if (description.kind !== "interactive") return group;
    const pose = description.pose.map((value) => value ?? NaN);
    if (!pose.every(Number.isFinite)) return group;
    const marker = new THREE.Group();
    marker.position.fromArray(pose);
    marker.quaternion.fromArray(pose, 3).normalize();
    group.add(marker);
    for (const item of description.controls) {
      const control = this.control(description, item, payload);
      control.userData.control = { display: this, shape: description, item, marker } satisfies Control;
      marker.add(control);
      orient(control);
    }
    this.addDecorations(marker, description);
    return group;
  }

  protected override describe({ description }: Shapes, object: THREE.Object3D): Record<string, unknown> {
    if (description.kind !== "interactive" || !object.children[0]) return {};
    const marker = object.children[0];
    object.updateMatrixWorld();
    const controls = marker.children.flatMap((part) => {
      const control = part.userData.control as Control | undefined;
      if (!control) return [];
      const parts = part.children.map((child) =>
        this.toFixedFrame(new THREE.Box3().setFromObject(child).getCenter(new THREE.Vector3())),
      );
      return [{ name: control.item.name, mode: control.item.interaction_mode, parts }];
    });
    return { name: description.name, pose: [...marker.position.toArray(), ...marker.quaternion.toArray()], controls };
  }

  private control(shape: InteractiveShape, item: ControlItem, payload: Float32Array): THREE.Group {
    const group = new THREE.Group();
    const tools: MarkerTools = {
      meshes: this.meshes,
      redraw: () => this.context.redraw(),
      problem: (text) => (this.status = { state: "error", text }),
    };
    const turn = item.orientation_mode === VIEW_FACING ? new THREE.Quaternion() : quaternion(item).invert();
    for (const marker of item.markers) {
      const object = markerObject(marker, payload, tools);
      if (!object) continue;
      // The poses of markers are relative to the interactive marker; the group is turned like the control.
      const turned = new THREE.Group();
      turned.quaternion.copy(turn);
      turned.add(object);
      group.add(turned);
    }
    if (item.markers.length === 0) this.addDefault(group, shape, item);
    if (item.orientation_mode === VIEW_FACING) faceCamera(group);
    return group;
  }

  /** Adds what a control without markers looks like. */
  private addDefault(group: THREE.Group, shape: InteractiveShape, item: ControlItem): void {
    const scale = shape.scale ?? 1;
    const direction = new THREE.Vector3(1, 0, 0).applyQuaternion(quaternion(item)).toArray().map(Math.abs);
    const color = `#${new THREE.Color().setRGB(...(direction as [number, number, number])).getHexString()}`;
    const look = (): THREE.Material => {
      const made = makeSolidMaterial(color, this.options.flag("Enable Transparency") ? DEFAULT_ALPHA : 1);
      made.side = THREE.DoubleSide;
      return made;
    };
    const mode = item.interaction_mode;
    if (mode === MODE.moveAxis)
      for (const side of [1, -1]) {
        const length = scale * ARROW_LENGTH;
        const arrow = { shaftLength: length * 0.4, shaftRadius: scale * 0.03, headLength: length * 0.6 };
        const mesh = new THREE.Mesh(arrowGeometry({ ...arrow, headRadius: scale * 0.08 }), look());
        mesh.position.x = side * scale * ARROW_BEGIN;
        if (side < 0) mesh.rotation.z = Math.PI;
        group.add(mesh);
      }
    else if (mode === MODE.movePlane || mode === MODE.rotateAxis || mode === MODE.moveRotate) {
      const ring = new THREE.RingGeometry(scale * RING_INNER, scale * RING_OUTER, 48).rotateY(Math.PI / 2);
      group.add(new THREE.Mesh(ring, look()));
    } else if (mode !== MODE.none) group.add(new THREE.Mesh(new THREE.SphereGeometry(scale * 0.15, 24, 16), look()));
  }

  private addDecorations(marker: THREE.Group, shape: InteractiveShape): void {
    const scale = shape.scale ?? 1;
    if (this.options.flag("Show Axes")) {
      const axes = new THREE.Mesh(axesGeometry(this.context.palette(), 0.06), axesMaterial(1));
      axes.scale.setScalar(scale * 0.5);
      marker.add(axes);
    }
    if (!this.options.flag("Show Descriptions") || !shape.description) return;
    const text = textSprite(shape.description, new THREE.Color(this.context.palette().measure), TEXT_HEIGHT_M, 1);
    if (!text) return;
    text.position.z = scale * 0.75;
    text.raycast = (): void => {};
    marker.add(text);
  }
}

/** The orientation of a control; the library of the servers does not always normalize it. */
export function quaternion({ orientation }: ControlItem): THREE.Quaternion {
  const [x, y, z, w] = orientation.map((value) => value ?? 0) as [number, number, number, number];
  const found = new THREE.Quaternion(x, y, z, w);
  return found.length() > 0 ? found.normalize() : found.identity();
}

/** Sets the orientation of a control relative to its marker: a fixed one does not turn with the marker. */
function orient(control: THREE.Object3D): void {
  const found = control.userData.control as Control | undefined;
  if (!found || found.item.orientation_mode === VIEW_FACING) return;
  control.quaternion.copy(quaternion(found.item));
  if (found.item.orientation_mode === FIXED) control.quaternion.premultiply(found.marker.quaternion.clone().invert());
}

/** Turns a control so that its x axis points to the camera, whenever a part of it is drawn. */
function faceCamera(group: THREE.Group): void {
  group.traverse((part) => {
    if (!(part instanceof THREE.Mesh)) return;
    part.onBeforeRender = (_renderer, _scene, camera): void => {
      const parent = group.parent?.getWorldQuaternion(new THREE.Quaternion()) ?? new THREE.Quaternion();
      const own = camera.getWorldQuaternion(new THREE.Quaternion());
      // The camera looks along -z, with y up: x of the control points to it, z up.
      const turn = new THREE.Quaternion().setFromRotationMatrix(
        new THREE.Matrix4().set(0, 1, 0, 0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 0, 0, 1),
      );
      group.quaternion.copy(parent.invert()).multiply(own).multiply(turn);
      group.updateMatrixWorld(true);
    };
  });
}
