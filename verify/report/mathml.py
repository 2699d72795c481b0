r"""LaTeX to MathML, which browsers draw without any help.

Only the part of LaTeX that claims are written in: scripts, ``\frac``, ``\sqrt``, accents, fonts,
Greek letters and the usual signs. An unknown command is shown by its name.
"""

from __future__ import annotations

import re
from html import escape

_FONT = r"\\(?:text|textrm|texttt|textbf|mathrm|mathbf|mathbb|mathcal|mathsf|operatorname|bm)"
_TOKEN = re.compile(_FONT + r"\s*\{[^{}]*\}|\\[A-Za-z]+|\\.|[0-9]+(?:\.[0-9]+)?|\s+|.", re.DOTALL)


def _pairs(text: str) -> dict[str, str]:
    words = text.split()
    return dict(zip(words[::2], words[1::2], strict=True))


GREEK = _pairs(
    "alpha α beta β gamma γ delta δ epsilon ϵ varepsilon ε zeta ζ eta η theta θ iota ι kappa κ "
    "lambda λ mu μ nu ν xi ξ pi π rho ρ sigma σ tau τ phi ϕ varphi φ chi χ psi ψ omega ω Gamma "
    "Γ Delta Δ Theta Θ Lambda Λ Xi Ξ Pi Π Sigma Σ Phi Φ Psi Ψ Omega Ω ell ℓ infty ∞ partial ∂ "
    "nabla ∇ emptyset ∅"
)
_SIGNS = _pairs(
    "le ≤ leq ≤ ge ≥ geq ≥ ne ≠ neq ≠ to → in ∈ notin ∉ cdot · times × sum ∑ prod ∏ int ∫ cup ∪ "
    "cap ∩ subset ⊂ subseteq ⊆ setminus ∖ forall ∀ exists ∃ succeq ⪰ preceq ⪯ succ ≻ prec ≺ "
    "approx ≈ sim ∼ equiv ≡ pm ± circ ∘ star ⋆ ast ∗ mid ∣ lceil ⌈ rceil ⌉ lfloor ⌊ rfloor ⌋ "
    "langle ⟨ rangle ⟩ ldots … dots … cdots ⋯ rightarrow → Rightarrow ⇒ mapsto ↦ iff ⇔ implies "
    "⇒ otimes ⊗ oplus ⊕ bigcup ⋃ land ∧ lor ∨ neg ¬ lVert ‖ rVert ‖ Vert ‖ ll ≪ gg ≫ top ⊤ "
    "colon :"
)
_SPACES = {**_pairs("quad 1 qquad 2 , 0.17 ; 0.28 : 0.22 ! 0"), " ": "0.28"}
_ACCENTS = {"hat": "^", "widehat": "^", "tilde": "~", "widetilde": "~", "bar": "‾", "overline": "‾"}
_NAMES = re.compile(r"max|min|sup|inf|log|ln|exp|cosh|sinh|tanh|arg|det|lim|diag|deg|dim")
_SIZES = re.compile(r"left|right|[bB]igg?[lr]?|displaystyle|textstyle|limits|nolimits")
_BLACKBOARD = {"R": "ℝ", "E": "𝔼", "N": "ℕ", "Z": "ℤ", "P": "ℙ"}


def mathml_of(formula: str) -> str:
    """Return a formula in LaTeX, without its dollar signs, as MathML."""
    return f"<math>{_Parser(formula).row()}</math>"


class _Parser:
    """A recursive descent over the parts of one formula."""

    def __init__(self, source: str) -> None:
        self._parts = [part for part in _TOKEN.findall(source) if not part.isspace()]
        self._at = 0

    def _peek(self) -> str:
        return self._parts[self._at] if self._at < len(self._parts) else ""

    def _next(self) -> str:
        part = self._peek()
        self._at += 1
        return part

    def row(self, end: str = "") -> str:
        """Return atoms with their scripts, up to a closing part."""
        found = []
        while (part := self._peek()) and part != end:
            found.append(self._scripted())
        self._next()
        return f"<mrow>{''.join(found)}</mrow>"

    def _scripted(self) -> str:
        base = "<mrow></mrow>" if self._peek() in "^_" else self._atom()
        scripts = {}
        while self._peek() in ("^", "_", "'"):
            part = self._next()
            scripts["^" if part == "'" else part] = "<mo>′</mo>" if part == "'" else self._atom()
        match sorted(scripts):
            case ["^", "_"]:
                return f"<msubsup>{base}{scripts['_']}{scripts['^']}</msubsup>"
            case ["^"]:
                return f"<msup>{base}{scripts['^']}</msup>"
            case ["_"]:
                return f"<msub>{base}{scripts['_']}</msub>"
        return base

    def _atom(self) -> str:
        part = self._next()
        if part == "{":
            return self.row("}")
        if part.startswith("\\"):
            return self._command(part[1:])
        if part[:1].isdigit():
            return f"<mn>{part}</mn>"
        if part.isalpha():
            return f"<mi>{part}</mi>"
        if part == "~":
            return '<mspace width="0.3em"/>'
        return f"<mo>{escape({'-': '−', '*': '∗'}.get(part, part))}</mo>"

    def _command(self, name: str) -> str:
        if name in GREEK:
            return f"<mi>{GREEK[name]}</mi>"
        if name in _SIGNS:
            return f"<mo>{_SIGNS[name]}</mo>"
        if _NAMES.fullmatch(name):
            return f"<mi>{name}</mi>"
        if name in _SPACES:
            return f'<mspace width="{_SPACES[name]}em"/>'
        if name in ("frac", "tfrac", "dfrac"):
            return f"<mfrac>{self._atom()}{self._atom()}</mfrac>"
        if name == "sqrt":
            if self._peek() != "[":
                return f"<msqrt>{self._atom()}</msqrt>"
            self._next()
            index = self.row("]")
            return f"<mroot>{self._atom()}{index}</mroot>"
        if name in _ACCENTS:
            return f'<mover accent="true">{self._atom()}<mo>{_ACCENTS[name]}</mo></mover>'
        if "{" in name[1:]:
            return self._upright(name)
        if _SIZES.fullmatch(name):
            return self._delimiter()
        return {"|": "<mo>‖</mo>"}.get(name) or f"<mo>{escape(name)}</mo>"

    def _delimiter(self) -> str:
        if self._peek() == ".":
            self._next()
            return ""
        return self._atom() if self._peek() not in ("", "{", "}") else ""

    def _upright(self, command: str) -> str:
        """Return the argument of a font command as upright text."""
        font, _, text = command.rstrip("}").partition("{")
        text = text.replace("\\", "")
        if font.strip() == "mathbb":
            text = _BLACKBOARD.get(text, text)
        return f"<mtext>{escape(text)}</mtext>"
