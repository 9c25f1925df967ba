// The hand: dragged in the scene, typed, out of reach, and all the ways for the arm to hold it.
import assert from "node:assert/strict";
import { apart, handAt, robotOf } from "./engine.mjs";
import { close, enter, farthest, openRobot, radians, read, scenario, shared, tab, until } from "./support.mjs";

const place = (pose) => pose.slice(0, 3).map((row) => row[3]);
const solutions = (page) => page.getByRole("region", { name: "Inverse solutions" });

/** Where a handle is on the page. */
async function handle(page, name) {
  const [spots, box] = [await page.evaluate(() => window.denavit.handles()), await page.locator("canvas.scene-canvas").boundingBox()];
  assert.ok(spots[name], `there is a handle ${name} among ${Object.keys(spots)}`);
  return [box.x + spots[name][0], box.y + spots[name][1]];
}

/** Drags a handle by so many pixels, in small steps. */
async function drag(page, name, [dx, dy], steps = 8) {
  const [x, y] = await handle(page, name);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + dx, y + dy, { steps });
  return [x + dx, y + dy];
}

const isReached = (engine) => (s) => s.target && apart(handAt(engine, s.q), s.target) < 1e-6;

scenario("the hand is dragged along an axis, and the arm follows it", async (page) => {
  const { engine, robot } = await openRobot(page, "staubli-rx90", { panel: "hand" });
  await until(async () => (await solutions(page).getByRole("option").count()) === 8, "there are eight solutions");
  const first = handAt(engine, robot.q);
  const mouse = await drag(page, "axis z", [0, 50]);
  // The handle is where the pointer holds it, also before it is let go; across the axis it may be off.
  await until(async () => Math.abs((await handle(page, "axis z"))[1] - mouse[1]) < 6, "the handle follows the pointer");
  await page.mouse.up();
  const isDown = (s) => isReached(engine)(s) && s.target[2][3] < first[2][3] - 0.02;
  // The address comes after the last step of the drag, as the fields show it.
  const shown = page.getByRole("textbox", { name: "Position z" });
  const s = await until(async () => {
    const now = await shared(page, isDown, "the arm is where the hand is wanted");
    return Math.abs(read(await shown.inputValue()) - 1000 * now.target[2][3]) < 0.006 && now;
  }, "fields and address say the same");
  const by = place(s.target).map((p, k) => p - place(first)[k]);
  assert.ok(Math.abs(by[0]) < 1e-9 && Math.abs(by[1]) < 1e-9, `moved along z by ${by}`);
  assert.ok(farthest(s.q, robot.q) < 1, "the nearest solution is followed, not another one");
  for (const [k, axis] of ["x", "y", "z"].entries()) {
    close(read(await page.getByRole("textbox", { name: `Position ${axis}` }).inputValue()), 1000 * s.target[k][3], 0.006);
  }

  // In a plane: the third coordinate stays.
  await drag(page, "plane y", [-24, -18]);
  await page.mouse.up();
  const moved = await shared(page, (next) => isReached(engine)(next) && apart(next.target, s.target) > 1e-3, "the hand is moved in a plane");
  close(moved.target[1][3], s.target[1][3], 1e-9, "y");
});

scenario("a row that was explained does not keep the handles and the other solutions away", async (page) => {
  await openRobot(page, "staubli-rx90", { panel: "table", look: { ghosts: true } });
  await page.getByRole("textbox", { name: "Row 2, theta", exact: true }).focus();
  const has = () => page.evaluate(() => [Object.keys(window.denavit.handles()).length, window.denavit.ghosts]);
  await until(async () => (await has()).every((count) => count === 0), "the row has the scene for itself");
  await tab(page, "Hand").click();
  await until(async () => (await has())[0] === 6 && (await has())[1] === 7, "six handles and seven other solutions");
});

