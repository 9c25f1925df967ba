// Ten robots, found in the catalogue by typing: what the page says of them is what the engine says.
import assert from "node:assert/strict";
import { handAt, robotOf } from "./engine.mjs";
import { drawn } from "./pixels.mjs";
import { close, degrees, open, scenario, tab, until, valueOf } from "./support.mjs";

/**
 * What is typed into the search, the robot that is meant, and how many ways it has to where it begins: eight for arms
 * with a spherical wrist or three parallel axes, four where the shoulder slides, two for the elbow of a SCARA, and
 * families for arms with a joint too many.
 */
const ROBOTS = [
  ["rx-90", "staubli-rx90", 8],
  ["stanford arm", "stanford", 8],
  ["universal ur5 standard", "ur5", 8],
  ["unimation puma rrrrrr standard", "puma560", 8],
  ["emika panda", "franka-panda", "families"],
  ["lwr iv", "kuka-lwr4", "families"],
  ["SCARA generic", "scara", 2],
  ["linear axis prrr", "rail-puma", "families"],
  ["irb 140", "abb-irb140", 8],
  ["PRPRRR", "cylindrical-wrist", 4],
];

scenario("ten robots of the catalogue are loaded, drawn and solved", async (page) => {
  await open(page);
  for (const [words, name, ways] of ROBOTS) {
    const { engine, file, robot } = robotOf(name);
    await page.keyboard.press("Control+k");
    const search = page.getByRole("combobox", { name: /Search the catalogue/ });
    await search.fill(words);
    const options = page.getByRole("listbox", { name: "Robots" }).getByRole("option");
    await until(async () => (await options.first().textContent()).includes(robot.robot.slice(0, 5)), `${words} finds ${robot.name}`);
    const before = await page.evaluate(() => window.denavit.frames);
    await search.press("Enter");
    await page.getByRole("dialog").waitFor({ state: "detached" });
    await page.getByRole("heading", { level: 1, name: `Denavit: ${file.name}`, exact: true }).waitFor();
    await until(async () => (await page.title()) === `${file.name} – Denavit`, `the title names ${file.name}`);

    // The joints, with the numbers that the engine begins with.
    await tab(page, "Joints").click();
    const sliders = page.getByRole("tabpanel", { name: "Joints" }).getByRole("slider");
    assert.equal(await sliders.count(), robot.joints.length, `${name}: a slider for each joint`);
    for (const [k, joint] of robot.joints.entries()) {
      const shown = await valueOf(page.getByRole("textbox", { name: new RegExp(`^${joint.name}\\b`) }));
      close(shown, joint.kind === "R" ? degrees(robot.q[k]) : 1000 * robot.q[k], 0.006, `${name} ${joint.name}`);
    }

    // The picture.
    await until(async () => (await page.evaluate(() => window.denavit.frames)) > before, `${name} is drawn`);
    const share = drawn(await page.locator("canvas.scene-canvas").screenshot());
    assert.ok(share > 0.02, `${name}: only ${(100 * share).toFixed(2)} % of the picture are drawn`);

    // The hand, and the ways to hold it there.
    await tab(page, "Hand").click();
    const hand = handAt(engine, robot.q);
    for (const [k, axis] of ["x", "y", "z"].entries()) {
      close(await valueOf(page.getByRole("textbox", { name: `Position ${axis}` })), 1000 * hand[k][3], 0.006, `${name} ${axis}`);
    }
    const found = page.getByRole("region", { name: "Inverse solutions" });
    await until(async () => (await found.getAttribute("aria-busy")) === "false" && (await found.getByText(/^By /).count()) === 1, `${name} is solved`);
    const solutions = await found.getByRole("option").count();
    assert.equal(solutions, ways === "families" ? 0 : ways, `${name}: solutions`);
    if (ways === "families") assert.ok((await found.getByRole("slider", { name: /along the curve/ }).count()) > 0, `${name}: a slider along a family`);
    else assert.equal(await found.getByText("arm is here").count(), 1, `${name}: the arm is at one of its solutions`);
  }
});

scenario("the catalogue in pictures: all of its robots, found by typing and by arrows", async (page) => {
  await open(page);
  await page.keyboard.press("Control+k");
  await page.getByRole("radio", { name: "Pictures" }).check({ force: true });
  const options = page.getByRole("listbox", { name: "Robots" }).getByRole("option");
  const count = await options.count();
  assert.ok(count >= 99, `${count} robots`);
  // What is out of sight is not drawn before it comes into view.
  await until(async () => (await options.nth(0).locator("svg line").count()) > 4, "the first one is drawn");
  assert.equal(await options.nth(count - 1).locator("svg").count(), 0, "the last one is not");
  for (let k = 0; k < count; k += 8) {
    await options.nth(k).scrollIntoViewIfNeeded();
    await until(async () => (await options.nth(k).locator("svg line").count()) > 3, `robot ${k} is drawn`);
  }
  // A joint each, and the hand.
  for (const [words, name] of [["scara generic", "scara"], ["emika panda", "franka-panda"]]) {
    await page.getByRole("combobox", { name: /Search/ }).fill(words);
    const picture = options.first().locator("svg");
    await until(async () => (await picture.locator(".part-R, .part-P").count()) === robotOf(name).robot.joints.length, `${name} has its joints`);
    assert.equal(await picture.locator(".part-hand").count(), 1);
  }
  await page.getByRole("combobox", { name: /Search/ }).fill("");
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("ArrowDown");
  const at = Number((await page.getByRole("combobox", { name: /Search/ }).getAttribute("aria-activedescendant")).replace("listed-", ""));
  const [first, second] = [await options.nth(0).boundingBox(), await options.nth(at).boundingBox()];
  assert.ok(at > 2 && second.y > first.y && second.x > first.x, "right, then down");
  const title = (await options.nth(at).locator(".robot-title").textContent()).trim();
  await page.keyboard.press("Enter");
  await page.getByRole("heading", { level: 1, name: `Denavit: ${title}`, exact: true }).waitFor();
});
