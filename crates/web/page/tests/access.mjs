// For everybody: axe-core in every panel, nothing wider than a phone, all by keys, nothing jumps while it loads.
import assert from "node:assert/strict";
import { mkdirSync, readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { NARROW, open, openRobot, saysInStatus, scenario, shared, tab, until, valueOf, WIDE } from "./support.mjs";

const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const SHOTS = process.env.SHOTS;
if (SHOTS) mkdirSync(SHOTS, { recursive: true });

/** Colours change over a tenth of a second: waits until all have. */
async function settled() {
  await new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)));
  const changes = document.getAnimations().filter((one) => one instanceof CSSTransition);
  await Promise.allSettled(changes.map((one) => one.finished));
}

/** Serious and critical findings, in words; in the dark only contrast can be another. */
async function findings(page, where) {
  const found = [];
  for (const [theme, options] of [["light", {}], ["dark", { runOnly: ["color-contrast"] }]]) {
    await page.emulateMedia({ colorScheme: theme });
    await page.locator(`html[data-theme=${theme}]`).waitFor({ state: "attached" });
    await page.evaluate(settled);
    if (SHOTS) await page.screenshot({ path: `${SHOTS}/${where.toLowerCase()}-${page.viewportSize().width}-${theme}.png` });
    const all = await page.evaluate(async (options_) => (await window.axe.run({ resultTypes: ["violations"], ...options_ })).violations, options);
    const serious = all.filter(({ impact }) => impact === "serious" || impact === "critical");
    found.push(...serious.map((v) => `${where}, ${theme}: ${v.id}: ${v.help} (${v.nodes.length} times, ${v.nodes[0].html.slice(0, 160)}; ${v.nodes[0].any?.[0]?.message ?? ""})`));
  }
  return [...found, ...(await page.evaluate(tooWide)).map((words) => `${where}: ${words}`)];
}

/** What runs off the page to the right, where there is nothing to scroll it with. */
function tooWide() {
  const root = document.documentElement;
  const found = root.scrollWidth > root.clientWidth ? [`the page is ${root.scrollWidth} px wide`] : [];
  const scrolls = (element) => element && (/auto|scroll|hidden|clip/.test(getComputedStyle(element).overflowX) || scrolls(element.parentElement));
  for (const element of document.querySelectorAll(".side *, .top *, .bottom *")) {
    const { right, width } = element.getBoundingClientRect();
    if (width > 0 && right > root.clientWidth + 1 && !scrolls(element.parentElement)) found.push(`${element.tagName}.${element.className} ends at ${Math.round(right)}`);
  }
  return found.slice(0, 5);
}

/** Fills the panels with what they can show. */
const PANELS = {
  Table: async (page) => {
    await page.getByRole("textbox", { name: "Row 2, theta", exact: true }).fill("q2 + apples");
    await page.locator(".cell-findings").first().waitFor();
  },
  Joints: async (page) => {
    await page.getByRole("region", { name: "Distance from singular configurations" }).getByRole("button", { name: "Velocity ellipsoid" }).click();
    await page.getByText(/^Half axes/).waitFor();
  },
  Hand: async (page) => {
    await until(async () => (await page.locator(".solution").count()) === 8, "there are eight solutions");
  },
  Formulas: async (page) => {
    await page.getByRole("tab", { name: "Inverse", exact: true }).click();
    await page.locator(".tree").waitFor();
  },
  Path: async (page) => {
    await tab(page, "Joints").click();
    await page.getByRole("slider", { name: /^q1\b/ }).press("Shift+ArrowRight");
    await tab(page, "Path").click();
    await page.getByRole("button", { name: "Add joints" }).click();
    await page.getByRole("button", { name: "Plan", exact: true }).click();
    await page.locator("figure.plot").first().waitFor();
  },
  Check: async (page) => {
    await page.getByRole("button", { name: "Example" }).click();
    await page.locator(".claim").first().waitFor();
  },
  Share: async (page) => {
    for (const summary of await page.locator(".panel summary").all()) {
      if (!(await summary.evaluate((element) => element.parentElement.open))) await summary.click();
    }
    await until(async () => (await page.getByRole("textbox", { name: /^Link/ }).inputValue()) !== "", "the link is made");
  },
};