scenario("the hand is turned by a ring about an axis of the tool", async (page) => {
  const { engine, robot } = await openRobot(page, "puma560", { panel: "hand" });
  const first = handAt(engine, robot.q);
  await page.getByRole("button", { name: "Handles that turn the hand" }).click();
  await page.getByRole("button", { name: /Handles along the axes of the base/ }).click();
  const ring = Object.keys(await page.evaluate(() => window.denavit.handles()))[2];
  await drag(page, ring, [16, 16]);
  await page.mouse.up();
  const isTurned = (s) => isReached(engine)(s) && apart(s.target, first) > 0.02;
  const s = await shared(page, isTurned, "the hand is turned, and the arm follows");
  assert.ok(farthest(place(s.target), place(first)) < 1e-9, "the hand stays in its place");
  // About z of the tool: that axis stays.
  assert.ok(farthest(s.target.map((row) => row[2]), first.map((row) => row[2])) < 1e-9);
});

scenario("a pose is typed, by position and by any set of angles", async (page) => {
  const { engine, robot } = await openRobot(page, "ur5", { panel: "hand" });
  const first = handAt(engine, robot.q);
  await page.getByRole("combobox", { name: "Orientation as" }).selectOption("zyx");
  const x = page.getByRole("textbox", { name: "Position x" });
  const wanted = first[0][3] + 0.02;
  await enter(x, `${wanted} m`);
  const s = await shared(page, (one) => isReached(engine)(one) && Math.abs(one.target[0][3] - wanted) < 1e-9, "x is as typed");
  assert.ok(apart(s.target.map((row) => row.slice(0, 3)), first.map((row) => row.slice(0, 3))) < 1e-9, "the orientation stays");

  // Rz(yaw)·Ry(pitch)·Rx(roll): the first column is (cos yaw cos pitch, sin yaw cos pitch, −sin pitch).
  const angles = page.getByRole("textbox", { name: /^Orientation/ });
  assert.equal(await angles.count(), 3);
  await enter(angles.nth(0), "20");
  await enter(angles.nth(1), "10 deg");
  const [yaw, pitch] = [radians(20), radians(10)];
  const turned = await shared(page, (one) => isReached(engine)(one) && Math.abs(one.target[2][0] + Math.sin(pitch)) < 1e-6, "the pitch is as typed");
  const column = turned.target.map((row) => row[0]);
  assert.ok(farthest(column, [Math.cos(yaw) * Math.cos(pitch), Math.sin(yaw) * Math.cos(pitch), -Math.sin(pitch), 0]) < 1e-4);

  await page.getByRole("combobox", { name: "Orientation as" }).selectOption("quaternion");
  const parts = await Promise.all([0, 1, 2, 3].map(async (k) => read(await angles.nth(k).inputValue())));
  close(Math.hypot(...parts), 1, 2e-4, "a unit quaternion");
});

scenario("the keys go through all solutions, and each holds the hand where it is", async (page) => {
  const { engine, robot } = await openRobot(page, "staubli-rx90", { panel: "hand" });
  const pose = handAt(engine, robot.q);
  const options = solutions(page).getByRole("option");
  await until(async () => (await options.count()) === 8, "there are eight solutions");
  await page.getByRole("listbox", { name: /Inverse solutions/ }).focus();
  await page.keyboard.press("Home");
  const seen = [];
  for (let k = 0; k < 8; k++) {
    await page.keyboard.press("Enter");
    const option = options.nth(k);
    await until(async () => (await option.getAttribute("aria-selected")) === "true", `solution ${k + 1} is taken`);
    await option.getByText("arm is here").waitFor();
    const { q } = await shared(page, (s) => (seen.length === 0 ? s.target : farthest(s.q, seen.at(-1)) > 1e-6), `solution ${k + 1} is in the address`);
    assert.ok(apart(handAt(engine, q), pose) < 1e-9, `solution ${k + 1} holds the hand`);
    assert.ok(seen.every((other) => farthest(q, other, Array(6).fill("R")) > 1e-3), `solution ${k + 1} is another one`);
    seen.push(q);
    await page.keyboard.press("ArrowDown");
  }
  assert.equal(await options.count(), 8, "the list stays as it is");
  const branches = new Set(await page.locator(".solution-words > span:nth-child(2)").allTextContents());
  assert.equal(branches.size, 8, "each has a name of its own");
});

