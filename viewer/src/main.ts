// SPDX-License-Identifier: Apache-2.0
/**
 * The entry point of the live page. While the browser still loads the page's main script, it connects to the server and
 * creates the WebGL context, which takes about as long.
 */

import "./styles/index.css";
import "uplot/dist/uPlot.min.css";
import { drawingSize, opaqueContext } from "./scene/context";
import { byId } from "./util/dom";
import { SocketSource, socketUrl } from "./protocol/socket";

const source = new SocketSource(socketUrl(location));
const canvas = byId("canvas") as HTMLCanvasElement;
Object.assign(canvas, drawingSize(canvas));
opaqueContext(canvas);
void import("./page").then(({ showPage }) => showPage(source));
