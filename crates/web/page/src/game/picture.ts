// The picture of the game: the axes of the joints, the frames that stand, and the answers that are offered, by their letters.

import type { Point } from "../engine/types.ts";
import { drawFrame } from "../scene/frames.ts";
import { add, cross, poseOf, scale } from "../scene/geometry.ts";
import type { Label } from "../scene/labels.ts";
import { measures } from "../scene/measure.ts";
import type { Stage } from "../scene/stage.ts";
import { Strokes } from "../scene/strokes.ts";
import { colours, type Palette } from "../scene/theme.ts";
import { answer, game, type Game, LETTERS, pointed, question } from "./game.ts";

/** Pixels between a letter and the finger that means it. */
const NEAR = 18;

class Picture {
  #strokes: Strokes;
  #palette: Palette;
  #labels: Label[] = [];
  /** Where the answers are. */
  spots: Point[] = [];

  constructor(strokes: Strokes, palette: Palette) {
    this.#strokes = strokes;
    this.#palette = palette;
  }

  draw(now: Game, at: number | null): Label[] {
    const { unit } = now.scene;
    this.#axes(now, unit);
    now.placed.forEach(({ origin, z, x }, k) => {
      drawFrame(this.#strokes, poseOf(x, cross(z, x), z, origin), this.#palette, { length: 2.6 * unit, alpha: 1, width: 2.4 });
      this.#labels.push(this.#name(`z_${k}`, add(origin, z, 2.6 * unit), z, this.#palette.z), this.#name(`x_${k}`, add(origin, x, 2.6 * unit), x, this.#palette.x));
    });
    this.#begun(now, unit);
    const asked = question.value;
    if (!asked) return this.#labels;
    const start = now.origin;
    asked.choices.forEach(({ value }, k) => {
      const wasTried = now.tried.includes(k);
      const colour = k === at ? this.#palette.glow : wasTried ? this.#palette.beyond : this.#palette.now;
      const spot = asked.part === "origin" ? value : add(start ?? [0, 0, 0], value, 4.2 * unit);
      if (asked.part === "origin") this.#point(value, 0.28 * unit, k === at);
      else this.#strokes.line(start ?? [0, 0, 0], spot, { colour, width: k === at ? 5 : 3, head: 14, alpha: wasTried ? 0.4 : 1, through: 0.7 });
      this.spots.push(spot);
      const toward: Point = asked.part === "origin" ? [0, 0, unit] : scale(value, unit);
      this.#labels.push({ text: LETTERS[k], at: spot, toward, colour, size: 15, plate: true, rank: 40 });
    });
    return this.#labels;
  }

  #name(text: string, at: Point, toward: Point, colour: Label["colour"]): Label {
    return { text, at, toward, colour, size: 14, rank: 10 };
  }

  #axes({ arm, scene }: Game, unit: number): void {
    arm.axes.forEach(({ along }, k) => {
      // Where the joint is drawn: a table may have its axis elsewhere along itself.
      const symbol = scene.symbols.find(({ joint }) => joint === k);
      const at = symbol?.centre ?? arm.axes[k].at;
      const long = 5 * unit;
      this.#strokes.line(add(at, along, -long), add(at, along, long), { colour: this.#palette.normal, width: 1.5, dash: 6, through: 0.8 });
      this.#labels.push({ text: `axis ${k + 1}`, at: add(at, along, long), toward: scale(along, unit), colour: this.#palette.quiet, size: 12, rank: 4 });
    });
  }

  /** What stands of the frame that is being placed. */
  #begun({ origin, z }: Game, unit: number): void {
    if (!origin) return;
    this.#point(origin, 0.2 * unit, true);
    if (z) this.#strokes.line(origin, add(origin, z, 2.6 * unit), { colour: this.#palette.z, width: 3.5, head: 12, through: 0.7 });
  }

  /** A point as a small cross of three lines: it is seen from everywhere. */
  #point(at: Point, size: number, isStrong: boolean): void {
    for (const axis of [[1, 0, 0], [0, 1, 0], [0, 0, 1]] satisfies Point[]) {
      this.#strokes.line(add(at, axis, -size), add(at, axis, size), { colour: isStrong ? this.#palette.glow : this.#palette.now, width: isStrong ? 5 : 3.5, through: 0.9 });
    }
  }
}

export function addGame(stage: Stage): void {
  const strokes = new Strokes(24, false, 128);
  stage.add(strokes.object);
  stage.onEnd(() => strokes.dispose());
  let spots: Point[] = [];
  stage.watch(
    "game",
    () => ({ now: game.value, at: pointed.value, asked: question.value, palette: colours.value }),
    ({ now, at, palette }) => {
      strokes.begin();
      const picture = new Picture(strokes, palette);
      stage.labels.set("game", now ? picture.draw(now, at) : []);
      spots = picture.spots;
      strokes.end();
    },
  );
  measures.answers = () =>
    spots.map((p) => {
      const { x, y } = stage.orbit.project(p);
      return [x, y];
    });
  stage.onPick = (x, y) => {
    if (!game.peek()) return false;
    const away = spots.map((p) => {
      const at = stage.orbit.project(p);
      return at.before ? Math.hypot(at.x - x, at.y - y) : Number.POSITIVE_INFINITY;
    });
    const nearest = away.indexOf(Math.min(...away));
    if (nearest < 0 || away[nearest] > NEAR) return false;
    answer(nearest);
    return true;
  };
}
