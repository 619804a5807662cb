// SPDX-License-Identifier: Apache-2.0
/** Checks of mesh files before a loader of three.js reads them: a small file must not block the page or fill its memory. */

/** The most vertices, also while a file is read. */
export const MAX_VERTICES = 6e6;
/** The most pixels of a texture; those of compressed images in the scene. */
export const MAX_PIXELS = 1 << 25;
/** The most nodes, groups, materials or primitives of a file. */
const MAX_PARTS = 100_000;
const MAX_BUFFERS = 4;
const MAX_TEXTURES = 256;
/** The most numbers of one vertex in a COLLADA file; a matrix has 16. */
const MAX_STRIDE = 16;

/** The number of triangles of a binary STL file; null for a text file. Bytes after the last triangle are ignored. */
export function binaryTriangles(bytes: ArrayBuffer): number | null {
  if (bytes.byteLength < 84) return null;
  const triangles = new DataView(bytes).getUint32(80, true);
  const size = 84 + 50 * triangles;
  if (size === bytes.byteLength) return triangles;
  const start = new TextDecoder("latin1").decode(bytes.slice(0, 10));
  return size < bytes.byteLength && !start.includes("solid") ? triangles : null;
}

/** The coordinates of the triangles in an STL text. */
export function stlCoordinates(text: string): Float32Array {
  const numbers: number[] = [];
  for (const [, x, y, z] of text.matchAll(/\bvertex\s+(\S+)\s+(\S+)\s+(\S+)/gi)) {
    numbers.push(Number(x), Number(y), Number(z));
    if (numbers.length > 3 * MAX_VERTICES) break;
  }
  return new Float32Array(numbers.slice(0, numbers.length - (numbers.length % 9)));
}

/** Why a TGA image is not read, or "": the loader of three.js allocates what the header states. */
export function tgaProblem(bytes: ArrayBuffer): string {
  if (bytes.byteLength < 18) return "is not a TGA image";
  const header = new DataView(bytes);
  const pixels = header.getUint16(12, true) * header.getUint16(14, true);
  return pixels > MAX_PIXELS ? limitProblem(pixels, MAX_PIXELS, "pixels") : "";
}

/** Why an OBJ text or its material library is not read, or "". */
export function objProblem(text: string): string {
  let vertices = 0;
  let parts = 0;
  for (const [line] of text.replaceAll("\\\n", " ").matchAll(/^[ \t]*(?:[flpogv]|usemtl|newmtl)[a-z]*\b.*/gm)) {
    const kind = line.trimStart()[0] as string;
    if ("ogun".includes(kind)) parts++;
    // A face with many corners becomes triangles, each with three vertices of its own.
    else vertices += kind === "f" ? 3 * (countWords(line) - 3) : kind === "v" ? 1 : countWords(line);
    if (parts > MAX_PARTS) return limitProblem(parts, MAX_PARTS, "groups or materials");
    if (vertices > 3 * MAX_VERTICES) return limitProblem(vertices, 3 * MAX_VERTICES, "vertices");
  }
  return "";
}

/** Why a COLLADA document is not read, or "". Removes what is not drawn: animations, physics and kinematics. */
export function colladaProblem(document: Document): string {
  if (document.doctype) return "contains a document type, which mesh files do not need";
  for (const name of ["animations", "animation_clips", "kinematics_models", "kinematics_scenes", "joints"])
    for (const library of [...document.getElementsByTagName(`library_${name}`)]) library.remove();
  for (const kind of ["physics_materials", "physics_models", "physics_scenes", "force_fields", "articulated_systems"])
    for (const library of [...document.getElementsByTagName(`library_${kind}`)]) library.remove();
  for (const accessor of document.getElementsByTagName("accessor"))
    if (!isIndex(accessor.getAttribute("stride") ?? "1", MAX_STRIDE))
      return `has a stride of ${accessor.getAttribute("stride")}`;
  let vertices = 0;
  for (const counts of document.getElementsByTagName("vcount"))
    for (const [number] of (counts.textContent ?? "").matchAll(/\S+/g)) {
      if (!isIndex(number, MAX_VERTICES)) return `has a polygon of ${number} vertices`;
      vertices += 3 * Math.max(Number(number), 1);
      if (vertices > 3 * MAX_VERTICES) return limitProblem(vertices, 3 * MAX_VERTICES, "vertices");
    }
  for (const indices of document.getElementsByTagName("p")) {
    const inputs = [...(indices.parentElement?.children ?? [])].filter(({ nodeName }) => nodeName === "input");
    if (!inputs.length || !inputs.every((input) => isIndex(input.getAttribute("offset") ?? "", MAX_STRIDE)))
      return "has indices without valid inputs";
    vertices += countWords(indices.textContent ?? "") / inputs.length;
    if (vertices > 3 * MAX_VERTICES) return limitProblem(vertices, 3 * MAX_VERTICES, "vertices");
  }
  return nodesProblem(document);
}

