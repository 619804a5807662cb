// SPDX-License-Identifier: Apache-2.0
/**
 * What runs first, while the page itself is still being read: the server is asked for the frames, and the browser for
 * the canvas's context, which takes it as long.
 */

import "./styles/index.css";
import { drawingSize, opaqueContext } from "./scene/context";
import { byId } from "./util/dom";
import { fatal } from "./util/fatal";
import { ReplaySource, replayBlock } from "./replay/source";
import { SocketSource, socketUrl } from "./protocol/socket";
import type { Source } from "./protocol/source";

/** Which of the two it is is known when the page is built: neither holds what only the other needs. */
function openSource(): Source {
  if (import.meta.env.MODE !== "replay") return new SocketSource(socketUrl(location));
  try {
    return new ReplaySource(replayBlock());
  } catch (error) {
    throw fatal("This replay cannot be played", error instanceof Error ? error.message : String(error));
  }
}

const source = openSource();
const canvas = byId("canvas") as HTMLCanvasElement;
Object.assign(canvas, drawingSize(canvas));
opaqueContext(canvas);
void import("./page").then(({ showPage }) => showPage(source));
