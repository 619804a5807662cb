# SPDX-License-Identifier: Apache-2.0
# ruff: noqa: E501 - lines of published files
"""Calibration files: published values of each format, and what the format's own program reads from them."""

import base64
import json
from contextlib import suppress

import cv2
import numpy as np
import pytest

import coframe
from coframe.calibration import FORMATS, CalibrationError, read
from coframe.cameras import CameraModel

# From the documentation of Kalibr.
CAMCHAIN = """
cam0:
  T_cam_imu:
  - [0.01779318, 0.99967549,-0.01822936, 0.07008565]
  - [-0.9998017, 0.01795239, 0.00860714,-0.01771023]
  - [0.00893160, 0.01807260, 0.99979678, 0.00399246]
  - [0.0, 0.0, 0.0, 1.0]
  camera_model: pinhole
  distortion_coeffs: [-0.294719325148729, 0.08601391290708914, -0.0003238494917967103, -0.00041999959826033857]
  distortion_model: radtan
  intrinsics: [461.15862106007575, 459.75286598073296, 362.6593161518, 248.5211018610]
  resolution: [752, 480]
  rostopic: /cam0/image_raw
  timeshift_cam_imu: -8.121e-05
cam1:
  T_cn_cnm1:
  - [ 0.99998854, 0.00216014, 0.00427195,-0.11003785]
  - [-0.00221074, 0.99992702, 0.01187697, 0.00045792]
  - [-0.00424598,-0.01188627, 0.99992034,-0.00064487]
  - [0.0, 0.0, 0.0, 1.0]
  camera_model: omni
  distortion_coeffs: [-0.2, 0.05, 0.001, -0.001]
  distortion_model: radtan
  intrinsics: [1.4, 460.0, 459.0, 362.0, 248.0]
  resolution: [752, 480]
  rostopic: /cam1/image_raw
"""
# calib_velo_to_cam.txt and calib_imu_to_velo.txt of 2011_09_26, calib.txt of sequence 00.
VELO_TO_CAM = """calib_time: 15-Mar-2012 11:37:16
R: 7.533745e-03 -9.999714e-01 -6.166020e-04 1.480249e-02 7.280733e-04 -9.998902e-01 9.998621e-01 7.523790e-03 1.480755e-02
T: -4.069766e-03 -7.631618e-02 -2.717806e-01
delta_f: 0.000000e+00 0.000000e+00
"""
IMU_TO_VELO = """calib_time: 25-May-2012 16:47:16
R: 9.999976e-01 7.553071e-04 -2.035826e-03 -7.854027e-04 9.998898e-01 -1.482298e-02 2.024406e-03 1.482454e-02 9.998881e-01
T: -8.086759e-01 3.195559e-01 -7.997231e-01
"""
ODOMETRY = """P0: 7.188560e+02 0 6.071928e+02 0 0 7.188560e+02 1.852157e+02 0 0 0 1 0
P1: 7.188560e+02 0 6.071928e+02 -3.861448e+02 0 7.188560e+02 1.852157e+02 0 0 0 1 0
Tr: 4.276802e-04 -9.999672e-01 -8.084491e-03 -1.198460e-02 -7.210626e-03 8.081198e-03 -9.999413e-01 -5.403984e-02 9.999738e-01 4.859485e-04 -7.206933e-03 -2.921968e-01
"""
# From nuScenes mini.
CALIBRATED_SENSORS = [
    {
        "token": "1d31c729b073425e8e0202c5c6e66ee1",
        "sensor_token": "725903f5b62f56118f4094b46a4470d8",
        "translation": [1.70079118954, 0.0159456324149, 1.51095763913],
        "rotation": [0.4998015430569128, -0.5030316162024876, 0.4997798114386805, -0.49737083824542755],
        "camera_intrinsic": [[1266.417203046554, 0, 816.2670197447984], [0, 1266.417203046554, 491.50706579294757], [0, 0, 1]],
    },
    {
        "token": "a183049901c24361a6b0b11b8013137c",
        "sensor_token": "dc8b396651c05aedbb9cdaae573bb567",
        "translation": [0.943713, 0.0, 1.84023],
        "rotation": [0.7077955119163518, -0.006492242056004365, 0.010646214713995808, -0.7063073142877817],
        "camera_intrinsic": [],
    },
]  # fmt: skip
SENSORS = [
    {"token": "725903f5b62f56118f4094b46a4470d8", "channel": "CAM_FRONT", "modality": "camera"},
    {"token": "dc8b396651c05aedbb9cdaae573bb567", "channel": "LIDAR_TOP", "modality": "lidar"},
]
AUTOWARE = """
sensor_kit_base_link:
  camera0/camera_link: {x: 0.10731, y: 0.56343, z: -0.27697, roll: -0.025, pitch: 0.315, yaw: 1.035}
  velodyne_top_base_link: {x: 0.0, y: 0.0, z: 0.0, roll: 0.0, pitch: 0.0, yaw: 1.575}
"""
CAMERA_INFO = """
image_width: 640
image_height: 480
camera_name: narrow_stereo
camera_matrix: {rows: 3, cols: 3, data: [468.0, 0.0, 330.6, 0.0, 467.9, 242.6, 0.0, 0.0, 1.0]}
distortion_model: plumb_bob
distortion_coefficients: {rows: 1, cols: 5, data: [0.08, -0.17, 0.001, -0.0002, 0.0]}
rectification_matrix: {rows: 3, cols: 3, data: [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]}
projection_matrix: {rows: 3, cols: 4, data: [474.0, 0.0, 328.9, -28.4, 0.0, 475.0, 243.0, 0.0, 0.0, 0.0, 1.0, 0.0]}
"""
HAND_EYE = """
parameters:
  name: arm_calibration
  calibration_type: eye_in_hand
  tracking_base_frame: camera_color_optical_frame
  tracking_marker_frame: marker
  robot_base_frame: base_link
  robot_effector_frame: tool0
transform:
  translation: {x: 0.05, y: -0.03, z: 0.08}
  rotation: {x: 0.0, y: 0.0, z: 0.7071067811865476, w: 0.7071067811865476}
"""
HAND_EYE_ROS1 = """
parameters: {eye_on_hand: false, robot_base_frame: base_link, robot_effector_frame: tool0, tracking_base_frame: cam,
  tracking_marker_frame: marker}
transformation: {qw: 0.7071067811865476, qx: 0.0, qy: 0.0, qz: 0.7071067811865476, x: 1.0, y: 0.0, z: 0.5}
"""
# A camera and an image at a known place, written by pycolmap 4.2.1; with it, the point (0.3, 0.2, 4) is at the pixel below.
COLMAP = {
    "cameras.bin": "AQAAAAAAAAADAAAABAAAAIACAAAAAAAA4AEAAAAAAAAAAAAAAAB5QAAAAAAAoHlAAAAAAAAIdEAAAAAAABBuQJqZmZmZmbm/exSuR+F6lD/8qfHSTWJQP/yp8dJNYmC/",
    "images.bin": "AQAAAAAAAAAHAAAAhvPrwfKs7T+amZmZmZm5P5qZmZmZmcm/MzMzMzMz0z8AAAAAAADgPwAAAAAAAPC/AAAAAAAAAEADAAAAbGVmdC8wMDAxLnBuZwAAAAAAAAAAAA==",
}  # fmt: skip
COLMAP_TEXT = {
    "cameras.txt": "# Camera list\n3 OPENCV 640 480 400 410 320.5 240.5 -0.1 0.02 0.001 -0.002\n",
    "images.txt": "# Image list\n7 0.92736184954957035 0.1 -0.2 0.3 0.5 -1 2 3 left/0001.png\n"
    "12.5 30.25 -1 400.125 20 17 5.5 6.5 -1 7 8 9\n",
}
COLMAP_PIXEL = [276.291341257911, 106.05482083165862]


