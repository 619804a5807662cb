# SPDX-License-Identifier: Apache-2.0
"""``coframe router``: a Zenoh router with the defaults of ROS 2."""

from __future__ import annotations

import os
import sys
import time

import click

from coframe.cli.declaration import Command
from coframe.cli.lifecycle import run_until_interrupted
from coframe.cli.output import log

__all__ = ["router"]

NODE = "coframe_router"
_UPDATE_PERIOD = 1.0  # seconds


@click.command(cls=Command)
@click.option(
    "--config",
    metavar="FILE",
    default="",
    show_default=False,
    help="Zenoh configuration file (JSON5), which replaces the defaults. [default: $ZENOH_ROUTER_CONFIG_URI]",
)
@click.option(
    "--listen",
    metavar="ENDPOINT",
    multiple=True,
    help="Endpoint to listen on, e.g. tcp/0.0.0.0:7447 for all interfaces; repeatable. [default: tcp/127.0.0.1:7447, "
    "only this machine]",
)
@click.option(
    "--connect",
    metavar="ENDPOINT",
    multiple=True,
    help="Endpoint of another router to connect to, e.g. tcp/10.0.0.5:7447; repeatable.",
)
def router(
    config: str,
    listen: tuple[str, ...],
    connect: tuple[str, ...],
) -> None:
    """Run a Zenoh router, which connects Zenoh nodes to each other, also across networks.

    The defaults are those of ROS 2's rmw_zenohd, except that the router listens only on this machine. The router prints
    a line whenever a process connects or disconnects. Without certificates, anyone who can reach an endpoint can read
    and publish everything.

    Example: coframe router --listen tcp/0.0.0.0:7447
    """
    from coframe.wire.zenoh.router import Router, how_to_reach  # noqa: PLC0415 - `coframe --help` must be fast

    def report(text: str) -> None:
        log("INFO", NODE, text)

    if not sys.stderr.isatty():
        os.environ.setdefault("NO_COLOR", "1")  # for the log of Zenoh
    with run_until_interrupted(), Router(file=config, listen=listen, connect=connect) as running:
        for endpoint in running.endpoints:
            report(f"Listening on {endpoint}. {how_to_reach(endpoint)}")
        for endpoint in connect:
            report(f"Connecting to {endpoint}")
        running.report_connections(report)
        while True:
            time.sleep(_UPDATE_PERIOD)
            running.report_omitted()
