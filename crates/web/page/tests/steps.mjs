// From frame to frame: the steps of a row one after another, both ways, and the matrix that they fill in.
import assert from "node:assert/strict";
import { differing, pictureOf } from "./pixels.mjs";
import { close, openRobot, read, scenario, until } from "./support.mjs";

const part = (page) => page.getByRole("region", { name: "From frame to frame" });
const key = (page, name) => part(page).getByRole("button", { name, exact: true });
const heading = (page, words) => part(page).getByRole("heading", { name: words, exact: true }).waitFor();
const product = async (page) => (await part(page).locator(".steps-product").textContent()).replaceAll(/\s/g, "");

/** The entries of the matrix, row by row. */
async function entries(page) {
  const rows = await part(page).locator(".steps-matrix tr").all();
  return Promise.all(rows.map((row) => row.locator("td").allTextContents()));
}

/** The inverse of a rigid motion, times another. */
function between(a, b) {
  const inner = (r, c) => [0, 1, 2].reduce((sum, k) => sum + a[k][r] * (b[k][c] - (c === 3 ? a[k][3] : 0)), 0);
  return [0, 1, 2].map((r) => [0, 1, 2, 3].map((c) => inner(r, c)));
}

/** Arms in the three conventions, the order of their steps, and the matrix of a row as the books print it: Spong, Hutchinson
 *  and Vidyasagar, (3.10); Craig, (3.6); Khalil and Dombre, (3.2). */
const CONVENTIONS = [
  ["puma560", "Rz(θ)·Tz(d)·Tx(a)·Rx(α)", ["cθ", "−sθ cα", "sθ sα", "a cθ"], ["sθ", "cθ cα", "−cθ sα", "a sθ"], ["0", "sα", "cα", "d"]],
  ["puma560-craig", "Rx(α)·Tx(a)·Rz(θ)·Tz(d)", ["cθ", "−sθ", "0", "a"], ["cα sθ", "cα cθ", "−sα", "−d sα"], ["sα sθ", "sα cθ", "cα", "d cα"]],
  ["staubli-rx90", "Rx(α)·Tx(d)·Rz(θ)·Tz(r)", ["cθ", "−sθ", "0", "d"], ["cα sθ", "cα cθ", "−sα", "−r sα"], ["sα sθ", "sα cθ", "cα", "r cα"]],
];

scenario("the steps of each row in the order of its convention end at the next frame", async (page) => {
  for (const [name, order, ...printed] of CONVENTIONS) {
    const { engine, robot } = await openRobot(page, name, { panel: "table", q: [0.4, -0.7, 1.1, 0.3, -0.5, 0.9] });
    await page.getByText("The frame goes from one to the next").waitFor();
    const { frames, rows } = engine.call("scene", { q: [0.4, -0.7, 1.1, 0.3, -0.5, 0.9] });
    for (let row = 0; row < robot.rows; row++) {
      for (let k = 1; k <= rows[row].length; k++) {
        await key(page, "A step forward").click();
        await part(page).getByText(new RegExp(`^Step ${k}: (turned|moved) (about|along) ${rows[row][k - 1].axis}`)).waitFor();
        await heading(page, `From frame ${row} to frame ${row + 1}`);
      }
      if (row === 0) {
        await part(page).getByRole("radio", { name: "Letters" }).check({ force: true });
        assert.equal(await product(page), order);
        assert.deepEqual((await entries(page)).slice(0, 3), printed, `${name} in letters`);
        await part(page).getByRole("radio", { name: "Numbers" }).check({ force: true });
      }
      const shown = (await entries(page)).slice(0, 3).map((line) => line.map(read));
      const right = between(frames[row], frames[row + 1]);
      right.forEach((line, r) => line.forEach((x, c) => close(shown[r][c], c < 3 ? x : 1000 * x, c < 3 ? 6e-5 : 6e-3, `${name}, row ${row + 1}, entry ${r} ${c}:`)));
    }
    assert.equal(await key(page, "A step forward").getAttribute("aria-disabled"), "true", "there is no frame behind the last");
  }
});

scenario("a step back goes into the row before, and each step is seen", async (page) => {
  await openRobot(page, "puma560", { panel: "table", selected: 1 });
  await key(page, "A step forward").click();
  await part(page).getByText(/^Step 1: turned about z1 by θ = q2 = 60°/).waitFor();
  assert.deepEqual(await entries(page), [["cθ", "−sθ", "0", "0"], ["sθ", "cθ", "0", "0"], ["0", "0", "1", "0"], ["0", "0", "0", "1"]]);
  const first = await pictureOf(page);
  // d2 is nothing; a2 moves the frame.
  await key(page, "A step forward").click();
  await key(page, "A step forward").click();
  await part(page).getByText(/^Step 3: moved along x2 by a = a2 = 431.8 mm/).waitFor();
  assert.ok(differing(first, await pictureOf(page)) > 0.002, "the frame has moved");
  for (const words of [/^Step 2: .*which is nothing/, /^Step 1/, /^At frame 1\./]) {
    await key(page, "A step back").click();
    await part(page).getByText(words).waitFor();
  }
  await key(page, "A step back").click();
  await heading(page, "From frame 0 to frame 1");
  await part(page).getByText(/^Step 3: /).waitFor();
  // The slider, too, by keys.
  await part(page).getByRole("slider", { name: "Steps that are done" }).focus();
  await page.keyboard.press("End");
  await part(page).getByText(/^Step 4: .*The frame is frame 1\.$/).waitFor();
  await page.getByRole("button", { name: "Row: show no longer" }).click();
  await page.getByText("The frame goes from one to the next").waitFor();
});

scenario("the steps play through all rows, and back", async (page) => {
  await openRobot(page, "planar-2r", { panel: "table" });
  await key(page, "Play the steps").click();
  await part(page).getByText(/^Step 3: .* by a = /).waitFor();
  await heading(page, "From frame 0 to frame 1");
  await key(page, "Pause the steps").click();
  const before = await entries(page);
  await page.waitForTimeout(1500);
  assert.deepEqual(await entries(page), before, "it stands still");
  await key(page, "Play the steps").click();
  await part(page).getByText(/^Step 4: .*The frame is frame 2\.$/).waitFor();
  await until(async () => (await key(page, "Play the steps").count()) === 1, "it has stopped at the end");
  await key(page, "Play the steps backwards").click();
  await part(page).getByText("At frame 0.").waitFor();
  await heading(page, "From frame 0 to frame 1");
  assert.deepEqual((await entries(page))[0], ["1", "0", "0", "0"]);
});
