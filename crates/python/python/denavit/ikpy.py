"""The interface of ikpy: programs written for it run with another import.

>>> from denavit.ikpy import Chain, OriginLink, URDFLink     # was: from ikpy.chain import Chain, …
>>> arm = Chain(name="arm", links=[
...     OriginLink(),
...     URDFLink("shoulder", [0, 0, 0.1], [0, 0, 0], rotation=[0, 0, 1]),
...     URDFLink("elbow", [0.3, 0, 0], [0, 0, 0], rotation=[0, 1, 0], bounds=(-2.0, 2.0)),
...     URDFLink("hand", [0.2, 0, 0], [0, 0, 0], joint_type="fixed"),
... ])
>>> pose = arm.forward_kinematics([0, 0.5, 0.8, 0])
>>> arm.inverse_kinematics(pose[:3, 3], initial_position=[0, 0.4, 0.7, 0]).round(9).tolist()
[0.0, 0.5, 0.8, 0.0]

Vectors have an entry for each link of the chain, as there: those of joints that do not move count for nothing. A target that is a whole
frame is solved by the closed form, in the solution next to the initial position; other targets by a descent from there, and from
elsewhere if that does not arrive. `Chain.residual` says how far off the last answer is. Interface of ikpy 3 and 4, without its plots.
"""

from __future__ import annotations

import os
import tempfile
import xml.etree.ElementTree as ElementTree
from collections.abc import Sequence
from pathlib import Path
from typing import Any, Literal, Optional, Union, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._descent import descend
from ._errors import ChainError, FileError, ShapeError, UnsupportedError, UsageError
from ._robot import Robot

Floats = NDArray[np.float64]
Bounds = tuple[float, float]

#: What counts as arrived, metres and units of axes; and how many other starts a descent has that does not.
_ARRIVED = 1e-7
_STARTS = 12


class Link:
    """A joint with what it carries, by the name that ikpy gives it."""

    def __init__(
        self,
        name: str,
        origin_translation: ArrayLike = (0.0, 0.0, 0.0),
        origin_orientation: ArrayLike = (0.0, 0.0, 0.0),
        rotation: Optional[ArrayLike] = None,
        translation: Optional[ArrayLike] = None,
        bounds: Optional[tuple[Optional[float], Optional[float]]] = None,
        joint_type: str = "revolute",
        **ignored: Any,
    ) -> None:
        #: Its name.
        self.name = name
        #: ``revolute``, ``continuous``, ``prismatic`` or ``fixed``.
        self.joint_type = joint_type
        if rotation is None and translation is None:
            self.joint_type = "fixed"
        elif rotation is None and joint_type == "revolute":
            self.joint_type = "prismatic"
        low, high = bounds or (None, None)
        #: The least and the greatest value of its joint, radians or metres.
        self.bounds: Bounds = (-np.inf if low is None else low, np.inf if high is None else high)
        #: Where its joint stands in the link before: position, and roll, pitch, yaw.
        self.origin = (_three(origin_translation), _three(origin_orientation))
        #: The axis of its joint.
        self.axis = _three(
            (1.0, 0.0, 0.0) if rotation is None and translation is None else _axis(rotation, translation)
        )

    def __repr__(self) -> str:
        return f"Link name={self.name} bounds={self.bounds}"


class URDFLink(Link):
    """A link as ``ikpy.link.URDFLink``."""


class OriginLink(Link):
    """The base, as ``ikpy.link.OriginLink``."""

    def __init__(self) -> None:
        super().__init__("Base link", joint_type="fixed")


