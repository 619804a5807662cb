// SPDX-License-Identifier: Apache-2.0
import { DISPLAYS, type OptionSpec } from "../src/generated/displays";
import { describe, expect, it } from "vitest";
import { Forest, Model } from "../src/model/model";
import type { ClientMessage, FrameUpdate } from "../src/protocol/messages";
import { decodeCounts } from "../src/panels/sparklines";
import { cssColor, Options, rvizColor } from "../src/displays/options";
import * as format from "../src/util/format";

const frame = (name: string, parent: number, component = 0) => ({ name, parent, static: false, component });

describe("the forest", () => {
  //  map > odom > base > (laser, camera)      world > drone
  const forest = new Forest(
    1,
    [
      frame("map", -1),
      frame("odom", 0),
      frame("base", 1),
      frame("laser", 2),
      frame("camera", 2),
      frame("world", -1, 1),
      frame("drone", 5, 1),
    ],
    [
      { root: "map", size: 5 },
      { root: "world", size: 2 },
    ],
  );
  const names = (indices: number[] | null): string[] | null => indices?.map((i) => forest.name(i)) ?? null;

  it("returns the chain via the nearest common ancestor", () => {
    expect(names(forest.chain(3, 4))).toEqual(["laser", "base", "camera"]);
    expect(names(forest.chain(0, 3))).toEqual(["map", "odom", "base", "laser"]);
    expect(names(forest.chain(2, 2))).toEqual(["base"]);
    expect(forest.chain(3, 6)).toBeNull();
  });

  it("returns the descendants of a frame", () => {
    expect(names(forest.subtree(2))?.sort()).toEqual(["base", "camera", "laser"]);
    expect(names(forest.roots)).toEqual(["map", "world"]);
  });

  it("terminates if the tree is invalid", () => {
    const loop = new Forest(1, [frame("a", 1), frame("b", 0), frame("self", 2), frame("far", 99)], []);
    expect(loop.ancestors(0).length).toBeLessThanOrEqual(4);
    expect(loop.subtree(0).length).toBeLessThanOrEqual(6);
  });
});

describe("the playhead", () => {
  const update = (time: number) =>
    ({ kind: "frames", revision: 1, time, origin: [0, 0, 0], count: 0, displays: [] }) as unknown as FrameUpdate;

  it("is the requested time until its frame update arrives", () => {
    const sent: ClientMessage[] = [];
    const model = new Model((message) => void sent.push(message));
    model.setFrameUpdate(update(10e9));
    for (let press = 0; press < 3; press++) {
      model.setClock({ live: false, playing: false }, model.playhead + 1e9);
      model.setFrameUpdate(update(10e9)); // sent before the seek
    }
    expect(sent.map((message) => message.type === "time" && message.mode === "at" && message.at)).toEqual([
      11e9, 12e9, 13e9,
    ]);
    expect([model.playhead, model.isSeeking]).toEqual([13e9, true]);
    model.setFrameUpdate(update(13e9));
    model.setFrameUpdate(update(14e9));
    expect([model.playhead, model.isSeeking]).toEqual([14e9, false]);
  });

  it("is the time of the next message after a step", () => {
    const model = new Model(() => {});
    model.setClock({ live: false, playing: false }, 5e9);
    model.step(1);
    model.setFrameUpdate(update(5.1e9));
    expect(model.playhead).toBe(5.1e9);
  });
});

describe("display options", () => {
  const options = (values: Record<string, never | string | number | boolean | null>) =>
    new Options(values, [
      { key: "Alpha", kind: "number", value: 0.5, min: 0, max: 1, step: 0.1 },
      { key: "Color", kind: "color", value: "#010203" },
      { key: "Style", kind: "choice", value: "Points", choices: ["Points", "Boxes"] },
    ]);

  it("use the default for invalid values", () => {
    const given = options({ Alpha: 7, Color: "255; 170; 0", Style: "Boxes" });
    expect([given.number("Alpha"), given.color("Color"), given.choice("Style")]).toEqual([1, "#ffaa00", "Boxes"]);
    const wrong = options({ Alpha: "x", Color: "999; 0; 0", Style: "Teapots" });
    expect([wrong.number("Alpha"), wrong.color("Color"), wrong.choice("Style")]).toEqual([0.5, "#010203", "Points"]);
    expect(options({ Alpha: null }).number("Alpha")).toBe(0.5);
  });

  it("set the fields of a subscription, with defaults for invalid values", () => {
    const quality = { reliability: "automatic", durability: "automatic", depth: 10 };
    const scan = new Options<"LaserScan">({ "Color Transformer": "FlatColor", Axis: 1 }, DISPLAYS.LaserScan.options);
    expect(scan.subscription()).toEqual({ color_by: "flat", channel: "intensity", axis: "z", decay: 0, ...quality });
    const odometry = new Options<"Odometry">({ Keep: 12.4 }, DISPLAYS.Odometry.options);
    expect(odometry.subscription()).toEqual({ keep: 12, ...quality });
    expect(new Options<"Path">({}, DISPLAYS.Path.options).subscription()).toEqual({ history: 1, ...quality });
    expect(new Options<"TF">({}, DISPLAYS.TF.options).subscription()).toEqual({});
  });

  it("have no effect without the flag that they need", () => {
    const [camera, image] = [DISPLAYS.Camera.options, DISPLAYS.Image.options].map((specs) => new Options({}, specs));
    const rectified = DISPLAYS.Image.options.find(({ key }) => key === "Rectified") as OptionSpec;
    expect([camera?.hasEffect(rectified), image?.hasEffect(rectified)]).toEqual([true, false]);
  });

  it("convert colors to and from the format of RViz", () => {
    expect(rvizColor(cssColor("48; 48; 48") as string)).toBe("48; 48; 48");
    expect(cssColor([0, 255, 16])).toBe("#00ff10");
  });
});

describe("formatted numbers", () => {
  it("have no negative zero, and a minus sign", () => {
    expect(format.formatFixed(-0.00001, 2)).toBe("0.00");
    expect(format.formatFixed(-1.5, 1)).toBe("−1.5");
    expect(format.formatFixed(NaN, 2)).toBe("–");
  });

  it("are short in columns", () => {
    expect([0.0123, 5, 250, 90000].map(format.duration)).toEqual(["12 ms", "5.0 s", "4 min", "25 h"]);
    expect([50, 99.97, 12345, null].map(format.rate)).toEqual(["50.0 Hz", "100 Hz", "12.3 kHz", ""]);
    expect([0.0042, 1.5, 12000].map(format.meters)).toEqual(["4.2 mm", "1.500 m", "12.00 km"]);
  });

  it("are decoded from base64, also if it is invalid", () => {
    expect(Array.from(decodeCounts(btoa("\x01\x00\x00\x01"), 3))).toEqual([1, 256, 0]);
    expect(Array.from(decodeCounts("not base64!", 2))).toEqual([0, 0]);
  });
});
