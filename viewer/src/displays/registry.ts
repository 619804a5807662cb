// SPDX-License-Identifier: Apache-2.0
/** The class that draws each display. The compiler reports displays of the server that are missing here. */

import type { DisplayClass } from "../generated/displays";
import type { Meshes } from "../scene/meshes";
import { AxesDisplay } from "./axes";
import { CameraDisplay } from "./camera_info";
import { CloudDisplay } from "./cloud";
import type { Context, Display, DisplayConfig } from "./display";
import { GridDisplay } from "./grid";
import { ImageDisplay } from "./image";
import { MapDisplay } from "./map";
import { MarkersDisplay } from "./markers";
import { PathDisplay } from "./path";
import { PosesDisplay } from "./poses";
import { RangeDisplay } from "./range";
import { RobotDisplay } from "./robot";
import { TfDisplay } from "./tf";

type Maker = new (id: number, config: DisplayConfig, context: Context, meshes: Meshes) => Display;

export const MAKERS: Readonly<Record<DisplayClass, Maker>> = {
  Axes: AxesDisplay,
  Camera: ImageDisplay,
  CameraInfo: CameraDisplay,
  Grid: GridDisplay,
  Image: ImageDisplay,
  LaserScan: CloudDisplay,
  Map: MapDisplay,
  Marker: MarkersDisplay,
  MarkerArray: MarkersDisplay,
  Odometry: PosesDisplay,
  Path: PathDisplay,
  PointCloud2: CloudDisplay,
  Pose: PosesDisplay,
  PoseArray: PosesDisplay,
  PoseWithCovariance: PosesDisplay,
  Range: RangeDisplay,
  RobotModel: RobotDisplay,
  TF: TfDisplay,
};
