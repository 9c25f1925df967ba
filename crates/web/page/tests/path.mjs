// Paths: way-points, a plan, playing and scrubbing it, its plots, and its numbers as a file.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { apart, handAt } from "./engine.mjs";
import { close, enter, farthest, openRobot, read, scenario, shared, tab, until } from "./support.mjs";

const time = (page) => page.getByRole("slider", { name: "Time on the path" });
const clock = async (page) => read((await page.locator(".clock").textContent()).split("s")[0]);

/** The clock once what has happened is drawn, and it says the same over two frames. */
async function shownNow(page) {
  let last = NaN;
  await until(async () => {
    await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
    const before = last;
    last = await clock(page);
    return last === before;
  }, "the clock stands still");
  return last;
}

async function plan(page) {
  await page.getByRole("button", { name: /^Plan/ }).click();
  await page.getByRole("button", { name: "Play", exact: true }).waitFor();
}

/** Moves a joint to so many degrees, and comes back. */
async function turn(page, name, to) {
  await tab(page, "Joints").click();
  await enter(page.getByRole("textbox", { name: new RegExp(`^${name}\\b`) }), String(to));
  await tab(page, "Path").click();
}

/** The numbers of the saved path, column by column. */
async function table(page) {
  const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "Save CSV" }).click()]);
  assert.match(download.suggestedFilename(), /-path\.csv$/);
  const [head, ...rows] = readFileSync(await download.path(), "utf8").trimEnd().split("\n").map((line) => line.split(","));
  for (const row of rows) assert.equal(row.length, head.length);
  const column = (name) => rows.map((row) => Number(row[head.indexOf(name)]));
  for (const name of head) assert.ok(column(name).every(Number.isFinite), `${name} is a column of numbers`);
  return { head, rows, column };
}

scenario("two way-points are planned, played and scrubbed, and saved as numbers", async (page) => {
  const { engine, robot } = await openRobot(page, "ur5", { panel: "path" });
  const names = robot.joints.map((joint) => joint.name);
  await turn(page, "q1", 40);
  await page.getByRole("button", { name: "Add joints" }).click();
  await turn(page, "q2", -60);
  await page.getByRole("button", { name: "Add joints" }).click();
  const goal = (await shared(page, (s) => s.points?.length === 2, "there are two way-points")).points[1].q;
  await plan(page);
  close(await clock(page), 0, 1e-9, "it does not play by itself");

  // The file holds the path: from the first configuration over the first way-point to the second, within all speeds.
  const numbers = async () => {
    const { head, rows, column } = await table(page);
    return { head, rows, column, times: column("t"), q: rows.map((_, k) => names.map((name) => column(name)[k])) };
  };
  let { head, rows, column, times, q } = await numbers();
  assert.deepEqual(head.slice(0, 7), ["t", ...names]);
  assert.ok(times.every((t, k) => k === 0 || t > times[k - 1]), "time goes on");
  assert.ok(farthest(q[0], robot.q) < 1e-9 && farthest(q.at(-1), goal) < 1e-6, "from the start to the last way-point");
  const via = robot.q.map((x, k) => (k === 0 ? goal[0] : x));
  assert.ok(Math.min(...q.map((at) => farthest(at, via))) < 0.02, "over the first way-point");
  robot.joints.forEach((joint) => {
    const fastest = Math.max(...column(`${joint.name}_velocity`).map(Math.abs));
    assert.ok(fastest <= joint.velocity * 1.001, `${joint.name} goes with ${fastest} at most`);
  });
  const half = Math.floor(rows.length / 2);
  const hand = handAt(engine, q[half]);
  assert.ok(farthest(["x", "y", "z"].map((name) => column(name)[half]), hand.slice(0, 3).map((row) => row[3])) < 1e-6, "the hand by its columns");

  // Slowly enough to be held on the way, however seldom a frame is drawn.
  await enter(page.getByRole("textbox", { name: /^Duration/ }), "20");
  await plan(page);
  await until(async () => Math.abs(Number(await time(page).getAttribute("max")) - 20) < 1e-6, "it takes 20 s");
  ({ times, q } = await numbers());

  // Played: time goes on, the joints follow, and it can be held.
  await page.getByRole("button", { name: "Play", exact: true }).click();
  const frames = await page.evaluate(() => window.denavit.frames);
  await until(async () => (await clock(page)) > 0.05 * times.at(-1), "time goes on");
  await until(async () => (await page.evaluate(() => window.denavit.frames)) > frames + 1, "the scene moves");
  await page.getByRole("button", { name: "Pause" }).click();
  const held = await shownNow(page);
  const at = (seconds) => {
    const k = Math.max(1, times.findIndex((t) => t >= seconds));
    const share = (seconds - times[k - 1]) / (times[k] - times[k - 1]);
    return q[k].map((x, j) => q[k - 1][j] + share * (x - q[k - 1][j]));
  };
  const s = await shared(page, (one) => farthest(one.q, at(held)) < 0.02, `the joints are where the path is at ${held} s`);
  assert.ok(farthest(s.q, robot.q) > 1e-3);

  await time(page).focus();
  await page.keyboard.press("PageUp");
  await until(async () => Math.abs((await clock(page)) - Math.min(times.at(-1), held + times.at(-1) / 10)) < 0.012, "a tenth further");
  const box = await time(page).boundingBox();
  await page.mouse.click(box.x + box.width - 2, box.y + box.height / 2);
  await shared(page, (one) => farthest(one.q, goal) < 0.02, "at its end the arm is at the last way-point");
});

