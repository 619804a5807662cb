"""Robot descriptions, their meshes and joint states."""
