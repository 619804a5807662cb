"""What the page draws and lists of a buffer: poses, statistics, timeline and relations."""