class Chain:
    """A chain of links as ``ikpy.chain.Chain``.

    Parameters
    ----------
    links
        The links, the origin first.
    active_links_mask
        Whether inverse kinematics moves each link; all that move otherwise.
    name
        What people call it.

    Raises `UsageError` if the mask has another length; the errors of `Robot.from_file`.
    """

    #: Its name.
    name: str
    #: Its links.
    links: list[Link]
    #: Whether inverse kinematics moves each link.
    active_links_mask: NDArray[np.bool_]
    #: The arm as this package has it, to the last link.
    robot: Robot
    #: How far the answer that was found last is from the target: metres and units of axes.
    residual: float

    def __init__(
        self,
        links: Sequence[Link],
        active_links_mask: Optional[Sequence[bool]] = None,
        name: str = "chain",
        **ignored: Any,
    ) -> None:
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "chain.urdf"
            file.write_text(_urdf(links, name), encoding="utf-8")
            robots = _Robots(file, [f"l{k}" for k in range(len(links))], as_written=True)
        self._set_up(links, robots, None, active_links_mask, name)

    @classmethod
    def from_urdf_file(
        cls,
        urdf_file: Union[str, os.PathLike[str]],
        base_elements: Optional[Sequence[str]] = None,
        last_link_vector: Optional[ArrayLike] = None,
        base_element_type: str = "link",
        active_links_mask: Optional[Sequence[bool]] = None,
        name: str = "chain",
        as_written: bool = False,
        **ignored: Any,
    ) -> Chain:
        """A chain of a URDF file.

        ``base_elements`` names links and joints in turn, from ``["base_link"]`` on; behind the last one the first joint of each link
        is followed to the end. ``last_link_vector`` is the tip behind the last link. With ``as_written`` 1.5708 in the file is no
        quarter turn, as there.

        Raises `ChainError` if there is no such link or joint, or nothing moves; the errors of `Robot.from_file`.
        """
        file = Path(urdf_file)
        links, names = _walked(file, list(base_elements or ["base_link"]), base_element_type)
        chain = cls.__new__(cls)
        robots = _Robots(file, names, as_written=as_written)
        if last_link_vector is not None:
            links.append(URDFLink("last_joint", last_link_vector, joint_type="fixed"))
        chain._set_up(links, robots, last_link_vector, active_links_mask, name)
        return chain

    def _set_up(
        self,
        links: Sequence[Link],
        robots: _Robots,
        last: Optional[ArrayLike],
        mask: Optional[Sequence[bool]],
        name: str,
    ) -> None:
        self.name = name
        self.links = list(links)
        if mask is not None and len(mask) != len(self.links):
            raise UsageError(
                f"the mask of active links has {len(mask)} entries; {len(self.links)} are needed"
            )
        self.active_links_mask = np.array([True] * len(self.links) if mask is None else mask, dtype=bool)
        self._robots = robots
        self.robot = robots.whole
        own = [joint.name for joint in self.robot.joints]
        moving = [k for k, link in enumerate(self.links) if link.joint_type != "fixed"]
        if [self.links[k].name for k in moving] != own:
            raise UnsupportedError(
                "the joints of the chain do not move one by one: " + ", ".join(map(str, own))
            )
        self._moving = np.array(moving, dtype=int)
        self._last = np.zeros(3) if last is None else _three(last)
        self.residual = 0.0

    def __len__(self) -> int:
        return len(self.links)

    def __repr__(self) -> str:
        names = [link.name for link in self.links]
        return f"Kinematic chain name={self.name} links={names} active_links={self.active_links_mask}"

    @overload
    def forward_kinematics(
        self, joints: ArrayLike, full_kinematics: Literal[False] = False, **ignored: Any
    ) -> Floats: ...
    @overload
    def forward_kinematics(
        self, joints: ArrayLike, full_kinematics: Literal[True], **ignored: Any
    ) -> list[Floats]: ...
    @overload
    def forward_kinematics(
        self, joints: ArrayLike, full_kinematics: bool, **ignored: Any
    ) -> Union[Floats, list[Floats]]: ...
    def forward_kinematics(
        self, joints: ArrayLike, full_kinematics: bool = False, **ignored: Any
    ) -> Union[Floats, list[Floats]]:
        """The pose of the tip, 4×4, or of every link, at joints ``(len(self),)``."""
        q = self._joints(joints)[self._moving]
        tip = self._tip(q)
        if not full_kinematics:
            return tip
        known = [np.eye(4), *(self._robots.pose(k, q) for k in range(1, len(self._robots.names)))]
        return known if len(known) == len(self.links) else [*known, tip]

    def inverse_kinematics(
        self,
        target_position: Optional[ArrayLike] = None,
        target_orientation: Optional[ArrayLike] = None,
        orientation_mode: Optional[str] = None,
        **arguments: Any,
    ) -> Floats:
        """Joints ``(len(self),)`` for a position, for an axis ``X``, ``Y`` or ``Z`` ``(3,)``, for the orientation ``all`` ``(3, 3)``, or for both."""
        target = np.eye(4)
        if orientation_mode is not None:
            if target_orientation is None:
                raise UsageError("target_orientation is needed for an orientation_mode")
            target[:3, _columns(orientation_mode)] = np.reshape(
                np.asarray(target_orientation, dtype=np.float64), (3, -1)
            )
        if target_position is not None:
            target[:3, 3] = target_position
        return self.inverse_kinematics_frame(
            target, orientation_mode=orientation_mode, no_position=target_position is None, **arguments
        )

    def inverse_kinematics_frame(
        self,
        target: ArrayLike,
        initial_position: Optional[ArrayLike] = None,
        orientation_mode: Optional[str] = None,
        no_position: bool = False,
        **ignored: Any,
    ) -> Floats:
        """Joints ``(len(self),)`` for the position of a 4×4 frame, and its orientation as ``orientation_mode`` says; near to ``initial_position``.

        Links that are not active stay where ``initial_position`` has them. Limits are kept. Arguments of ikpy's optimisers are accepted
        and have no effect.
        """
        frame = np.asarray(target, dtype=np.float64)
        if frame.shape != (4, 4):
            raise ShapeError(f"target has the shape {frame.shape}; (4, 4) is needed")
        if no_position and orientation_mode is None:
            raise UsageError("neither a position nor an orientation is given")
        joints = self._joints(np.zeros(len(self)) if initial_position is None else initial_position).copy()
        active = self.active_links_mask[self._moving]
        start = joints[self._moving]
        goal = _Goal(
            self, frame, None if orientation_mode is None else _columns(orientation_mode), no_position
        )
        found: Optional[Floats] = None
        if goal.is_whole and active.all():
            behind = np.eye(4)
            behind[:3, 3] = -self._last
            found = self.robot.ik(frame @ behind, near=start, limits=True).nearest
        if found is None:
            found = goal.sought(start, active)
        self.residual = float(np.linalg.norm(goal.off(found)))
        joints[self._moving] = found
        return joints

    def active_to_full(self, active_joints: ArrayLike, initial_position: ArrayLike) -> Floats:
        """Values of active links among those of all."""
        full = np.array(initial_position, dtype=np.float64)
        np.place(full, self.active_links_mask, active_joints)
        return full

    def active_from_full(self, joints: ArrayLike) -> Floats:
        """Those of the active links."""
        active: Floats = np.compress(self.active_links_mask, np.asarray(joints), axis=0)
        return active

    def _joints(self, joints: ArrayLike) -> Floats:
        given = np.asarray(joints, dtype=np.float64)
        if given.shape != (len(self),):
            raise ShapeError(
                f"the joints have the shape {given.shape}; ({len(self)},) is needed, one for each link"
            )
        return given

    def _tip(self, q: Floats) -> Floats:
        pose: Floats = self.robot.fk(q)
        pose[:3, 3] += pose[:3, :3] @ self._last
        return pose


