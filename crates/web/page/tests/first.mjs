// What one sees first: a calm picture, the arm large and in the middle, words that do not overlap, a whole tool bar.
import assert from "node:assert/strict";
import { differing, pictureOf } from "./pixels.mjs";
import { NARROW, openRobot, scenario, shared, until, WIDE } from "./support.mjs";

const SIZES = [["wide", WIDE], ["upright", { width: 820, height: 1180 }], ["narrow", NARROW]];
/** Six joints and fewer, offset wrists, one that is folded, one on a rail, a redundant one, slides. */
const ARMS = ["staubli-rx90", "ur5", "puma560-craig", "scara", "franka-panda", "stanford", "cartesian-ppp", "planar-3r", "abb-irb140", "kuka-iiwa-7", "rail-puma", "prrrrp"];

for (const [size, viewport] of SIZES) {
  scenario(`twelve arms at first sight: large, in the middle, with words that do not overlap, ${size}`, { viewport }, async (page) => {
    for (const name of ARMS) {
      await openRobot(page, name);
      await pictureOf(page);
      const { joints, places, ghosts } = await page.evaluate(() => ({ joints: window.denavit.joints(), places: window.denavit.places, ghosts: window.denavit.ghosts }));
      const { width, height } = await page.locator("canvas.scene-canvas").boundingBox();
      assert.equal(ghosts, 0, `${name}: other solutions are shown when they are asked for`);
      const span = (of, whole) => {
        const [low, high] = [Math.min(...of), Math.max(...of)];
        assert.ok(low > 0 && high < whole, `${name}: all joints are in the picture`);
        return { share: (high - low) / whole, middle: (low + high) / 2 / whole };
      };
      const [across, upward] = [span(joints.map(([x]) => x), width), span(joints.map(([, y]) => y), height)];
      assert.ok(Math.max(across.share, upward.share) > 0.3, `${name}: the joints span ${across.share.toFixed(2)} × ${upward.share.toFixed(2)} of the picture`);
      assert.ok(Math.abs(across.middle - 0.5) < 0.3 && Math.abs(upward.middle - 0.5) < 0.3, `${name}: it is in the middle`);
      // Labels, and what stands over the picture.
      assert.ok(places.length > 4, `${name} has labels`);
      // Around the words are three pixels of the background's colour.
      const meet = (a, b) => a.x + 3.1 < b.x + b.width && b.x + 3.1 < a.x + a.width && a.y + 3.1 < b.y + b.height && b.y + 3.1 < a.y + a.height;
      const overlaps = places.flatMap((a, i) => places.slice(i + 1).filter((b) => meet(a, b)));
      assert.deepEqual(overlaps, [], name);
    }
  });
}

scenario("the first view is the one that fits", async (page) => {
  await openRobot(page, "ur5");
  const first = await pictureOf(page);
  await page.getByRole("button", { name: "Fit the arm into view (F)" }).click();
  await page.mouse.move(1100, 600);
  assert.ok(differing(first, await pictureOf(page)) < 0.002, "it has nothing to mend");
});

scenario("the card of a row and the arm stand side by side, unless somebody has chosen the view", async (page) => {
  await openRobot(page, "puma560", { panel: "table" });
  const { width } = await page.locator("canvas.scene-canvas").boundingBox();
  assert.ok(width > 700, "there is room for both");
  const first = await pictureOf(page);
  const row = page.getByRole("button", { name: /^Row 3, revolute/ });
  const leftmost = async () => Math.min(...(await page.evaluate(() => window.denavit.joints())).map(([x]) => x));
  await row.click();
  const card = await page.locator(".scene-row").boundingBox();
  const box = await page.locator("canvas.scene-canvas").boundingBox();
  await until(async () => box.x + (await leftmost()) > card.x + card.width, "all joints stand beside the card");
  await page.getByRole("button", { name: "Row: show no longer" }).click();
  await page.mouse.move(1100, 780);
  await until(async () => differing(first, await pictureOf(page)) < 0.01, "the view is as before");
  await page.locator("canvas.scene-canvas").focus();
  await page.keyboard.press("ArrowLeft");
  await pictureOf(page);
  const before = await leftmost();
  await row.click();
  await pictureOf(page);
  assert.equal(await leftmost(), before, "a view that was chosen stays");
});

scenario("other solutions are there when they are asked for", async (page) => {
  await openRobot(page, "staubli-rx90");
  await page.getByRole("button", { name: "Other solutions" }).click();
  await until(() => page.evaluate(() => window.denavit.ghosts === 7), "seven other solutions");
  await page.getByRole("button", { name: "Other solutions" }).click();
  await until(() => page.evaluate(() => window.denavit.ghosts === 0), "none");
});

scenario("an arm in a plane is seen at a right angle to it, and has the handles that it can follow", async (page) => {
  await openRobot(page, "planar-3r");
  const { camera } = await shared(page, (s) => s.camera, "there is a view").catch(() => ({}));
  const handles = async () => Object.keys(await page.evaluate(() => window.denavit.handles())).sort();
  assert.deepEqual(await handles(), ["axis x", "axis y", "plane z"]);
  await page.getByRole("button", { name: "Handles that turn the hand" }).click();
  await until(async () => (await handles()).join() === "ring z", "it turns about z alone");
  await page.locator("canvas.scene-canvas").focus();
  await page.keyboard.press("f");
  const s = await shared(page, (next) => next.camera, "there is a view");
  assert.ok(Math.abs((camera ?? s.camera)[1] - Math.PI / 2) < 1e-3, "from above");
  // One that slides out of the plane as well is seen from a corner.
  await openRobot(page, "scara");
  assert.equal((await handles()).join(), "ring z", "it turns about z alone");
  await page.getByRole("button", { name: "Handles that move the hand" }).click();
  await until(async () => (await handles()).length === 6, "it moves in space");
  await page.keyboard.press("f");
  const other = await shared(page, (next) => next.file.joints.length === 4 && next.camera, "there is a view");
  assert.ok(other.camera[1] < 1);
});

for (const width of [390, 360]) {
  scenario(`the tool bar is whole on a phone, ${width} pixels`, { viewport: { width, height: 740 }, hasTouch: true, isMobile: true }, async (page) => {
    await openRobot(page, "ur5");
    const scene = await page.locator("canvas.scene-canvas").boundingBox();
    for (const tool of await page.getByRole("toolbar", { name: "Scene" }).getByRole("button").all()) {
      const box = await tool.boundingBox();
      const name = await tool.getAttribute("aria-label");
      assert.ok(box.x >= 0 && box.x + box.width <= width && box.y + box.height <= scene.y + scene.height, `${name} is in the picture: ${JSON.stringify(box)}`);
      // WCAG 2.2, 2.5.8.
      assert.ok(box.width >= 24 && box.height >= 24, `${name} is large enough for a finger: ${JSON.stringify(box)}`);
    }
  });
}
