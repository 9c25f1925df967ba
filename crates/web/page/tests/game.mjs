// Frames placed by hand: the rules, for all arms of the catalogue in all conventions, and the game on the page.
import assert from "node:assert/strict";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";
import { Engine } from "./engine.mjs";
import { differing, pictureOf } from "./pixels.mjs";
import { openRobot, saysInStatus, scenario, tab, until } from "./support.mjs";

/** A module of the page, which is no JavaScript before it is built. */
async function module(path) {
  const { outputFiles } = await build({ entryPoints: [fileURLToPath(new URL(path, import.meta.url))], bundle: true, format: "esm", write: false });
  return import(`data:text/javascript;base64,${Buffer.from(outputFiles[0].contents).toString("base64")}`);
}

/** A row of the table as a transform: the product of the convention. */
function rowOf(convention, { theta, d, a, alpha }) {
  const [ct, st, ca, sa] = [Math.cos(theta), Math.sin(theta), Math.cos(alpha), Math.sin(alpha)];
  if (convention === "standard") return [[ct, -st * ca, st * sa, a * ct], [st, ct * ca, -ct * sa, a * st], [0, sa, ca, d], [0, 0, 0, 1]];
  return [[ct, -st, 0, a], [ca * st, ca * ct, -sa, -d * sa], [sa * st, sa * ct, ca, d * ca], [0, 0, 0, 1]];
}

const times = (a, b) => a.map((row) => [0, 1, 2, 3].map((c) => row.reduce((sum, x, k) => sum + x * b[k][c], 0)));
const poseOf = ({ origin, z, x }) => {
  const y = [z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0]];
  return [...[0, 1, 2].map((r) => [x[r], y[r], z[r], origin[r]]), [0, 0, 0, 1]];
};
const most = (a, b) => Math.max(...a.flatMap((row, r) => row.map((x, c) => Math.abs(x - b[r][c]))));

// By itself: it computes in the process that serves the page.
scenario("whoever takes right answers alone gets a table of the same arm, whichever they are", { alone: true }, async () => {
  const [{ armOf, parameters, axisIndex }, { origins, zs, xs }] = [await module("../src/game/rules.ts"), await module("../src/game/choices.ts")];
  const engine = new Engine();
  let seed = 7;
  const random = () => (seed = (seed * 48271) % 2147483647) / 2147483647;
  let played = 0;
  for (const [at, { name }] of engine.call("catalogue").robots.entries()) {
    const own = engine.call("open", { text: name, kind: "robot" }).file;
    for (const to of ["standard", "craig", "khalil"]) {
      let { robot } = engine.call("edit", { file: own });
      let file = own;
      // Converting takes long: every fourth arm is enough of that.
      if (to !== own.convention && at % 4 !== 0) continue;
      if (to !== own.convention) {
        const converted = engine.call("convert", { to });
        if (!converted.proved || !converted.file) continue;
        file = converted.file;
        ({ robot } = engine.call("edit", { file }));
      }
      if (!robot || robot.rows !== robot.joints.length || robot.joints.some(({ row }, k) => row !== k)) continue;
      for (let round = 0; round < 2; round++) {
        const q = robot.q.map((x, k) => x + (round === 0 ? 0 : 0.3 * (random() - 0.5) * (robot.joints[k].kind === "P" ? 0.2 : 1)));
        const { frames } = engine.call("scene", { q });
        const arm = armOf(file.convention, frames.slice(0, robot.rows + 1), robot.joints.map(({ kind }) => kind), robot.reach);
        const placed = [arm.frames[0]];
        const take = (choices, what) => {
          const right = choices.filter(({ verdict }) => verdict.right);
          assert.ok(right.length > 0, `${name} ${to}, frame ${placed.length}: there is a right ${what}`);
          assert.ok(choices.length >= 2, `${name} ${to}, frame ${placed.length}: there is a choice of ${what}`);
          for (const { verdict } of choices) assert.ok(verdict.words.length > 5);
          return right[Math.floor(random() * right.length)].value;
        };
        for (let frame = 1; frame <= robot.rows; frame++) {
          const before = placed[frame - 1];
          const origin = take(origins(arm, frame, before), "origin");
          const z = take(zs(arm, frame, before, origin), "z");
          const answers = xs(arm, frame, before, { origin, z });
          const x = take(answers, "x");
          // With the standard convention a wrong x is one that no row leads to.
          for (const { value, verdict } of to === "standard" ? answers : []) {
            const isFrame = Math.abs(value.reduce((sum, v, k) => sum + v * z[k], 0)) < 1e-6;
            if (verdict.right || !isFrame) continue;
            const wrong = { origin, z, x: value };
            assert.ok(most(times(poseOf(before), rowOf(to, parameters(to, before, wrong))), poseOf(wrong)) > 1e-6, `${name}, frame ${frame}: ${verdict.words}`);
          }
          placed.push({ origin, z, x });
          // The row that joins both frames, as the convention multiplies it.
          const row = rowOf(to, parameters(file.convention, before, placed[frame]));
          assert.ok(most(times(poseOf(before), row), poseOf(placed[frame])) < 1e-4 * Math.max(1, robot.reach), `${name} ${to}, row ${frame}`);
          const index = axisIndex(arm, frame);
          if (index !== null) assert.ok(Math.abs(arm.axes[index].along.reduce((sum, v, k) => sum + v * z[k], 0)) > 1 - 1e-9, `${name} ${to}: z${frame}`);
        }
        played += 1;
      }
    }
  }
  assert.ok(played > 200, `${played} games`);
});

