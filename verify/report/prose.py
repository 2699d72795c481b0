"""Plain text to HTML: Greek letters, indices and exponents as they are read aloud.

``rho_T^{2 r} <= sqrt(a)`` becomes what a reader expects; what stands between backticks stays code.
"""

from __future__ import annotations

import re
from collections.abc import Collection
from functools import cache
from html import escape

from .mathml import GREEK, mathml_of

_GREEK = re.compile(
    r"(?<![A-Za-z])(" + "|".join(sorted(GREEK, key=len, reverse=True)) + r")(?![a-z])"
)
_SCRIPT = re.compile(
    r"(?<=[\w\u0303)\]*|‖}′'Σ∏→>])([_^])"
    r"(?:\{([^{}]*)\}|([-+]?\([^()]*\)|[-+]?[A-Za-z0-9\u0370-\u03ff∞]+|\*))"
)
_SIGNS = (
    *(("<=", "≤"), (">=", "≥"), ("!=", "≠"), ("->", "→"), ("||", "‖"), ("...", "…")),
    (" * ", " · "),
)


def html_of(text: str) -> str:
    """Return a text as HTML, what stands between dollar signs as MathML."""
    pieces = re.split(r"\$\$?([^$]+)\$\$?|`([^`]+)`", text)
    found = []
    for i in range(0, len(pieces), 3):
        found.append(plain_html(pieces[i]))
        if i + 1 < len(pieces):
            formula, code = pieces[i + 1 : i + 3]
            found.append(mathml_of(formula) if formula else f"<code>{escape(code)}</code>")
    return "".join(found)


def coded(text: str, keys: Collection[str]) -> str:
    """Return a text with backticks around every key of a claim in it, so that it stays as it is.

    Parameters
    ----------
    text : str
    keys : collection of str
        Those with a colon or a number sign are looked for.
    """
    pattern = _pattern(tuple(keys))
    return pattern.sub(r"`\1`", text) if pattern else text


@cache
def _pattern(keys: tuple[str, ...]) -> re.Pattern[str] | None:
    names = {name for key in keys for name in (key, key.partition("[")[0])}
    marked = sorted((n for n in names if ":" in n or "#" in n), key=len, reverse=True)
    if not marked:
        return None
    either = "|".join(re.escape(name) for name in marked)
    return re.compile(rf"(?<![`\w])({either})(?![`\w])")


def plain_html(text: str) -> str:
    """Return a text without code or formulas as HTML."""
    for sign, drawn in _SIGNS:
        text = text.replace(sign, drawn)
    text = re.sub(r"(?<![A-Za-z])sum(?=_)", "Σ", text)
    text = re.sub(r"(?<![A-Za-z])sqrt\b ?", "√", text)
    text = re.sub(r"(?<![A-Za-z])(oo|infinity)(?![A-Za-z])", "∞", text)
    text = _GREEK.sub(lambda found: GREEK[found[1]], text)
    text = re.sub(r"(?<![A-Za-z])([A-Za-z\u0370-\u03ff])~", "\\1\u0303", text)
    text = escape(text, quote=False)
    before = None
    while before != text:  # indices within exponents first
        before, text = text, _SCRIPT.sub(_script, text)
    return text


def _script(found: re.Match[str]) -> str:
    tag = "sub" if found[1] == "_" else "sup"
    inner = found[2] if found[2] is not None else found[3]
    if found[2] is None and inner.startswith("("):
        inner = inner[1:-1]
    return f"<{tag}>{inner}</{tag}>"
