// Formulas that somebody printed: right, wrong by a sign, and no formulas at all.
import assert from "node:assert/strict";
import { openRobot, scenario, until } from "./support.mjs";

const area = (page) => page.getByRole("textbox", { name: "Formulas to check" });
const claims = (page) => page.locator(".claim");

async function check(page, text) {
  await area(page).fill(text);
  await page.getByRole("button", { name: "Check", exact: true }).click();
  await page.locator(".progress-line strong").waitFor();
}

scenario("a right formula is proved, one with a wrong sign is found, with its slip", async (page) => {
  await openRobot(page, "staubli-rx90", { panel: "check" });
  // The hand of the RX-90 (Khalil and Dombre, 2.5); the second has + for −.
  await check(page, "P_x = C1*(C2*D3 - S23*RL4)\n\nP_y = S1*(C2*D3 + S23*RL4)\n");
  await page.getByText("2 claims: 1 wrong, 1 proved.").waitFor();
  const [right, wrong] = [claims(page).nth(0), claims(page).nth(1)];
  assert.match(await right.textContent(), /P_x.*proved equal/);
  assert.match(await wrong.textContent(), /P_y.*wrong/);
  // The slip, and the right formula: with minus where plus was printed.
  await wrong.getByText("The slip").waitFor();
  assert.match(await wrong.locator("del").first().textContent(), /\+/);
  assert.match(await wrong.locator("ins").first().textContent(), /[-−]/);
  const correct = await wrong.locator("div", { has: page.locator("dt", { hasText: "Right" }) }).locator("dd").first().textContent();
  assert.match(correct.replaceAll(" ", ""), /[-−].*(RL4.*S23|S23.*RL4)|(RL4.*S23|S23.*RL4).*[-−]/);

  // In the text both are marked, and the claim leads there.
  assert.equal(await page.locator(".mirror mark.at-equal").count(), 1);
  assert.match(await page.locator(".mirror mark.at-wrong").first().textContent(), /S1/);
  await wrong.getByRole("button", { name: /P_y/ }).click();
  const chosen = await area(page).evaluate((element) => element.value.slice(element.selectionStart, element.selectionEnd));
  assert.match(chosen, /S1\*\(C2\*D3 \+ S23\*RL4\)/);

  // Put right, by keys.
  await area(page).fill("P_y = S1*(C2*D3 - S23*RL4)");
  await page.getByText("The text has changed since.").waitFor();
  await page.keyboard.press("Control+Enter");
  await page.getByText("1 claim: 1 proved.").waitFor();
});

scenario("what is no formula gets words, and the next text is read as if nothing had been", async (page) => {
  await openRobot(page, "staubli-rx90", { panel: "check" });
  await check(page, "P_x = C1*(C2*D3 - ");
  await until(async () => (await page.locator(".claim-unreadable").count()) === 1, "the broken formula is told");
  assert.match(await page.locator(".claim-unreadable").textContent(), /P_x.*cannot be read.*line 1.*Error\s*1:\d+ \w{3}/s);
  await check(page, "There is nothing about the robot in here.");
  await page.getByText("No claim about the robot was found in this text.").waitFor();
  await check(page, `${"P_x = C1*(C2*D3 - S23*RL4)\n\n".repeat(40)}P_z = ((((((`);
  await until(async () => (await claims(page).count()) >= 40, "all claims are told");
  await check(page, "P_z = S2*D3 + C23*RL4");
  await page.getByText("1 claim: 1 proved.").waitFor();
});

scenario("the example has a slip in it, which is found", async (page) => {
  await openRobot(page, "puma560", { panel: "check" });
  await page.getByRole("button", { name: "Example" }).click();
  await page.locator(".claim-wrong").first().waitFor();
  assert.match(await page.locator(".progress-line strong").textContent(), /1 wrong/);
});
