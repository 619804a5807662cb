"""Messages between the server and the page."""
