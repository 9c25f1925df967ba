// A derivation step by step: one formula after another, with what each is about in the picture.
import assert from "node:assert/strict";
import { differing, pictureOf } from "./pixels.mjs";
import { close, openRobot, scenario, until } from "./support.mjs";

const walk = (page) => page.getByRole("group", { name: "Step by step" });
const press = (page, name) => page.getByRole("button", { name, exact: true }).click();

async function begin(page, topic) {
  await page.getByRole("tablist", { name: "Topics" }).getByRole("tab", { name: topic, exact: true }).click();
  await page.locator("#topic-panel .document:not(.dimmed) math").first().waitFor();
  await press(page, "Step by step");
  await walk(page).waitFor();
}

/** How many formulas there are, and which is shown, from 1. */
async function place(page) {
  const [, at, count] = /(\d+) of (\d+)/.exec(await walk(page).textContent());
  return { at: Number(at), count: Number(count) };
}

scenario("link transforms one after another, each with its row in the picture", async (page) => {
  const { robot } = await openRobot(page, "puma560", { panel: "formulas" });
  await begin(page, "Links");
  const { count } = await place(page);
  assert.equal(count, 1 + robot.rows, "the general one, and one a row");
  const lines = page.locator("#topic-panel .formula-line");
  for (let row = 1; row <= robot.rows; row++) {
    await press(page, "Next");
    await walk(page).getByText(`Row ${row}: from frame ${row - 1} to frame ${row}.`).waitFor();
    await page.locator(".scene-row-title", { hasText: `Row ${row}` }).waitFor();
    const isSeen = () => lines.evaluateAll((all) => all.map((line) => getComputedStyle(line).visibility === "visible"));
    await until(async () => (await isSeen()).every((seen, k) => seen === k <= row), "what comes behind is not to be seen yet");
  }
  assert.equal(await page.getByRole("button", { name: "Next", exact: true }).getAttribute("aria-disabled"), "true");
  await press(page, "Back");
  await page.locator(".scene-row-title", { hasText: `Row ${robot.rows - 1}` }).waitFor();
  await press(page, "Show all");
  await until(async () => (await page.locator(".scene-row").count()) === 0, "no row is marked in the picture");
  await until(async () => (await page.locator(".walk-ahead").count()) === 0, "all is seen again");
});

/** The number that a sentence says to be drawn, out of the engine's frames. */
function drawn(words, { frames, rows }) {
  const [, axis, frame, of] = /is the ([xyz]) (?:coordinate|component), in frame (\d+), of the last frame’s (origin|[xyz] axis)/.exec(words) ?? [];
  if (!axis) return null;
  const [first, last] = [frames[Number(frame)], frames[rows.length]];
  const along = first.map((row) => row["xyz".indexOf(axis)]);
  const way = of === "origin" ? [0, 1, 2].map((r) => last[r][3] - first[r][3]) : [0, 1, 2].map((r) => last[r]["xyz".indexOf(of[0])]);
  return way.reduce((sum, x, r) => sum + x * along[r], 0);
}

for (const topic of ["Forward model", "Algorithm"]) {
  scenario(`what a name is said to be in the picture is what its formula gives: ${topic}`, async (page) => {
    const q = [0.4, -0.7, 1.1, 0.3, -0.5, 0.9];
    const { engine } = await openRobot(page, "staubli-rx90", { panel: "formulas", q });
    const scene = engine.call("scene", { q });
    const { values } = engine.call("values", { topic: topic === "Algorithm" ? "algorithm" : "forward", q });
    await begin(page, topic);
    // The numbers beside the formulas are there.
    await until(async () => (await page.locator(".formula-value").first().textContent()).trim() !== "", "numbers");
    const { count } = await place(page);
    let told = 0;
    const before = await pictureOf(page);
    for (let k = 1; k < count; k++) {
      await press(page, "Next");
      await until(async () => (await place(page)).at === k + 1, `formula ${k + 1}`);
      // The formula and its words come at once.
      const [name, words] = await page.evaluate(() => [document.querySelector(".walk-now .formula-box").ariaLabel, document.querySelector(".walking [role=status]").textContent]);
      const [, said] = /^(\S+) is the/.exec(words) ?? [];
      const number = drawn(words, scene);
      if (number === null) continue;
      close(number, values[said], 1e-9, `${name}: ${words}`);
      told += 1;
    }
    assert.ok(told >= 9, `${told} names are drawn`);
    assert.ok(differing(before, await pictureOf(page)) > 0.002, "in the picture, too");
  });
}

scenario("an inverse derivation goes on and back, and another topic begins without it", async (page) => {
  await openRobot(page, "planar-2r", { panel: "formulas" });
  await begin(page, "Inverse");
  const { count } = await place(page);
  assert.ok(count > 4, `${count} formulas`);
  for (let k = 0; k < count - 1; k++) await press(page, "Next");
  await until(async () => (await place(page)).at === count, "at the end");
  await press(page, "Back");
  await until(async () => (await place(page)).at === count - 1, "one back");
  await page.getByRole("tablist", { name: "Topics" }).getByRole("tab", { name: "Jacobian", exact: true }).click();
  await walk(page).waitFor({ state: "detached" });
  await until(async () => (await page.locator(".walk-ahead").count()) === 0, "nothing is ahead");
});
