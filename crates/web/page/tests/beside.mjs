// Several arms side by side.
import assert from "node:assert/strict";
import { robotOf } from "./engine.mjs";
import { differing, pictureOf } from "./pixels.mjs";
import { openRobot, saysInStatus, scenario, until } from "./support.mjs";

async function stand(page, words) {
  await page.keyboard.press("Control+k");
  await page.getByRole("combobox", { name: /Search/ }).fill(words);
  await page.getByRole("button", { name: "Stand it beside the arm" }).click();
  await page.getByRole("dialog").waitFor({ state: "detached" });
}

scenario("arms of the catalogue stand beside the arm, and those of its kind move along", async (page) => {
  const { robot } = await openRobot(page, "ur5");
  const alone = await pictureOf(page);
  await stand(page, "ur10e standard");
  const { robot: other } = robotOf("ur10e");
  await page.getByText(`${other.robot}: reaches ${(1000 * other.reach).toFixed(0)} mm, moves along`).waitFor();
  const two = await pictureOf(page);
  assert.ok(differing(alone, two) > 0.03, "there are two");
  // All of the first is still seen, in less room.
  const { width, height } = await page.locator("canvas.scene-canvas").boundingBox();
  for (const [x, y] of await page.evaluate(() => window.denavit.joints())) assert.ok(x > 0 && x < width && y > 0 && y < height);

  // The last joint of one arm is not to be seen at its first: what moves beside is the other's.
  await stand(page, "scara generic");
  await page.getByText(/^SCARA \(generic\): reaches \d+ mm$/).waitFor();
  const three = await pictureOf(page);
  const field = page.getByRole("textbox", { name: /^q1\b/ });
  await field.fill("90");
  await field.press("Enter");
  await field.blur();
  assert.ok(differing(three, await pictureOf(page)) > 0.03, "they move");
  await stand(page, "puma 560 standard");
  await page.keyboard.press("Control+k");
  await page.getByRole("button", { name: "Stand it beside the arm" }).click();
  await saysInStatus(page, /There is room for 3 arms/);
  await page.keyboard.press("Escape");

  for (const name of [other.robot, "SCARA (generic)", /Puma 560/]) await page.getByRole("button", { name: typeof name === "string" ? `Take ${name} away` : /^Take .*Puma 560.* away$/ }).click();
  await page.getByRole("button", { name: "Reset" }).click();
  await page.locator("canvas.scene-canvas").focus();
  await page.keyboard.press("f");
  await page.locator("canvas.scene-canvas").blur();
  await until(async () => differing(alone, await pictureOf(page)) < 0.01, `${robot.robot} stands alone again`);
});
