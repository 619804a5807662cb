// SPDX-License-Identifier: Apache-2.0
/** The nodes that a program has added to the scene: placed in frames or below each other, and clickable. */

import * as THREE from "three";
import type { Model } from "../model/model";
import type { NodeGeometry, SceneNode } from "../protocol/messages";
import type { Theme } from "../util/theme";
import type { FramePoses } from "./frame_poses";
import { drawNode } from "./node_drawings";
import type { Hit } from "./picking";
import type { View } from "./view";

interface Entry {
  node: SceneNode;
  geometry: NodeGeometry | null;
  drawing: THREE.Object3D | null;
}

/** Where the nodes with one name are. Several of them differ in their times, and one of them is shown. */
interface Place {
  name: string;
  entries: Map<number, Entry>;
  current: Entry | null;
  /** At the frame of the pose, or at zero in the inner group of the node above. */
  outer: THREE.Group;
  /** At the pose; the drawings and the nodes below are inside. */
  inner: THREE.Group;
  /** Why nothing is drawn, or "". */
  problem: string;
}

export interface NodeRow {
  name: string;
  kind: string;
  hidden: boolean;
  problem: string;
}

/** Larger coordinates are ignored when fitting the camera, because one outlier would make everything else tiny. */
const MAX_FIT_COORDINATE_M = 1e4;

export class NodesView {
  readonly object = new THREE.Group();
  private readonly places = new Map<string, Place>();
  private readonly names = new Map<number, string>();
  /** Names of nodes that the user has hidden in this page. */
  private readonly hiddenNames = new Set<string>();
  private readonly listeners: (() => void)[] = [];

  constructor(
    private readonly model: Model,
    private readonly view: View,
    private readonly theme: Theme,
  ) {
    view.renderer.scene.add(this.object);
    model.on("hello", () => this.clear());
    model.on("node", (node) => this.setNode(node));
    model.on("geometry", (geometry) => this.setGeometry(geometry));
    model.on("nodes_removed", ({ ids }) => this.remove(ids));
    view.onPoses((framePoses, update) => this.place(framePoses, update.time));
    view.addBounds(() => this.bounds());
    view.addSurfaces(() => [this.object]);
    view.onClick((event) => this.click(event));
    view.onHover((event) => this.clickableAt(event) !== null);
    theme.onChange(() => {
      for (const place of this.places.values()) for (const entry of place.entries.values()) this.redraw(place, entry);
    });
  }

  /** Calls the listener when nodes were added, removed or renamed, or their problems have changed. */
  onChange(listener: () => void): void {
    this.listeners.push(listener);
  }

  /** The nodes, in the order of their names. */
  rows(): NodeRow[] {
    return [...this.places.values()]
      .sort((a, b) => (a.name < b.name ? -1 : 1))
      .map((place) => ({
        name: place.name,
        kind: place.current?.node.kind ?? "",
        hidden: this.hiddenNames.has(place.name),
        problem: place.problem,
      }));
  }

  setHidden(name: string, hidden: boolean): void {
    if (hidden) this.hiddenNames.add(name);
    else this.hiddenNames.delete(name);
    this.notifyChange();
  }

  private setNode(node: SceneNode): void {
    const place = this.places.get(node.name) ?? this.addPlace(node.name);
    const known = place.entries.get(node.id);
    const before = known?.node;
    const entry = known ?? { node, geometry: null, drawing: null };
    entry.node = node;
    if (!before || APPEARANCE.some((key) => JSON.stringify(before[key]) !== JSON.stringify(node[key])))
      this.redraw(place, entry);
    if (known) {
      this.view.refresh();
      return;
    }
    place.entries.set(node.id, entry);
    this.names.set(node.id, node.name);
    this.notifyChange();
  }

  private setGeometry(geometry: NodeGeometry): void {
    const place = this.places.get(this.names.get(geometry.id) ?? "");
    const entry = place?.entries.get(geometry.id);
    if (!place || !entry) return;
    entry.geometry = geometry;
    this.redraw(place, entry);
    this.view.refresh();
  }