def file_of(tmp_path, name, text):
    path = tmp_path / name
    path.write_text(text if isinstance(text, str) else json.dumps(text))
    return path


def test_kalibr_transforms_points_from_the_imu_into_the_camera(tmp_path):
    rig = read(file_of(tmp_path, "camchain-imucam.yaml", CAMCHAIN))
    assert "T_cam_imu transforms points from the IMU into the camera" in rig.convention
    point = np.array([0.2, -0.3, 2.0])
    # The rows of T_cam_imu, applied by hand.
    assert rig.lookup("cam0", "imu") @ point == pytest.approx(
        [0.01779318 * 0.2 - 0.99967549 * 0.3 - 0.01822936 * 2 + 0.07008565,
         -0.9998017 * 0.2 - 0.01795239 * 0.3 + 0.00860714 * 2 - 0.01771023,
         0.0089316 * 0.2 - 0.0180726 * 0.3 + 0.99979678 * 2 + 0.00399246], abs=1e-6)  # fmt: skip
    # The left camera of EuRoC is 11 cm to the left of the right one.
    assert rig.lookup("cam0", "cam1").translation == pytest.approx([0.110030, -0.000216, 0.001101], abs=1e-4)
    assert rig.time_offsets == {"cam0": -8.121e-05}
    assert rig.cameras["cam0"].image_size == (752, 480)
    assert rig.cameras["cam0"].lens.name == "plumb_bob"
    assert rig.cameras["cam1"].lens.coefficients == (1.4, -0.2, 0.05, 0.001, -0.001)


