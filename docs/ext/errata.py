"""``{refutations}``: every refuted claim, where it fails and what holds, as verified at build."""

from html import escape

from docutils import nodes
from sphinx.util.docutils import SphinxDirective
from verdicts import anchor

from nearsight.verify import catalogue
from nearsight.verify.recorded import recorded
from nearsight.verify.report.prose import html_of, plain_html
from nearsight.verify.report.words import sides


class Refutations(SphinxDirective):
    """Judge the refuted claims again, and list them."""

    def run(self):
        """Return one box a claim; a claim that is no longer refuted is a warning."""
        found = []
        for claim in catalogue():
            if recorded().get(claim.key) != "refuted":
                continue
            evidence = claim.judge("quick")
            if evidence.verdict != "refuted":
                text = f"{claim.key} is recorded as refuted and found to be {evidence.verdict}"
                found.append(self.state.document.reporter.warning(text, line=self.lineno))
            found.append(nodes.raw("", box(claim, evidence), format="html"))
        return found


def box(claim, evidence):
    """Return a claim, its instance and what holds instead as HTML."""
    instance = " · ".join(
        f"{plain_html(name)}&nbsp;=&nbsp;{escape(plain(value))}"
        for name, value in evidence.instance.items()
    )
    rows = [
        ("printed", html_of(claim.statement)),
        ("instance", instance),
        ("there", html_of(evidence.reason)),
        ("so", escape(sides(evidence))),
        ("instead", html_of(claim.repaired)),
    ]
    body = "".join(f"<dt>{name}</dt><dd>{text}</dd>" for name, text in rows if text)
    return (
        f'<div class="refutation" id="{anchor(claim.key)}"><p><code>{escape(claim.key)}</code> '
        f"<strong>{html_of(claim.title)}</strong></p><dl>{body}</dl></div>"
    )


def plain(value):
    """Return a value of an instance as text."""
    if isinstance(value, dict):
        return ", ".join(f"{k}: {plain(v)}" for k, v in value.items())
    if isinstance(value, list | tuple):
        return "[" + ", ".join(plain(v) for v in value) + "]"
    return str(value)


def setup(app):
    """Register the directive."""
    app.add_directive("refutations", Refutations)
    return {"parallel_read_safe": True}
