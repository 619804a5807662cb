"""Implementation modules of rclpy. Users import them only for type annotations."""
