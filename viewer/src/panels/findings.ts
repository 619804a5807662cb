// SPDX-License-Identifier: Apache-2.0
/** What the doctor says of the frames: a list beside them, a mark on each row concerned, and the page of each code. */

import { h, icon, iconButton, shorten, type IconName } from "../util/dom";
import * as format from "../util/format";
import type { Model } from "../model/model";
import type { CodePage, Finding, Findings, Hello, Severity } from "../protocol/messages";

/** What stands on a frame's row. */
export interface Mark {
  severity: Severity;
  lines: string[];
}

/** Worst first; each has a shape of its own, not only a colour. */
const SEVERITIES: readonly Severity[] = ["error", "warning", "note"];
const SHAPES: Record<Severity, IconName> = { error: "octagon", warning: "triangle", note: "disc" };
const MOST_LINES = 8;
const TEXT = 1000;

/** By frame: the worst of what concerns it, with what each finding says. */
export function marksOf(findings: readonly Finding[]): Map<string, Mark> {
  const marks = new Map<string, Mark>();
  const every = findings.flatMap((finding) => [finding, ...finding.explains]);
  for (const severity of SEVERITIES)
    for (const finding of every.filter((one) => one.severity === severity))
      for (const frame of finding.frames) {
        const mark = marks.get(frame) ?? { severity, lines: [] };
        if (mark.lines.length < MOST_LINES) mark.lines.push(headline(finding));
        marks.set(frame, mark);
      }
  return marks;
}

export function severityIcon(severity: Severity): SVGElement {
  const svg = icon(SHAPES[severity]);
  svg.dataset.severity = severity;
  return svg;
}

/** What the doctor says of the whole; nothing as long as it has not spoken. */
export function verdict(told: Findings | null, mode: Hello["mode"] | undefined): string {
  if (told === null) return "";
  if (told.state === "failed") return shorten(told.text, TEXT);
  if (told.state === "waiting") return mode === "live" ? "Listening for some seconds…" : "Examining the recording…";
  if (told.state === "none")
    return "The doctor examines the ROS graph and recordings; of what is shown here it cannot tell who sent what.";
  if (told.findings.length) return "What is wrong, why that matters, and what to do. Click one to see its frame.";
  return mode === "live" ? "Nothing is wrong in the last 10 seconds." : "Nothing is wrong in this recording.";
}

function headline({ code, severity, text }: Finding): string {
  return `${code} ${severity}: ${shorten(text, 200)}`;
}

export class FindingsPanel {
  readonly element: HTMLElement;
  private readonly summary = h("p", { id: "verdict", role: "status" });
  private readonly list = h("ul", { class: "findings", id: "findings" });
  private readonly sheet = new CodeSheet();
  private shown = "";

  constructor(private readonly model: Model) {
    this.element = h(
      "section",
      { class: "tab-body" },
      h("div", { class: "section" }, h("h3", {}, "Doctor"), this.summary),
      this.list,
    );
    model.on("findings", (findings) => this.show(findings));
    model.on("page", (page) => this.sheet.show(page));
    model.on("hello", () => this.show(null));
    this.show(null);
  }

  private show(told: Findings | null): void {
    const key = JSON.stringify(told);
    if (key === this.shown) return;
    this.shown = key;
    const findings = told?.findings ?? [];
    this.summary.textContent = verdict(told, this.model.hello?.mode);
    this.list.replaceChildren(...findings.map((finding) => this.card(finding)));
  }

  private card(finding: Finding): HTMLElement {
    const { severity, subject, code, first, publishers, namespace } = finding;
    const facts = [namespace, publishers.length ? `published by ${publishers.join(", ")}` : ""]
      .filter(Boolean)
      .join(" · ");
    return h(
      "li",
      { class: "finding", data: { severity, code } },
      h(
        "button",
        { type: "button", class: "finding-head", on: { click: () => this.choose(finding) } },
        severityIcon(severity),
        h("span", {}, h("strong", {}, `${code} ${severity}`), ` ${finding.title}`),
        subject ? h("span", { class: "mono subject" }, shorten(subject, 160)) : null,
      ),
      h("p", {}, shorten(finding.text, TEXT)),
      h("p", { class: "muted" }, h("b", {}, "Why: "), shorten(finding.why, TEXT)),
      h("p", {}, h("b", {}, "Do: "), shorten(finding.fix, TEXT)),
      facts ? h("p", { class: "muted" }, shorten(facts, 300)) : null,
      finding.explains.length
        ? h(
            "ul",
            { class: "list" },
            ...finding.explains.map((effect) => h("li", {}, `So: ${headline(effect)} ${shorten(effect.subject, 100)}`)),
          )
        : null,
      h(
        "div",
        { class: "buttons" },
        h(
          "button",
          { type: "button", class: "small", on: { click: () => this.model.send({ type: "explain", code }) } },
          `About ${code}`,
        ),
        first === null ? null : this.firstButton(first),
      ),
    );
  }

  private firstButton(first: number): HTMLElement {
    const act = (): void => this.model.setClock({ live: false, playing: false }, first);
    return h(
      "button",
      { type: "button", class: "small", title: "Look at the first time", on: { click: act } },
      format.stamp(this.model.origin, first),
    );
  }

  private choose(finding: Finding): void {
    const frames = [finding, ...finding.explains].flatMap((one) => one.frames);
    const known = frames.find((frame) => this.model.forest.index.has(frame));
    if (known !== undefined) this.model.select(known);
  }
}

/** The page of a code: Markdown, of which headings, lists and code are told apart. */
class CodeSheet {
  private readonly title = h("h2");
  private readonly body = h("div", { class: "sheet-body", id: "code-page" });
  private readonly dialog: HTMLDialogElement;

  constructor() {
    this.dialog = h(
      "dialog",
      { aria: { label: "About a finding" } },
      h(
        "div",
        { class: "sheet-head" },
        this.title,
        iconButton("close", "Close", () => this.dialog.close()),
      ),
      this.body,
    );
    document.body.append(this.dialog);
  }

  show({ code, title, text }: CodePage): void {
    this.title.textContent = `${code}: ${title}`;
    const [, ...blocks] = text.trim().split(/\n{2,}/);
    this.body.replaceChildren(...blocks.map(block));
    if (!this.dialog.open) this.dialog.showModal();
  }
}

function block(text: string): HTMLElement {
  if (text.startsWith("## ")) return h("h3", {}, text.slice(3));
  if (text.startsWith("```")) return h("pre", {}, text.replace(/^```\w*\n?|\n?```$/g, ""));
  if (text.startsWith("- "))
    return h(
      "ul",
      {},
      ...text
        .slice(2)
        .split(/\n- /)
        .map((item) => h("li", {}, ...inline(item))),
    );
  return h("p", {}, ...inline(text));
}

/** What stands between backticks is code. */
function inline(text: string): (string | HTMLElement)[] {
  return text.split("`").map((part, i) => (i % 2 ? h("code", {}, part) : part));
}
