"""``{gallery}``: every picture of `nearsight figures`, with its caption and its command."""

import re

from docutils import nodes
from sphinx.util.docutils import SphinxDirective

from nearsight.cli.options import option_of
from nearsight.figures import pictures


class Gallery(SphinxDirective):
    """Show all pictures from `docs/figures/`; one that is not there is a warning."""

    def run(self):
        """Return one section a picture."""
        return [self.section(picture) for picture in pictures()]

    def section(self, picture):
        """Return title, picture, caption, command and the options it takes."""
        found = nodes.section(ids=[f"figure-{picture.name}"], names=[picture.name])
        found += nodes.title(picture.name, picture.name)
        found += nodes.paragraph("", unbroken(picture.title))
        figure = nodes.figure(classes=["picture"])
        file = f"{picture.name}.svg"
        link = nodes.reference(refuri=f"_images/{file}", internal=True)  # where Sphinx puts it
        link += nodes.image(uri=f"figures/{file}", alt=picture.title)
        figure += link
        figure += nodes.caption("", unbroken(picture.caption))
        found += figure
        command = f"nearsight figures {picture.name}"
        found += nodes.literal_block(command, command, language="none")
        text = nodes.paragraph("", "Options it takes:" if picture.takes else "It takes no options.")
        for name in picture.takes:
            text += nodes.Text(" ")
            text += nodes.literal("", option_of(name))
        if picture.takes:
            text += nodes.Text(".")
        if picture.label:
            text += nodes.Text(" In the paper: ")
            text += nodes.literal("", picture.label)
        found += text
        return found


def unbroken(text):
    """Return a text in which a line does not end within a sum or a comparison."""
    # A browser breaks a line behind a hyphen, even before a no-break space: hence the word joiner.
    return re.sub(r" ([-+=]|[<>]=?) (?=\S)", "\u00a0\\1\u2060\u00a0", text)


def setup(app):
    """Register the directive."""
    app.add_directive("gallery", Gallery)
    return {"parallel_read_safe": True}
