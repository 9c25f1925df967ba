// How the hand can move: the ellipsoid of its velocities, lost directions, joints that move without it; the bars of torques.
import assert from "node:assert/strict";
import { handAt } from "./engine.mjs";
import { differing, pictureOf } from "./pixels.mjs";
import { close, openRobot, radians, read, scenario, shared, tab, until } from "./support.mjs";

const part = (page) => page.getByRole("region", { name: "Distance from singular configurations" });

/** The half axes that the panel says. */
async function halfAxes(page) {
  const words = await part(page).getByText(/^Half axes/).textContent();
  return /Half axes ([^m]*) m\/s/.exec(words)[1].split(", ").map(read);
}

/** The singular values of a matrix with two columns or rows, the larger first: by trace and determinant of M Mᵀ. */
function singularValues([[a, b], [c, d]]) {
  const [sum, det] = [a * a + b * b + c * c + d * d, (a * d - b * c) ** 2];
  const root = Math.sqrt(Math.max(0, sum * sum - 4 * det));
  return [Math.sqrt((sum + root) / 2), Math.sqrt((sum - root) / 2)];
}

scenario("the ellipsoid of a planar arm has the singular values of its Jacobian as half axes", async (page) => {
  const q = [0.4, 1.1];
  const { engine } = await openRobot(page, "planar-2r", { q });
  const before = await pictureOf(page);
  await part(page).getByRole("button", { name: "Velocity ellipsoid" }).click();
  // Lengths out of the forward model: the hand at rest stretched out, and folded.
  const reach = handAt(engine, [0, 0])[0][3];
  const least = handAt(engine, [0, Math.PI])[0][3];
  const [a1, a2] = [(reach + least) / 2, (reach - least) / 2];
  const [s1, c1, s12, c12] = [Math.sin(q[0]), Math.cos(q[0]), Math.sin(q[0] + q[1]), Math.cos(q[0] + q[1])];
  const right = singularValues([[-a1 * s1 - a2 * s12, -a2 * s12], [a1 * c1 + a2 * c12, a2 * c12]]);
  (await halfAxes(page)).forEach((x, k) => close(x, [...right, 0][k], 6e-4, `half axis ${k}:`));
  const with_ = await pictureOf(page);
  assert.ok(differing(before, with_) > 0.002, "it is drawn");
  assert.equal(await part(page).locator(".lost li").count(), 0, "nothing is lost that the arm ever has");
  // Stretched out along x it cannot move along x, and the picture says it.
  const fields = ["q1", "q2"].map((name) => page.getByRole("textbox", { name: new RegExp(`^${name}\\b`) }));
  for (const field of fields) {
    await field.fill("0");
    await field.press("Enter");
  }
  await part(page).getByText("The hand cannot move along x.").waitFor();
  assert.equal((await halfAxes(page))[1], 0);
  // The switch in the tool bar is the same, and the address keeps it.
  await shared(page, (s) => s.look.ellipsoid === true, "it is in the address");
  await page.getByRole("toolbar", { name: "Scene" }).getByRole("button", { name: "Velocity ellipsoid" }).click();
  await part(page).getByText(/^Half axes/).waitFor({ state: "detached" });
});