/** Instances of nodes are copies: each of 30 nodes with two instances of the next one gives a billion. */
function nodesProblem(document: Document): string {
  const byId = new Map<string, Element>();
  for (const node of document.getElementsByTagName("node")) byId.set(node.getAttribute("id") ?? "", node);
  const sizes = new Map<Element, number>();
  const size = (element: Element): number => {
    const known = sizes.get(element);
    if (known !== undefined) return known;
    sizes.set(element, Infinity); // A node that contains itself.
    let total = 1;
    for (const child of element.children) {
      if (child.nodeName === "node") total += size(child);
      else if (child.nodeName === "instance_node") {
        const target = byId.get((child.getAttribute("url") ?? "").slice(1));
        total += target ? size(target) : 1;
      } else if (child.nodeName.startsWith("instance_")) total++;
      if (total > MAX_PARTS) return Infinity;
    }
    sizes.set(element, total);
    return total;
  };
  let total = 0;
  for (const name of ["visual_scene", "library_nodes"])
    for (const element of document.getElementsByTagName(name)) total += size(element);
  return total > MAX_PARTS ? `has more than ${MAX_PARTS} nodes, or nodes that contain themselves` : "";
}

/** Why a glTF file is not read, or "". */
export function gltfProblem(json: unknown): string {
  const file = record(json);
  let vertices = 0;
  for (const accessor of toRecords(file.accessors)) {
    if (!isIndex(String(accessor.count), 4 * MAX_VERTICES))
      return `has an accessor of ${String(accessor.count)} values`;
    // The values of these are not in the file.
    if (accessor.bufferView === undefined || accessor.sparse) vertices += Number(accessor.count);
  }
  if (vertices > MAX_VERTICES) return limitProblem(vertices, MAX_VERTICES, "vertices");
  const nodes = toRecords(file.nodes);
  const primitives = toRecords(file.meshes).map((mesh) => toRecords(mesh.primitives).length);
  const parts =
    nodes.reduce((sum, { mesh }) => sum + 1 + (primitives[Number(mesh)] ?? 0), toRecords(file.materials).length) +
    primitives.reduce((sum, number) => sum + number, 0);
  if (parts > MAX_PARTS) return limitProblem(parts, MAX_PARTS, "nodes, primitives and materials");
  const external = toRecords(file.buffers).filter(({ uri }) => typeof uri === "string" && !uri.startsWith("data:"));
  if (external.length > MAX_BUFFERS) return limitProblem(external.length, MAX_BUFFERS, "files");
  const textures = toRecords(file.images).length;
  if (textures > MAX_TEXTURES) return limitProblem(textures, MAX_TEXTURES, "textures");
  return isForest(nodes.map(({ children }) => (Array.isArray(children) ? (children as unknown[]) : [])))
    ? ""
    : "has nodes that contain themselves or have two parents";
}

/** Whether every node has at most one parent, and none contains itself. */
function isForest(children: unknown[][]): boolean {
  const all = children.flat();
  const isChild = new Set(all);
  if (isChild.size !== all.length) return false;
  const pending: unknown[] = [...children.keys()].filter((i) => !isChild.has(i));
  let reached = 0;
  while (pending.length) {
    const below = children[Number(pending.pop())];
    if (!below) continue;
    reached++;
    for (const child of below) pending.push(child);
  }
  return reached === children.length;
}

/** The JSON part of a glTF file, text or binary; throws an error if it is damaged. */
export function gltfJson(bytes: ArrayBuffer): unknown {
  const view = new DataView(bytes);
  const isBinary = bytes.byteLength >= 20 && view.getUint32(0, false) === 0x676c5446;
  const json = isBinary ? new Uint8Array(bytes, 20, view.getUint32(12, true)) : new Uint8Array(bytes);
  return JSON.parse(new TextDecoder().decode(json));
}

function record(value: unknown): Record<string, unknown> {
  return typeof value === "object" && value !== null ? (value as Record<string, unknown>) : {};
}

function toRecords(value: unknown): Record<string, unknown>[] {
  return Array.isArray(value) ? value.map(record) : [];
}

/** The number of words that whitespace separates. */
function countWords(text: string): number {
  let number = 0;
  let inWord = false;
  for (let i = 0; i < text.length; i++) {
    const isSpace = text.charCodeAt(i) <= 32;
    if (!isSpace && !inWord) number++;
    inWord = !isSpace;
  }
  return number;
}

function isIndex(text: string, max: number): boolean {
  return /^\d{1,9}$/.test(text.trim()) && Number(text) <= max;
}

function limitProblem(count: number, max: number, what: string): string {
  return `has ${Math.round(count)} ${what}; at most ${max} can be read`;
}
