// Formulas: every topic in MathML, copied as text, their symbols tied to the joints, their numbers to the arm.
import assert from "node:assert/strict";
import { handAt } from "./engine.mjs";
import { differing, pictureOf } from "./pixels.mjs";
import { close, enter, openRobot, read, scenario, shared, tab, until } from "./support.mjs";

const clipboard = { permissions: ["clipboard-read", "clipboard-write"] };
const topic = (page, name) => page.getByRole("tablist", { name: "Topics" }).getByRole("tab", { name, exact: true });
const panel = (page) => page.locator("#topic-panel");

async function choose(page, name) {
  await topic(page, name).click();
  const document_ = panel(page).locator(".document:not(.dimmed)");
  await until(async () => (await panel(page).getAttribute("aria-busy")) === "false" && (await document_.count()) === 1, `${name} is derived`);
  return document_;
}

/** Copies a formula from its menu, and reads the clipboard. */
async function copied(page, button, format) {
  await page.getByRole("button", { name: button, exact: true }).click();
  await page.getByRole("menu", { name: "Copy as" }).getByRole("menuitem", { name: format, exact: true }).click();
  await until(async () => (await page.locator("footer [role=status]").textContent()).includes(`copied as ${format}`), `it is copied as ${format}`);
  return page.evaluate(() => navigator.clipboard.readText());
}

scenario("each topic is derived and shown in MathML with words", async (page) => {
  await openRobot(page, "staubli-rx90", { panel: "formulas" });
  const seen = new Set();
  for (const name of ["DH table", "Links", "Forward model", "Algorithm", "Inverse", "Jacobian", "Singularities"]) {
    const shown = await choose(page, name);
    const count = await shown.locator("math").count();
    assert.ok(count >= 1, `${name}: ${count} formulas`);
    assert.equal(await shown.locator("math:not([alttext])").count(), 0, `${name}: each formula has words`);
    const heights = await shown.locator("math").evaluateAll((all) => all.map((math) => math.getBoundingClientRect().height));
    assert.ok(heights.every((height) => height > 4), `${name}: each formula has a height`);
    seen.add(await shown.textContent());
  }
  assert.equal(seen.size, 7, "no topic shows another's formulas");
  const shown = await choose(page, "Inverse");
  assert.ok((await shown.locator(".tree li").count()) > 8, "the tree of solutions");
  // Known again: at once.
  await topic(page, "Forward model").click();
  await page.getByRole("group", { name: "t11", exact: true }).waitFor({ timeout: 3000 });
  assert.ok(await page.evaluate(() => document.fonts.check('16px "Denavit Maths"')), "the font of formulas is there");
});

scenario("the forward model is copied as LaTeX and Python, and as Python it is the hand's pose", clipboard, async (page) => {
  const q = [0.3, 0.9, -0.4, 1.1, 0.7, -0.2];
  const { engine } = await openRobot(page, "staubli-rx90", { panel: "formulas", q });
  await choose(page, "Forward model");
  const latex = await copied(page, "Copy t11", "LaTeX");
  assert.match(latex, /^t_\{11\} = C_\{1\}/);
  assert.ok(latex.includes("S_{23}") && latex.includes("C_{23}"), latex);
  assert.match(await copied(page, "Copy t14", "Typst"), /^t_14 = C_1/);
  assert.match(await copied(page, "Copy t14", "C"), /^t14 = .*sin\(q2 \+ q3\).*;$/);

  const all = await page.getByRole("button", { name: /^Copy all \d+ equations$/ }).getAttribute("aria-label");
  const python = await copied(page, all, "Python");
  const names = ["q1", "q2", "q3", "q4", "q5", "q6", "D3", "RL4"];
  const lines = python.split("\n").filter(Boolean);
  const body = lines.map((line) => `out.${line}`).join("\n").replaceAll("np.", "Math.");
  const entries = new Function("out", ...names, `${body}\nreturn out;`)({}, ...q, 0.45, 0.45);
  const hand = handAt(engine, q);
  for (const r of [0, 1, 2]) for (const c of [0, 1, 2, 3]) close(entries[`t${r + 1}${c + 1}`], hand[r][c], 1e-12, `t${r + 1}${c + 1}`);

  // With the keys: Enter opens the menu, the arrows choose, Escape leaves.
  await page.getByRole("group", { name: "t24", exact: true }).focus();
  await page.keyboard.press("Enter");
  await page.getByRole("menu", { name: "Copy as" }).waitFor();
  await page.keyboard.press("Home");
  await page.keyboard.press("Enter");
  await until(async () => /^t_\{24\}/.test(await page.evaluate(() => navigator.clipboard.readText())), "t24 is copied by keys");
});