def test_kitti_raw_and_odometry(tmp_path):
    file_of(tmp_path, "calib_velo_to_cam.txt", VELO_TO_CAM)
    file_of(tmp_path, "calib_imu_to_velo.txt", IMU_TO_VELO)
    rig = read(tmp_path)
    # The cameras are 27 cm in front of the laser scanner, which is 81 cm in front of the IMU.
    assert rig.lookup("velo", "cam0").translation == pytest.approx([0.273, -0.002, -0.073], abs=2e-3)
    assert rig.lookup("imu", "velo").translation == pytest.approx([0.81, -0.307, 0.802], abs=2e-3)
    ahead = rig.lookup("cam0", "velo") @ np.array([10.0, 0.0, 0.0])
    assert ahead[2] == pytest.approx(10.0 * 9.998621e-01 - 2.717806e-01, abs=1e-5)
    single = read(file_of(tmp_path, "calib.txt", ODOMETRY))
    assert single.lookup("cam0", "cam1").translation == pytest.approx([386.1448 / 718.856, 0.0, 0.0])
    assert single.cameras["cam1"].project([0.0, 0.0, 5.0]).tolist() == [607.1928, 185.2157]
    point = np.array([8.0, 1.0, -0.5])
    tr = np.array([float(word) for word in ODOMETRY.split("Tr:")[1].split()]).reshape(3, 4)
    assert single.lookup("cam0", "velo") @ point == pytest.approx(tr @ [*point, 1.0], abs=1e-5)


def test_kitti_cameras(tmp_path):
    lines = []
    for number, tx in (("00", 0.0), ("01", -387.9)):
        lines += [
            f"S_{number}: 1392 512",
            f"K_{number}: 984.2 0 690 0 980.8 233.2 0 0 1",
            f"D_{number}: -0.37 0.2 0.001 0.001 -0.07",
            f"R_{number}: 1 0 0 0 1 0 0 0 1",
            f"T_{number}: {-0.537 if tx else 0.0} 0.006 -0.01",
            f"S_rect_{number}: 1242 375",
            f"R_rect_{number}: 1 0 0 0 1 0 0 0 1",
            f"P_rect_{number}: 721.5 0 609.6 {tx} 0 721.5 172.9 0 0 0 1 0",
        ]
    rig = read(file_of(tmp_path, "calib_cam_to_cam.txt", "\n".join(lines)))
    assert rig.lookup("cam0", "cam1").translation == pytest.approx([0.537, -0.006, 0.01])
    assert rig.cameras["cam1"].image_size == (1392, 512)
    assert rig.cameras["cam1"].baseline[0] == pytest.approx(387.9 / 721.5)


def test_nuscenes_has_w_first(tmp_path):
    file_of(tmp_path, "sensor.json", SENSORS)
    rig = read(file_of(tmp_path, "calibrated_sensor.json", CALIBRATED_SENSORS))
    camera = rig.lookup("ego", "CAM_FRONT")
    # nuscenes-devkit: Quaternion([w, x, y, z]).rotation_matrix @ [0, 0, 1]; the camera looks forward, and y is down.
    assert (camera.rotation @ [0.0, 0.0, 1.0])[0] > 0.999
    assert (camera.rotation @ [0.0, 1.0, 0.0])[2] < -0.999
    assert rig.lookup("ego", "LIDAR_TOP").translation.tolist() == [0.943713, 0.0, 1.84023]
    assert (rig.lookup("ego", "LIDAR_TOP").rotation @ [0.0, 1.0, 0.0])[0] > 0.99
    assert rig.cameras["CAM_FRONT"].k[0, 2] == 816.2670197447984
    assert list(rig.cameras) == ["CAM_FRONT"]


