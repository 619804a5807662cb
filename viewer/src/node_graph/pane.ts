// SPDX-License-Identifier: Apache-2.0
/** The graph of nodes and topics. Drag to move it, use the wheel to zoom, click a topic to inspect it. */

import type { Pane } from "../dock/dock";
import type { Model } from "../model/model";
import type { NodeGraph } from "../protocol/messages";
import { h, iconButton, setText, shorten } from "../util/dom";
import { storeValue, loadStored } from "../util/storage";
import { arrange, type Arrow, type Box } from "./layout";

const SVG = "http://www.w3.org/2000/svg";
const ZOOM_STEP = 1.25;
const CLICK_PX = 4;
const MIN_SCALE = 0.05;
const MAX_SCALE = 4;

export class GraphPane implements Pane {
  readonly id = "graph";
  readonly title = "Nodes and topics";
  readonly body: HTMLElement;
  readonly controls: HTMLElement[];
  private readonly note = h("p", { class: "graph-note", id: "graph-note", role: "status" });
  private readonly svg = shape("svg", { class: "graph", role: "group", "aria-label": "Nodes and topics" });
  private readonly content = shape("g", {});
  private readonly search = h("input", { type: "search", placeholder: "Filter", aria: { label: "Node or topic" } });
  private graph: NodeGraph | null = null;
  private isOpen = false;
  private showsInfrastructure = loadStored("graph-infrastructure", false);
  private size = { width: 1, height: 1 };
  private view = { x: 0, y: 0, scale: 1 };
  /** Whether the user has moved or zoomed the graph. */
  private isMoved = false;

  constructor(private readonly model: Model) {
    const all = h("input", { type: "checkbox", checked: this.showsInfrastructure });
    all.addEventListener("change", () => {
      this.showsInfrastructure = all.checked;
      storeValue("graph-infrastructure", all.checked);
      this.draw();
    });
    this.search.addEventListener("input", () => this.draw());
    this.controls = [
      h(
        "label",
        { class: "graph-option", title: "/rosout, /parameter_events, hidden topics, the viewer" },
        all,
        "infrastructure",
      ),
      this.search,
      iconButton("plus", "Zoom in", () => this.zoom(ZOOM_STEP)),
      iconButton("minus", "Zoom out", () => this.zoom(1 / ZOOM_STEP)),
      iconButton("fit", "Show the whole graph", () => this.fit()),
    ];
    this.svg.append(arrowHead("arrow"), arrowHead("arrow-problem"), this.content);
    this.body = h("div", { class: "node-graph" }, this.note, this.svg as unknown as HTMLElement);
    this.listen();
    model.on("graph", (graph) => {
      this.graph = graph;
      this.draw();
    });
    model.on("hello", () => this.request());
    new ResizeObserver(() => (this.isMoved ? this.place() : this.fit())).observe(this.svg);
  }

  open(): void {
    this.isOpen = true;
    this.graph = null;
    this.model.countGraphUsers(true);
  }

  close(): void {
    this.isOpen = false;
    this.graph = null;
    this.content.replaceChildren();
    this.model.countGraphUsers(false);
  }

  private request(): void {
    if (!this.isOpen || !this.model.hello) return;
    this.graph = null;
    this.model.send({ type: "graph", shown: true });
  }

  private draw(): void {
    if (!this.isOpen || !this.graph) return;
    const arranged = arrange(this.graph, { infrastructure: this.showsInfrastructure, text: this.search.value });
    const problems = arranged.arrows.filter((arrow) => arrow.hasProblem).length;
    const facts = [
      this.graph.text || (arranged.boxes.length ? "" : "Nothing to show."),
      problems
        ? `${problems} ${problems === 1 ? "endpoint does" : "endpoints do"} not match: see the marked lines.`
        : "",
      arranged.omitted ? `${arranged.omitted} parts are not shown; use the filter.` : "",
    ];
    setText(this.note, facts.filter(Boolean).join(" "));
    this.size = { width: arranged.width, height: arranged.height };
    this.content.replaceChildren(
      ...arranged.arrows.map((arrow) => this.arrow(arrow)),
      ...arranged.boxes.map((box) => this.box(box)),
    );
    if (this.isMoved) this.place();
    else this.fit();
  }

