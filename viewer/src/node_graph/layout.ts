// SPDX-License-Identifier: Apache-2.0
/** Chooses what the graph shows, and where it is; dagre arranges it in columns from publishers to subscriptions. */

import { graphlib, layout } from "@dagrejs/dagre";
import type { GraphLink, NodeGraph } from "../protocol/messages";

export interface GraphOptions {
  infrastructure: boolean;
  /** A part of a name of a node or a topic, or "". */
  text: string;
}

/** A node or a topic. The center and the size are in pixels. */
export interface Box {
  key: string;
  name: string;
  isTopic: boolean;
  detail: string;
  hasProblem: boolean;
  x: number;
  y: number;
  width: number;
  height: number;
}

export interface Arrow {
  from: string;
  to: string;
  detail: string;
  hasProblem: boolean;
  points: readonly { x: number; y: number }[];
}

export interface GraphLayout {
  boxes: Box[];
  arrows: Arrow[];
  width: number;
  height: number;
  /** The number of boxes that exist but are not shown. */
  omitted: number;
}

const CHARACTER_PX = 7;
const BOX_HEIGHT = 26;
const MAX_CHARACTERS = 42;
/** More would take dagre several seconds. */
const MAX_BOXES = 400;

/** The links that pass the options, without those of hidden nodes and topics. */
export function chosenLinks(graph: NodeGraph, { infrastructure, text }: GraphOptions): GraphLink[] {
  const wanted = text.toLowerCase();
  return graph.links.filter((link) => {
    const [node, topic] = [graph.nodes[link.node], graph.topics[link.topic]];
    if (!node || !topic) return false;
    if (!infrastructure && (node.infrastructure || topic.infrastructure)) return false;
    return node.name.toLowerCase().includes(wanted) || topic.topic.toLowerCase().includes(wanted);
  });
}

export function arrange(graph: NodeGraph, options: GraphOptions): GraphLayout {
  const links = chosenLinks(graph, options);
  const boxes = new Map<string, Box>();
  let omitted = 0;
  const box = (key: string, name: string, isTopic: boolean, detail: string): Box | null => {
    const known = boxes.get(key);
    if (known) return known;
    if (boxes.size >= MAX_BOXES) {
      omitted++;
      return null;
    }
    const width = 20 + CHARACTER_PX * Math.min(name.length, MAX_CHARACTERS);
    const made = { key, name, isTopic, detail, hasProblem: false, x: 0, y: 0, width, height: BOX_HEIGHT };
    boxes.set(key, made);
    return made;
  };
  const wanted = options.text.toLowerCase();
  graph.nodes.forEach(({ name, infrastructure }, i) => {
    // A node without visible topics is shown as well.
    if ((options.infrastructure || !infrastructure) && name.toLowerCase().includes(wanted))
      box(`n${i}`, name, false, "");
  });
  const dag = new graphlib.Graph();
  dag.setGraph({ rankdir: "LR", nodesep: 10, ranksep: 46, marginx: 12, marginy: 12 });
  dag.setDefaultEdgeLabel(() => ({}));
  const arrows: Arrow[] = [];
  for (const link of links) {
    const topic = graph.topics[link.topic];
    const node = box(`n${link.node}`, graph.nodes[link.node]?.name ?? "", false, "");
    const about = box(`t${link.topic}`, topic?.topic ?? "", true, topic?.types.join(", ") ?? "");
    if (!node || !about) continue;
    const [from, to] = link.publishes ? [node.key, about.key] : [about.key, node.key];
    const detail = `${node.name} ${link.publishes ? "publishes" : "subscribes to"} ${about.name}: ${link.problem || link.qos}`;
    if (link.problem) node.hasProblem = about.hasProblem = true;
    arrows.push({ from, to, detail, hasProblem: link.problem !== "", points: [] });
  }
  for (const { key, width, height } of boxes.values()) dag.setNode(key, { width, height });
  for (const { from, to } of arrows) dag.setEdge(from, to);
  layout(dag);
  for (const one of boxes.values()) {
    const { x, y } = dag.node(one.key) as { x: number; y: number };
    Object.assign(one, { x, y });
  }
  for (const arrow of arrows)
    arrow.points = (dag.edge(arrow.from, arrow.to) as { points: { x: number; y: number }[] }).points;
  const { width = 0, height = 0 } = dag.graph() as { width?: number; height?: number };
  return { boxes: [...boxes.values()], arrows, omitted, width: finiteOrZero(width), height: finiteOrZero(height) };
}

function finiteOrZero(size: number): number {
  return Number.isFinite(size) ? Math.max(size, 1) : 1;
}