def test_autoware_sensor_kits(tmp_path):
    file_of(tmp_path, "sensor_kit_calibration.yaml", AUTOWARE)
    kit = "base_link:\n  sensor_kit_base_link: {x: 0.9, y: 0.0, z: 2.0, roll: -0.001, pitch: 0.015, yaw: -0.0364}\n"
    file_of(tmp_path, "sensors_calibration.yaml", kit)
    rig = read(tmp_path)
    expected = coframe.Transform.from_rpy([0.9, 0.0, 2.0], [-0.001, 0.015, -0.0364]) @ coframe.Transform.from_rpy(
        [0.10731, 0.56343, -0.27697], [-0.025, 0.315, 1.035]
    )
    assert rig.lookup("base_link", "camera0/camera_link").is_close(expected.replace(target=None, source=None))


def test_camera_info_files(tmp_path):
    rig = read(file_of(tmp_path, "left.yaml", CAMERA_INFO))
    camera = rig.cameras["narrow_stereo"]
    assert (camera.image_size, camera.lens.name, camera.baseline[0]) == ((640, 480), "plumb_bob", 28.4 / 474.0)
    expected = cv2.projectPoints(
        np.array([[0.3, -0.2, 1.5]]), np.zeros(3), np.zeros(3), camera.k, np.array([0.08, -0.17, 0.001, -0.0002, 0.0])
    )[0].ravel()
    assert camera.project([0.3, -0.2, 1.5]) == pytest.approx(expected)


def test_hand_eye_results(tmp_path):
    mount = read(file_of(tmp_path, "arm.calib", HAND_EYE)).lookup("tool0", "camera_color_optical_frame")
    assert mount.translation.tolist() == [0.05, -0.03, 0.08]
    assert mount.rpy == pytest.approx([0.0, 0.0, np.pi / 2])
    on_base = read(file_of(tmp_path, "base.yaml", HAND_EYE_ROS1)).lookup("base_link", "cam")
    assert (on_base @ np.array([1.0, 0.0, 0.0])) == pytest.approx([1.0, 1.0, 0.5])


def test_files_that_opencv_wrote(tmp_path):
    rotation, translation = cv2.Rodrigues(np.array([0.01, -0.02, 0.03]))[0], np.array([-0.12, 0.001, 0.002])
    k, d = np.array([[400.0, 0, 320], [0, 410, 240], [0, 0, 1]]), np.array([[-0.2, 0.05, 0.001, -0.002, 0.01]])
    storage = cv2.FileStorage(str(tmp_path / "stereo.yml"), cv2.FILE_STORAGE_WRITE)
    for name, matrix in (("M1", k), ("D1", d), ("M2", k), ("D2", d), ("R", rotation), ("T", translation)):
        storage.write(name, matrix)
    storage.write("image_width", 640)
    storage.write("image_height", 480)
    storage.release()
    rig = read(tmp_path / "stereo.yml")
    point = np.array([0.3, 0.2, 2.0])
    assert rig.lookup("right", "left") @ point == pytest.approx(rotation @ point + translation)
    assert rig.cameras["left"].image_size == (640, 480)
    assert np.array_equal(rig.cameras["right"].lens.coefficients, d.ravel())


@pytest.mark.parametrize("kind", ["text", "binary"])
def test_colmap(tmp_path, kind):
    for name, text in COLMAP.items() if kind == "binary" else COLMAP_TEXT.items():
        (tmp_path / name).write_bytes(base64.b64decode(text) if kind == "binary" else text.encode())
    rig = read(tmp_path)
    pose = rig.lookup("world", "left/0001.png")
    assert pose.translation == pytest.approx([-0.7154723699099141, 0.967263815045043, -1.95])
    # Its pixels have their origin half a pixel further to the upper left.
    pixel = rig.cameras["camera3"].project(pose.inverse() @ np.array([0.3, 0.2, 4.0]))
    assert pixel + 0.5 == pytest.approx(COLMAP_PIXEL, abs=1e-9)
    assert len(rig.transforms) == 1


