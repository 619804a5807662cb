// SPDX-License-Identifier: Apache-2.0
/** Acts on the graph: publishes messages, calls services, sends goals, sets parameters, and drives a robot. */

import type { Pane } from "../dock/dock";
import type { Model } from "../model/model";
import type { Controlled, ControlKind, Json } from "../protocol/messages";
import { h, select, setText, shorten } from "../util/dom";
import { Teleop } from "./teleop";
import { nestValues, parseValue, formatValue } from "./values";

type Mode = ControlKind | "drive";

const MODES: readonly (readonly [Mode, string])[] = [
  ["topic", "Publish"],
  ["service", "Call a service"],
  ["action", "Send a goal"],
  ["node", "Set parameters"],
  ["drive", "Drive"],
];
const VERBS: Record<ControlKind, string> = { topic: "Publish", service: "Call", action: "Send", node: "Set" };
const MAX_VALUE = 2000;

export class ControlPane implements Pane {
  readonly id = "control";
  readonly title = "Control";
  readonly body: HTMLElement;
  readonly controls: HTMLElement[];
  private mode: Mode = "topic";
  private readonly teleop: Teleop;
  private readonly name = h("input", { type: "text", list: "control-names", autocomplete: "off" });
  private readonly type = h("input", { type: "text", placeholder: "package/msg/Name", aria: { label: "Type" } });
  private readonly topicNames = h("datalist", { id: "control-names" });
  private readonly publishButton = h("button", { type: "submit", class: "primary" });
  private readonly fields = h("div", { class: "control-fields" });
  private readonly form: HTMLFormElement;
  private readonly status = h("p", { class: "control-status", id: "control-status", role: "status" });
  private readonly answer = h("dl", { class: "facts", id: "control-answer" });
  private readonly inputs = new Map<string, { type: string; input: HTMLInputElement; initial: string }>();
  private lastRequest = 0;
  private step: "names" | "form" | "act" = "names";
  private isOpen = false;

  constructor(private readonly model: Model) {
    const mode = select("What to do", MODES, this.mode, (value) => this.setMode(value as Mode));
    this.name.setAttribute("aria-label", "Name");
    this.name.addEventListener("change", () => this.requestForm(""));
    this.type.addEventListener("change", () => this.requestForm(this.type.value.trim()));
    this.form = h(
      "form",
      {
        class: "control-form",
        on: {
          submit: (event) => {
            event.preventDefault();
            this.submit();
          },
        },
      },
      h("label", { class: "field" }, h("span", {}, "Name"), this.name),
      h("label", { class: "field" }, h("span", {}, "Type"), this.type),
      this.fields,
      h("div", { class: "buttons" }, this.publishButton),
    );
    this.teleop = new Teleop(model);
    this.controls = [mode];
    this.body = h(
      "div",
      { class: "control" },
      this.topicNames,
      this.form,
      this.teleop.element,
      this.status,
      this.answer,
    );
    model.on("controlled", (answer) => this.receive(answer));
    model.on("hello", () => this.isOpen && this.setMode(this.mode));
  }

  open(): void {
    this.isOpen = true;
    this.setMode(this.mode);
  }

  close(): void {
    this.isOpen = false;
    this.teleop.stop();
  }

  private setMode(mode: Mode): void {
    this.mode = mode;
    this.teleop.stop();
    const permitted = this.model.hello?.can_control ?? false;
    this.form.hidden = !permitted || mode === "drive";
    this.teleop.element.hidden = !permitted || mode !== "drive";
    this.fields.replaceChildren();
    this.answer.replaceChildren();
    this.inputs.clear();
    this.name.value = this.type.value = "";
    (this.type.parentElement as HTMLElement).hidden = mode === "node";
    setText(
      this.status,
      permitted ? "" : "Acting on the graph needs a permission. Start the viewer with: coframe view --control",
    );
    if (!permitted || mode === "drive") return;
    setText(this.publishButton, VERBS[mode]);
    this.publishButton.disabled = true;
    this.request("names");
  }

  private request(step: "names" | "form" | "act", ros_type = "", values = {}): void {
    if (this.mode === "drive") return;
    this.step = step;
    const name = step === "names" ? "" : this.name.value.trim();
    this.model.send({ type: "control", id: ++this.lastRequest, step, kind: this.mode, name, ros_type, values });
  }

  private requestForm(rosType: string): void {
    this.answer.replaceChildren();
    if (this.name.value.trim()) this.request("form", rosType);
  }

  private receive({ id, ok, text, hint, ros_type: rosType, fields }: Controlled): void {
    if (id !== this.lastRequest || !this.isOpen) return;
    this.status.dataset.state = ok ? "ok" : "error";
    if (!ok || this.step === "act") setText(this.status, shorten([text, hint].filter(Boolean).join(" "), 600));
    else setText(this.status, "");
    if (this.step === "act") this.publishButton.disabled = false;
    if (!ok) return;
    if (this.step === "names") {
      this.topicNames.replaceChildren(...fields.map(({ path, type }) => new Option(type, path)));
    } else if (this.step === "form" || this.mode === "node") {
      if (this.mode !== "node") this.type.value = rosType;
      this.fill(fields);
    } else
      this.answer.replaceChildren(
        ...fields.map(({ path, value }) =>
          h("div", {}, h("dt", {}, shorten(path, 80)), h("dd", { class: "mono" }, shorten(value, MAX_VALUE))),
        ),
      );
  }

  private fill(fields: Controlled["fields"]): void {
    this.inputs.clear();
    this.fields.replaceChildren(
      ...fields.map((field) => {
        const initial = formatValue(field);
        const input = h("input", { type: "text", title: field.type, aria: { label: field.path }, autocomplete: "off" });
        input.value = initial;
        input.addEventListener("input", () => input.setCustomValidity(""));
        this.inputs.set(field.path, { type: field.type, input, initial });
        return h("label", { class: "field" }, h("span", { title: field.type }, shorten(field.path, 60)), input);
      }),
    );
    this.publishButton.disabled = false;
  }

  private submit(): void {
    const values = new Map<string, Json>();
    for (const [path, { type, input, initial }] of this.inputs) {
      if (input.value === initial) continue;
      try {
        values.set(path, parseValue(type, input.value));
      } catch {
        input.setCustomValidity(`This is not a value of the type ${type}.`);
        input.reportValidity();
        return;
      }
    }
    if (this.mode === "node" && values.size === 0) return;
    this.publishButton.disabled = true;
    this.answer.replaceChildren();
    setText(this.status, "Waiting for the answer…");
    // The names of parameters contain dots themselves.
    this.request("act", this.type.value.trim(), this.mode === "node" ? Object.fromEntries(values) : nestValues(values));
  }
}