class _Goal:
    """What is wanted of the tip."""

    def __init__(self, chain: Chain, frame: Floats, columns: Optional[list[int]], no_position: bool) -> None:
        self.chain, self.frame, self.columns, self.no_position = chain, frame, columns or [], no_position

    @property
    def is_whole(self) -> bool:
        return len(self.columns) == 3 and not self.no_position

    def off(self, q: Floats) -> Floats:
        missing = self.frame - self.chain._tip(q)
        parts = [] if self.no_position else [missing[:3, 3]]
        return np.concatenate([*parts, *(missing[:3, c] for c in self.columns)])

    def slopes(self, q: Floats) -> Floats:
        jacobian = self.chain.robot.jacobian(q)
        v, w = jacobian[:3], jacobian[3:]
        pose = self.chain._tip(q)
        # The tip stands behind the last link; an axis turns with it.
        parts = [] if self.no_position else [v + np.cross(w, pose[:3, :3] @ self.chain._last, axis=0)]
        return np.concatenate([*parts, *(np.cross(w, pose[:3, c], axis=0) for c in self.columns)])

    def sought(self, start: Floats, active: NDArray[np.bool_]) -> Floats:
        """The best of descents, the first from ``start``."""
        limits = np.array([self.chain.links[k].bounds for k in self.chain._moving])
        lower, upper = np.where(active, limits[:, 0], start), np.where(active, limits[:, 1], start)
        best = descend(start, lower, upper, self.off, self.slopes)
        random = np.random.default_rng(0)
        low, high = np.maximum(lower, start - np.pi), np.minimum(upper, start + np.pi)
        for _ in range(_STARTS):
            if np.linalg.norm(self.off(best)) <= _ARRIVED:
                break
            other = descend(random.uniform(low, np.maximum(low, high)), lower, upper, self.off, self.slopes)
            best = min(best, other, key=lambda q: float(np.linalg.norm(self.off(q))))
        return best


