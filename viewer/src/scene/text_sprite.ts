// SPDX-License-Identifier: Apache-2.0
/** Text in the scene that faces the camera. */

import * as THREE from "three";

const TEXT_PX = 48;
const LINE_SPACING = 1.2;
/** Longer texts would make the texture larger than graphics cards allow. */
const MAX_TEXTURE_PX = 4096;

/** Returns text whose lines have a height in meters; null for blank text. */
export function textSprite(text: string, color: THREE.Color, height: number, alpha: number): THREE.Sprite | null {
  const lines = text.split("\n");
  const canvas = document.createElement("canvas");
  const context = canvas.getContext("2d");
  if (!context || !text.trim()) return null;
  const font = `600 ${TEXT_PX}px system-ui, sans-serif`;
  context.font = font;
  const width = Math.ceil(Math.max(...lines.map((line) => context.measureText(line).width))) + 8;
  canvas.width = Math.min(width, MAX_TEXTURE_PX);
  canvas.height = Math.min(Math.ceil(lines.length * TEXT_PX * LINE_SPACING), MAX_TEXTURE_PX);
  context.font = font;
  context.textBaseline = "middle";
  context.textAlign = "center";
  context.fillStyle = `#${color.getHexString()}`;
  lines.forEach((line, i) =>
    context.fillText(line, canvas.width / 2, (i + 0.5) * TEXT_PX * LINE_SPACING, canvas.width),
  );
  const texture = new THREE.CanvasTexture(canvas);
  texture.colorSpace = THREE.SRGBColorSpace;
  const material = new THREE.SpriteMaterial({ map: texture, opacity: alpha, depthWrite: false });
  const sprite = new THREE.Sprite(material);
  const meters = (height * canvas.height) / TEXT_PX;
  sprite.scale.set((meters * canvas.width) / canvas.height, meters, 1);
  return sprite;
}
