"""Roles that name a claim with its recorded verdict.

``{refuted}`thm:global-exp-decay[a]` `` says that a claim is refuted, and links to its instance; the
build warns, and so fails, if the recorded verdict is another one. ``{proved}`` likewise.
``{claim}`` shows whatever is recorded, for claims on which better evidence may come.
"""

from docutils import nodes
from sphinx.util.docutils import SphinxRole

from nearsight.verify.recorded import recorded

SIGNS = {"proved": "✓", "supported": "≈", "refuted": "✗"}


def anchor(key):
    """Return the name of a claim in an address."""
    return "claim-" + "".join(c if c.isalnum() else "-" for c in key.lower()).strip("-")


class VerdictRole(SphinxRole):
    """A claim with the sign of its verdict."""

    def __init__(self, verdict=""):
        """Keep what the verdict has to be; any if empty."""
        self.verdict = verdict

    def run(self):
        """Return the claim, or a warning where the verdict is not as said."""
        key, found = self.text, recorded().get(self.text)
        if found is None or self.verdict not in ("", found):
            wanted = self.verdict or "recorded"
            text = f"claim {key!r} is said to be {wanted}; recorded is {found}"
            return [], [self.inliner.reporter.warning(text, line=self.lineno)]
        shown = nodes.literal("", f"{SIGNS[found]} {key}", classes=["claim", f"claim-{found}"])
        if found != "refuted":
            return [shown], []
        page = self.env.app.builder.get_relative_uri(self.env.docname, "theory/errata")
        link = nodes.reference("", "", internal=True, refuri=f"{page}#{anchor(key)}")
        link += shown
        return [link], []


def setup(app):
    """Register a role for each verdict, and one for any."""
    for verdict in SIGNS:
        app.add_role(verdict, VerdictRole(verdict))
    app.add_role("claim", VerdictRole())
    return {"parallel_read_safe": True}
