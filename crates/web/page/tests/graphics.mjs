// A picture that the browser takes away, and fingers instead of a mouse.
import assert from "node:assert/strict";
import { apart, handAt } from "./engine.mjs";
import { differing, drawn, pictureOf } from "./pixels.mjs";
import { NARROW, openRobot, radians, scenario, shared, until } from "./support.mjs";

const taken = (page) => page.getByRole("alert").getByText(/taken the picture away/);
/** Takes the picture away; `back` gives it again. */
const lose = (page) =>
  page.evaluate(() => {
    const gl = document.querySelector("canvas.scene-canvas").getContext("webgl2");
    window.context = gl.getExtension("WEBGL_lose_context");
    window.context.loseContext();
  });

scenario("a picture that is taken away comes back with all that has changed meanwhile", { expected: [/CONTEXT_LOST|Context Lost/i] }, async (page) => {
  await openRobot(page, "puma560", { look: { ellipsoid: true } });
  const whole = await pictureOf(page);
  await lose(page);
  await taken(page).waitFor();
  await page.evaluate(() => window.context.restoreContext());
  await taken(page).waitFor({ state: "detached" });
  assert.ok(differing(whole, await pictureOf(page)) < 0.001, "the same picture: bodies, lines, words");

  // Moved while there was no picture, as the arm that was moved with one.
  const field = page.getByRole("textbox", { name: /^q1\b/ });
  await field.fill("50");
  await field.press("Enter");
  await field.blur();
  const moved = await pictureOf(page);
  assert.ok(differing(whole, moved) > 0.05, "it is another picture");
  await page.getByRole("button", { name: "Undo" }).click();
  await lose(page);
  await taken(page).waitFor();
  await page.getByRole("button", { name: "Redo" }).click();
  await shared(page, (s) => Math.abs(s.q[0] - radians(50)) < 1e-9, "the joint is moved");
  await page.evaluate(() => window.context.restoreContext());
  await taken(page).waitFor({ state: "detached" });
  assert.ok(differing(moved, await pictureOf(page)) < 0.01, "with what has changed");
});

scenario("a picture that does not come back is drawn again when it is asked for", { expected: [/CONTEXT_LOST|Context Lost/i] }, async (page) => {
  await openRobot(page, "puma560");
  const whole = await pictureOf(page);
  await lose(page);
  await taken(page).waitFor();
  await page.getByRole("button", { name: "Draw it again" }).click();
  await taken(page).waitFor({ state: "detached" });
  await until(async () => drawn(await pictureOf(page)) > 0.02, "there is a picture");
  // Away from the cube, which is where the button was.
  await page.mouse.move(1000, 700);
  assert.ok(differing(whole, await pictureOf(page)) < 0.005, "of the same arm from the same side");
});

const FINGERS = { viewport: NARROW, hasTouch: true, isMobile: true };

/** Fingers on the picture, one path of points each, as a touch screen tells them. */
async function touch(page, ...paths) {
  const client = await page.context().newCDPSession(page);
  const box = await page.locator("canvas.scene-canvas").boundingBox();
  const at = (step) => paths.map((path, id) => ({ id, x: box.x + path[Math.min(step, path.length - 1)][0], y: box.y + path[Math.min(step, path.length - 1)][1] }));
  await client.send("Input.dispatchTouchEvent", { type: "touchStart", touchPoints: at(0) });
  const steps = Math.max(...paths.map((path) => path.length));
  for (let k = 1; k < steps; k++) await client.send("Input.dispatchTouchEvent", { type: "touchMove", touchPoints: at(k) });
  await client.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
  await client.detach();
}

/** From a point to another, in steps. */
const way = ([x, y], [dx, dy], steps = 8) => Array.from({ length: steps + 1 }, (_, k) => [x + (k * dx) / steps, y + (k * dy) / steps]);

scenario("one finger turns the view, two move it and zoom", FINGERS, async (page) => {
  await openRobot(page, "ur5");
  const camera = async (isWanted, words) => (await shared(page, (s) => s.camera && isWanted(s.camera), words)).camera;
  const { width, height } = await page.locator("canvas.scene-canvas").boundingBox();
  await touch(page, way([30, height - 90], [60, 0]));
  const first = await camera(([azimuth]) => Math.abs(azimuth + 0.95) > 0.2, "the view is turned");
  // Two fingers apart: nearer. The factor is that of their distances.
  const [left, right] = [[width / 2 - 40, height / 2], [width / 2 + 40, height / 2]];
  await touch(page, way(left, [-40, 0]), way(right, [40, 0]));
  const near = await camera((c) => c[2] < 0.8 * first[2], "it is nearer");
  assert.ok(near[2] > 0.4 * first[2] && near[2] < 0.6 * first[2], `half as far: ${near[2] / first[2]}`);
  assert.ok(Math.abs(near[0] - first[0]) < 1e-3, "two fingers do not turn it");
  // Together upwards: the point that is looked at goes.
  await touch(page, way(left, [0, -50]), way(right, [0, -50]));
  const up = await camera((c) => Math.hypot(...[3, 4, 5].map((k) => c[k] - near[k])) > 0.01, "it is moved");
  assert.ok(Math.abs(up[2] / near[2] - 1) < 0.05, "and not zoomed");
});

scenario("a finger turns a joint, and takes the handle of the hand", FINGERS, async (page) => {
  const { engine, robot } = await openRobot(page, "ur5");
  const [x, y] = (await page.evaluate(() => window.denavit.joints()))[1];
  await touch(page, way([x, y], [40, 10]));
  const turned = await shared(page, (s) => Math.abs(s.q[1] - robot.q[1]) > 0.05, "the second joint is turned");
  assert.deepEqual(turned.q.filter((_, k) => k !== 1), robot.q.filter((_, k) => k !== 1).map((v) => Number(v.toPrecision(12))), "that one alone");
  const [hx, hy] = (await page.evaluate(() => window.denavit.handles()))["axis z"];
  await touch(page, way([hx, hy], [0, -30], 12));
  const moved = await shared(page, (s) => s.target && apart(s.target, handAt(engine, turned.q)) > 0.01, "the hand is moved");
  assert.ok(Math.abs(moved.target[0][3] - handAt(engine, turned.q)[0][3]) < 1e-9, "along z alone");
});
