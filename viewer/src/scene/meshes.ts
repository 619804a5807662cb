// SPDX-License-Identifier: Apache-2.0
/** Loads mesh files. Their size is limited, and displays that use the same file share it. */

import * as THREE from "three";
import { ColladaLoader } from "three/examples/jsm/loaders/ColladaLoader.js";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
import { MTLLoader } from "three/examples/jsm/loaders/MTLLoader.js";
import { OBJLoader } from "three/examples/jsm/loaders/OBJLoader.js";
import { STLLoader } from "three/examples/jsm/loaders/STLLoader.js";
import { TGALoader } from "three/examples/jsm/loaders/TGALoader.js";
import {
  binaryTriangles,
  colladaProblem,
  gltfJson,
  gltfProblem,
  MAX_PIXELS,
  MAX_VERTICES,
  objProblem,
  stlCoordinates,
  tgaProblem,
} from "./mesh_limits";

const MAX_BYTES = 200e6;
/** The page blocks while a text file is parsed. */
const MAX_TEXT_BYTES = 60e6;
/** The color of surfaces whose texture cannot be drawn. */
export const MISSING_TEXTURE = "#b8bcc0";
/** A URL that replaces forbidden ones; loading it fails immediately. */
const FORBIDDEN_URL = "data:,";

// The loaders of COLLADA files and of materials create their own loaders of TGA images.
const parseTga = TGALoader.prototype.parse;
TGALoader.prototype.parse = function (bytes: ArrayBuffer): ReturnType<typeof parseTga> {
  refuse(tgaProblem(bytes), "a TGA image");
  return parseTga.call(this, bytes);
};

export interface LoadedMesh {
  object: THREE.Object3D;
  /** Whether the file contains colors, as DAE and GLB files do; STL files do not. */
  hasColors: boolean;
  /** The names of textures that cannot be drawn, such as TIFF and DDS images, which browsers do not decode. */
  missing: readonly string[];
}

type ParsedMesh = Omit<LoadedMesh, "missing">;

export class MeshError extends Error {}

export class Meshes {
  private readonly loadingMeshes = new Map<string, Promise<LoadedMesh>>();

