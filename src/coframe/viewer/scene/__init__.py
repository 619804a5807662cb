"""What the page draws and lists of a buffer: poses, statistics, the timeline and relations between frames."""