class _Robots:
    """The arm from its base to its tip, and the parts of it that say where links are."""

    def __init__(self, file: Path, names: list[str], *, as_written: bool) -> None:
        self.names = names
        self.whole = Robot.from_file(file, base=names[0], tip=names[-1], as_written=as_written)
        self._parts: list[Optional[tuple[Robot, bool]]] = [None] * len(names)
        for k in range(1, len(names) - 1):
            self._parts[k] = self._part(file, k, as_written)

    def _part(self, file: Path, k: int, as_written: bool) -> tuple[Robot, bool]:
        """The chain to a link or, if nothing moves before it, that from it on."""
        try:
            return Robot.from_file(file, base=self.names[0], tip=self.names[k], as_written=as_written), True
        except ChainError:
            return Robot.from_file(file, base=self.names[k], tip=self.names[-1], as_written=as_written), False

    def pose(self, k: int, q: Floats) -> Floats:
        """Where a link is in the base."""
        part = self._parts[k]
        if part is None:
            pose: Floats = self.whole.fk(q)
            return pose
        robot, is_before = part
        if is_before:
            before: Floats = robot.fk(q[: robot.n])
            return before
        rest: Floats = self.whole.fk(q) @ np.linalg.inv(robot.fk(q[len(q) - robot.n :]))
        return rest


def _columns(mode: str) -> list[int]:
    columns = {"X": [0], "Y": [1], "Z": [2], "all": [0, 1, 2]}
    if mode not in columns:
        raise UsageError(f"no orientation_mode `{mode}`: X, Y, Z or all")
    return columns[mode]


def _three(given: ArrayLike) -> Floats:
    vector = np.asarray(given, dtype=np.float64)
    if vector.shape != (3,):
        raise ShapeError(f"a vector has the shape {vector.shape}; (3,) is needed")
    return vector


def _axis(rotation: Optional[ArrayLike], translation: Optional[ArrayLike]) -> ArrayLike:
    if rotation is not None and translation is not None:
        raise UnsupportedError("a link both turns and slides: make two of it")
    given = translation if rotation is None else rotation
    assert given is not None
    return given


