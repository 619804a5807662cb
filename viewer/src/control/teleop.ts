// SPDX-License-Identifier: Apache-2.0
/**
 * Drives a robot with keys, buttons or a gamepad. The velocity is repeated only while something is pressed; the server
 * stops the robot when nothing arrives.
 */

import type { Model } from "../model/model";
import { h, select, setText } from "../util/dom";
import * as format from "../util/format";

const PERIOD_MS = 100;
const DEAD_ZONE = 0.15;
/** Forward, left and counterclockwise of each button, and its keys. */
const BUTTONS = [
  ["↖", 1, 0, 1, ""],
  ["↑", 1, 0, 0, "ArrowUp"],
  ["↗", 1, 0, -1, ""],
  ["↺", 0, 0, 1, "ArrowLeft"],
  ["■", 0, 0, 0, ""],
  ["↻", 0, 0, -1, "ArrowRight"],
  ["←", 0, 1, 0, ""],
  ["↓", -1, 0, 0, "ArrowDown"],
  ["→", 0, -1, 0, ""],
] as const;

type Direction = readonly [forward: number, left: number, turn: number];

export class Teleop {
  readonly element: HTMLElement;
  private readonly topic = h("input", { type: "text", value: "/cmd_vel", aria: { label: "Topic of the velocity" } });
  private readonly speedInput = h("input", {
    type: "number",
    value: "0.3",
    min: "0",
    step: "0.1",
    aria: { label: "m/s" },
  });
  private readonly turn = h("input", { type: "number", value: "0.8", min: "0", step: "0.1", aria: { label: "rad/s" } });
  private readonly state = h("p", { class: "numbers", id: "drive-state", role: "status" }, "Standing still");
  private rosType = "geometry_msgs/msg/Twist";
  private readonly heldKeys = new Map<string, Direction>();
  private timer = 0;
  private isMoving = false;

  constructor(private readonly model: Model) {
    const kinds = ["Twist", "TwistStamped"].map((name) => [`geometry_msgs/msg/${name}`, name] as const);
    const pad = h("div", {
      class: "drive-pad",
      id: "drive-pad",
      tabindex: "0",
      role: "group",
      aria: { label: "Drive: hold a button or an arrow key; a gamepad also works" },
    });
    for (const [text, forward, left, turn] of BUTTONS) {
      const button = h("button", { type: "button", aria: { label: directionName(forward, left, turn) } }, text);
      button.addEventListener("pointerdown", (event) => {
        button.setPointerCapture(event.pointerId);
        this.hold("button", [forward, left, turn]);
      });
      for (const event of ["pointerup", "pointercancel"] as const)
        button.addEventListener(event, () => this.release("button"));
      pad.append(button);
    }
    pad.addEventListener("keydown", (event) => {
      const found = BUTTONS.find(([, , , , key]) => key === event.key);
      if (!found) return;
      event.preventDefault();
      event.stopPropagation();
      this.hold(event.key, [found[1], found[2], found[3]]);
    });
    pad.addEventListener("keyup", (event) => this.release(event.key));
    pad.addEventListener("focusout", () => this.stop());
    for (const event of ["blur", "gamepaddisconnected"] as const) window.addEventListener(event, () => this.stop());
    const field = (label: string, input: HTMLElement): HTMLElement =>
      h("label", { class: "field" }, h("span", {}, label), input);
    this.element = h(
      "div",
      { class: "teleop", hidden: true },
      field("Topic", this.topic),
      field(
        "Type",
        select("Type of the velocity", kinds, this.rosType, (value) => (this.rosType = value)),
      ),
      field("m/s", this.speedInput),
      field("rad/s", this.turn),
      pad,
      this.state,
    );
    window.addEventListener("gamepadconnected", () => this.start());
  }

  /** Stops the robot. */
  stop(): void {
    this.heldKeys.clear();
    this.send();
    clearInterval(this.timer);
    this.timer = 0;
  }

  private hold(key: string, direction: Direction): void {
    this.heldKeys.set(key, direction);
    this.send();
    this.start();
  }

  private release(key: string): void {
    if (!this.heldKeys.delete(key)) return;
    this.send();
  }

  private start(): void {
    this.timer ||= window.setInterval(() => this.send(), PERIOD_MS);
  }

  private send(): void {
    if (this.element.hidden && !this.isMoving) return;
    const [forward, left, turn] = this.direction();
    const moves = forward !== 0 || left !== 0 || turn !== 0;
    if (!moves && !this.isMoving) return; // The last message was zero.
    this.isMoving = moves;
    const [speed, rate] = [this.speedInput.valueAsNumber || 0, this.turn.valueAsNumber || 0];
    const linear: [number, number] = [forward * speed, left * speed];
    const angular = turn * rate;
    this.model.send({ type: "drive", topic: this.topic.value.trim(), ros_type: this.rosType, linear, angular });
    const numbers = `${format.formatFixed(linear[0], 2)}, ${format.formatFixed(linear[1], 2)} m/s, ${format.formatFixed(angular, 2)} rad/s`;
    setText(this.state, moves ? numbers : "Standing still");
  }

  private direction(): Direction {
    const sum = [0, 0, 0];
    for (const direction of this.heldKeys.values())
      direction.forEach((value, k) => (sum[k] = (sum[k] as number) + value));
    const axis = (value: number | undefined): number => (Math.abs(value ?? 0) < DEAD_ZONE ? 0 : -(value ?? 0));
    const pad = this.element.hidden ? null : navigator.getGamepads().find((one) => one?.connected);
    // The left stick drives, the right one turns.
    if (pad) [pad.axes[1], pad.axes[0], pad.axes[2]].forEach((value, k) => (sum[k] = (sum[k] as number) + axis(value)));
    return sum.map((value) => Math.max(-1, Math.min(1, value))) as unknown as Direction;
  }
}

function directionName(forward: number, left: number, turn: number): string {
  const parts = [
    forward > 0 ? "forward" : forward < 0 ? "backward" : "",
    left > 0 ? "left" : left < 0 ? "right" : "",
    turn > 0 ? "turn left" : turn < 0 ? "turn right" : "",
  ].filter(Boolean);
  return parts.length ? `Drive: ${parts.join(", ")}` : "Stop";
}
