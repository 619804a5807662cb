// SPDX-License-Identifier: Apache-2.0
/**
 * The entry point. While the browser still loads the page's main script, it connects to the server and creates the
 * WebGL context, which takes about as long.
 */

import "./styles/index.css";
import { drawingSize, opaqueContext } from "./scene/context";
import { byId } from "./util/dom";
import { fatal } from "./util/fatal";
import { ReplaySource, replayBlock } from "./replay/source";
import { SocketSource, socketUrl } from "./protocol/socket";
import type { Source } from "./protocol/source";

/** The build mode selects the source, so that each page contains only the code that it needs. */
function openSource(): Source {
  if (import.meta.env.MODE !== "replay") return new SocketSource(socketUrl(location));
  try {
    return new ReplaySource(replayBlock());
  } catch (error) {
    throw fatal("Cannot open this replay", error instanceof Error ? error.message : String(error));
  }
}

const source = openSource();
const canvas = byId("canvas") as HTMLCanvasElement;
Object.assign(canvas, drawingSize(canvas));
opaqueContext(canvas);
void import("./page").then(({ showPage }) => showPage(source));