  private remove(ids: readonly number[]): void {
    for (const id of ids) {
      const place = this.places.get(this.names.get(id) ?? "");
      const entry = place?.entries.get(id);
      this.names.delete(id);
      if (!place || !entry) continue;
      discard(entry);
      place.entries.delete(id);
      if (place.entries.size > 0) continue;
      place.outer.removeFromParent();
      this.places.delete(place.name);
    }
    this.notifyChange();
  }

  private clear(): void {
    this.remove([...this.names.keys()]);
  }

  private addPlace(name: string): Place {
    const [outer, inner] = [new THREE.Group(), new THREE.Group()];
    const place: Place = { name, entries: new Map(), current: null, outer, inner, problem: "" };
    outer.add(inner);
    inner.userData.node = place;
    this.places.set(name, place);
    return place;
  }

  private redraw(place: Place, entry: Entry): void {
    discard(entry);
    entry.drawing = drawNode(entry.node, entry.geometry, this.theme.palette());
    if (!entry.drawing) return;
    entry.drawing.visible = entry === place.current;
    place.inner.add(entry.drawing);
  }

  private notifyChange(): void {
    this.view.refresh();
    for (const listener of this.listeners) listener();
  }

  /** Chooses the nodes of a time, and places them. */
  private place(framePoses: FramePoses, time: number): void {
    let rowsChanged = false;
    for (const place of this.places.values()) {
      const current = entryAt(place.entries, time);
      if (current === place.current) continue;
      rowsChanged = true;
      place.current = current;
      for (const entry of place.entries.values()) if (entry.drawing) entry.drawing.visible = entry === current;
    }
    for (const place of this.places.values()) {
      const problem = this.placeOne(place, framePoses);
      rowsChanged ||= problem !== place.problem;
      place.problem = problem;
    }
    if (rowsChanged) for (const listener of this.listeners) listener();
  }

  /** Places a node. Returns why it cannot be placed, or "". */
  private placeOne(place: Place, framePoses: FramePoses): string {
    const { outer, inner, current } = place;
    const above = this.nearestAncestor(place.name);
    // A node in its own frame is not inside the node above it, but is hidden with it.
    const inside = current?.node.frame === null ? (above?.inner ?? this.object) : this.object;
    if (outer.parent !== inside) inside.add(outer);
    outer.visible = this.isShown(place);
    if (!current) return "";
    const { node } = current;
    inner.position.fromArray(node.pose);
    inner.quaternion.fromArray(node.pose, 3);
    if (inside !== this.object) {
      outer.position.set(0, 0, 0);
      outer.quaternion.identity();
      return node.problem;
    }
    const known = moveTo(outer, node.frame || this.model.fixed, this.model, framePoses);
    outer.visible &&= known;
    return known ? node.problem : `no frame named “${node.frame ?? ""}”`;
  }

  /** The nearest node above a name. */
  private nearestAncestor(name: string): Place | null {
    for (let end = name.lastIndexOf("/"); end > 0; end = name.lastIndexOf("/", end - 1)) {
      const place = this.places.get(name.slice(0, end));
      if (place) return place;
    }
    return null;
  }

  private isShown(place: Place): boolean {
    for (let at: Place | null = place; at; at = this.nearestAncestor(at.name))
      if (!at.current?.node.visible || this.hiddenNames.has(at.name)) return false;
    return true;
  }

  private bounds(): THREE.Box3 {
    const box = new THREE.Box3();
    for (const { outer, inner } of this.places.values()) {
      if (!isVisible(outer)) continue;
      for (const drawing of inner.children) {
        if (!drawing.visible || drawing instanceof THREE.Group) continue;
        drawing.updateWorldMatrix(true, false);
        const own = new THREE.Box3().setFromObject(drawing);
        if ([...own.min, ...own.max].every((value) => Math.abs(value) < MAX_FIT_COORDINATE_M)) box.union(own);
      }
    }
    return box;
  }

