"""The parts of rclpy that are imported by name only for type hints."""
