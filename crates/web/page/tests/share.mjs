// Links: what one page shows another shows, and an address that somebody broke does no harm.
import assert from "node:assert/strict";
import { apart, handAt, robotOf } from "./engine.mjs";
import { differing, pictureOf } from "./pixels.mjs";
import { address, close, decode, encode, enter, farthest, open, openRobot, radians, ready, saysInStatus, scenario, shared, tab, until, valueOf } from "./support.mjs";

const clipboard = { permissions: ["clipboard-read", "clipboard-write"] };

scenario("a copied link opens the same robot, joints, target and panel elsewhere", clipboard, async (page, context) => {
  const { engine, robot } = await openRobot(page, "puma560", { panel: "hand" });
  const x = handAt(engine, robot.q)[0][3] - 0.03;
  await enter(page.getByRole("textbox", { name: "Position x" }), `${x} m`);
  await page.getByRole("button", { name: /Lengths in millimetres/ }).click();
  await page.getByRole("button", { name: "Look from the right" }).click();
  await tab(page, "Table").click();
  await page.getByRole("textbox", { name: "Name of the robot", exact: true }).fill("Ours <b>&amp;");
  const before = await shared(page, (s) => s.file.name.startsWith("Ours") && Math.abs(s.target?.[0][3] - x) < 1e-9, "the address is up to date");
  await tab(page, "Share").click();
  await page.getByRole("button", { name: "Copy link" }).click();
  await saysInStatus(page, /link is copied/);
  const link = await page.evaluate(() => navigator.clipboard.readText());
  assert.ok(link.length < 8000, `${link.length} characters`);
  const sent = decode(new URL(link).hash);
  assert.ok(apart(sent.target, before.target) < 1e-12);

  const other = await context.newPage();
  await other.goto(link);
  await ready(other);
  await other.getByRole("heading", { level: 1, name: "Denavit: Ours <b>&amp;", exact: true }).waitFor();
  assert.equal(await tab(other, "Share").getAttribute("aria-selected"), "true");
  await tab(other, "Hand").click();
  const again = await shared(other, (s) => s.panel === "hand", "the other page has an address");
  assert.ok(farthest(again.q, sent.q, Array(6).fill("R")) < 1e-9, "the same joints");
  assert.ok(apart(again.target, sent.target) < 1e-9, "the same target");
  assert.equal(again.look.lengths, "m");
  close(await valueOf(other.getByRole("textbox", { name: "Position x" })), x, 6e-6);
  assert.ok(farthest(again.camera, sent.camera) < 2e-3, "the same view");
  await tab(page, "Hand").click();
  await page.bringToFront();
  const here = await pictureOf(page);
  await other.bringToFront();
  assert.ok(differing(here, await pictureOf(other)) < 0.01, "the same picture");
});

scenario("every change is in the address, and the address can be gone back from", async (page) => {
  const { file } = await openRobot(page, "scara");
  await enter(page.getByRole("textbox", { name: /^q1\b/ }), "33");
  const s = await shared(page, (one) => Math.abs(one.q[0] - radians(33)) < 1e-9, "the joint is in the address");
  assert.deepEqual(s.file, file, "the table is as it was");
  const entries = await page.evaluate(() => history.length);
  await enter(page.getByRole("textbox", { name: /^q1\b/ }), "34");
  await shared(page, (one) => Math.abs(one.q[0] - radians(34)) < 1e-9, "the next one, too");
  assert.equal(await page.evaluate(() => history.length), entries, "without a step in the history");
  // Another address in the same page.
  await page.evaluate((hash) => (location.hash = hash), encode({ file, q: [0.5, 0.25, 0.1, 0], panel: "joints" }));
  await until(async () => Math.abs((await valueOf(page.getByRole("textbox", { name: /^q2\b/ }))) - 14.32) < 0.01, "the page follows its address");
});

scenario("a link keeps masses and drives", async (page) => {
  const row = { theta: "q1", mass: "2", first_moment: ["1", "0", "0"], inertia_at_origin: ["1", "0", "0", "2", "0", "2"], rotor: "0.1", viscous: "1", coulomb: "2" };
  const file = { name: "x", convention: "craig", parameters: [], joints: [row], poses: [] };
  await open(page, encode({ file, q: [0.5], panel: "joints" }));
  await enter(page.getByRole("textbox", { name: /^q1\b/ }), "33");
  const s = await shared(page, (one) => Math.abs(one.q[0] - radians(33)) < 1e-9, "the joint is in the address");
  assert.deepEqual(s.file.joints, [row]);
});

const good = encode({ file: { name: "x", convention: "standard", parameters: [], joints: [{ theta: "q1", a: "1" }], poses: [] } });
const HOSTILE = [
  ["garbage", "#%%%%not-an-address", /carries no robot/],
  ["a wrong alphabet", "#1.!!!!", /damaged/],
  ["a truncated one", good.slice(0, good.length / 2), /damaged/],
  ["another version", good.replace("#1.", "#7."), /another version/],
  ["a huge one", `#1.${"A".repeat(300_000)}`, /damaged/],
  ["a bomb", encode({ file: "0".repeat(30_000_000) }), /damaged/],
  ["another kind of thing", encode([1, 2, 3]), /no robot/],
  ["a table of nonsense", encode({ file: { name: "x", convention: "craig", parameters: [], joints: "none", poses: [] } }), /no robot/],
  ["too many rows", encode({ file: { name: "x", convention: "craig", parameters: [], joints: Array(5000).fill({ theta: "q1" }), poses: [] } }), /no robot/],
];

scenario("hostile addresses get words, and the page works", async (page, context) => {
  await page.close();
  for (const [name, fragment, words] of HOSTILE) {
    const other = await context.newPage();
    await other.goto(address(fragment));
    await ready(other);
    await saysInStatus(other, words);
    await other.getByRole("heading", { level: 1, name: /^Denavit: \S/ }).waitFor();
    const slider = other.getByRole("tabpanel").getByRole("slider").first();
    const before = await slider.inputValue();
    await slider.press("ArrowRight");
    await until(async () => (await slider.inputValue()) !== before, `after ${name} the page works`);
    await other.close();
  }
});

scenario("what an address says is text, not markup, and what does not fit is left out", async (page) => {
  const { file, robot } = robotOf("scara");
  const evil = '<img src=x onerror="document.title=\'taken\'">';
  const poses = [{ name: evil, values: ["0", "0", "0", "0"] }];
  const wild = { file: { ...file, name: evil, source: evil, poses }, q: [1, 2], target: [[1, 2], [3]], camera: [0, 0, -1, "x", 0, 0], look: { angles: "furlongs" }, panel: "__proto__", selected: 1e9 };
  await open(page, encode(wild));
  assert.equal(await page.locator("img").count(), 0);
  await page.getByRole("button", { name: evil, exact: true }).waitFor();
  await until(async () => (await page.title()) === `${evil} – Denavit`, "the name is shown as it is");
  close(await valueOf(page.getByRole("textbox", { name: /^q1\b/ })), (robot.q[0] * 180) / Math.PI, 0.006, "the first configuration where the other does not fit");
  for (const name of ["Table", "Hand", "Formulas", "Share"]) await tab(page, name).click();
  assert.equal(await page.locator("img[src=x]").count(), 0);
});