def _walked(file: Path, elements: list[str], kind: str) -> tuple[list[Link], list[str]]:
    """The links of a chain, the origin first, and the names of the bodies between them."""
    try:
        root = ElementTree.parse(file).getroot()
    except OSError as why:
        raise FileError(f"{file}: {why.strerror}") from None
    except ElementTree.ParseError as why:
        raise ChainError(f"{file}: {why}") from None
    joints = [joint for joint in root.findall("joint") if joint.find("parent") is not None]
    bodies = [body.get("name", "") for body in root.findall("link")]

    def end(joint: ElementTree.Element, which: str) -> str:
        found = joint.find(which)
        return "" if found is None else found.get("link", "")

    def named(name: str) -> ElementTree.Element:
        for joint in joints:
            if joint.get("name") == name:
                return joint
        raise ChainError(f"{file}: no joint `{name}`")

    if kind == "joint":
        elements = [end(named(elements[0]), "parent"), *elements]
    elif kind != "link":
        raise UsageError(f"no base_element_type `{kind}`: link or joint")
    body = elements[0]
    if body not in bodies:
        raise ChainError(f"{file}: no link `{body}`; base_elements=[…] names the first one")
    links: list[Link] = [OriginLink()]
    names = [body]
    rest = elements[1:]
    while True:
        children = [joint for joint in joints if end(joint, "parent") == body]
        joint = named(rest.pop(0)) if rest else next(iter(children), None)
        if joint is None:
            return links, names
        body = rest.pop(0) if rest else end(joint, "child")
        if end(joint, "child") != body:
            raise ChainError(f"{file}: `{joint.get('name')}` does not carry `{body}`")
        links.append(_link_of(joint))
        names.append(body)


def _link_of(joint: ElementTree.Element) -> Link:
    def three(tag: str, key: str, usual: str) -> list[float]:
        found = joint.find(tag)
        text = usual if found is None else found.get(key, usual)
        return [float(x) for x in text.split()]

    kind = joint.get("type", "fixed")
    axis = three("axis", "xyz", "1 0 0")
    limit = joint.find("limit")
    bounds: tuple[Optional[float], Optional[float]] = (None, None)
    if limit is not None and kind != "continuous":
        low, high = limit.get("lower"), limit.get("upper")
        bounds = (None if low is None else float(low), None if high is None else float(high))
    return URDFLink(
        joint.get("name", ""),
        three("origin", "xyz", "0 0 0"),
        three("origin", "rpy", "0 0 0"),
        rotation=axis if kind in ("revolute", "continuous") else None,
        translation=axis if kind == "prismatic" else None,
        bounds=bounds,
        joint_type=kind,
    )


def _urdf(links: Sequence[Link], name: str) -> str:
    """A URDF of links that were made by hand; the first one is the base."""
    root = ElementTree.Element("robot", name=name)
    for k in range(len(links)):
        ElementTree.SubElement(root, "link", name=f"l{k}")

    def written(vector: Floats) -> str:
        return " ".join(map(repr, vector.tolist()))

    for k, link in enumerate(links):
        if k == 0:
            continue
        low, high = link.bounds
        is_bounded = bool(np.isfinite(low) and np.isfinite(high))
        kind = "continuous" if link.joint_type == "revolute" and not is_bounded else link.joint_type
        joint = ElementTree.SubElement(root, "joint", name=link.name, type=kind)
        ElementTree.SubElement(joint, "parent", link=f"l{k - 1}")
        ElementTree.SubElement(joint, "child", link=f"l{k}")
        ElementTree.SubElement(joint, "origin", xyz=written(link.origin[0]), rpy=written(link.origin[1]))
        if kind != "fixed":
            ElementTree.SubElement(joint, "axis", xyz=written(link.axis))
        if is_bounded:
            ElementTree.SubElement(
                joint, "limit", lower=repr(float(low)), upper=repr(float(high)), effort="0", velocity="0"
            )
    return ElementTree.tostring(root, encoding="unicode")
