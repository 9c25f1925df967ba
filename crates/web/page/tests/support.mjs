// What every test of the page begins with: one browser, a fresh context each, and a list of what went wrong in it.
import assert from "node:assert/strict";
import test, { after, describe } from "node:test";
import { setTimeout as pause } from "node:timers/promises";
import { deflateRawSync, inflateRawSync } from "node:zlib";
import { chromium } from "playwright-core";
import { robotOf } from "./engine.mjs";
import { serve } from "./site.mjs";

export const WIDE = { width: 1280, height: 800 };
export const NARROW = { width: 390, height: 844 };
/** How long something may take before it has failed, milliseconds. Derivations on a busy machine take seconds. */
const PATIENCE = 20_000;

const site = await serve();
const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  args: ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"],
});
after(async () => {
  await browser.close();
  site.end();
});

/** The address of the page, with a fragment. */
export function address(fragment = "") {
  return site.url + fragment;
}

const scenarios = [];
// Once all files have said theirs: what measures by itself, then two at a time, since while one waits the other works.
setImmediate(() => {
  for (const [words, isAlone, concurrency] of [["by itself", true, 1], ["the page", false, 2]]) {
    const some = scenarios.filter(({ alone }) => alone === isAlone);
    if (some.length > 0) describe(words, { concurrency }, () => some.forEach(({ name, run }) => test(name, { timeout: 120_000 }, run)));
  }
});

/** There is one clipboard: who uses it waits for who has it. */
let clipboard = Promise.resolve();

/**
 * A test in a context of its own. It fails on every error in the console, failed request, or request to elsewhere;
 * `expected` are those that the test provokes; `alone` it runs if it measures.
 */
export function scenario(name, options, body = options) {
  const { expected = [], permissions = [], alone = false, init, ...context } = body === options ? {} : options;
  const run = async () => {
    const surroundings = await browser.newContext({ viewport: WIDE, acceptDownloads: true, ...context });
    surroundings.setDefaultTimeout(PATIENCE);
    const { origin } = new URL(site.url);
    if (permissions.length > 0) await surroundings.grantPermissions(permissions, { origin });
    const wrong = [];
    // How often a page was left for another, or for good: what it was still fetching then is given up. It may be given
    // up before the word comes that the page is left, or asked for after the next page was: that shows once this one stands.
    let left = 0;
    let givenUp = [];
    const leftBefore = new WeakMap();
    const say = (words) => expected.some((pattern) => pattern.test(words)) || wrong.push(words);
    const follow = (page) => {
      page.on("console", (m) => m.type() === "error" && say(`console: ${m.text()}`));
      page.on("pageerror", (e) => say(`error: ${e}`));
      page.on("close", () => left++);
      page.on("domcontentloaded", () => (givenUp = []));
    };
    surroundings.on("page", follow);
    surroundings.on("request", (r) => {
      if (r.isNavigationRequest()) left++;
      leftBefore.set(r, left);
    });
    surroundings.on("request", (r) => /^(data|blob):/.test(r.url()) || new URL(r.url()).origin === origin || say(`request: ${r.url()}`));
    surroundings.on("response", (r) => r.status() >= 400 && say(`response: ${r.status()} ${r.url()}`));
    surroundings.on("requestfailed", (r) => {
      // A worker that is ended while it fetches a part has not failed, nor a page that is left, nor a tab before it has its icon.
      const isLeft = leftBefore.get(r) !== left || /((inverse|derive|read|write|check)\.wasm|icon\.svg)$/.test(r.url());
      const why = r.failure()?.errorText;
      const words = `failed: ${r.url()} ${why}`;
      if (why !== "net::ERR_ABORTED") say(words);
      else if (!isLeft) givenUp.push(words);
    });
    if (init) await surroundings.addInitScript(init);
    const page = await surroundings.newPage();
    try {
      await body(page, surroundings);
      givenUp.forEach(say);
      assert.deepEqual(wrong, []);
    } catch (why) {
      if (wrong.length > 0 && !why.message?.includes(wrong[0])) why.message += `\nIn the page: ${wrong.join("\n")}`;
      throw why;
    } finally {
      wrong.length = 0;
      await surroundings.close();
    }
  };
  const inTurn = () => (clipboard = clipboard.then(run, run));
  scenarios.push({ name, alone, run: permissions.length > 0 ? inTurn : run });
}

