// SPDX-License-Identifier: Apache-2.0
/** The findings of the doctor: a list, and the page of each code. */

import { h, icon, iconButton, shorten, type IconName } from "../util/dom";
import * as format from "../util/format";
import { headline } from "../model/marks";
import type { Model } from "../model/model";
import type { CodePage, FindingEntry, FindingEntries, Hello, Severity } from "../protocol/messages";

/** Each severity has its own shape, because color alone is not accessible. */
const SHAPES: Record<Severity, IconName> = { error: "octagon", warning: "triangle", note: "disc" };
/** More than the server sends: a command without its middle could run what a name contains. */
const MAX_TEXT = 2100;

export function severityIcon(severity: Severity): SVGElement {
  const svg = icon(SHAPES[severity]);
  svg.dataset.severity = severity;
  return svg;
}

/** The summary of the findings; empty before the first result. */
export function summary(result: FindingEntries | null, mode: Hello["mode"] | undefined): string {
  if (result === null) return "";
  if (result.state === "failed") return shorten(result.text, MAX_TEXT);
  if (result.state === "waiting")
    return mode === "live" ? "Collecting data for some seconds…" : "Examining the recording…";
  if (result.state === "none")
    return "The doctor examines ROS graphs and recordings. This source contains neither publishers nor arrival times.";
  if (result.findings.length)
    return "Problems, their effects and how to fix them. Click a finding to select its frame.";
  return mode === "live" ? "No problems in the last 10 seconds." : "No problems in this recording.";
}

export class FindingsPanel {
  readonly element: HTMLElement;
  private readonly summaryText = h("p", { id: "findings-summary", role: "status" });
  private readonly list = h("ul", { class: "findings", id: "findings" });
  private readonly codeDialog = new CodeDialog();
  private shown = "";

  constructor(private readonly model: Model) {
    this.element = h(
      "section",
      { class: "tab-body" },
      h("div", { class: "section" }, h("h3", {}, "Doctor"), this.summaryText),
      this.list,
    );
    model.on("findings", (findings) => this.show(findings));
    model.on("page", (page) => this.codeDialog.show(page));
    model.on("hello", () => this.show(null));
    this.show(null);
  }

  private show(result: FindingEntries | null): void {
    const key = JSON.stringify(result);
    if (key === this.shown) return;
    this.shown = key;
    const findings = result?.findings ?? [];
    this.summaryText.textContent = summary(result, this.model.hello?.mode);
    this.list.replaceChildren(...findings.map((finding) => this.card(finding)));
  }

  private card(finding: FindingEntry): HTMLElement {
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
      h("p", {}, shorten(finding.text, MAX_TEXT)),
      h("p", { class: "muted" }, h("b", {}, "Why: "), shorten(finding.why, MAX_TEXT)),
      h("p", {}, h("b", {}, "Fix: "), shorten(finding.fix, MAX_TEXT)),
      facts ? h("p", { class: "muted" }, shorten(facts, 300)) : null,
      finding.explains.length
        ? h(
            "ul",
            { class: "list" },
            ...finding.explains.map((effect) =>
              h("li", {}, `Causes: ${headline(effect)} ${shorten(effect.subject, 100)}`),
            ),
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
        first === null ? null : this.makeTimeButton(first),
      ),
    );
  }

  private makeTimeButton(first: number): HTMLElement {
    const act = (): void => this.model.setClock({ live: false, playing: false }, first);
    return h(
      "button",
      { type: "button", class: "small", title: "Go to the first occurrence", on: { click: act } },
      format.stamp(this.model.origin, first),
    );
  }

  private choose(finding: FindingEntry): void {
    const frames = [finding, ...finding.explains].flatMap((one) => one.frames);
    const known = frames.find((frame) => this.model.forest.index.has(frame));
    if (known !== undefined) this.model.select(known);
  }
}

/** A dialog with the page of a code: Markdown with headings, lists and code. */
class CodeDialog {
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
        .map((item) => h("li", {}, ...renderInlineCode(item))),
    );
  return h("p", {}, ...renderInlineCode(text));
}

/** Converts text between backticks to code elements. */
function renderInlineCode(text: string): (string | HTMLElement)[] {
  return text.split("`").map((part, i) => (i % 2 ? h("code", {}, part) : part));
}
