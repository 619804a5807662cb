// SPDX-License-Identifier: Apache-2.0
/** The available displays, by RViz's class names. */

import type { Meshes } from "../scene/meshes";
import { AxesDisplay, AXES_SPECS } from "./axes";
import { CameraDisplay, CAMERA_SPECS } from "./camera_info";
import { CloudDisplay, cloudSpecs } from "./cloud";
import type { Context, Display, DisplayConfig } from "./display";
import { GridDisplay, GRID_SPECS } from "./grid";
import { IMAGE_SPECS, ImageDisplay, PROJECT } from "./image";
import { MapDisplay, MAP_SPECS } from "./map";
import { MarkersDisplay, MARKER_SPECS } from "./markers";
import type { OptionSpec } from "./options";
import { PathDisplay, PATH_SPECS } from "./path";
import { COVARIANT_POSE_SPECS, ODOMETRY_SPECS, POSE_SPECS, PosesDisplay } from "./poses";
import { RANGE_SPECS, RangeDisplay } from "./range";
import { ROBOT_SPECS, RobotDisplay } from "./robot";
import { TF_SPECS, TfDisplay } from "./tf";

interface Kind {
  specs: readonly OptionSpec[];
  /** Whether it uses too much bandwidth to be displayed automatically. */
  heavy?: boolean;
  /** Whether it displays a topic. */
  topic: boolean;
  make(id: number, config: DisplayConfig, specs: readonly OptionSpec[], context: Context, meshes: Meshes): Display;
}

type Maker = new (id: number, config: DisplayConfig, specs: readonly OptionSpec[], context: Context) => Display;

function plain(specs: readonly OptionSpec[], Class: Maker, topic = true): Kind {
  return { specs, topic, make: (id, config, own, context) => new Class(id, config, own, context) };
}

const markers: Kind = { specs: MARKER_SPECS, topic: true, make: (...all) => new MarkersDisplay(...all) };

/**
 * RViz's Camera display: an image into which the scene is projected. Earlier versions of this page saved the display of
 * a CameraInfo under this name.
 */
const camera: Kind = {
  specs: IMAGE_SPECS,
  heavy: true,
  topic: true,
  make: (id, config, specs, context) => {
    if (/camera_info$/.test(config.topic ?? "")) return new CameraDisplay(id, config, CAMERA_SPECS, context);
    config.options[PROJECT] ??= true;
    return new ImageDisplay(id, config, specs, context);
  },
};

export const KINDS: Record<string, Kind> = {
  TF: plain(TF_SPECS, TfDisplay, false),
  Grid: plain(GRID_SPECS, GridDisplay, false),
  Axes: plain(AXES_SPECS, AxesDisplay, false),
  RobotModel: { specs: ROBOT_SPECS, topic: false, make: (...all) => new RobotDisplay(...all) },
  LaserScan: plain(cloudSpecs(0.03, "Intensity"), CloudDisplay),
  PointCloud2: plain(cloudSpecs(0.01, "AxisColor"), CloudDisplay),
  PointCloud: plain(cloudSpecs(0.01, "AxisColor"), CloudDisplay),
  Map: plain(MAP_SPECS, MapDisplay),
  Path: plain(PATH_SPECS, PathDisplay),
  Pose: plain(POSE_SPECS, PosesDisplay),
  PoseWithCovariance: plain(COVARIANT_POSE_SPECS, PosesDisplay),
  PoseArray: plain(POSE_SPECS, PosesDisplay),
  Odometry: plain(ODOMETRY_SPECS, PosesDisplay),
  Marker: markers,
  MarkerArray: markers,
  Range: plain(RANGE_SPECS, RangeDisplay),
  Camera: camera,
  Image: { ...plain(IMAGE_SPECS, ImageDisplay), heavy: true },
  CameraInfo: plain(CAMERA_SPECS, CameraDisplay),
};

/** Removes the package of a class: "rviz_default_plugins/TF" and "rviz/TF" are both TF. */
export function kindName(className: string): string {
  return className.replace(/^.*\//, "");
}
