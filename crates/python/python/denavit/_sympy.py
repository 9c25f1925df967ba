"""Formulas as SymPy has them, proved to be those that they are made from."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Union

from . import _denavit
from ._errors import UnsupportedError

Node = tuple[str, list[int], str]
Formulas = list[tuple[str, list[list[int]]]]


def made(
    nodes: Sequence[Node], formulas: Formulas, assumptions: dict[str, Any]
) -> list[tuple[str, list[list[Any]]]]:
    """Formulas by names, matrices of SymPy's expressions; each is read back and proved equal to the one that it is made from.

    Raises `UnsupportedError` if a proof fails, `ImportError` without SymPy.
    """
    import sympy  # type: ignore[import-not-found, import-untyped, unused-ignore]

    build: dict[str, Any] = {
        "number": lambda _, text: sympy.Rational(text),
        "pi": lambda _, text: sympy.pi,
        "symbol": lambda _, text: sympy.Symbol(text, **assumptions),
        "neg": lambda a, _: -a[0],
        "add": lambda a, _: a[0] + a[1],
        "sub": lambda a, _: a[0] - a[1],
        "mul": lambda a, _: a[0] * a[1],
        "div": lambda a, _: a[0] / a[1],
        "pow": lambda a, text: a[0] ** int(text),
        "sqrt": lambda a, _: sympy.sqrt(a[0]),
        "sin": lambda a, _: sympy.sin(a[0]),
        "cos": lambda a, _: sympy.cos(a[0]),
        "atan2": lambda a, _: sympy.atan2(a[0], a[1]),
        "sign": lambda a, _: sympy.sign(a[0]),
    }
    expressions: list[Any] = []
    for op, of, text in nodes:
        expressions.append(build[op]([expressions[k] for k in of], text))
    used = sorted({k for _, rows in formulas for row in rows for k in row})
    back, roots = nodes_of([expressions[k] for k in used])
    open_ones = _denavit.not_proved(nodes, back, list(zip(used, roots)))
    if open_ones:
        first = expressions[used[open_ones[0]]]
        raise UnsupportedError(f"not proved to be the formula that it was made from: {first}")
    return [(name, [[expressions[k] for k in row] for row in rows]) for name, rows in formulas]


def nodes_of(expressions: Sequence[Any]) -> tuple[list[Node], list[int]]:
    """Expressions of SymPy as nodes, and the node of each.

    Raises `UnsupportedError` if one holds what formulas of robots do not.
    """
    import sympy

    nodes: list[Node] = []
    known: dict[Any, int] = {}

    def node(op: str, *of: int, text: str = "") -> int:
        nodes.append((op, list(of), text))
        return len(nodes) - 1

    def chain(op: str, parts: Sequence[Any]) -> int:
        at = place(parts[0])
        for part in parts[1:]:
            at = node(op, at, place(part))
        return at

    def power(base: Any, exponent: Any) -> int:
        if exponent.is_Integer:
            n = int(exponent)
            at = place(base)
            return at if n == 1 else node("pow", at, text=str(n))
        if exponent.is_Rational and exponent.q == 2:
            root = node("sqrt", place(base))
            return root if exponent.p == 1 else node("pow", root, text=str(int(exponent.p)))
        raise UnsupportedError(f"no power like {base}**({exponent}) is read")

    def place(e: Any) -> int:
        if e not in known:
            known[e] = fresh(e)
        return known[e]

    def fresh(e: Any) -> int:
        if e.is_Rational:
            return node("number", text=f"{e.p}/{e.q}")
        if e == sympy.pi:
            return node("pi")
        if e.is_Symbol:
            return node("symbol", text=e.name)
        if e.is_Add:
            return chain("add", e.args)
        if e.is_Mul:
            return chain("mul", e.args)
        if e.is_Pow:
            return power(*e.args)
        if isinstance(e, sympy.Abs):
            return node("sqrt", node("pow", place(e.args[0]), text="2"))
        names: dict[Any, str] = {
            sympy.sin: "sin",
            sympy.cos: "cos",
            sympy.atan2: "atan2",
            sympy.sign: "sign",
        }
        op: Union[str, None] = names.get(e.func)
        if op is None:
            raise UnsupportedError(f"{e.func} is no function of the formulas of robots")
        return node(op, *(place(a) for a in e.args))

    return nodes, [place(e) for e in expressions]
