# SPDX-License-Identifier: Apache-2.0
"""``coframe bag edit``: writes an edited copy of a recording."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

import click

from coframe._output.formatting import count
from coframe.bags import COMPRESSIONS
from coframe.bags.editing import RULES, Recipe
from coframe.bags.editing import edit as edit_recording
from coframe.cli.declaration import PATH, Command
from coframe.cli.lifecycle import run_to_completion
from coframe.cli.options import bag_argument, keep_option
from coframe.cli.output import fail, one_line, printable, warn
from coframe.cli.progress import reading_progress
from coframe.errors import EditError

if TYPE_CHECKING:
    from pathlib import Path

    from coframe._sources.sources import Readable
    from coframe.bags.editing import EditReport

__all__ = ["NOTHING_MATCHED", "edit", "print_report"]

NOTHING_MATCHED = 3  # exit code if a rule changed nothing
_RULES_KEY = "coframe.edit.rules"
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?", re.ASCII)
_WORDS = {"set-static": 2, "replace-mount": 1}  # words before the numbers of rules with several words
_HELP = {
    "rename-frame": "Give a frame another name in all messages and robot descriptions.",
    "prefix": "Prefix for all frame names, including the slash, e.g. robot1/.",
    "strip-slashes": "Remove leading slashes from frame names.",
    "rename-topic": "Give a topic another name; /a/*=/b/* for all topics of a namespace.",
    "drop-topic": "Leave a topic out; * stands for any characters.",
    "shift": "Move the stamps in messages: of a topic, of a frame (its transforms and the messages in it), of "
    "PARENT->CHILD, or of a node that the recording names. OFFSET is +35ms or -1h.",
    "shift-log": "Move the receive times of a topic (* for all) instead of the stamps in its messages.",
    "clock": "Convert the stamps that are on the other clock: wall or sim, with the recorded /clock.",
    "set-static": "Add a static transform, or replace the one of CHILD; in meters and radians, or with a quaternion x "
    "y z w. Or all those of a FILE: a robot description, a calibration (Kalibr, Autoware, camera_info) or a recording.",
    "replace-mount": "Correct the pose of a frame that does not move, and keep everything else about its transform.",
    "drop-publisher": "Leave out one of two publishers: see the guide for the forms.",
    "dedupe": "Remove messages with a stamp, and transforms, that repeat an earlier one.",
    "time": "Keep only a time span, by receive time, such as 10s..60s, 10s.. or ..-2s.",
    "rate": "Thin a topic to a rate in Hz; of transforms, each child frame.",
    "static-first": "Also write the static transforms that come late at the beginning.",
    "drop-invalid": "Remove transforms that tf2 rejects, such as those with NaN.",
}


class _EditCommand(Command):
    """Reads the rules from the command line in order, including rules of several words."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Remove the rules from the words, then parse the others as usual."""
        rules, rest = [], []
        words = list(args)
        while words:
            word = words.pop(0)
            if word == "--":
                rest += [word, *words]
                break
            name, equals, value = word.removeprefix("--").partition("=")
            if not word.startswith("--") or name not in RULES:
                rest.append(word)
            elif equals or not RULES[name].form:
                rules.append((name, value))
            else:
                word_count = _length(name, words)
                if not words or (word_count == 1 and words[0].startswith("--")):
                    ctx.fail(f"Option '--{name}' requires a value: {RULES[name].form}.")
                rules.append((name, _join_words(words[:word_count])))
                del words[:word_count]
        ctx.meta[_RULES_KEY] = rules
        return super().parse_args(ctx, rest)


def _length(name: str, words: list[str]) -> int:
    """Return how many words the value of a rule has."""
    if name not in _WORDS or any(" " in word for word in words[:1]):
        return 1
    names = _WORDS[name]
    numbers = 0
    while numbers < 7 and len(words) > names + numbers and _NUMBER.fullmatch(words[names + numbers]):
        numbers += 1
    if numbers:
        return names + numbers
    return 1 + next(
        (place for place, word in enumerate(words[1:]) if "=" not in word or word.startswith("-")), len(words[1:])
    )


