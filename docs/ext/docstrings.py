"""Numpydoc as this project writes it, for napoleon.

The docstring of a property begins with a sentence, in which a colon is a colon; napoleon takes what
stands before it for a type. Attributes are listed like parameters, also two in one line.
"""

from sphinx.ext import napoleon


class Docstring(napoleon.NumpyDocstring):
    """Read the docstring of a property like that of a method."""

    def __init__(self, docstring, config=None, app=None, what="", *place):
        """Take the arguments that napoleon gives."""
        super().__init__(docstring, config, app, "method" if what == "property" else what, *place)


def setup(app):
    """Put it in the place of napoleon's own."""
    app.setup_extension("sphinx.ext.napoleon")
    napoleon.NumpyDocstring = Docstring
    return {"parallel_read_safe": True}
