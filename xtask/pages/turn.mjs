// Turns slides in headless Chromium, large and on a phone: `node turn.mjs CHROMIUM PAGE...`.
// Fails where a step does not come, is not whole on the screen, or is set very small; on errors in the console, on any
// request, and on serious findings of axe-core.
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";
import { createRequire } from "node:module";
import { chromium } from "playwright-core";

/** The smallest letters, of those that fit a slide. */
const SMALLEST = 0.45;
const [executablePath, ...pages] = process.argv.slice(2);
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const browser = await chromium.launch({ executablePath, args: ["--no-sandbox"] });
const findings = [];
let turned = 0;

for (const file of pages) {
  for (const viewport of [{ width: 1280, height: 720 }, { width: 844, height: 390 }]) {
    const url = pathToFileURL(file).href;
    const context = await browser.newContext({ viewport });
    const page = await context.newPage();
    const say = (text) => findings.push(`${file} (${viewport.width} px): ${text}`);
    page.on("console", (m) => m.type() === "error" && say(`console: ${m.text()}`));
    page.on("pageerror", (e) => say(`error: ${e}`));
    page.on("request", (r) => r.url().split("#")[0] !== url && !r.url().startsWith("data:") && say(`request: ${r.url()}`));
    await page.goto(url);
    await page.evaluate(() => document.fonts.ready);
    const steps = await page.evaluate(() => {
      const isPaced = document.querySelector("main").dataset.pace === "steps";
      return [...document.querySelectorAll(".slide")].map((s) => (isPaced ? Math.max(1, s.querySelectorAll(".step").length) : 1));
    });
    for (const [slide, count] of steps.entries()) {
      for (let step = 0; step < count; step++) {
        for (const text of await page.evaluate(inspect, [slide, step, SMALLEST])) say(`slide ${slide + 1}, step ${step + 1}: ${text}`);
        turned += 1;
        await page.keyboard.press("ArrowRight");
      }
    }
    // The last step stays, and the way back ends at the first.
    await page.keyboard.press("ArrowRight");
    const last = steps.length - 1;
    if (new URL(page.url()).hash !== `#${last + 1}.${steps[last]}`) say(`ends at ${page.url()}`);
    await page.keyboard.press("ArrowLeft");
    await page.keyboard.press("Home");
    if (new URL(page.url()).hash !== "#1.1") say(`begins at ${page.url()}`);
    await page.keyboard.press("ArrowRight");
    await page.evaluate(axe);
    const { violations } = await page.evaluate(() => axe.run({ resultTypes: ["violations"] }));
    for (const v of violations.filter((v) => ["serious", "critical"].includes(v.impact))) {
      say(`${v.id}: ${v.help} (${v.nodes.length} times, ${v.nodes[0].html.slice(0, 160)})`);
    }
    await context.close();
  }
}
await browser.close();
for (const text of findings) console.error(text);
console.log(`${pages.length} talks, ${turned} steps: ${findings.length} findings`);
process.exit(findings.length > 0 ? 1 : 0);

/** Runs in the page: sentences about what is wrong with the step that should be seen. */
function inspect([slide, step, smallest]) {
  const found = [];
  if (location.hash !== `#${slide + 1}.${step + 1}`) found.push(`the address says ${location.hash}`);
  const shown = [...document.querySelectorAll(".slide")].filter((s) => getComputedStyle(s).display !== "none");
  if (shown.length !== 1 || shown[0] !== document.querySelectorAll(".slide")[slide]) return [...found, "another slide is shown"];
  const seen = [...shown[0].querySelectorAll(".step")].filter((s) => getComputedStyle(s).visibility === "visible");
  const all = shown[0].querySelectorAll(".step").length;
  const isPaced = document.querySelector("main").dataset.pace === "steps";
  if (seen.length !== (isPaced ? Math.min(all, step + 1) : all)) found.push(`${seen.length} of ${all} steps are seen`);
  const body = shown[0].querySelector(".body");
  if (!body) return found;
  const words = (e) => (e.textContent || "").trim().slice(0, 60);
  if (body.scrollHeight > body.clientHeight + 2) found.push(`is higher than the screen: ${words(body)}`);
  for (const e of body.querySelectorAll(".formula, .table")) if (e.scrollWidth > e.clientWidth + 2) found.push(`does not fit: ${words(e)}`);
  const share = Number(body.style.getPropertyValue("--share") || 1);
  if (share < smallest) found.push(`is set ${share.toFixed(2)} times as large: ${words(body)}`);
  return found;
}
