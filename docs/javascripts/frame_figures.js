// SPDX-License-Identifier: Apache-2.0
// Interactive figures of the handbook: drag frames and points, and read the numbers. A figure stands below the picture
// of its chapter. Each handle can also be moved with the arrow keys.
(() => {
  "use strict";

  const SVG = "http://www.w3.org/2000/svg";
  const WIDTH = 480, HEIGHT = 300, SCALE = 60; // pixels, and pixels per meter
  const ORIGIN = [120, 210]; // pixels
  const STEP = 0.05, TURN = Math.PI / 36; // of an arrow key, in meters and radians
  const AXIS = 0.7; // meters

  // A planar pose is [x, y, yaw], relative to a parent.
  const compose = ([x, y, yaw], [u, v, turn]) => [
    x + u * Math.cos(yaw) - v * Math.sin(yaw),
    y + u * Math.sin(yaw) + v * Math.cos(yaw),
    wrap(yaw + turn),
  ];
  const inverse = ([x, y, yaw]) => [
    -x * Math.cos(yaw) - y * Math.sin(yaw),
    x * Math.sin(yaw) - y * Math.cos(yaw),
    wrap(-yaw),
  ];
  const wrap = (angle) => Math.atan2(Math.sin(angle), Math.cos(angle));
  const number = (value) => (Math.abs(value) < 0.005 ? 0 : value).toFixed(2);
  const pair = ([x, y]) => `[${number(x)}, ${number(y)}]`;
  const degrees = (angle) => `${Math.round((angle * 180) / Math.PI)} degrees`;
  const pose = (value) => `${pair(value)} m, yaw ${degrees(value[2])}`;
  const matrix = ([x, y, yaw]) => {
    const [c, s] = [number(Math.cos(yaw)), number(Math.sin(yaw))];
    return `[${c} ${number(-Math.sin(yaw))} ${number(x)}; ${s} ${c} ${number(y)}; 0 0 1]`;
  };

  // For each picture: its frames with their parents, a point in the last frame or null, and the rows of numbers.
  const FIGURES = {
    "01_why_frames.svg": {
      title: "One point, two frames: drag the lidar, its x axis and the obstacle.",
      frames: [["base_link", null, [0, 0, 0]], ["lidar_link", "base_link", [1.2, 0.6, 0.4]]],
      point: ["obstacle", [3.4, 1.6]],
      rows: (world, point) => [
        ["pose of lidar_link in base_link", pose(world.lidar_link)],
        ["obstacle in base_link", pair(point)],
        ["obstacle in lidar_link", pair(compose(inverse(world.lidar_link), [...point, 0]))],
      ],
    },
    "02_rotations.svg": {
      title: "A rotation about z: turn the x axis of the child.",
      frames: [["parent", null, [0, 0, 0]], ["child", "parent", [2, 0, 0.8]]],
      point: null,
      rows: ({ child }) => [
        ["yaw", `${degrees(child[2])}, ${number(child[2])} rad`],
        ["quaternion x, y, z, w", `[0, 0, ${number(Math.sin(child[2] / 2))}, ${number(Math.cos(child[2] / 2))}]`],
        ["first column of the matrix, the x axis", pair([Math.cos(child[2]), Math.sin(child[2])])],
        ["second column, the y axis", pair([-Math.sin(child[2]), Math.cos(child[2])])],
      ],
    },
    "04_lookup_transform.svg": {
      title: "lookup_transform(target, source): drag the source and a point in it.",
      frames: [["base_link", null, [0, 0, 0]], ["camera_link", "base_link", [1.8, 0.4, 1.2]]],
      point: ["point", [2.6, 1.8]],
      rows: ({ camera_link: camera }, point) => [
        ["lookup_transform(base_link, camera_link)", pose(camera)],
        ["lookup_transform(camera_link, base_link)", pose(inverse(camera))],
        ["point in camera_link, the source", pair(compose(inverse(camera), [...point, 0]))],
        ["point in base_link, the target", pair(point)],
      ],
    },
    "11_motion_between_frames.svg": {
      title: "Composition: drag the tool and the camera on it.",
      frames: [
        ["base", null, [0, 0, 0]],
        ["tool", "base", [1.6, 0.4, 0.5]],
        ["camera", "tool", [1.4, 0.5, 0.6]],
      ],
      point: null,
      rows: ({ tool, camera }) => [
        ["base_from_tool", matrix(tool)],
        ["tool_from_camera", matrix(compose(inverse(tool), camera))],
        ["base_from_camera, the product", matrix(camera)],
      ],
    },
  };

  const make = (name, attributes, parent) => {
    const element = document.createElementNS(SVG, name);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    parent.append(element);
    return element;
  };
  const toPixels = ([x, y]) => [ORIGIN[0] + SCALE * x, ORIGIN[1] - SCALE * y];
  const clamp = (value, low, high) => Math.min(high, Math.max(low, value));
  const inside = ([x, y]) => [
    clamp(x, -ORIGIN[0] / SCALE, (WIDTH - ORIGIN[0]) / SCALE),
    clamp(y, (ORIGIN[1] - HEIGHT) / SCALE, ORIGIN[1] / SCALE),
  ];

  class Figure {
    constructor(plan) {
      this.plan = plan;
      this.poses = Object.fromEntries(plan.frames.map(([name, , start]) => [name, start]));
      this.point = plan.point && plan.point[1];
      this.element = document.createElement("figure");
      this.element.className = "frame-figure";
      const caption = document.createElement("figcaption");
      caption.textContent = `${plan.title} Or use Tab and the arrow keys.`;
      this.svg = make("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: "group", "aria-label": plan.title }, this.element);
      this.table = document.createElement("table");
      this.table.setAttribute("aria-live", "polite");
      this.element.append(this.table, caption);
      this.drawings = plan.frames.map((frame) => this.#frame(frame));
      if (plan.point) {
        const mark = make("circle", { r: 6, class: "point" }, this.svg);
        const label = make("text", {}, this.svg);
        label.textContent = plan.point[0];
        this.mark = { handle: mark, label };
        this.#listen(mark, `position of ${plan.point[0]}`, (place) => (this.point = place), (dx, dy) => [
          this.point[0] + dx,
          this.point[1] + dy,
        ]);
      }
      this.update();
    }

    world(name) {
      const parent = this.plan.frames.find((frame) => frame[0] === name)[1];
      return parent ? compose(this.world(parent), this.poses[name]) : this.poses[name];
    }

    place(name, value) {
      const parent = this.plan.frames.find((frame) => frame[0] === name)[1];
      this.poses[name] = compose(inverse(this.world(parent)), value);
    }

    #frame([name, parent]) {
      const group = make("g", {}, this.svg);
      const drawing = {
        name,
        x: make("line", { class: "x-axis" }, group),
        y: make("line", { class: "y-axis" }, group),
        label: make("text", {}, group),
      };
      drawing.label.textContent = name;
      drawing.handle = make("circle", { r: parent ? 7 : 4, class: parent ? "handle" : "root" }, group);
      if (!parent) return drawing;
      drawing.tip = make("circle", { r: 6, class: "tip" }, group);
      this.#listen(
        drawing.handle,
        `position of ${name}`,
        ([x, y]) => this.place(name, [x, y, this.world(name)[2]]),
        (dx, dy) => [this.world(name)[0] + dx, this.world(name)[1] + dy],
      );
      const turn = (yaw) => {
        const [x, y] = this.world(name);
        this.place(name, [x, y, wrap(yaw)]);
      };
      this.#listen(
        drawing.tip,
        `rotation of ${name}`,
        ([x, y]) => turn(Math.atan2(y - this.world(name)[1], x - this.world(name)[0])),
        (dx, dy) => {
          const [x, y, yaw] = this.world(name);
          const turned = yaw + (TURN * (dy - dx)) / STEP;
          return [x + AXIS * Math.cos(turned), y + AXIS * Math.sin(turned)];
        },
      );
      return drawing;
    }

    #listen(handle, label, move, step) {
      handle.setAttribute("tabindex", "0");
      handle.setAttribute("role", "button");
      handle.setAttribute("aria-label", `${label}: arrow keys`);
      const drag = (event) => {
        const place = new DOMPoint(event.clientX, event.clientY).matrixTransform(this.svg.getScreenCTM().inverse());
        move(inside([(place.x - ORIGIN[0]) / SCALE, (ORIGIN[1] - place.y) / SCALE]));
        this.update();
      };
      handle.addEventListener("pointerdown", (event) => {
        event.preventDefault();
        handle.focus();
        handle.setPointerCapture(event.pointerId);
        handle.addEventListener("pointermove", drag);
      });
      for (const end of ["pointerup", "pointercancel"])
        handle.addEventListener(end, () => handle.removeEventListener("pointermove", drag));
      handle.addEventListener("keydown", (event) => {
        const [dx, dy] = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key] || [];
        if (dx === undefined) return;
        event.preventDefault();
        move(inside(step(dx * STEP, dy * STEP)));
        this.update();
      });
    }

    update() {
      for (const { name, x, y, label, handle, tip } of this.drawings) {
        const here = this.world(name);
        const at = toPixels(here);
        for (const [line, axis] of [[x, [AXIS, 0, 0]], [y, [0, AXIS, 0]]]) {
          const end = toPixels(compose(here, axis));
          Object.entries({ x1: at[0], y1: at[1], x2: end[0], y2: end[1] }).forEach(([key, value]) =>
            line.setAttribute(key, value),
          );
          if (line === x && tip) this.#put(tip, end);
        }
        this.#put(handle, at);
        this.#write(label, [at[0] + 6, at[1] + 22]);
      }
      if (this.mark) {
        const at = toPixels(this.point);
        this.#put(this.mark.handle, at);
        this.#write(this.mark.label, [at[0] + 9, at[1] - 9]);
      }
      const world = Object.fromEntries(this.plan.frames.map(([name]) => [name, this.world(name)]));
      this.table.replaceChildren(
        ...this.plan.rows(world, this.point).map(([title, value]) => {
          const row = document.createElement("tr");
          const [head, cell] = [document.createElement("th"), document.createElement("td")];
          head.scope = "row";
          head.textContent = title;
          cell.textContent = value;
          row.append(head, cell);
          return row;
        }),
      );
    }

    #put(circle, [x, y]) {
      circle.setAttribute("cx", x);
      circle.setAttribute("cy", y);
    }

    #write(text, [x, y]) {
      text.setAttribute("x", Math.min(x, WIDTH - 90));
      text.setAttribute("y", clamp(y, 12, HEIGHT - 4));
    }
  }

  const show = () => {
    for (const [file, plan] of Object.entries(FIGURES))
      for (const picture of document.querySelectorAll(`img[src$="${file}"]`))
        picture.closest("p").after(new Figure(plan).element);
  };
  if (document.readyState === "loading") document.addEventListener("DOMContentLoaded", show);
  else show();
})();