def _join_words(words: list[str]) -> str:
    return words[0] if len(words) == 1 else " ".join(f"'{word}'" if " " in word else word for word in words)


def _rule_options(command: Any) -> Any:
    """Declare the options of all rules, for the help; `_EditCommand` takes them from the command line."""
    for name, rule in reversed(RULES.items()):
        # --keep is an option of its own here.
        form = rule.form.partition(" [keep")[0]
        option: dict[str, Any] = {"metavar": form} if form else {"is_flag": True}
        command = click.option(f"--{name}", expose_value=False, help=_HELP[name], **option)(command)
    return command


@click.command(cls=_EditCommand, short_help="Edit frames, topics, stamps and mounts of a recording.")
@bag_argument
@click.option("--output", "-o", metavar="OUT", type=PATH, help="File or folder to create for the copy.")
@_rule_options
@keep_option
@click.option(
    "--recipe", "recipes", metavar="FILE", type=PATH, multiple=True, help="Apply the rules of a YAML file first."
)
@click.option("--save-recipe", metavar="FILE", type=PATH, help="Write the rules to a YAML file.")
@click.option("--dry-run", is_flag=True, help="Only count what each rule would change.")
@click.option(
    "--compression", metavar="METHOD", help="Compression of MCAP chunks: none, zstd or lz4. [default: the same as BAG]"
)
@click.pass_context
def edit(
    context: click.Context,
    bag: Readable,
    output: Path | None,
    keep: str,
    recipes: tuple[Path, ...],
    save_recipe: Path | None,
    dry_run: bool,
    compression: str | None,
) -> None:
    """Write an edited copy of the recording BAG; BAG is not changed.

    Rules are applied in the order in which they are given, and each can be repeated. Everything else is
    copied unchanged. The copy has the format of BAG: a file if OUT has a file suffix (fixed.mcap), otherwise a
    folder. ROS 1 bags become MCAP.

    The exit code is 3 if the copy was written but a rule changed nothing, such as one with a misspelled name.

    Example: coframe bag edit run.mcap -o new.mcap --rename-frame Lidar=lidar

    Example: coframe bag edit run -o new --shift /points=+35ms --dedupe

    Example: coframe bag edit run -o new --set-static base lidar 1 0 2 0 0 0

    Example: coframe bag edit run -o r1 --prefix r1/ --keep map --dry-run
    """
    if compression not in {None, *COMPRESSIONS}:
        fail(f"--compression: unknown method {compression!r}", f"Methods: {', '.join(COMPRESSIONS)}.", code=2)
    with run_to_completion():
        recipe = _recipe(recipes, context.meta[_RULES_KEY], keep)
        if not len(recipe):
            fail("no rule is given", "See `coframe bag edit --help` for the rules.", code=2)
        if save_recipe is not None:
            recipe.save(save_recipe)
        if output is None and not dry_run:
            if save_recipe is not None:
                return
            fail("give the recording to write: -o OUT, or --dry-run", code=2)
        with reading_progress() as progress:
            report = edit_recording(
                bag, None if dry_run else output, recipe, compression=compression, progress=progress
            )
        print_report(report)
        if report.unmatched:
            raise click.exceptions.Exit(NOTHING_MATCHED)


def _recipe(files: tuple[Path, ...], rules: list[tuple[str, str]], keep: str) -> Recipe:
    recipe = Recipe()
    try:
        for file in files:
            for rule in Recipe.load(file):
                recipe.add(rule.name, rule.text)
        for name, value in rules:
            recipe.add(name, f"{value} keep {keep}" if name == "prefix" and keep else value)
    except EditError as error:
        fail(str(error), error.hint, code=2)
    return recipe


def print_report(report: EditReport) -> None:
    """Print what each rule changed, and warn about those that changed nothing."""
    for rule in report.rules:
        print(one_line(f"{rule.rule}: {rule.text}"))
    for rule in report.unmatched:
        warn(f"{rule.rule} matched nothing. {rule.hint}".rstrip())
    for note in report.notes:
        warn(note)
    amount = count(report.messages, "message")
    print(printable(f"{report.path}: {amount}" if report.path is not None else f"nothing written; {amount} would be"))