  /**
   * Loads a mesh.
   *
   * @param url The URL of the file.
   * @param name The name in the robot description; its extension determines the format.
   * @returns A copy that shares its geometry with all other copies of this file.
   */
  async load(url: string, name: string): Promise<LoadedMesh> {
    let promise = this.loadingMeshes.get(url);
    if (!promise) {
      promise = fetchMesh(url, name);
      this.loadingMeshes.set(url, promise);
    }
    const { object, hasColors, missing } = await promise;
    return { object: object.clone(), hasColors, missing };
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
  if (vertices > MAX_VERTICES)
    throw new MeshError(`${shortenName(name)} has ${vertices} vertices. At most ${MAX_VERTICES} can be drawn.`);
  loaded.object.position.set(0, 0, 0);
  loaded.object.quaternion.identity();
  return loaded;
}

async function fetchBytes(url: string, name: string): Promise<ArrayBuffer> {
  if (!isAllowed(url)) throw new MeshError(`${shortenName(name)} is not served by this viewer.`);
  const stop = new AbortController();
  const response = await fetch(url, { signal: stop.signal });
  if (!response.ok)
    throw new MeshError(`${shortenName(name)}: ${(await response.text()).slice(0, 200) || response.status}`);
  const tooLarge = (size: number): never => {
    stop.abort();
    throw new MeshError(
      `${shortenName(name)} has ${Math.round(size / 1e6)} MB. At most ${MAX_BYTES / 1e6} MB can be drawn.`,
    );
  };
  const declared = Number(response.headers.get("Content-Length") ?? 0);
  if (declared > MAX_BYTES) tooLarge(declared);
  const parts: Uint8Array[] = [];
  let size = 0;
  const reader = response.body?.getReader();
  for (let part = await reader?.read(); part && !part.done; part = await reader?.read()) {
    size += part.value.length;
    if (size > MAX_BYTES) tooLarge(size);
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
  const missing = new Set<string>();
  manager.setURLModifier((target) => {
    if (isAllowed(target)) return target;
    missing.add(shortenName(target));
    return FORBIDDEN_URL;
  });
  manager.onError = (target) => void (target === FORBIDDEN_URL || missing.add(shortenName(target)));
  const texturesLoaded = completion(manager);
  const loaded = await parseFormat(bytes, url, name, manager);
  await texturesLoaded();
  dropEmptyTextures(loaded.object);
  return { ...loaded, missing: [...missing] };
}

/** Returns a function that waits until all requests of a manager have succeeded or failed. */
function completion(manager: THREE.LoadingManager): () => Promise<void> {
  let busy = false;
  let end = (): void => {};
  manager.onStart = (): void => void (busy = true);
  manager.onLoad = (): void => {
    busy = false;
    end();
  };
  return () => (busy ? new Promise((resolve) => (end = resolve)) : Promise.resolve());
}

async function parseFormat(
  bytes: ArrayBuffer,
  url: string,
  name: string,
  manager: THREE.LoadingManager,
): Promise<ParsedMesh> {
  const kind = /\.([a-z0-9]+)$/i.exec(name.split(/[?#]/)[0] ?? "")?.[1]?.toLowerCase() ?? "";
  // The server provides files in the same folder below the URL of the mesh.
  const folder = url.startsWith("data:") ? "" : `${url}/`;
  switch (kind) {
    case "stl":
      return { object: new THREE.Mesh(parseStl(bytes, name)), hasColors: false };
    case "dae": {
      const document = new DOMParser().parseFromString(text(bytes, name), "application/xml");
      refuse(colladaProblem(document), name);
      makeOpaque(document);
      const source = new XMLSerializer().serializeToString(document);
      const scene = new ColladaLoader(manager).parse(source, folder)?.scene;
      if (!scene) throw new MeshError(`${shortenName(name)} is not a COLLADA file.`);
      return { object: scene, hasColors: true };
    }
    case "obj":
      return parseObj(text(bytes, name), name, folder, manager);
    case "glb":
    case "gltf":
      return parseGltf(bytes, name, folder, manager);
    default:
      throw new MeshError(
        `${shortenName(name)} has an unsupported format. Supported formats: STL, DAE, OBJ, GLB and glTF.`,
      );
  }
}

/**
 * Removes the transparency of materials, as RViz ignores it: old exporters write 0 for opaque surfaces, which means
 * invisible by the specification.
 */
function makeOpaque(document: Document): void {
  for (const name of ["transparent", "transparency"])
    for (const element of [...document.getElementsByTagName(name)]) element.remove();
}

/** Parses an OBJ file with its material library, if it exists. */
async function parseObj(
  source: string,
  name: string,
  folder: string,
  manager: THREE.LoadingManager,
): Promise<ParsedMesh> {
  refuse(objProblem(source), name);
  const loader = new OBJLoader(manager);
  const library = /^mtllib[ \t]+(.+?)\s*$/m.exec(source)?.[1];
  let colored = false;
  if (library && folder)
    try {
      const url = folder + library.replaceAll("\\", "/").split("/").map(encodeURIComponent).join("/");
      const definitions = text(await fetchBytes(url, library), library);
      refuse(objProblem(definitions), library);
      const materials = new MTLLoader(manager).parse(definitions, folder);
      materials.preload();
      loader.setMaterials(materials);
      colored = true;
    } catch (error) {
      if (!(error instanceof MeshError)) throw error;
    }
  return { object: loader.parse(source), hasColors: colored };
}

function parseStl(bytes: ArrayBuffer, name: string): THREE.BufferGeometry {
  let geometry = new THREE.BufferGeometry();
  const triangles = binaryTriangles(bytes);
  if (triangles !== null) {
    refuse(
      3 * triangles > MAX_VERTICES ? `has ${triangles} triangles; at most ${MAX_VERTICES / 3} can be drawn` : "",
      name,
    );
    const size = 84 + 50 * triangles;
    geometry = new STLLoader().parse(size === bytes.byteLength ? bytes : bytes.slice(0, size));
  } else {
    // The loader of three.js needs quadratic time for a text with many beginnings of facets and no ends.
    geometry.setAttribute("position", new THREE.BufferAttribute(stlCoordinates(text(bytes, name)), 3));
  }
  if (!geometry.getAttribute("position")?.count) throw new MeshError(`${shortenName(name)} contains no triangles.`);
  // The normals in STL files are unreliable; those of the triangles are always correct.
  geometry.computeVertexNormals();
  return geometry;
}

async function parseGltf(
  bytes: ArrayBuffer,
  name: string,
  folder: string,
  manager: THREE.LoadingManager,
): Promise<ParsedMesh> {
  refuse(gltfProblem(gltfJson(bytes)), name);
  const loader = new GLTFLoader(manager);
  // The usual one decodes images before their size can be checked.
  loader.register((parser) => {
    parser.textureLoader = new THREE.TextureLoader(manager);
    return { name: "coframe" };
  });
  return { object: (await loader.parseAsync(bytes, folder)).scene, hasColors: true };
}

function refuse(problem: string, name: string): void {
  if (problem) throw new MeshError(`${shortenName(name)} ${problem}.`);
}

function text(bytes: ArrayBuffer, name: string): string {
  if (bytes.byteLength > MAX_TEXT_BYTES)
    throw new MeshError(
      `${shortenName(name)} is a text file of ${Math.round(bytes.byteLength / 1e6)} MB. At most ${MAX_TEXT_BYTES / 1e6} MB can be drawn.`,
    );
  return new TextDecoder().decode(bytes);
}

/** Removes textures that cannot be drawn, and draws gray instead of the black of a missing color. */
function dropEmptyTextures(object: THREE.Object3D): void {
  object.traverse((part) => {
    for (const material of materialsOf(part))
      for (const [key, texture] of Object.entries(material)) {
        if (!(texture instanceof THREE.Texture) || hasImage(texture)) continue;
        Object.assign(material, { [key]: null, needsUpdate: true });
        if (key === "map") (material as THREE.MeshPhongMaterial).color.set(MISSING_TEXTURE);
      }
  });
}

/** Whether a texture has an image of a size that can be drawn; others would be decoded only to be refused. */
export function hasImage(texture: THREE.Texture): boolean {
  const { width, height } = (texture.image as { width?: number; height?: number } | undefined) ?? {};
  return Boolean(width) && (width as number) * (height ?? 1) <= MAX_PIXELS;
}

export function materialsOf(object: THREE.Object3D): THREE.Material[] {
  const material = (object as Partial<THREE.Mesh>).material;
  return material ? (Array.isArray(material) ? material : [material]) : [];
}

/** Mesh files can contain any URL. Only the server of this page and data inside the page are allowed. */
function isAllowed(url: string): boolean {
  if (/^(data|blob):/.test(url)) return true;
  try {
    return new URL(url, location.href).origin === location.origin && location.protocol !== "file:";
  } catch {
    return false;
  }
}

function shortenName(name: string): string {
  const file = name.split("/").pop() ?? name;
  return file.length > 80 ? `${file.slice(0, 80)}…` : file;
}