def test_nerf_has_the_axes_of_opengl(tmp_path):
    # The first frame of the scene lego of the NeRF paper: 4 m from the origin, to which it looks.
    matrix = [
        [-0.9999021887779236, 0.004192245192825794, -0.013345719315111637, -0.05379832163453102],
        [-0.013988681137561798, -0.2996590733528137, 0.95394366979599, 3.845470428466797],
        [-4.656612873077393e-10, 0.9540371894836426, 0.29968830943107605, 1.2080823183059692],
        [0.0, 0.0, 0.0, 1.0],
    ]
    scene = {"camera_angle_x": 0.6911112070083618, "frames": [{"file_path": "./train/r_0", "transform_matrix": matrix}]}
    rig = read(file_of(tmp_path, "transforms_train.json", scene))
    origin = rig.lookup("r_0", "world") @ np.zeros(3)
    assert origin[:2] == pytest.approx([0.0, 0.0], abs=1e-2)
    assert origin[2] == pytest.approx(4.03, abs=0.01)
    assert (rig.lookup("world", "r_0").rotation @ [0.0, 1.0, 0.0])[2] < -0.9, "y points down"
    assert not rig.cameras, "the file contains no image size"
    scene |= {"w": 800, "h": 800, "k1": 0.01, "camera_model": "OPENCV_FISHEYE"}
    camera = read(file_of(tmp_path, "transforms.json", scene)).cameras["camera"]
    assert camera.k[0, 0] == pytest.approx(1111.111, abs=1e-3)  # the focal length that the paper's programs compute
    assert (camera.k[0, 2], camera.lens.name) == (399.5, "equidistant")


def test_urdfs_and_recordings(tmp_path):
    urdf = """<robot name="r"><link name="base"/><link name="cam"/><joint name="j" type="fixed"><parent link="base"/>
    <child link="cam"/><origin xyz="0.1 0.2 0.3" rpy="0 0 1.5"/></joint></robot>"""
    expected = coframe.Transform.from_rpy([0.1, 0.2, 0.3], [0.0, 0.0, 1.5])
    assert read(file_of(tmp_path, "robot.urdf", urdf)).lookup("base", "cam").is_close(expected)
    from coframe.calibration import write

    write(read(tmp_path / "robot.urdf"), tmp_path / "rig.mcap")
    assert read(tmp_path / "rig.mcap").lookup("base", "cam").is_close(expected)


@pytest.mark.parametrize(
    ("name", "text", "error"),
    [
        ("a.yaml", CAMCHAIN.replace("0.01779318,", "1.9,"), r"a\.yaml: cam0.T_cam_imu is not a rotation"),
        ("a.yaml", CAMCHAIN.replace("[752, 480]", "[752]", 1), r"cam0.resolution has 1 numbers, not 2"),
        ("a.yaml", CAMCHAIN.replace("radtan", "ftheta", 1), r"cam0 cannot be used: the distortion model 'ftheta'"),
        ("a.yaml", CAMCHAIN.replace("pinhole", "catadioptric"), r"cam0.camera_model is not supported: 'catadioptric'"),
        ("a.yaml", CAMCHAIN.replace("461.15", ".nan, 461.15", 1), r"cam0.intrinsics"),
        ("a.yaml", "a: [1", "is not valid YAML"),
        ("a.yaml", "a: 1", "is not a calibration in a known format"),
        ("a.json", "{", "is not valid JSON"),
        ("a.json", "[" * 100000, "is not valid JSON"),
        ("a.json", '{"frames": [{"transform_matrix": [[1, 0], [0, 1]]}]}', r"frames\[0\].transform_matrix has 4 numbers"),
        ("velo.txt", VELO_TO_CAM, "does not name its frames"),
        ("calib.txt", ODOMETRY.replace("9.999672e-01", "x"), "is not a list of numbers"),
        ("cameras.txt", "1 MAGIC 640 480 1 2 3\n", "the model 'MAGIC', which is not supported"),
        ("cameras.txt", "1 PINHOLE 640\n", "has the line '1 PINHOLE 640'"),
    ],
)  # fmt: skip
def test_files_with_mistakes_are_errors_that_name_the_place(tmp_path, name, text, error):
    file_of(tmp_path, "images.txt", "")
    with pytest.raises(CalibrationError, match=error):
        read(file_of(tmp_path, name, text))


def test_damaged_binary_files_are_errors(tmp_path):
    good = {name: base64.b64decode(text) for name, text in COLMAP.items()}
    random = np.random.default_rng(2)
    for name, whole in good.items():
        for _ in range(200):
            data = bytearray(whole)
            for at in random.integers(0, len(data), 3):
                data[at] = random.integers(256)
            for each, content in {**good, name: bytes(data[: random.integers(0, len(data) + 1)])}.items():
                (tmp_path / each).write_bytes(content)
            with suppress(coframe.CoframeError):
                read(tmp_path)


def test_files_that_do_not_exist(tmp_path):
    with pytest.raises(CalibrationError, match="No such file"):
        read(tmp_path / "nothing.yaml")
    assert len(FORMATS) == 11
    assert CameraModel is not None
