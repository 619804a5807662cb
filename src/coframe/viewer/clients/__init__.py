"""The connected browser tabs: what each of them shows, requests and receives."""
