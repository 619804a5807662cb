// SPDX-License-Identifier: Apache-2.0
/** Mesh files: fetched with a limit, parsed by their ending, shared by all who name them. */

import * as THREE from "three";
import { ColladaLoader } from "three/examples/jsm/loaders/ColladaLoader.js";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
import { MTLLoader } from "three/examples/jsm/loaders/MTLLoader.js";
import { OBJLoader } from "three/examples/jsm/loaders/OBJLoader.js";
import { STLLoader } from "three/examples/jsm/loaders/STLLoader.js";

const MOST_BYTES = 200e6;
/** Text is parsed in one go, during which the page stands still. */
const MOST_TEXT_BYTES = 60e6;
const MOST_VERTICES = 6e6;
/** For what must not be asked for: it fails at once. */
export const NOTHING = "data:,";

export interface LoadedMesh {
  object: THREE.Object3D;
  /** Whether the file brought its own colours: a DAE's and a GLB's are kept, an STL has none. */
  coloured: boolean;
}

export class MeshError extends Error {}

export class Meshes {
  private readonly loading = new Map<string, Promise<LoadedMesh>>();

  /**
   * @param url Where it is.
   * @param name As the robot wrote it: its ending says what it is.
   * @returns A copy that shares its geometry with all others of this file.
   */
  async load(url: string, name: string): Promise<LoadedMesh> {
    let promise = this.loading.get(url);
    if (!promise) {
      promise = fetchMesh(url, name);
      this.loading.set(url, promise);
    }
    const { object, coloured } = await promise;
    return { object: object.clone(), coloured };
  }
}

async function fetchMesh(url: string, name: string): Promise<LoadedMesh> {
  const bytes = await fetchBytes(url, name);
  const loaded = await parse(bytes, url, name);
  let vertices = 0;
  loaded.object.traverse((part) => {
    part.userData.shared = true;
    vertices += (part as Partial<THREE.Mesh>).geometry?.getAttribute("position")?.count ?? 0;
  });
  if (vertices > MOST_VERTICES) throw new MeshError(`${short(name)} has ${vertices} vertices, too many to draw`);
  loaded.object.position.set(0, 0, 0);
  loaded.object.quaternion.identity();
  return loaded;
}

async function fetchBytes(url: string, name: string): Promise<ArrayBuffer> {
  if (!isOurs(url)) throw new MeshError(`${short(name)} is not served by this viewer`);
  const stop = new AbortController();
  const response = await fetch(url, { signal: stop.signal });
  if (!response.ok) throw new MeshError(`${short(name)}: ${(await response.text()).slice(0, 200) || response.status}`);
  const tooLarge = (size: number): never => {
    stop.abort();
    throw new MeshError(
      `${short(name)} is larger than the ${MOST_BYTES / 1e6} MB that are drawn (${Math.round(size / 1e6)} MB)`,
    );
  };
  const announced = Number(response.headers.get("Content-Length") ?? 0);
  if (announced > MOST_BYTES) tooLarge(announced);
  const parts: Uint8Array[] = [];
  let size = 0;
  const reader = response.body?.getReader();
  for (let part = await reader?.read(); part && !part.done; part = await reader?.read()) {
    size += part.value.length;
    if (size > MOST_BYTES) tooLarge(size);
    parts.push(part.value);
  }
  const bytes = new Uint8Array(size);
  let at = 0;
  for (const part of parts) {
    bytes.set(part, at);
    at += part.length;
  }
  return bytes.buffer;
}

async function parse(bytes: ArrayBuffer, url: string, name: string): Promise<LoadedMesh> {
  const manager = new THREE.LoadingManager();
  manager.setURLModifier((wanted) => (isOurs(wanted) ? wanted : NOTHING));
  const textures = ending(manager);
  const loaded = await parsed(bytes, url, name, manager);
  await textures();
  dropEmptyTextures(loaded.object);
  return loaded;
}

/** Waits until all that was asked for has come, or has failed to. */
function ending(manager: THREE.LoadingManager): () => Promise<void> {
  let busy = false;
  let end = (): void => {};
  manager.onStart = (): void => void (busy = true);
  manager.onLoad = (): void => {
    busy = false;
    end();
  };
  return () => (busy ? new Promise((resolve) => (end = resolve)) : Promise.resolve());
}