scenario("a symbol under the pointer lights its joints, and a joint its symbols", async (page) => {
  await openRobot(page, "staubli-rx90", { panel: "formulas" });
  const shown = await choose(page, "Forward model");
  const lit = () => shown.locator(".joint-symbol.lit").evaluateAll((all) => [...new Set(all.map((one) => one.textContent.replace(/\s/g, "")))].sort());
  await page.mouse.move(2, 2);
  assert.deepEqual(await lit(), []);
  const dark = await pictureOf(page);
  await shown.locator(".joint-symbol", { hasText: /^C23$/ }).first().hover();
  await until(async () => (await lit()).includes("C23"), "C23 is lit");
  // All that is about joint 2 or 3, and nothing else; t11 to t34 are about more.
  for (const name of await lit()) assert.match(name, /[23]|^t|D|RL/, `${name} is lit`);
  assert.ok(!(await lit()).some((name) => /^[CS][1456]$/.test(name)), "no other joint is lit");
  assert.ok((await lit()).includes("C2") && (await lit()).includes("S23"));
  assert.ok(differing(dark, await pictureOf(page)) > 0.0005, "the scene shows the joints");
  await page.mouse.move(2, 2);
  await until(async () => (await lit()).length === 0, "nothing is lit");

  // The reverse: the pointer on the second joint.
  const box = await page.locator("canvas.scene-canvas").boundingBox();
  const [x, y] = (await page.evaluate(() => window.denavit.joints()))[1];
  await page.mouse.move(box.x + x, box.y + y);
  await until(async () => (await lit()).includes("C23"), "the pointer on the arm lights symbols");
  const names = (await lit()).filter((name) => /^[CS]\d+$/.test(name));
  assert.deepEqual(names, ["C2", "C23", "S2", "S23"]);
});

scenario("the numbers beside the intermediates follow the arm", async (page) => {
  const q = [0.2, 1, -0.3, 0.4, 0.8, 0.1];
  const { engine } = await openRobot(page, "staubli-rx90", { panel: "formulas", q });
  await choose(page, "Algorithm");
  const number = async (name) => {
    const line = page.locator(".formula-line").filter({ has: page.getByRole("group", { name, exact: true }) });
    const text = await line.locator(".formula-value").textContent();
    return text.includes("now") ? read(text.replace("now ", "")) : Number.NaN;
  };
  // The address follows the arm a moment later, as the numbers do: both are asked until they agree.
  const follows = (name, wanted, isWanted = () => true) =>
    until(async () => {
      const { q: now } = await shared(page, isWanted, "the arm is where it is wanted");
      return Math.abs((await number(name)) - wanted(now)) < 2e-3 && now;
    }, async () => `${name} follows the arm; it is ${await number(name)}`);
  // p1x = RL4 S23 − D3 C2, by hand.
  const p1x = (at) => 0.45 * Math.sin(at[1] + at[2]) - 0.45 * Math.cos(at[1]);
  await follows("p1x", p1x);
  await follows("t24", (at) => handAt(engine, at)[1][3]);
  await page.locator("canvas.scene-canvas").focus();
  const [x, y] = (await page.evaluate(() => window.denavit.handles()))["axis x"];
  const box = await page.locator("canvas.scene-canvas").boundingBox();
  await page.mouse.move(box.x + x, box.y + y);
  await page.mouse.down();
  await page.mouse.move(box.x + x, box.y + y + 40, { steps: 6 });
  await page.mouse.up();
  const isDragged = (s) => Math.abs(p1x(s.q) - p1x(q)) > 5e-3;
  await follows("p1x", p1x, isDragged);
  await follows("t34", (at) => handAt(engine, at)[2][3], isDragged);
});

scenario("a long derivation is cancelled, and derived again", async (page) => {
  await openRobot(page, "oblique-6r", { panel: "formulas" });
  await choose(page, "DH table");
  await topic(page, "Singularities").click();
  await page.getByText("Looking for the singularities").waitFor();
  // At once, not when the button has settled: the derivation may be over before.
  await page.getByRole("button", { name: "Cancel", exact: true }).dispatchEvent("click");
  await page.getByText("Not derived.").waitFor();
  assert.equal(await panel(page).locator("math").count(), 0, "nothing of another topic is shown");
  // The page is as it was: joints move, other topics come.
  await tab(page, "Joints").click();
  await enter(page.getByRole("textbox", { name: /^q1\b/ }), "30");
  await tab(page, "Formulas").click();
  await choose(page, "Links");
  const shown = await choose(page, "Singularities");
  assert.ok((await shown.locator("math").count()) > 0);
});

scenario("formulas that are a little too wide are set smaller, and scroll only where they are much too wide", async (page) => {
  await openRobot(page, "staubli-rx90", { panel: "formulas" });
  let shown = await choose(page, "Jacobian");
  await page.evaluate(() => document.fonts.load('16px "Denavit Maths"').then(() => document.fonts.ready));
  const sizes = () => shown.locator(".formula-box").evaluateAll((all) => all.map((box) => {
    const math = box.querySelector("math");
    const own = parseFloat(getComputedStyle(math).fontSize);
    const kept = math.style.fontSize;
    math.style.fontSize = "";
    const usual = parseFloat(getComputedStyle(math).fontSize);
    math.style.fontSize = kept;
    return { share: own / usual, overflows: box.scrollWidth > box.clientWidth + 1 };
  }));
  const some = await sizes();
  assert.ok(some.some(({ share }) => share < 0.999), "the Jacobian is smaller");
  shown = await choose(page, "Forward model");
  const all = [...some, ...(await sizes())];
  for (const { share, overflows } of all) {
    assert.ok(share > 0.78 && share <= 1.0001, `${share} of the usual size`);
    if (overflows) assert.ok(share > 0.999, "what scrolls has its usual size");
  }
  // With more room all are as large as any.
  await choose(page, "Jacobian");
  await page.locator(".divider").focus();
  await page.keyboard.press("Home");
  await until(async () => (await sizes()).every(({ share, overflows }) => share > 0.999 && !overflows), "all have their usual size");
});
