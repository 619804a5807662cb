// SPDX-License-Identifier: Apache-2.0
/** The Joints panel: sliders for the movable joints of robots, whose positions can be published. */

import { RobotDisplay } from "../displays/robot";
import type { Displays } from "../displays/manager";
import { h, shorten } from "../util/dom";
import type { Model } from "../model/model";
import type { RobotJoint, RobotModel } from "../protocol/messages";

const SEND_INTERVAL_MS = 50;
const DEGREES = 180 / Math.PI;

export class JointsPanel {
  readonly element: HTMLElement;
  private readonly body = h("div");
  private readonly positions = new Map<string | number, Record<string, number>>();
  private readonly publishingRobots = new Set<string | number>();
  private readonly timers = new Map<string | number, number>();
  private shown = "";

  constructor(
    private readonly model: Model,
    private readonly displays: Displays,
  ) {
    this.element = h("section", { class: "tab-body" }, this.body);
    displays.onChange(() => this.render());
    model.on("hello", () => this.render());
    this.render();
  }

  private render(): void {
    const robots = this.displays.robots.filter((display) => display.robot);
    const key = JSON.stringify(
      robots.map(({ id, robot }) => [id, robot?.id, robot?.joints.map((joint) => joint.name)]),
    );
    if (key === this.shown) return;
    this.shown = key;
    if (robots.length === 0) {
      this.body.replaceChildren(
        h(
          "div",
          { class: "empty" },
          h("strong", {}, "No robot"),
          h("p", {}, "A robot description is read from the topic /robot_description, or from a file:"),
          h("code", {}, "coframe view --robot my_robot.urdf"),
        ),
      );
      return;
    }
    this.body.replaceChildren(...robots.map((display) => this.section(display, display.robot as RobotModel)));
  }

  private section(display: RobotDisplay, robot: RobotModel): HTMLElement {
    const movable = movableJoints(robot);
    const positions =
      this.positions.get(robot.id) ?? Object.fromEntries(movable.map((joint) => [joint.name, joint.value]));
    this.positions.set(robot.id, positions);
    const rows = movable.map((joint) => this.row(display, robot, joint, positions));
    const publish = h("input", { type: "checkbox", disabled: !this.model.hello?.can_publish });
    publish.addEventListener("change", () => {
      if (publish.checked) this.publishingRobots.add(robot.id);
      else this.publishingRobots.delete(robot.id);
      this.send(display, robot);
    });
    const set = (value: (joint: MovableJoint) => number): void => {
      movable.forEach((joint, i) => rows[i]?.set(value(joint)));
      this.send(display, robot);
    };
    return h(
      "div",
      { class: "section" },
      h("h3", {}, shorten(robot.name, 60)),
      h("p", {}, `${movable.length} movable joints · ${shorten(robot.source, 80)}`),
      h(
        "label",
        { class: "check" },
        publish,
        h(
          "span",
          {},
          this.model.hello?.can_publish ? "Publish on /joint_states" : "Publishing requires a live ROS graph",
        ),
      ),
      h(
        "div",
        { class: "buttons" },
        h("button", { type: "button", class: "small", on: { click: () => set(neutralPosition) } }, "Center"),
        h("button", { type: "button", class: "small", on: { click: () => set(random) } }, "Random"),
        h(
          "button",
          { type: "button", class: "small", on: { click: () => this.release(display, robot) } },
          "Reset to /tf",
        ),
      ),
      ...rows.map((row) => row.element),
    );
  }

  private row(
    display: RobotDisplay,
    robot: RobotModel,
    joint: MovableJoint,
    positions: Record<string, number>,
  ): { element: HTMLElement; set(value: number): void } {
    const angular = joint.type !== "prismatic";
    const [lower, upper] = limits(joint);
    const range = h("input", { type: "range", aria: { label: joint.name.slice(0, 100) }, step: "any" });
    Object.assign(range, { min: String(lower), max: String(upper) });
    const number = h("input", {
      type: "number",
      step: angular ? "1" : "0.001",
      aria: { label: `${joint.name.slice(0, 100)}, ${angular ? "degrees" : "meters"}` },
    });
    const set = (value: number): void => {
      const limited = Math.max(lower, Math.min(upper, value));
      positions[joint.name] = limited;
      range.value = String(limited);
      number.value = angular ? (limited * DEGREES).toFixed(1) : limited.toFixed(4);
    };
    set(positions[joint.name] ?? joint.value);
    range.addEventListener("input", () => {
      set(range.valueAsNumber);
      this.send(display, robot);
    });
    number.addEventListener("change", () => {
      if (Number.isFinite(number.valueAsNumber)) set(angular ? number.valueAsNumber / DEGREES : number.valueAsNumber);
      this.send(display, robot);
    });
    const name = h("span", { title: joint.name.slice(0, 300) }, shorten(joint.name, 60));
    return {
      element: h("div", { class: "joint", data: { joint: joint.name.slice(0, 200) } }, name, number, range),
      set,
    };
  }

  /** Applies the positions to the page immediately, and sends them to the server at a limited rate. */
  private send(display: RobotDisplay, robot: RobotModel): void {
    const publish = this.publishingRobots.has(robot.id);
    const positions = this.positions.get(robot.id) ?? {};
    // Published positions return as transforms, for example from robot_state_publisher.
    display.setJoints({ ...positions }, !publish);
    if (this.timers.has(robot.id)) return;
    const timer = window.setTimeout(() => {
      this.timers.delete(robot.id);
      this.model.send({
        type: "joints",
        robot: robot.id,
        positions: { ...positions },
        publish: this.publishingRobots.has(robot.id),
      });
    }, SEND_INTERVAL_MS);
    this.timers.set(robot.id, timer);
  }

  private release(display: RobotDisplay, robot: RobotModel): void {
    this.publishingRobots.delete(robot.id);
    this.positions.delete(robot.id);
    display.setJoints(Object.fromEntries(movableJoints(robot).map((joint) => [joint.name, joint.value])), false);
    this.model.send({ type: "joints", robot: robot.id, positions: {}, publish: false });
    this.shown = "";
    this.render();
  }
}

/** A joint that a slider can move. */
type MovableJoint = RobotJoint & { value: number };

function movableJoints(robot: RobotModel): MovableJoint[] {
  return robot.joints.filter((joint): joint is MovableJoint => joint.value !== null);
}

function limits(joint: RobotJoint): [number, number] {
  const range = joint.type === "prismatic" ? 1 : Math.PI;
  if (joint.type === "continuous" || joint.lower === null || joint.upper === null || !(joint.lower < joint.upper))
    return [-range, range];
  return [Math.max(joint.lower, -100), Math.min(joint.upper, 100)];
}

/** The neutral position, as in joint_state_publisher_gui: zero if the limits permit it, otherwise their middle. */
function neutralPosition(joint: RobotJoint): number {
  const [lower, upper] = limits(joint);
  return lower <= 0 && upper >= 0 ? 0 : (lower + upper) / 2;
}

function random(joint: RobotJoint): number {
  const [lower, upper] = limits(joint);
  return lower + Math.random() * (upper - lower);
}