for (const [size, viewport] of [["wide", WIDE], ["narrow", NARROW]]) {
  scenario(`no serious findings of axe-core, nothing beyond the edge, ${size}`, { viewport, bypassCSP: true }, async (page) => {
    await openRobot(page, "staubli-rx90", { panel: "table" });
    await page.evaluate(axe);
    const wrong = [];
    for (const [name, fill] of Object.entries(PANELS)) {
      await tab(page, name).click();
      await fill(page);
      wrong.push(...(await findings(page, name)));
      // The next panel begins with a robot that is right.
      if (name === "Table") await page.getByRole("textbox", { name: "Row 2, theta", exact: true }).fill("q2");
    }
    await page.keyboard.press("Control+k");
    await page.getByRole("listbox", { name: "Robots" }).waitFor();
    wrong.push(...(await findings(page, "catalogue")));
    await page.getByRole("tab", { name: "Paste or open" }).click();
    wrong.push(...(await findings(page, "paste")));
    assert.deepEqual(wrong, []);
  });

  scenario(`no serious findings of axe-core in what is played, ${size}`, { viewport, bypassCSP: true }, async (page) => {
    await openRobot(page, "staubli-rx90", { panel: "table" });
    await page.evaluate(axe);
    const wrong = [];
    await page.keyboard.press("Control+k");
    await page.getByRole("radio", { name: "Pictures" }).check({ force: true });
    await until(async () => (await page.locator(".arm-picture").count()) > 3, "there are pictures");
    wrong.push(...(await findings(page, "pictures")));
    await page.keyboard.press("Escape");

    // A row that is played, the game, and a derivation step by step.
    const steps = page.getByRole("region", { name: "From frame to frame" });
    for (let k = 0; k < 2; k++) await steps.getByRole("button", { name: "A step forward" }).click();
    wrong.push(...(await findings(page, "steps")));
    await page.getByRole("button", { name: "Place the frames yourself" }).click();
    for (let k = 0; k < 3; k++) await page.locator(".answer").nth(k).click();
    await page.getByRole("region", { name: "Place the frames" }).getByRole("alert").waitFor();
    wrong.push(...(await findings(page, "game")));
    await tab(page, "Formulas").click();
    await page.getByRole("tab", { name: "Forward model" }).click();
    await page.getByRole("button", { name: "Step by step" }).click();
    for (let k = 0; k < 4; k++) await page.getByRole("button", { name: "Next", exact: true }).click();
    wrong.push(...(await findings(page, "derivation")));
    assert.deepEqual(wrong, []);
  });
}

/** What has the focus, and whether one sees that it has it: by itself, its active option, or the words of its button. */
function focused() {
  const element = document.activeElement;
  const isSeen = (shown) => {
    if (!shown) return false;
    const { outlineStyle, outlineWidth, boxShadow } = getComputedStyle(shown);
    const { width, height, left, top } = shown.getBoundingClientRect();
    const inside = left < innerWidth && top < innerHeight && left + width > 0 && top + height > 0;
    return inside && ((outlineStyle !== "none" && parseFloat(outlineWidth) > 0) || boxShadow !== "none");
  };
  const active = document.getElementById(element.getAttribute("aria-activedescendant") ?? "");
  return {
    name: element.getAttribute("aria-label") ?? element.textContent.trim().slice(0, 40),
    role: element.getAttribute("role") ?? element.tagName.toLowerCase(),
    seen: isSeen(element) || isSeen(active) || (element.type === "radio" && isSeen(element.nextElementSibling)),
  };
}

/** Presses Tab until the focus is on something; all stops on the way have to be seen. */
async function tabTo(page, isWanted, key = "Tab") {
  const way = [];
  for (let k = 0; k < 80; k++) {
    await page.keyboard.press(key);
    const now = await page.evaluate(focused);
    way.push(`${now.role} ${now.name}`);
    assert.ok(now.seen || now.role === "body", `the focus is seen on ${now.role} ${now.name}`);
    if (isWanted(now)) return now;
  }
  return assert.fail(`not reached by ${key}: ${way.join(" → ")}`);
}