  /** The clickable node under the pointer, with the point that is hit; null if there is none. */
  private clickableAt(event: PointerEvent): { place: Place; node: SceneNode; hit: Hit } | null {
    if (![...this.places.values()].some((place) => place.current?.node.clickable)) return null;
    const hit = this.view.findHit(event, [this.object]);
    const place = hit?.object.parent?.userData.node as Place | undefined;
    const node = place?.current?.node;
    return hit && place && node?.clickable ? { place, node, hit } : null;
  }

  /** Reports a click on a clickable node, and returns whether it was one. */
  private click(event: PointerEvent): boolean {
    const clicked = this.clickableAt(event);
    if (!clicked) return false;
    const { place, node, hit } = clicked;
    this.model.send({
      type: "click",
      node: node.id,
      frame: this.model.fixed,
      position: this.view.inFixedFrame(hit.point),
      local: place.inner.worldToLocal(hit.point.clone()).toArray(),
      index: INDEXED.has(node.kind) ? hit.index : null,
    });
    return true;
  }

  /** What is drawn, for tests: centers and sizes of boxes, in meters in the fixed frame. */
  probe(): Record<string, unknown> {
    const { origin } = this.view.framePoses;
    const rows = [...this.places.values()].map((place) => {
      const drawing = place.current?.drawing ?? null;
      if (drawing) drawing.updateWorldMatrix(true, false);
      // Exact boxes of turned objects need all vertices; those of lines are not in an attribute of this kind.
      const exact = place.current?.node.kind !== "lines";
      const box = drawing ? new THREE.Box3().setFromObject(drawing, exact) : new THREE.Box3();
      const center = box.getCenter(new THREE.Vector3()).toArray();
      return [
        place.name,
        {
          kind: place.current?.node.kind,
          visible: drawing !== null && isVisible(drawing),
          center: center.map((value, k) => value + (origin[k] as number)),
          size: box.getSize(new THREE.Vector3()).toArray(),
          vertices: (place.current?.geometry?.vertices.length ?? 0) / 3,
          problem: place.problem,
        },
      ];
    });
    return Object.fromEntries(rows) as Record<string, unknown>;
  }
}

/** The kinds of nodes of which a part can be clicked. */
const INDEXED = new Set<SceneNode["kind"]>(["points", "lines", "mesh"]);
/** What changes the drawing of a node. */
const APPEARANCE = ["kind", "color", "opacity", "size", "text", "wireframe"] as const;

/** The last of the nodes with one name that is shown at a time; without a time the last one of all. */
function entryAt(entries: ReadonlyMap<number, Entry>, time: number): Entry | null {
  let found: Entry | null = null;
  for (const entry of entries.values()) {
    const own = entry.node.time ?? -Infinity;
    if (own <= time || Number.isNaN(time)) if (!found || own >= (found.node.time ?? -Infinity)) found = entry;
  }
  return found;
}

/** Moves a group to a frame. Returns whether the pose of the frame is known. */
function moveTo(group: THREE.Group, frame: string, model: Model, framePoses: FramePoses): boolean {
  const i = model.forest.index.get(frame) ?? -1;
  if (i >= 0 && i < framePoses.count && Number.isFinite(framePoses.positions[i * 3] as number)) {
    group.position.fromArray(framePoses.positions, i * 3);
    group.quaternion.fromArray(framePoses.quaternions, i * 4);
    return true;
  }
  if (frame !== model.fixed) return false;
  // The fixed frame may not exist yet, or have no transforms.
  group.position.set(...framePoses.origin).negate();
  group.quaternion.identity();
  return true;
}

function isVisible(object: THREE.Object3D): boolean {
  for (let at: THREE.Object3D | null = object; at; at = at.parent) if (!at.visible) return false;
  return object.parent !== null;
}

/** Removes what is drawn of a node and frees its resources. */
function discard(entry: Entry): void {
  const { drawing } = entry;
  entry.drawing = null;
  if (!drawing) return;
  drawing.removeFromParent();
  const { geometry, material } = drawing as THREE.Mesh<THREE.BufferGeometry, THREE.MeshBasicMaterial>;
  // All sprites share one geometry.
  if (!(drawing instanceof THREE.Sprite)) geometry.dispose();
  material.map?.dispose();
  material.dispose();
}
