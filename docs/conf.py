"""How the pages are built: `sphinx-build -W --keep-going -n docs OUT`."""

import sys
from importlib.metadata import version as version_of
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent / "ext"))

project = "nearsight"
author = "The nearsight developers"
version = release = version_of("nearsight")

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",  # its role `autolink`: a name in backticks links if it is documented
    "sphinx.ext.mathjax",
    "sphinx-mathjax-offline",  # MathJax beside the pages: formulas need no network
    "commands",
    "docstrings",
    "errata",
    "frontdoor",
    "gallery",
    "verdicts",
]
exclude_patterns = ["ext"]
nitpicky = True
nitpick_ignore_regex = [
    # The types of attributes are prose ("ndarray, shape (N,)"), which napoleon takes for classes.
    ("py:class", r"(?!nearsight\.).*"),
    # In backticks of docstrings also stand arguments and private names: plain code, no link.
    ("py:obj", r"(?!nearsight\.\w+$).*"),
]

myst_enable_extensions = ["attrs_block", "colon_fence", "deflist", "dollarmath"]
myst_heading_anchors = 3
myst_dmath_double_inline = True

default_role = "autolink"
add_module_names = False
autodoc_member_order = "bysource"
autodoc_typehints = "none"  # the types stand in the docstrings, with shapes
autodoc_default_options = {"members": True}
napoleon_google_docstring = False
napoleon_use_param = False  # types as prose: "ndarray, shape (N,)" names no class to link to
napoleon_use_rtype = False
napoleon_custom_sections = [("Attributes", "params_style"), ("Class attributes", "params_style")]

html_theme = "furo"
html_title = "nearsight"
html_static_path = ["_static"]
html_css_files = ["extra.css"]
html_show_sourcelink = False
html_show_copyright = False
html_copy_source = False
html_theme_options = {"navigation_with_keys": True}
mathjax3_config = {
    "tex": {
        "macros": {
            "norm": [r"\left\lVert #1 \right\rVert", 1],
            "abs": [r"\left\lvert #1 \right\rvert", 1],
            "inner": [r"\left\langle #1, #2 \right\rangle", 2],
            "R": r"\mathbb{R}",
            "E": r"\mathbb{E}",
            "CR": r"\mathrm{CR}",
            "cost": r"\mathrm{cost}",
            "OPT": r"\mathrm{OPT}",
            "LPC": r"\mathrm{LPC}",
            "argmin": r"\operatorname*{arg\,min}",
            "Var": r"\operatorname{Var}",
            "xhat": r"\hat x",
            "xtil": r"\tilde x",
        }
    },
}

suppress_warnings = [
    "config.cache",  # `mathjax3_config` holds nothing unpicklable, but extensions here are modules
]