scenario("everything by keys: a robot, a joint, a solution, a cell, a formula, a link", { permissions: ["clipboard-read", "clipboard-write"] }, async (page) => {
  await open(page);
  await tabTo(page, ({ name }) => /choose another robot/.test(name));
  await page.keyboard.press("Enter");
  await page.getByRole("combobox", { name: /Search/ }).waitFor();
  await page.keyboard.type("puma 560");
  await page.keyboard.press("ArrowDown");
  await page.keyboard.press("ArrowUp");
  await page.keyboard.press("Enter");
  await page.getByRole("heading", { level: 1, name: "Denavit: Unimation Puma 560", exact: true }).waitFor();

  await tabTo(page, ({ role, name }) => role === "tab" && name === "Joints");
  await tabTo(page, ({ role, name }) => role === "input" && /^q1/.test(name));
  await page.keyboard.press("ArrowRight");
  await until(async () => (await valueOf(page.getByRole("textbox", { name: /^q1\b/ }))) === 1, "q1 is stepped");

  await tabTo(page, ({ role }) => role === "tab", "Shift+Tab");
  await page.keyboard.press("ArrowRight");
  assert.equal(await tab(page, "Hand").getAttribute("aria-selected"), "true");
  await until(async () => (await page.locator(".solution").count()) === 8, "there are eight solutions");
  await tabTo(page, ({ role }) => role === "listbox");
  const before = (await shared(page, (s) => s.panel === "hand", "the panel is in the address")).q;
  await page.keyboard.press("End");
  await page.keyboard.press("Enter");
  await shared(page, (s) => s.q.some((x, k) => Math.abs(x - before[k]) > 0.1), "another solution is taken");

  await tabTo(page, ({ role }) => role === "tab", "Shift+Tab");
  await page.keyboard.press("Home");
  assert.equal(await tab(page, "Table").getAttribute("aria-selected"), "true");
  await tabTo(page, ({ name }) => name === "Row 1, theta");
  await page.keyboard.press("ArrowDown");
  assert.equal((await page.evaluate(focused)).name, "Row 2, theta");

  await tabTo(page, ({ role }) => role === "tab", "Shift+Tab");
  for (let k = 0; k < 3; k++) await page.keyboard.press("ArrowRight");
  await page.locator(".formula-box").first().waitFor();
  await tabTo(page, ({ role, name }) => role === "group" && name === "t14");
  await page.keyboard.press("ArrowRight");
  await page.locator(".joint-symbol.chosen").waitFor();

  await tab(page, "Formulas").focus();
  await page.keyboard.press("End");
  await tabTo(page, ({ name }) => name === "Copy link");
  await page.keyboard.press("Enter");
  await saysInStatus(page, /copied/);

  // The scene: turned by arrows.
  const camera = (await shared(page, (s) => s.camera, "there is a view")).camera;
  await page.locator("canvas.scene-canvas").focus();
  await page.keyboard.press("ArrowLeft");
  await shared(page, (s) => Math.abs(s.camera[0] - camera[0]) > 0.05, "the view is turned");
});

/** Sums up what has moved without a hand. */
function watchShifts() {
  window.shifts = [];
  new PerformanceObserver((list) => {
    for (const { value, hadRecentInput, sources } of list.getEntries()) {
      if (!hadRecentInput) window.shifts.push({ value, what: sources.map(({ node }) => node?.className || node?.nodeName) });
    }
  }).observe({ type: "layout-shift", buffered: true });
}

for (const [size, viewport] of [["wide", WIDE], ["narrow", NARROW]]) {
  scenario(`nothing jumps while the page loads, ${size}`, { viewport, init: watchShifts }, async (page) => {
    await open(page);
    await until(async () => (await page.locator("canvas.scene-canvas").getAttribute("aria-label"))?.includes("Hand at"), "all is there");
    const shifts = await page.evaluate(() => window.shifts);
    const sum = shifts.reduce((all, { value }) => all + value, 0);
    assert.ok(sum < 0.02, `${sum}: ${JSON.stringify(shifts)}`);
  });
}