/** Asks again until the answer is something; fails with what was waited for. */
export async function until(ask, words, patience = PATIENCE) {
  const end = performance.now() + patience;
  for (;;) {
    const answer = await ask();
    if (answer) return answer;
    if (performance.now() > end) assert.fail(`waited in vain until ${typeof words === "function" ? await words() : words}`);
    await pause(30);
  }
}

/** Opens the page; it is ready once the arm has been drawn. */
export async function open(page, fragment = "") {
  await page.goto(address(fragment));
  await ready(page);
}

export async function ready(page) {
  await page.getByRole("button", { name: /choose another robot/ }).waitFor();
  await until(() => page.evaluate(() => window.denavit?.frames > 0), "the arm is drawn");
}

/** Opens a robot of the catalogue by a shared address, in a panel. */
export async function openRobot(page, name, { panel = "joints", ...more } = {}) {
  const subject = robotOf(name);
  await open(page, encode({ file: subject.file, q: subject.robot.q, panel, ...more }));
  return subject;
}

export function tab(page, name) {
  return page.getByRole("tablist", { name: "Panels" }).getByRole("tab", { name });
}

/** The line at the foot of the page. */
export async function status(page) {
  return (await page.locator("footer [role=status]").textContent()).trim();
}

export async function saysInStatus(page, pattern) {
  await until(async () => pattern.test(await status(page)), async () => `the status line says ${pattern}, and not “${await status(page)}”`);
}

// Speed ------------------------------------------------------------------------------------------------------------

/** How fast something is: printed; a gate where nothing else runs (`cargo xtask page --timed`), at three times the budget. */
export function figure(words, value, unit, budget, isMost = true) {
  console.log(`# ${words}: ${value.toFixed(value < 10 ? 2 : 0)} ${unit} (budget ${isMost ? "≤" : "≥"} ${budget} ${unit})`);
  if (process.env.PAGE_FIGURES !== "gate") return;
  assert.ok(isMost ? value <= 3 * budget : value >= budget / 3, `${words}: ${value} ${unit}`);
}

// The address ------------------------------------------------------------------------------------------------------

/** As `src/fragment.ts` writes it. */
export function encode(shared) {
  return `#1.${deflateRawSync(JSON.stringify(shared)).toString("base64url")}`;
}

export function decode(fragment) {
  return JSON.parse(inflateRawSync(Buffer.from(fragment.replace(/^#1\./, ""), "base64url")).toString());
}

/** What the address holds, once it is as wanted: the page's state to twelve digits. */
export async function shared(page, isWanted, words) {
  let last;
  const ask = async () => {
    const hash = await page.evaluate(() => location.hash);
    if (hash.length < 4) return null;
    last = decode(hash);
    return isWanted(last) ? last : null;
  };
  return until(ask, () => `${words}; the address holds ${JSON.stringify({ ...last, file: undefined })}`);
}

// Numbers ----------------------------------------------------------------------------------------------------------

export function close(one, other, by, words = "") {
  assert.ok(Math.abs(one - other) <= by, `${words} ${one} and ${other} differ by more than ${by}`);
}

/** The largest difference of two lists, angles up to whole turns where `kinds` says so. */
export function farthest(one, other, kinds = []) {
  assert.equal(one.length, other.length);
  const turn = 2 * Math.PI;
  return Math.max(...one.map((x, k) => Math.abs(kinds[k] === "R" ? x - other[k] - turn * Math.round((x - other[k]) / turn) : x - other[k])));
}

export const degrees = (x) => (x * 180) / Math.PI;
export const radians = (x) => (x * Math.PI) / 180;

/** A number as it stands on the page: with the minus of print. */
export function read(text) {
  return Number(text.replace("−", "-").replace(/[^\d.eE+-]/g, ""));
}

/** The number in a field. */
export async function valueOf(locator) {
  return read(await locator.inputValue());
}

/** Types a number or words into a field, and leaves it. */
export async function enter(locator, text) {
  await locator.fill(text);
  await locator.press("Enter");
}
