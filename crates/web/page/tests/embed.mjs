// The page in another page: parts of it, without bars and tabs, for the robot, panel and row that the address asks for.
import assert from "node:assert/strict";
import { address, decode, encode, scenario, until } from "./support.mjs";

const drawn = (page) => until(() => page.evaluate(() => window.denavit?.frames > 0), "the arm is drawn");

async function openAs(page, query) {
  await page.goto(`${address()}?${query}`);
  await drawn(page);
}

scenario("scene and panel of a row that is explained, and the way to the whole page", async (page, surroundings) => {
  await openAs(page, "embed&robot=scara&panel=table&row=2&theme=dark");
  await page.locator(".scene-row-title", { hasText: "Row 2" }).waitFor();
  assert.equal(await page.getByRole("textbox", { name: "Row 2, a", exact: true }).inputValue(), "a2");
  assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), "dark");
  for (const gone of [page.getByRole("banner"), page.getByRole("tablist", { name: "Panels" }), page.getByRole("button", { name: /choose another robot/ }), page.getByRole("separator")]) {
    assert.equal(await gone.count(), 0);
  }
  // The steps can be played, and what is edited moves the arm.
  await page.getByRole("region", { name: "From frame to frame" }).getByRole("button", { name: "A step forward" }).click();
  await page.getByText(/^Step 1: turned about z1/).waitFor();
  await page.getByRole("textbox", { name: "Value of a1" }).fill("500");
  await page.getByRole("textbox", { name: "Value of a1" }).press("Enter");
  assert.equal(await page.evaluate(() => location.hash), "", "the address of a frame stays");
  assert.equal(await page.evaluate(() => localStorage.length), 0, "nothing is kept for the page of somebody else");
  const [whole] = await Promise.all([surroundings.waitForEvent("page"), page.getByRole("button", { name: "SCARA (generic) in Denavit" }).click()]);
  await whole.getByRole("button", { name: /choose another robot/ }).waitFor();
  assert.equal(new URL(whole.url()).search, "");
  assert.equal(decode(new URL(whole.url()).hash).file.parameters[0].value, "500 mm", "with all that was shown");
});

scenario("the scene alone, a panel alone, a shared state", async (page) => {
  await openAs(page, "embed=scene&robot=ur5&row=1");
  assert.equal(await page.locator(".panel").count(), 0);
  const [scene, window_] = [await page.locator("canvas.scene-canvas").boundingBox(), page.viewportSize()];
  assert.ok(scene.width === window_.width && scene.height > window_.height - 50, "it fills the frame");
  await page.locator(".scene-row").getByRole("button", { name: "A step forward" }).click();
  await until(async () => (await page.locator(".scene-row-now").count()) === 1, "a step is made in the scene");

  await page.goto(`${address()}?embed=panel&robot=planar-2r&panel=formulas&topic=inverse`);
  await page.locator(".document math").first().waitFor();
  assert.equal(await page.getByRole("tab", { name: "Inverse", exact: true }).getAttribute("aria-selected"), "true");
  assert.equal(await page.locator("canvas").count(), 0);

  const file = { name: "One link", convention: "craig", parameters: [], joints: [{ theta: "q1", a: "0.5 m" }], poses: [] };
  await openAs(page, `embed&panel=joints${encode({ file, q: [0.5] })}`);
  await page.getByRole("button", { name: "One link in Denavit" }).waitFor();
  await page.getByRole("slider", { name: /^q1/ }).waitFor();
});

scenario("what an address asks for and is not there is passed over", async (page) => {
  await openAs(page, "embed=<script>&robot=../../x&panel=nowhere&row=99&topic=all&theme=pink");
  await page.getByRole("button", { name: "Stäubli RX-90 in Denavit" }).waitFor();
  assert.equal(await page.getByRole("banner").count(), 0);
  await openAs(page, "robot=no-such-robot");
  await page.getByText(/^No robot no-such-robot in the catalogue/).waitFor();
  await page.getByRole("button", { name: /Stäubli RX-90: choose another robot/ }).waitFor();
});