  private box(box: Box): SVGElement {
    const { x, y, width, height, isTopic, name, detail } = box;
    const radius = isTopic ? height / 2 : 4;
    const group = shape("g", {
      class: `graph-box ${isTopic ? "is-topic" : "is-node"}`,
      transform: `translate(${x - width / 2} ${y - height / 2})`,
      "data-problem": String(box.hasProblem),
      "data-name": name.slice(0, 300),
    });
    const title = shape("title", {});
    title.textContent = `${name}\n${detail}`.trim().slice(0, 500);
    const text = shape("text", { x: width / 2, y: height / 2 + 4, "text-anchor": "middle" });
    text.textContent = shorten(name, 42);
    group.append(title, shape("rect", { width, height, rx: radius }), text);
    if (isTopic) {
      group.setAttribute("tabindex", "0");
      group.setAttribute("role", "button");
      group.setAttribute("aria-label", `Inspect ${shorten(name, 120)}`);
      group.addEventListener("click", () => this.model.emit("inspect", name));
      group.addEventListener("keydown", (event) => {
        if (event.key !== "Enter" && event.key !== " ") return;
        event.preventDefault();
        event.stopPropagation();
        this.model.emit("inspect", name);
      });
    }
    return group;
  }

  private arrow({ points, detail, hasProblem }: Arrow): SVGElement {
    const line = shape("path", {
      class: "graph-arrow",
      d: points.map(({ x, y }, i) => `${i ? "L" : "M"}${x.toFixed(1)} ${y.toFixed(1)}`).join(""),
      "data-problem": String(hasProblem),
      "marker-end": `url(#${hasProblem ? "arrow-problem" : "arrow"})`,
    });
    const title = shape("title", {});
    title.textContent = detail.slice(0, 500);
    line.append(title);
    return line;
  }

  private fit(): void {
    const { clientWidth, clientHeight } = this.svg;
    if (!clientWidth || !clientHeight) return;
    const { width, height } = this.size;
    const scale = Math.min(1.2, clientWidth / width, clientHeight / height);
    this.view = { x: (clientWidth - width * scale) / 2, y: (clientHeight - height * scale) / 2, scale };
    this.isMoved = false;
    this.place();
  }

  private zoom(factor: number, x = this.svg.clientWidth / 2, y = this.svg.clientHeight / 2): void {
    const scale = Math.max(MIN_SCALE, Math.min(MAX_SCALE, this.view.scale * factor));
    const ratio = scale / this.view.scale;
    this.view = { x: x - (x - this.view.x) * ratio, y: y - (y - this.view.y) * ratio, scale };
    this.isMoved = true;
    this.place();
  }

  private place(): void {
    const { x, y, scale } = this.view;
    this.content.setAttribute("transform", `translate(${x} ${y}) scale(${scale})`);
  }

  private listen(): void {
    const { svg } = this;
    svg.addEventListener(
      "wheel",
      (event) => {
        event.preventDefault();
        const bounds = svg.getBoundingClientRect();
        this.zoom(ZOOM_STEP ** (-event.deltaY / 100), event.clientX - bounds.left, event.clientY - bounds.top);
      },
      { passive: false },
    );
    svg.addEventListener("pointerdown", (event) => {
      const begin = { ...this.view };
      const move = (at: PointerEvent): void => {
        const [dx, dy] = [at.clientX - event.clientX, at.clientY - event.clientY];
        if (!this.isMoved && Math.hypot(dx, dy) < CLICK_PX) return;
        this.isMoved = true;
        this.view = { ...begin, x: begin.x + dx, y: begin.y + dy };
        this.place();
      };
      const end = (): void => {
        removeEventListener("pointermove", move);
        removeEventListener("pointerup", end);
      };
      addEventListener("pointermove", move);
      addEventListener("pointerup", end);
    });
  }
}

function shape<K extends keyof SVGElementTagNameMap>(
  name: K,
  attributes: Record<string, string | number>,
): SVGElementTagNameMap[K] {
  const element = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, String(value));
  return element;
}

function arrowHead(id: string): SVGElement {
  const marker = shape("marker", {
    ...{ id, viewBox: "0 0 8 8", refX: 7, refY: 4, markerWidth: 7, markerHeight: 7, orient: "auto" },
  });
  marker.append(shape("path", { d: "M0 0.5 8 4 0 7.5z", class: id }));
  return marker;
}
