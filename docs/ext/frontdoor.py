"""``.. frontdoor::``: all public names of `nearsight`; functions of its own in full."""

from docutils.statemachine import StringList
from sphinx.util.docutils import SphinxDirective

from nearsight import _EXPORTS

# Packages have pages of their own, and describe what `nearsight` hands on.
PACKAGES = ("graphs", "bounds", "lpc", "perturbation", "lowerbounds", "verify", "figures")


class FrontDoor(SphinxDirective):
    """List the names that packages define, then describe the functions of the front door."""

    def run(self):
        """Parse the text that says so, in reStructuredText."""
        lines = []
        for package in PACKAGES:
            names = sorted(n for n, m in _EXPORTS.items() if m == f".{package}" and n != package)
            shown = ", ".join(f":py:obj:`{n} <nearsight.{package}.{n}>`" for n in names)
            lines.append(
                f"* :doc:`nearsight.{package} <{package}>`" + (f": {shown}" if shown else "")
            )
        lines.append("")
        own = sorted(n for n, m in _EXPORTS.items() if m.strip(".") not in PACKAGES)
        for name in own:
            lines += [f".. autofunction:: nearsight.{name}", ""]
        return self.parse_text_to_nodes(StringList(lines, source="frontdoor"))


def handed_on(app, env, node, content):
    """Resolve `nearsight.Parameters` where it is described, `nearsight.bounds.Parameters`."""
    name = node.get("reftarget", "").removeprefix("nearsight.")
    if node.get("refdomain") != "py" or name not in _EXPORTS:
        return None
    target = f"nearsight{_EXPORTS[name]}.{name}"
    python = env.get_domain("py")
    page = node.get("refdoc", "")
    return python.resolve_xref(env, page, app.builder, "obj", target, node, content)


def setup(app):
    """Register the directive."""
    app.add_directive("frontdoor", FrontDoor)
    app.connect("missing-reference", handed_on)
    return {"parallel_read_safe": True}
