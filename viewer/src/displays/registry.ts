// SPDX-License-Identifier: Apache-2.0
/** The class that draws each display. The compiler reports displays of the server that are missing here. */

import type { DisplayClass } from "../generated/displays";
import type { Meshes } from "../scene/meshes";
import { AxesDisplay } from "./axes";
import { BoxesDisplay, RectanglesDisplay } from "./boxes";
import { CameraDisplay } from "./camera_info";
import { CellsDisplay } from "./cells";
import { CloudDisplay } from "./cloud";
import type { Context, Display, DisplayConfig } from "./display";
import { DiagnosticsDisplay } from "./diagnostics";
import { FixDisplay } from "./fixes";
import { GridDisplay } from "./grid";
import { ImageDisplay } from "./image";
import { InteractiveDisplay } from "./interactive";
import { EffortDisplay, TrajectoryDisplay } from "./joints";
import { MapDisplay } from "./map";
import { MarkersDisplay } from "./markers";
import { PointDisplay, PolygonDisplay } from "./outlines";
import { ParticlesDisplay } from "./particles";
import { PathDisplay } from "./path";
import { PosesDisplay } from "./poses";
import { RangeDisplay } from "./range";
import { RobotDisplay } from "./robot";
import { TfDisplay } from "./tf";
import { ImuDisplay, ScrewDisplay } from "./vectors";

type Maker = new (id: number, config: DisplayConfig, context: Context, meshes: Meshes) => Display;

export const MAKERS: Readonly<Record<DisplayClass, Maker>> = {
  AccelStamped: ScrewDisplay,
  Axes: AxesDisplay,
  BoundingBox3DArray: BoxesDisplay,
  Camera: ImageDisplay,
  CameraInfo: CameraDisplay,
  DepthCloud: CloudDisplay,
  Detection2D: RectanglesDisplay,
  Detection2DArray: RectanglesDisplay,
  Detection3D: BoxesDisplay,
  Detection3DArray: BoxesDisplay,
  DiagnosticArray: DiagnosticsDisplay,
  Effort: EffortDisplay,
  FluidPressure: CloudDisplay,
  Grid: GridDisplay,
  GridCells: CellsDisplay,
  Illuminance: CloudDisplay,
  Image: ImageDisplay,
  Imu: ImuDisplay,
  InteractiveMarkers: InteractiveDisplay,
  JointTrajectory: TrajectoryDisplay,
  LaserScan: CloudDisplay,
  Map: MapDisplay,
  Marker: MarkersDisplay,
  MarkerArray: MarkersDisplay,
  NavSatFix: FixDisplay,
  Odometry: PosesDisplay,
  ParticleCloud: ParticlesDisplay,
  Path: PathDisplay,
  PointCloud: CloudDisplay,
  PointCloud2: CloudDisplay,
  PointStamped: PointDisplay,
  Polygon: PolygonDisplay,
  Pose: PosesDisplay,
  PoseArray: PosesDisplay,
  PoseWithCovariance: PosesDisplay,
  Range: RangeDisplay,
  RelativeHumidity: CloudDisplay,
  RobotModel: RobotDisplay,
  TF: TfDisplay,
  Temperature: CloudDisplay,
  TwistStamped: ScrewDisplay,
  VoxelGrid: CellsDisplay,
  Wrench: ScrewDisplay,
};
