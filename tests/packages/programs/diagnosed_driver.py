# SPDX-License-Identifier: Apache-2.0
"""A driver that reports its temperature and the rate of its topic."""

import diagnostic_updater
import rclpy
from diagnostic_msgs.msg import DiagnosticStatus
from rclpy.node import Node
from sensor_msgs.msg import Temperature


class Driver(Node):
    def __init__(self):
        super().__init__("driver")
        self.updater = diagnostic_updater.Updater(self, period=0.5)
        self.updater.setHardwareID("sensor 12")
        self.updater.add("Temperature", self.check_temperature)
        bounds = {"min": 5.0, "max": 50.0}
        self.publisher = diagnostic_updater.DiagnosedPublisher(
            self.create_publisher(Temperature, "temperature", 10),
            self.updater,
            diagnostic_updater.FrequencyStatusParam(bounds, 0.5, 10),
            diagnostic_updater.TimeStampStatusParam(),
        )
        self.temperature = 85.0
        self.create_timer(0.05, self.read)

    def read(self):
        message = Temperature(temperature=self.temperature)
        message.header.stamp = self.get_clock().now().to_msg()
        self.publisher.publish(message)

    def check_temperature(self, stat):
        if self.temperature > 80.0:
            stat.summary(DiagnosticStatus.WARN, "too hot")
        else:
            stat.summary(DiagnosticStatus.OK, "fine")
        stat.add("temperature", f"{self.temperature:.1f}")
        return stat


def main():
    rclpy.init()
    try:
        rclpy.spin(Driver())
    except KeyboardInterrupt:
        pass
    rclpy.try_shutdown()


if __name__ == "__main__":
    main()