const part = (page) => page.getByRole("region", { name: "Place the frames" });
const question = (page) => part(page).getByRole("heading", { level: 3 }).first().textContent();

/** Tries the answers one after another until another question is there; how many were wrong. */
async function answered(page) {
  const asked = await question(page);
  const answers = part(page).getByRole("list", { name: "Answers" }).getByRole("button");
  const count = await answers.count();
  for (let k = 0; k < count; k++) {
    await answers.nth(k).click();
    const said = part(page).getByRole("alert");
    const isNext = async () => (await question(page)) !== asked;
    const isWrong = async () => /, wrong$/.test(await answers.nth(k).getAttribute("aria-label").catch(() => ""));
    await until(async () => (await isNext()) || (await isWrong()), "the answer is judged");
    const words = await said.textContent();
    if (await isNext()) {
      assert.match(words, /^Right/);
      return k;
    }
    assert.match(words, /^(?!Right).*[a-z]{3}/);
  }
  return assert.fail(`no answer to “${asked}” is right`);
}

scenario("frames are placed one after another, wrong answers are told why, and the table stands at the end", async (page) => {
  await openRobot(page, "scara", { panel: "table" });
  const before = await pictureOf(page);
  await page.getByRole("button", { name: "Place the frames yourself" }).click();
  assert.ok(differing(before, await pictureOf(page)) > 0.003, "the arm stands without its frames");
  let slips = 0;
  for (let frame = 1; frame <= 4; frame++) {
    for (const words of [`Where does frame ${frame} have its origin?`, `Which way does z of frame ${frame} go?`, `Which way does x of frame ${frame} go?`]) {
      assert.equal(await question(page), words);
      slips += await answered(page);
    }
    await part(page).getByText(new RegExp(`^${frame} of 4 frames stand; ${slips === 0 ? "no slip" : slips === 1 ? "1 slip" : `${slips} slips`} so far`)).waitFor();
  }
  assert.ok(slips > 0, "who tries everything makes slips");
  await part(page).getByRole("table", { name: "The table of the placed frames" }).waitFor();
  assert.equal(await part(page).getByRole("row").count(), 5);
  await part(page).getByRole("button", { name: "Begin anew" }).click();
  await part(page).getByText(/^0 of 4 frames stand; no slip/).waitFor();
  await part(page).getByRole("button", { name: "End" }).click();
  await page.getByRole("textbox", { name: "Row 1, theta", exact: true }).waitFor();
});

scenario("answers are taken in the picture, too, and an arm that moves ends the game", async (page) => {
  await openRobot(page, "planar-2r", { panel: "table" });
  await page.getByRole("button", { name: "Place the frames yourself" }).click();
  const box = await page.locator("canvas.scene-canvas").boundingBox();
  const answers = () => page.evaluate(() => window.denavit.answers());
  await until(async () => (await answers()).length >= 2, "the answers are in the picture");
  const asked = await question(page);
  for (const [x, y] of await answers()) {
    if ((await question(page)) !== asked) break;
    await page.mouse.click(box.x + x, box.y + y);
  }
  await until(async () => (await question(page)) === "Which way does z of frame 1 go?", "a right one was among them");
  // The hand has no handles meanwhile.
  assert.equal(Object.keys(await page.evaluate(() => window.denavit.handles())).length, 0);
  const [x, y] = (await page.evaluate(() => window.denavit.joints()))[1];
  await page.mouse.move(box.x + x, box.y + y);
  await page.mouse.down();
  await page.mouse.move(box.x + x + 60, box.y + y + 40, { steps: 6 });
  await page.mouse.up();
  await saysInStatus(page, /its frames are to be placed anew/);
  assert.equal(await part(page).count(), 0);
  // Another panel ends it as well.
  await page.getByRole("button", { name: "Place the frames yourself" }).click();
  await tab(page, "Joints").click();
  await tab(page, "Table").click();
  assert.equal(await part(page).count(), 0);
});