scenario("the plots have axes, curves and a cursor that is moved", async (page) => {
  const { robot } = await openRobot(page, "puma560", { panel: "path" });
  await turn(page, "q1", 30);
  await page.getByRole("button", { name: "Add joints" }).click();
  await plan(page);
  const plots = page.locator("figure.plot");
  assert.equal(await plots.count(), 3, "joints, speeds, manipulability");
  for (let k = 0; k < 3; k++) {
    const plot = plots.nth(k);
    assert.ok((await plot.locator(".grid text").count()) >= 4, "numbers on both axes");
    const curves = await plot.locator("path.curve").evaluateAll((all) => all.map((one) => one.getAttribute("d").length));
    assert.equal(curves.length, k === 2 ? 1 : robot.joints.length);
    assert.ok(curves.every((length) => length > 200), "curves of many points");
  }
  const cursor = plots.first().locator(".cursor line");
  const place = async () => Number(/translate\((\S+)/.exec(await cursor.getAttribute("transform"))[1]);
  const first = await place();
  const slider = page.getByRole("slider", { name: /Time, on the plot of joints/ }).first();
  await slider.focus();
  await page.keyboard.press("PageUp");
  await until(async () => (await place()) > first + 5, "the cursor moves");
  const end = Number(await slider.getAttribute("aria-valuemax"));
  close(await clock(page), end / 10, 0.011, "by a tenth of the time");
  await page.keyboard.press("End");
  // The first joint's dot is where 30° is on the axis.
  const s = await shared(page, (one) => Math.abs(one.q[0] - Math.PI / 6) < 1e-6, "the arm is at the end");
  assert.ok(s.q.length === 6);
});

scenario("a straight line and an arc of the hand", async (page) => {
  const { engine, robot } = await openRobot(page, "staubli-rx90", { panel: "hand" });
  const first = handAt(engine, robot.q);
  const go = async (axis, by, words) => {
    await tab(page, "Hand").click();
    const field = page.getByRole("textbox", { name: `Position ${axis}` });
    await enter(field, `${read(await field.inputValue()) + by} mm`);
    await tab(page, "Path").click();
    await page.getByRole("button", { name: words }).click();
  };
  await tab(page, "Path").click();
  await go("y", 60, "Add line");
  await go("z", -50, "Add arc");
  await go("y", 80, "End the arc here");
  const { points } = await shared(page, (s) => s.points?.length === 2, "there are two way-points");
  assert.deepEqual(points.map((point) => point.kind), ["line", "arc"]);
  await plan(page);
  const { column } = await table(page);
  const hands = column("x").map((x, k) => [x, column("y")[k], column("z")[k]]);
  const at = (pose) => pose.slice(0, 3).map((row) => row[3]);
  const nearest = (to) => Math.min(...hands.map((hand) => Math.hypot(...hand.map((x, k) => x - to[k]))));
  assert.ok(nearest(points[1].via) < 2e-3, "the arc goes through its point");
  assert.ok(Math.hypot(...hands.at(-1).map((x, k) => x - at(points[1].pose)[k])) < 1e-6, "and ends at its end");
  // On the line only y changes.
  const corner = hands.findIndex((hand) => Math.hypot(...hand.map((x, k) => x - at(points[0].pose)[k])) < 1e-3);
  assert.ok(corner > 3, "the line comes first");
  for (const hand of hands.slice(0, corner)) assert.ok(Math.abs(hand[0] - first[0][3]) < 1e-6 && Math.abs(hand[2] - first[2][3]) < 1e-6, "straight");
  assert.ok(apart(first, points[0].pose) > 0.05);
});

scenario("nothing plays by itself where less motion is wanted", { reducedMotion: "reduce" }, async (page) => {
  await openRobot(page, "puma560", { panel: "path" });
  await turn(page, "q1", 30);
  await page.getByRole("button", { name: "Add joints" }).click();
  await plan(page);
  const frames = () => page.evaluate(() => window.denavit.frames);
  const before = await until(async () => {
    const now = await frames();
    await page.evaluate(() => new Promise((resolve) => setTimeout(resolve, 400)));
    return now === (await frames()) ? now : null;
  }, "the picture stands still");
  assert.equal(await clock(page), 0);
  assert.equal(await page.getByRole("button", { name: "Pause" }).count(), 0);
  // What somebody asks for still moves.
  await page.getByRole("button", { name: "Play", exact: true }).click();
  await until(async () => (await frames()) > before, "it plays when it is asked to");
});

scenario("way-points, their order and the duration are undone like all else", async (page) => {
  const { robot } = await openRobot(page, "scara", { panel: "path" });
  await turn(page, "q1", 40);
  await page.getByRole("button", { name: "Add joints" }).click();
  await turn(page, "q1", -20);
  await page.getByRole("button", { name: "Add joints" }).click();
  const points = page.getByRole("list", { name: "Way-points" }).getByRole("listitem");
  const count = (n) => until(async () => (await shared(page, () => true, "")).points?.length === n || (n === 0 && (await shared(page, () => true, "")).points === undefined), `${n} way-points`);
  await count(2);
  const duration = page.getByRole("textbox", { name: /^Duration/ });
  await enter(duration, "7");
  await duration.blur();
  await page.getByRole("button", { name: "Undo" }).click();
  await until(async () => (await duration.inputValue()) === "", "no duration again");
  await page.getByRole("button", { name: "Undo" }).click();
  await count(1);
  await page.getByRole("button", { name: "Redo" }).click();
  await count(2);
  assert.ok((await points.count()) >= 2);
  // Another robot lets them go; undoing brings both back.
  await page.keyboard.press("Control+k");
  await page.getByRole("combobox", { name: /Search/ }).fill("planar 2r");
  await page.keyboard.press("Enter");
  await shared(page, (s) => s.file.name !== robot.robot && !s.points, "another robot, without way-points");
  await page.getByRole("button", { name: "Undo" }).click();
  await shared(page, (s) => s.file.name === robot.robot && s.points?.length === 2, "the robot and its way-points are back");
});
