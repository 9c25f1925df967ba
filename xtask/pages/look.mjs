// Opens pages in headless Chromium, light and dark, wide and narrow: `node look.mjs CHROMIUM PAGE...`.
// Fails on serious findings of axe-core, on what runs off the page, on formulas and figures without words, on errors in
// the console, and on any request.
import { readFileSync } from "node:fs";
import { pathToFileURL } from "node:url";
import { createRequire } from "node:module";
import { chromium } from "playwright-core";

const [executablePath, ...pages] = process.argv.slice(2);
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const browser = await chromium.launch({ executablePath, args: ["--no-sandbox"] });
const findings = [];

// Each view of each page on its own, two at a time.
const views = pages.flatMap((file) =>
  ["light", "dark"].flatMap((colorScheme) =>
    [{ width: 1280, height: 900 }, { width: 390, height: 844 }].map((viewport) => ({ file, colorScheme, viewport })),
  ),
);
const next = views.values();
await Promise.all([look(), look()]);
await browser.close();
for (const text of findings) console.error(text);
console.log(`${pages.length} pages, light and dark, wide and narrow: ${findings.length} findings`);
process.exit(findings.length > 0 ? 1 : 0);

/** Looks at views until none is left. */
async function look() {
  for (const { file, colorScheme, viewport } of next) {
    const url = pathToFileURL(file).href;
    const context = await browser.newContext({ colorScheme, viewport });
    const page = await context.newPage();
    const say = (text) => findings.push(`${file} (${colorScheme}, ${viewport.width} px): ${text}`);
    page.on("console", (m) => m.type() === "error" && say(`console: ${m.text()}`));
    page.on("pageerror", (e) => say(`error: ${e}`));
    page.on("request", (r) => r.url() !== url && !r.url().startsWith("data:") && say(`request: ${r.url()}`));
    await page.goto(url);
    await page.evaluate(() => document.fonts.ready);
    for (const text of await page.evaluate(inspect, viewport.width > 1000)) say(text);
    await page.evaluate(axe);
    const { violations } = await page.evaluate(() => axe.run({ resultTypes: ["violations"] }));
    for (const v of violations.filter((v) => ["serious", "critical"].includes(v.impact) || v.id === "heading-order")) {
      say(`${v.id}: ${v.help} (${v.nodes.length} times, ${v.nodes[0].html.slice(0, 160)})`);
    }
    await context.close();
  }
}

/** Runs in the page: sentences about what is wrong. */
function inspect(isWide) {
  const found = [];
  const root = document.documentElement;
  if (root.scrollWidth > root.clientWidth + 1) found.push(`the page is ${root.scrollWidth} px wide`);
  const words = (e) => (e.textContent || "").trim().slice(0, 60);
  if (isWide) {
    for (const e of document.querySelectorAll(".formula, .table")) {
      if (e.scrollWidth > e.clientWidth + 1) found.push(`does not fit: ${words(e)}`);
    }
  }
  for (const e of document.querySelectorAll("math")) {
    if (!e.getAttribute("alttext")) found.push(`no alternative text: ${words(e)}`);
  }
  for (const e of document.querySelectorAll("svg")) {
    if (!e.querySelector("title")?.textContent) found.push("a figure without title");
  }
  let level = 1;
  for (const e of document.querySelectorAll("h1, h2, h3, h4, h5, h6")) {
    const own = Number(e.tagName[1]);
    if (own > level + 1) found.push(`heading of level ${own} below one of level ${level}: ${words(e)}`);
    level = own;
  }
  if (document.querySelectorAll("h1").length !== 1) found.push("not one title");
  if (!document.fonts.check('16px "Denavit Maths"')) found.push("the font of formulas is not there");
  return found;
}
