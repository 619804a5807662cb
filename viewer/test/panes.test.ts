// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { lastBefore, matchesFilter } from "../src/log/filter";
import { visibleRows } from "../src/message_inspector/rows";
import { arrange, chosenLinks } from "../src/node_graph/layout";
import type { InspectedField, LogEntry, NodeGraph } from "../src/protocol/messages";

describe("the rows of a message", () => {
  const row = (path: string, depth: number, text = ""): InspectedField => {
    return { path, depth, name: path, type: "", text, is_number: false };
  };
  const rows = [row("/a.header", 0), row("/a.header.stamp", 1), row("/a.header.stamp.sec", 2, "1")];
  rows.push(row("/a.ranges", 0, "[1 2]"), row("/a.ranges[0]", 1, "1"), row("/a.z", 0, "5"));

  it("of messages are open, those of arrays are closed until the user opens them", () => {
    expect(visibleRows(rows, new Set())).toEqual([0, 1, 2, 3, 5]);
    expect(visibleRows(rows, new Set(["/a.ranges"]))).toEqual([0, 1, 2, 3, 4, 5]);
    expect(visibleRows(rows, new Set(["/a.header"]))).toEqual([0, 3, 5]);
  });
});

describe("the log", () => {
  const entry = (change: Partial<LogEntry>): LogEntry => {
    return { stamp: 0, level: "info", node: "a", text: "Hello", place: "x.py:1", ...change };
  };

  it("is filtered by level, node and text", () => {
    const all = { level: "debug", node: "", text: "" } as const;
    expect(matchesFilter(entry({}), all)).toBe(true);
    expect(matchesFilter(entry({}), { ...all, level: "warning" })).toBe(false);
    expect(matchesFilter(entry({ level: "fatal" }), { ...all, level: "warning" })).toBe(true);
    expect(matchesFilter(entry({}), { ...all, node: "b" })).toBe(false);
    expect(matchesFilter(entry({}), { ...all, text: "hell" })).toBe(true);
    expect(matchesFilter(entry({}), { ...all, text: "X.PY" })).toBe(true);
    expect(matchesFilter(entry({}), { ...all, text: "other" })).toBe(false);
  });

  it("knows the last message before a time", () => {
    const entries = [1, 3, 2, 9].map((stamp) => entry({ stamp }));
    expect([0, 1, 2.5, 10].map((time) => lastBefore(entries, time))).toEqual([-1, 0, 2, 3]);
  });
});

describe("the graph of nodes and topics", () => {
  const graph: NodeGraph = {
    type: "graph",
    text: "",
    nodes: ["/camera", "/filter", "/view"].map((name) => ({ name, infrastructure: name === "/view" })),
    topics: ["/image", "/rosout"].map((topic) => ({ topic, types: ["t"], infrastructure: topic === "/rosout" })),
    links: [],
  };
  const link = (node: number, topic: number, publishes: boolean, problem = ""): void => {
    graph.links.push({ node, topic, publishes, qos: "reliable, volatile", problem });
  };
  link(0, 0, true, "offers best-effort, but /filter requests reliable: no messages arrive");
  link(1, 0, false);
  link(0, 1, true);
  link(2, 0, false);

  it("hides infrastructure by default, and filters by name", () => {
    expect(chosenLinks(graph, { infrastructure: false, text: "" })).toHaveLength(2);
    expect(chosenLinks(graph, { infrastructure: true, text: "" })).toHaveLength(4);
    expect(chosenLinks(graph, { infrastructure: true, text: "rosout" })).toHaveLength(1);
  });

  it("is arranged from publishers to subscriptions, with mismatches marked", () => {
    const { boxes, arrows } = arrange(graph, { infrastructure: false, text: "" });
    const at = new Map(boxes.map((box) => [box.name, box]));
    expect([...at.keys()].sort()).toEqual(["/camera", "/filter", "/image"]);
    expect(at.get("/camera")?.x).toBeLessThan(at.get("/image")?.x ?? 0);
    expect(at.get("/image")?.x).toBeLessThan(at.get("/filter")?.x ?? 0);
    expect(arrows.map((arrow) => arrow.hasProblem)).toEqual([true, false]);
    expect(at.get("/image")?.hasProblem).toBe(true);
    expect(arrows[0]?.detail).toContain("/camera publishes /image: offers best-effort");
  });

  it("of thirty nodes has no overlapping boxes", () => {
    const large: NodeGraph = { type: "graph", text: "", nodes: [], topics: [], links: [] };
    for (let i = 0; i < 30; i++) {
      large.nodes.push({ name: `/node_${i}`, infrastructure: false });
      large.topics.push({ topic: `/topic_${i}`, types: ["t"], infrastructure: false });
      large.links.push({ node: i, topic: i, publishes: true, qos: "", problem: "" });
      for (const k of [1, 7])
        large.links.push({ node: (i + k) % 30, topic: i, publishes: false, qos: "", problem: "" });
    }
    const { boxes } = arrange(large, { infrastructure: false, text: "" });
    expect(boxes).toHaveLength(60);
    const overlaps = boxes.flatMap((a, i) =>
      boxes.slice(i + 1).filter((b) => {
        const [dx, dy] = [Math.abs(a.x - b.x), Math.abs(a.y - b.y)];
        return dx < (a.width + b.width) / 2 && dy < (a.height + b.height) / 2;
      }),
    );
    expect(overlaps).toEqual([]);
  });
});
