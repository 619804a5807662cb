# SPDX-License-Identifier: Apache-2.0
"""``coframe battery``: the lowest voltage in a recording."""

import click

import coframe


@click.command()
@click.argument("bag")
@click.option("--topic", default="/battery", show_default=True, help="Topic of the battery.")
def battery(bag: str, topic: str) -> None:
    """Print the lowest voltage in the recording BAG.

    Example: coframe battery run.mcap
    """
    with coframe.open_bag(bag) as recording:
        voltages = [each.message.voltage for each in recording.messages(topic)]
    click.echo(f"lowest voltage: {min(voltages):.1f} V in {len(voltages)} messages")
