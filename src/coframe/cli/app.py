"""All commands together."""

from __future__ import annotations

from coframe.cli.bag import bag
from coframe.cli.batch import batch
from coframe.cli.cloud import cloud
from coframe.cli.demo import demo
from coframe.cli.doctor import doctor
from coframe.cli.echo import echo
from coframe.cli.frames import frames
from coframe.cli.joints import joints
from coframe.cli.lookup import lookup
from coframe.cli.monitor import monitor
from coframe.cli.new_app import new_app
from coframe.cli.play import PlayCommand, play
from coframe.cli.record import record
from coframe.cli.relay import relay
from coframe.cli.robot import robot
from coframe.cli.static import static
from coframe.cli.trajectory import trajectory
from coframe.cli.view import view
from coframe.cli.why import WhyCommand, why

__all__ = ["app"]

app = new_app()
app.command()(demo)
app.command()(doctor)
app.command()(echo)
app.command()(frames)
app.command()(monitor)
app.command(cls=WhyCommand)(why)
app.command()(view)
app.command()(relay)
app.command()(lookup)
app.command()(trajectory)
app.command()(record)
app.command(cls=PlayCommand)(play)
app.command()(cloud)
app.command()(batch)
app.command(context_settings={"ignore_unknown_options": True, "allow_extra_args": True})(robot)
app.command(context_settings={"ignore_unknown_options": True, "allow_extra_args": True})(joints)
app.add_typer(bag, name="bag")
# The numbers of a transform may be negative: this command reads its arguments itself.
app.command(add_help_option=False, context_settings={"ignore_unknown_options": True, "allow_extra_args": True})(static)
