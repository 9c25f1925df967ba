"""What is derived of a robot: formulas, explanations, verdicts, code, documents."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import TYPE_CHECKING, Optional, Union

from numpy.typing import ArrayLike

from ._denavit import Core
from ._numbers import vector

if TYPE_CHECKING:
    from ._derivations import Derivation
    from ._documents import Checked, Exercise

PathLike = Union[str, os.PathLike[str]]


class Derivations:
    """The methods of `Robot` that derive."""

    __slots__ = ()
    _core: Core

    def derive(
        self,
        format: str = "text",
        *,
        frame: Union[str, int] = "base",
        of: Union[str, int] = "tool",
        only: str = "all",
    ) -> Derivation:
        """Link transforms, the simplified pose of ``of`` in ``frame``, and the shortest algorithm for it, proved.

        ``format`` is ``text``, ``latex``, ``typst``, ``markdown``, ``html`` or ``json``; ``only`` what the algorithm
        computes: ``all``, or a list of ``position``, ``orientation``, ``x``, ``y``, ``z``.

        >>> from denavit import Robot
        >>> "t14 = " in Robot("ur5").derive()
        True
        """
        from ._derivations import Derivation, forward_formulas

        core, frames = self._core, (str(frame), str(of))
        return Derivation._of(
            format,
            lambda format: core.derive_text(format, *frames, only),
            lambda: core.derive_nodes(*frames, only),
            forward_formulas,
        )

    def ik_explain(
        self,
        format: str = "text",
        *,
        given: Optional[Sequence[Union[str, int]]] = None,
        goal: str = "pose",
    ) -> Derivation:
        """How the closed form of the inverse kinematics is derived, step by step, each step proved.

        Formats as in `derive`. Raises `UnsupportedError` with the reason if there is no closed form.
        """
        words = None if given is None else [str(joint) for joint in given]
        from ._derivations import Derivation, inverse_formulas

        core = self._core
        return Derivation._of(
            format,
            lambda format: core.ik_explain(format, words, goal),
            lambda: core.ik_nodes(words, goal),
            inverse_formulas,
        )

    def jacobian_explain(self, format: str = "text", *, of: Union[str, int] = "tool") -> Derivation:
        """The Jacobian in the frame where it is shortest, its determinant in factors, and why the arm is singular where one
        is zero. Formats as in `derive`.
        """
        from ._derivations import Derivation, jacobian_formulas

        core, body = self._core, str(of)
        return Derivation._of(
            format,
            lambda format: core.jacobian_explain(format, body),
            lambda: core.jacobian_nodes(body),
            jacobian_formulas,
        )

    def dynamics_explain(
        self,
        format: str = "text",
        *,
        keep: Union[str, Sequence[str]] = (),
        drop: Union[str, Sequence[str]] = (),
    ) -> Derivation:
        """Base parameters and torques as formulas, step by step; symbols of Khalil and Dombre's names where the robot says
        nothing of masses. Formats as in `derive`.

        Several parameters of the links may stand for what is grouped with them: ``keep`` names those that are to, such as
        ``"YY2"`` or ``["YY2", "M4"]``, in place of those that the rule of Gautier and Khalil keeps, ``drop`` those that are not
        to. The torques are the same.

        >>> from denavit import Robot
        >>> robot = Robot("planar-2r")
        >>> "ZZR1" in robot.dynamics_explain(), "MR2" in robot.dynamics_explain(keep="M2")
        (True, True)

        Raises `UsageError` with the reason if the parameters that are named cannot be chosen.
        """
        from ._derivations import Derivation, dynamic_formulas

        core = self._core
        kept, dropped = ([names] if isinstance(names, str) else list(names) for names in (keep, drop))
        return Derivation._of(
            format,
            lambda format: core.dynamics_explain(format, kept, dropped),
            lambda: core.dynamics_nodes(kept, dropped),
            dynamic_formulas,
        )

    def check(self, document: PathLike, *, name: str = "document.md") -> Checked:
        """The claims of a document about this robot, each with its verdict: see `denavit.check`."""
        from ._documents import checked_of, read_document

        return checked_of(self._core.check(*read_document(document, name)))

    def exercise(self, kind: str, *, seed: int = 1, count: int = 1, language: str = "en") -> Exercise:
        """A sheet of tasks with round numbers, its solution, and what marks answers.

        ``kind`` is ``fk`` (link transforms, the pose of the tool as a formula and in numbers), ``dh`` (the table of a drawing),
        ``ik`` (all configurations for a pose), ``jacobian`` or ``singularities``. The same ``seed`` makes the same sheet;
        ``count`` is the number of configurations or poses.

        >>> from denavit import Robot
        >>> exercise = Robot("planar-2r").exercise("ik", seed=7)
        >>> marked = exercise.check(exercise.solution)
        >>> marked.points == marked.most
        True

        Raises `UsageError` if there is no such kind, `UnsupportedError` with the reason if the robot has not what it is about.
        """
        from ._documents import exercise_of

        return exercise_of(self, kind, seed, count, language)

    def generate(
        self,
        language: str,
        functions: Optional[Sequence[str]] = None,
        *,
        folder: Optional[PathLike] = None,
        name: Optional[str] = None,
        goal: str = "pose",
        overwrite: bool = False,
    ) -> dict[str, str]:
        """Source code that builds and tests itself: texts by the path of their file.

        ``language`` is ``rust``, ``c``, ``python``, ``matlab``, ``javascript``, ``cuda``, or ``ikfast``: a C++ file with IKFast's
        interface, which has ``fk`` and ``ik`` and nothing else. ``functions`` that are not named are ``fk``, ``jacobian`` and ``ik``,
        as far as the language has them.

        Written to ``folder`` where one is given; files that are there already with other contents stay, all of them, unless
        ``overwrite`` says otherwise.

        >>> from denavit import Robot
        >>> sorted(Robot("ur5").generate("c", ["fk"], name="ur5"))[:2]
        ['Makefile', 'test_ur5.c']

        Raises `UsageError` if there is no such language or function, `UnsupportedError` if there is no such code, `FileError`
        if a file stands in the way or cannot be written.
        """
        if functions is None:
            functions = ["fk", "ik"] if language.lower() == "ikfast" else ["fk", "jacobian", "ik"]
        elif isinstance(functions, str):
            functions = [part.strip() for part in functions.split(",")]
        files = dict(self._core.generate(language, list(functions), name, goal)[0])
        if folder is not None:
            from pathlib import Path

            from ._files import write

            write(Path(folder), files, overwrite)
        return files

    def report(self, format: str = "html", *, language: str = "en") -> str:
        """What a lab report would contain, as one page of ``html``, or as ``latex`` or ``typst``; in ``en``, ``fr``, ``de`` or ``es``."""
        return self._core.report(format, language)

    def figure(self, q: Optional[ArrayLike] = None, *, scheme: bool = False) -> str:
        """The arm with its frames and lengths as SVG, at ``q`` or where it shows well; ``scheme`` draws the line diagram."""
        return self._core.figure(vector(q, "q"), scheme)
