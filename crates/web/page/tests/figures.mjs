// How fast the page is.
import assert from "node:assert/strict";
import { pictureOf } from "./pixels.mjs";
import { figure, open, openRobot, scenario, tab, until } from "./support.mjs";

/** When the arm was first on the page, milliseconds from the navigation. */
function firstFrame() {
  const look = () => {
    if (window.denavit?.frames > 0) window.firstFrame = performance.now();
    else requestAnimationFrame(look);
  };
  look();
}

scenario("the first picture of the arm", { alone: true, init: firstFrame }, async (page) => {
  await open(page);
  figure("navigation to the first picture", (await page.evaluate(() => window.firstFrame)) / 1000, "s", 1.5);
});

scenario("frames while the view is turned, with all ghosts", { alone: true }, async (page) => {
  await openRobot(page, "staubli-rx90", { look: { ghosts: true } });
  await until(() => page.evaluate(() => window.denavit.ghosts >= 7), "all other solutions are drawn");
  const box = await page.locator("canvas.scene-canvas").boundingBox();
  // From a corner without handles: the pointer is held, then moved once a frame.
  await page.mouse.move(box.x + 60, box.y + 120);
  await page.mouse.down();
  const { frames, seconds, ghosts } = await page.evaluate(async ([x, y]) => {
    const canvas = document.querySelector("canvas.scene-canvas");
    const next = () => new Promise(requestAnimationFrame);
    const move = (k) => canvas.dispatchEvent(new PointerEvent("pointermove", { pointerId: 1, pointerType: "mouse", buttons: 1, bubbles: true, clientX: x + 4 * k, clientY: y + (k % 40) }));
    for (let k = 0; k < 15; k++, await next()) move(k);
    const [start, before] = [performance.now(), window.denavit.frames];
    for (let k = 15; performance.now() - start < 2500; k++, await next()) move(k);
    return { frames: window.denavit.frames - before, seconds: (performance.now() - start) / 1000, ghosts: window.denavit.ghosts };
  }, [box.x + 60, box.y + 120]);
  await page.mouse.up();
  assert.ok(ghosts >= 7, "the ghosts are there while it turns");
  figure("frames while orbiting, six joints, all ghosts", frames / seconds, "a second", 40, false);
});

/** What each request took inside of its worker. */
function watchWorkers() {
  window.took = [];
  const Plain = window.Worker;
  window.Worker = class extends Plain {
    #asked = new Map();
    constructor(...all) {
      super(...all);
      this.addEventListener("message", ({ data }) => window.took.push({ op: this.#asked.get(data.id), ms: data.milliseconds }));
    }
    postMessage(message, ...rest) {
      this.#asked.set(message.id, message.op);
      super.postMessage(message, ...rest);
    }
  };
}

scenario("a solution while the hand is dragged", { alone: true, init: watchWorkers }, async (page) => {
  await openRobot(page, "staubli-rx90", { panel: "hand" });
  await until(async () => (await page.locator(".solution").count()) === 8, "there are eight solutions");
  const box = await page.locator("canvas.scene-canvas").boundingBox();
  const [x, y] = (await page.evaluate(() => window.denavit.handles()))["plane y"];
  await page.mouse.move(box.x + x, box.y + y);
  await page.mouse.down();
  await page.mouse.move(box.x + x - 10, box.y + y - 10, { steps: 10 });
  // Once a frame, as a hand does.
  await page.evaluate(async ([left, top]) => {
    window.took.length = 0;
    const canvas = document.querySelector("canvas.scene-canvas");
    for (let k = 0; k < 60; k++) {
      const at = { clientX: left - 10 - 0.6 * k, clientY: top - 10 + 0.6 * k };
      canvas.dispatchEvent(new PointerEvent("pointermove", { pointerId: 1, pointerType: "mouse", buttons: 1, bubbles: true, ...at }));
      await new Promise(requestAnimationFrame);
    }
  }, [box.x + x, box.y + y]);
  await page.mouse.up();
  const times = (await page.evaluate(() => window.took)).filter(({ op }) => op === "solve").map(({ ms }) => ms);
  assert.ok(times.length > 30, `${times.length} solutions`);
  const median = times.sort((a, b) => a - b)[Math.floor(times.length / 2)];
  figure(`a solution while dragging, median of ${times.length}`, median, "ms", 1);
});

function watchTasks() {
  window.tasks = [];
  new PerformanceObserver((list) => window.tasks.push(...list.getEntries().map(({ duration }) => duration))).observe({ type: "longtask" });
}

scenario("the longest task of the page while formulas are derived", { alone: true, init: watchTasks }, async (page) => {
  await openRobot(page, "staubli-rx90", { panel: "formulas", look: { ghosts: true } });
  await until(async () => (await page.locator("#topic-panel .document:not(.dimmed)").count()) === 1, "the first topic is derived");
  // The first picture with the other solutions takes long where WebGL is done in software: it is no derivation.
  await until(() => page.evaluate(() => window.denavit.ghosts >= 7), "all other solutions are drawn");
  await pictureOf(page);
  await page.evaluate(() => (window.tasks.length = 0));
  for (const name of ["Algorithm", "Jacobian", "Singularities", "Inverse"]) {
    await page.getByRole("tab", { name, exact: true }).click();
    await until(async () => (await page.locator("#topic-panel").getAttribute("aria-busy")) === "false" && (await page.locator("#topic-panel .document:not(.dimmed)").count()) === 1, `${name} is derived`);
  }
  await tab(page, "Joints").click();
  figure("longest task while deriving", Math.max(0, ...(await page.evaluate(() => window.tasks))), "ms", 100);
});
