"""What is derived, as text, in notebooks, and for SymPy."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Callable, NamedTuple, Optional

if TYPE_CHECKING:
    from ._sympy import Formulas, Node

#: Formulas as the module lists them.
Listed = tuple["list[Node]", "Formulas"]


class Step(NamedTuple):
    """A step of an algorithm, or a parameter by others."""

    #: What is computed, a symbol.
    name: Any
    #: From what; names of earlier steps are symbols in it.
    value: Any


class ForwardFormulas(NamedTuple):
    """The forward model as SymPy has it."""

    #: The pose, 4×4; ``None`` if it is too large to expand.
    pose: Optional[Any]
    #: Link transforms, 4×4 each, row by row of the table.
    links: list[Any]
    #: The shortest algorithm.
    steps: list[Step]


class JacobianFormulas(NamedTuple):
    """The Jacobian as SymPy has it."""

    #: The matrix, ``6×n``; ``None`` if it is too large to expand.
    jacobian: Optional[Any]
    #: Determinants in factors that are 0 where the arm is singular, where they are expanded.
    determinants: list[Any]
    #: The program for the matrix.
    steps: list[Step]
    #: Those of the linear rows alone, of arms with up to three joints whose hand's origin gets stuck elsewhere than its body.
    point_determinants: list[Any]


class DynamicFormulas(NamedTuple):
    """Torques as SymPy has them; A, C q̇ and Q of arms with few joints."""

    #: A(q), ``n×n``.
    inertia: Optional[Any]
    #: C(q, q̇) q̇ with friction, ``n×1``.
    velocity: Optional[Any]
    #: Q(q), ``n×1``.
    gravity: Optional[Any]
    #: Base parameters by those of the links.
    base: list[Step]
    #: The program for the torques ``t1`` ….
    steps: list[Step]


class InverseFormulas(NamedTuple):
    """The closed form of the inverse kinematics as SymPy has it: equations by what they are for, in the order of the derivation."""

    #: By unknown: ``{"q1": [Eq(…), …], …}``; how joints follow from sums stands at ``joints``, what a pose must meet at ``pose``.
    equations: dict[str, list[Any]]

    @property
    def all(self) -> list[Any]:
        """All of them."""
        return [equation for some in self.equations.values() for equation in some]


class Derivation(str):
    """A derivation as text in the format that was asked for, with the others by `to`; a notebook shows it as formulas.

    >>> from denavit import Robot
    >>> found = Robot("planar-2r").derive()
    >>> "C12" in found, found.to("latex").startswith("%")
    (True, True)
    >>> found.to_sympy().pose[0, 3]  # doctest: +SKIP
    a1*cos(q1) + a2*cos(q1 + q2)
    """

    _write: Callable[[str], str]
    _list: Callable[[], Listed]
    _dress: Callable[[list[tuple[str, list[list[Any]]]]], Any]

    @classmethod
    def _of(
        cls,
        format: str,
        write: Callable[[str], str],
        listed: Callable[[], Listed],
        dress: Callable[[list[tuple[str, list[list[Any]]]]], Any],
    ) -> Derivation:
        made = cls(write(format))
        made._write, made._list, made._dress = write, listed, dress
        return made

    def __repr__(self) -> str:
        """The text, to be read."""
        return str(self)

    def __reduce__(self) -> Any:
        return (str, (str(self),))

    def to(self, format: str) -> Derivation:
        """The same in another format: ``text``, ``latex``, ``typst``, ``markdown``, ``html`` or ``json``."""
        return Derivation._of(format, self._write, self._list, self._dress)

    @property
    def latex(self) -> str:
        """The same as a fragment of LaTeX."""
        return self._write("latex")

    def to_sympy(self, **assumptions: bool) -> Any:
        """The formulas as SymPy has them: `ForwardFormulas`, `InverseFormulas`, `JacobianFormulas` or `DynamicFormulas`.

        Each expression is read back and proved equal to the formula that it was made from. Symbols are plain ones, equal to
        ``sympy.Symbol("q1")``; ``assumptions`` are what SymPy is to assume of them, as in ``to_sympy(real=True)``.

        Raises `UnsupportedError` if a proof fails, `ImportError` if SymPy is not installed.
        """
        from ._sympy import made

        nodes, formulas = self._list()
        return self._dress(made(nodes, formulas, assumptions))

    def _repr_html_(self) -> str:
        page = self._write("html")
        inner = page.split("<main>", 1)[-1].rsplit("</main>", 1)[0]
        return f'<div class="denavit">{inner}</div>'

    def _repr_latex_(self) -> str:
        return self._write("latex")


def _one(found: list[tuple[str, list[list[Any]]]], name: str) -> Optional[Any]:
    import sympy  # type: ignore[import-not-found, import-untyped, unused-ignore]

    return next((sympy.Matrix(rows) for known, rows in found if known == name), None)


def _named(found: list[tuple[str, list[list[Any]]]], kind: str) -> list[Step]:
    import sympy

    parts = ((name.split(" ", 1), rows[0][0]) for name, rows in found)
    return [Step(sympy.Symbol(name[1]), value) for name, value in parts if name[0] == kind]


def forward_formulas(found: list[tuple[str, list[list[Any]]]]) -> ForwardFormulas:
    """The forward model out of its formulas by names."""
    import sympy

    links = [sympy.Matrix(rows) for name, rows in found if name == "link"]
    return ForwardFormulas(_one(found, "pose"), links, _named(found, "step"))


def jacobian_formulas(found: list[tuple[str, list[list[Any]]]]) -> JacobianFormulas:
    """The Jacobian out of its formulas by names."""
    determinants = [rows[0][0] for name, rows in found if name == "determinant"]
    point = [rows[0][0] for name, rows in found if name == "point"]
    return JacobianFormulas(_one(found, "jacobian"), determinants, _named(found, "step"), point)


def dynamic_formulas(found: list[tuple[str, list[list[Any]]]]) -> DynamicFormulas:
    """Torques out of their formulas by names."""
    inertia, velocity, gravity = (_one(found, name) for name in ("inertia", "velocity", "gravity"))
    return DynamicFormulas(inertia, velocity, gravity, _named(found, "base"), _named(found, "step"))


def inverse_formulas(found: list[tuple[str, list[list[Any]]]]) -> InverseFormulas:
    """The closed form out of its formulas by names."""
    import sympy

    equations: dict[str, list[Any]] = {}
    for name, rows in found:
        left, right = rows[0]
        equations.setdefault(name.split(" ", 1)[1], []).append(sympy.Eq(left, right, evaluate=False))
    return InverseFormulas(equations)
