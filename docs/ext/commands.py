"""``{commands}``: what `nearsight COMMAND --help` says, for every command, as tables."""

import re

import click
from docutils import nodes
from sphinx import addnodes
from sphinx.util.docutils import SphinxDirective

from nearsight.cli import cli

ARGUMENTS = {  # of which `--help` says nothing but the name
    "names": "Pictures to draw; all if none is named (see the gallery).",
    "labels": "Claims; all if none is named.",
}


class Commands(SphinxDirective):
    """List every command with its arguments and options."""

    def run(self):
        """Return one section a command."""
        context = click.Context(cli, info_name="nearsight")
        names = cli.list_commands(context)
        return [self.section(name, cli.get_command(context, name)) for name in names]

    def section(self, name, command):
        """Return title, usage, help and a table of options."""
        context = click.Context(command, info_name=f"nearsight {name}")
        found = nodes.section(ids=[f"command-{name}"], names=[name])
        found += nodes.title(name, name)
        usage = " ".join(["nearsight", name, *command.collect_usage_pieces(context)])
        found += nodes.literal_block(usage, usage, language="none")
        for text in (command.help or "").split("\n\n"):
            found += prose(text)
        rows = []
        for parameter in command.get_params(context):
            if isinstance(parameter, click.Argument):
                rows.append((parameter.make_metavar(context), ARGUMENTS[parameter.name]))
            elif row := parameter.get_help_record(context):
                rows.append(row)
        found += table(rows)
        closing = Rows()
        command.format_epilog(context, closing)
        if closing.rows:
            found += self.pictures()
            found += table(closing.rows)
        return found

    def pictures(self):
        """Return the line above the list of pictures, with a link to the gallery."""
        link = addnodes.pending_xref(
            refdoc=self.env.docname,
            refdomain="std",
            reftype="doc",
            reftarget="/gallery",
            refexplicit=True,
        )
        link += nodes.inline("", "gallery")
        text = "The pictures, and in brackets the options that each takes; they are shown in the "
        return nodes.paragraph("", "", nodes.Text(text), link, nodes.Text("."))


class Rows(click.HelpFormatter):
    """What keeps the list that a command's help ends with."""

    def __init__(self):
        super().__init__()
        self.rows = []

    def write_dl(self, rows, col_max=30, col_spacing=2):
        """Keep rows of name and text."""
        self.rows += rows


def prose(text):
    """Return a text as a paragraph, in which options are code."""
    found = nodes.paragraph()
    for piece in re.split(r"((?<![\w-])--?[a-z][a-z-]*)", " ".join(text.split())):
        found += nodes.literal("", piece) if piece.startswith("-") else nodes.Text(piece)
    return found


def table(rows):
    """Return rows of option and help as a table."""
    group = nodes.tgroup(cols=2)
    group += [nodes.colspec(colwidth=35), nodes.colspec(colwidth=65)]
    body = nodes.tbody()
    for option, text in rows:
        row = nodes.row()
        row += nodes.entry("", nodes.paragraph("", "", nodes.literal(option, option)))
        row += nodes.entry("", prose(text))
        body += row
    group += body
    return nodes.table("", group, classes=["options"])


def setup(app):
    """Register the directive."""
    app.add_directive("commands", Commands)
    return {"parallel_read_safe": True}