scenario("out of reach: how far, and the way to the nearest pose", async (page) => {
  const { engine, robot } = await openRobot(page, "staubli-rx90", { panel: "hand" });
  await enter(page.getByRole("textbox", { name: "Position x" }), "2 m");
  await page.getByRole("heading", { name: "Out of reach" }).waitFor();
  const words = await page.getByText(/The nearest pose the arm reaches is/).textContent();
  // The wrist comes 0.9 m far from the shoulder, which is in the base frame's origin.
  const [, , z] = place(handAt(engine, robot.q));
  close(read(/is (\S+) mm/.exec(words)[1]), 1000 * (Math.hypot(2, z) - 0.9), 3, "the distance");
  await page.getByRole("button", { name: "Go to the nearest" }).click();
  await page.getByRole("heading", { name: "Out of reach" }).waitFor({ state: "detached" });
  const { q } = await shared(page, (s) => !s.target && farthest(s.q, robot.q) > 0.1, "the arm is at the nearest pose");
  close(Math.hypot(...place(handAt(engine, q))), 0.9, 1e-3, "stretched");
});

for (const [words, name, change] of [
  ["at a wrist singularity", "staubli-rx90", (q) => q.map((x, k) => (k === 4 ? 0 : x))],
  ["of an arm with seven joints", "kuka-lwr4", (q) => q],
]) {
  scenario(`a family ${words}: the slider moves the arm, the hand stands still`, async (page) => {
    const q = change(robotOf(name).robot.q);
    const { engine, robot } = await openRobot(page, name, { panel: "hand", q });
    const slider = solutions(page).getByRole("slider", { name: /along the curve/ }).first();
    await slider.waitFor();
    const kinds = robot.joints.map((joint) => joint.kind);
    const pose = handAt(engine, q);
    let before = q;
    await slider.focus();
    for (const key of ["Home", "PageUp", "PageUp", "ArrowRight", "End"]) {
      await page.keyboard.press(key);
      if (key === "Home") {
        await page.keyboard.press("ArrowRight");
        await shared(page, (s) => s.target, "the arm is on the family");
        continue;
      }
      const s = await shared(page, (one) => one.target && farthest(one.q, before, kinds) > 1e-4, `${key} moves the arm`);
      assert.ok(apart(handAt(engine, s.q), pose) < 1e-6, `the hand stands still after ${key}`);
      before = s.q;
    }
  });
}

scenario("steps along the axes of base and tool, by buttons and keys", { permissions: ["clipboard-read", "clipboard-write"] }, async (page) => {
  const { engine, robot } = await openRobot(page, "puma560", { panel: "hand" });
  const first = handAt(engine, robot.q);
  await page.getByRole("button", { name: "Step along minus x" }).focus();
  await page.keyboard.press("ArrowLeft");
  await page.keyboard.press("PageDown");
  const s = await shared(page, (one) => isReached(engine)(one) && one.target[2][3] < first[2][3] - 1e-3, "two steps are made");
  assert.ok(farthest(place(s.target), [first[0][3] - 0.01, first[1][3], first[2][3] - 0.01]) < 1e-9);
  await page.getByRole("radio", { name: "Tool axes" }).check();
  await page.getByRole("button", { name: "Step along plus z" }).click();
  const next = await shared(page, (one) => isReached(engine)(one) && apart(one.target, s.target) > 1e-4, "a step of the tool");
  assert.ok(farthest(place(next.target), [0, 1, 2].map((r) => s.target[r][3] + 0.01 * s.target[r][2])) < 1e-9, "along z of the tool");

  await page.getByRole("button", { name: "Copy pose" }).click();
  const copied = JSON.parse(await page.evaluate(() => navigator.clipboard.readText()));
  assert.ok(apart(copied, next.target) < 1e-9);
  await page.getByRole("button", { name: "Follow the joints" }).click();
  await shared(page, (one) => !one.target, "the target is forgotten");
});