async function parsed(
  bytes: ArrayBuffer,
  url: string,
  name: string,
  manager: THREE.LoadingManager,
): Promise<LoadedMesh> {
  const kind = /\.([a-z0-9]+)$/i.exec(name.split(/[?#]/)[0] ?? "")?.[1]?.toLowerCase() ?? "";
  // What stands beside the file is served below its own address.
  const folder = url.startsWith("data:") ? "" : `${url}/`;
  switch (kind) {
    case "stl":
      return { object: new THREE.Mesh(parseStl(bytes, name)), coloured: false };
    case "dae": {
      const scene = new ColladaLoader(manager).parse(text(bytes, name), folder)?.scene;
      if (!scene) throw new MeshError(`${short(name)} is no COLLADA file`);
      return { object: scene, coloured: true };
    }
    case "obj":
      return parseObj(text(bytes, name), folder, manager);
    case "glb":
    case "gltf":
      return { object: (await new GLTFLoader(manager).parseAsync(bytes, folder)).scene, coloured: true };
    default:
      throw new MeshError(`${short(name)}: only STL, DAE, OBJ and GLB meshes can be drawn`);
  }
}

/** With the materials that stand beside it, if it names any and they are there. */
async function parseObj(source: string, folder: string, manager: THREE.LoadingManager): Promise<LoadedMesh> {
  const loader = new OBJLoader(manager);
  const library = /^mtllib[ \t]+(.+?)\s*$/m.exec(source)?.[1];
  let coloured = false;
  if (library && folder)
    try {
      const url = folder + library.replaceAll("\\", "/").split("/").map(encodeURIComponent).join("/");
      const materials = new MTLLoader(manager).parse(text(await fetchBytes(url, library), library), folder);
      materials.preload();
      loader.setMaterials(materials);
      coloured = true;
    } catch (error) {
      if (!(error instanceof MeshError)) throw error;
    }
  return { object: loader.parse(source), coloured };
}

function parseStl(bytes: ArrayBuffer, name: string): THREE.BufferGeometry {
  const binary = bytes.byteLength >= 84 && 84 + new DataView(bytes).getUint32(80, true) * 50 === bytes.byteLength;
  if (!binary) text(bytes, name);
  const geometry = new STLLoader().parse(bytes);
  if (!geometry.getAttribute("position")?.count) throw new MeshError(`${short(name)} holds no triangles`);
  // Exporters disagree on the normals; those of the triangles are always right.
  geometry.computeVertexNormals();
  return geometry;
}

function text(bytes: ArrayBuffer, name: string): string {
  if (bytes.byteLength > MOST_TEXT_BYTES)
    throw new MeshError(`${short(name)} is a text file of ${Math.round(bytes.byteLength / 1e6)} MB, too large to draw`);
  return new TextDecoder().decode(bytes);
}

/** A texture that could not be had would be drawn black. */
export function dropEmptyTextures(object: THREE.Object3D): void {
  object.traverse((part) => {
    for (const material of materialsOf(part)) {
      const textured = material as THREE.MeshPhongMaterial;
      if (!textured.map || hasPicture(textured.map)) continue;
      textured.map = null;
      textured.color.set("#b8bcc0");
      textured.needsUpdate = true;
    }
  });
}

export function hasPicture(texture: THREE.Texture): boolean {
  return Boolean((texture.image as { width?: number } | undefined)?.width);
}

export function materialsOf(object: THREE.Object3D): THREE.Material[] {
  const material = (object as Partial<THREE.Mesh>).material;
  return material ? (Array.isArray(material) ? material : [material]) : [];
}

/** Files may name anything; only this server and what is in the page itself are asked. */
function isOurs(url: string): boolean {
  if (/^(data|blob):/.test(url)) return true;
  try {
    return new URL(url, location.href).origin === location.origin && location.protocol !== "file:";
  } catch {
    return false;
  }
}

function short(name: string): string {
  const file = name.split("/").pop() ?? name;
  return file.length > 80 ? `${file.slice(0, 80)}…` : file;
}