scenario("a wrist that is singular: what is lost, and the joints that move with the hand still", async (page) => {
  const q = [0.3, -0.9, 0.4, 0.2, 0, 0.5];
  const { engine } = await openRobot(page, "puma560", { q });
  // The joints of the wrist turn against each other: checked by the forward model.
  await part(page).getByText(/the joints move in the ratio q4 : q6 = 1 : −1/).waitFor();
  const moved = handAt(engine, [q[0], q[1], q[2], q[3] + 0.3, q[4], q[5] - 0.3]);
  handAt(engine, q).forEach((row, r) => row.forEach((x, c) => close(x, moved[r][c], 1e-12)));
  // The equation holds for what every joint does: velocities by differences of the forward model.
  const words = await part(page).getByText(/^All that the hand can do obeys/).textContent();
  const coefficients = [0, 0, 0, 0, 0, 0];
  for (const [, sign, size, name] of /obeys (.*) = 0/.exec(words)[1].matchAll(/([−+]?)\s*([\d.]*)\s*([vω][xyz])/g)) {
    coefficients[["vx", "vy", "vz", "ωx", "ωy", "ωz"].indexOf(name)] = (sign === "−" ? -1 : 1) * (size === "" ? 1 : Number(size));
  }
  assert.ok(Math.max(...coefficients.map(Math.abs)) === 1, words);
  const h = 1e-5;
  q.forEach((_, j) => {
    const [a, b] = [-h, h].map((by) => handAt(engine, q.map((x, k) => (k === j ? x + by : x))));
    const m = handAt(engine, q);
    const rate = (r, c) => [0, 1, 2].reduce((sum, k) => sum + ((b[r][k] - a[r][k]) / 2 / h) * m[c][k], 0);
    const twist = [...[0, 1, 2].map((r) => (b[r][3] - a[r][3]) / 2 / h), rate(2, 1), rate(0, 2), rate(1, 0)];
    close(twist.reduce((sum, x, k) => sum + x * coefficients[k], 0), 0, 3e-3, `joint ${j + 1}:`);
  });
  await part(page).getByRole("button", { name: "Move them so" }).click();
  await page.getByRole("slider", { name: /along the curve/ }).first().waitFor();
  // Away from there nothing is lost.
  await tab(page, "Joints").click();
  const q5 = page.getByRole("textbox", { name: /^q5\b/ });
  await q5.fill("40");
  await q5.press("Enter");
  await until(async () => (await part(page).locator(".lost li, .still").count()) === 0, "nothing is lost");
});

scenario("an elbow that is stretched: the joints move without the hand at first, and there is no motion to go on with", async (page) => {
  const q = [0, -60, 0, 30, 60, 0].map(radians);
  const { engine } = await openRobot(page, "ur5", { q });
  const words = await part(page).getByText(/^At first the hand stands still/).textContent();
  const [, names, rates] = /ratio (.*) = (.*)\./s.exec(words);
  const moved = (by) => {
    const now = [...q];
    names.split(" : ").forEach((name, k) => (now[Number(name.trim().slice(1)) - 1] += by * read(rates.split(" : ")[k])));
    return Math.hypot(...handAt(engine, now).flatMap((row, r) => row.map((x, c) => x - handAt(engine, q)[r][c])));
  };
  const [near, far] = [moved(1e-3), moved(0.3)];
  assert.ok(near < 1e-5 && far > 1e-3, `not farther than to first order: ${words}: ${near}, ${far}`);
  await until(() => page.evaluate(() => window.denavit.frames > 3), "it is drawn");
  assert.equal(await part(page).getByRole("button", { name: "Move them so" }).count(), 0);
});

scenario("an arm with seven joints always has a motion without the hand", async (page) => {
  const { robot, engine } = await openRobot(page, "franka-panda");
  const words = await part(page).getByText(/the joints move in the ratio/).textContent();
  const [, names, rates] = /ratio (.*) = (.*?)\./s.exec(words.replace(/\s+Move them so$/, ".").replaceAll(/(\d)\.(\d)/g, "$1,$2"));
  const q = [...robot.q];
  const step = 1e-4;
  const [list, by] = [names.split(" : "), rates.split(" : ").map((x) => read(x.replace(",", ".")))];
  list.forEach((name, k) => (q[robot.joints.findIndex((joint) => joint.name === name.trim())] += step * by[k]));
  handAt(engine, robot.q).forEach((row, r) => row.forEach((x, c) => close(x, handAt(engine, q)[r][c], 3e-3 * step, "the hand stays")));
});

scenario("bars beside torques are as long as they are large", async (page) => {
  await openRobot(page, "ur5", { q: [0, radians(-30), radians(50), 0, 0.3, 0] });
  const rows = page.getByRole("region", { name: "Weight" }).locator("dl > div");
  const all = await rows.evaluateAll((list) => list.map((row) => [row.querySelector("dd").textContent, row.querySelector(".torque-bar span").style.left, row.querySelector(".torque-bar span").style.width]));
  const torques = all.map(([text]) => read(text.replace(/N.*/, "")));
  const most = Math.max(...torques.map(Math.abs));
  assert.ok(most > 1);
  all.forEach(([, left, width], k) => {
    close(read(width), (50 * Math.abs(torques[k])) / most, 0.5, `bar ${k + 1}`);
    if (Math.abs(torques[k]) > 0.05) assert.ok(torques[k] < 0 ? read(left) < 50 : Math.abs(read(left) - 50) < 1e-6, "to its side");
  });
});
