"""Robot descriptions, their meshes, and the joint states that the page publishes."""
