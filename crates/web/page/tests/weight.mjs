// The weight of the arm: torques that hold it, and a fall that is played, plotted and saved.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { enter, open, openRobot, read, scenario, shared, tab, until } from "./support.mjs";

const weight = (page) => page.getByRole("region", { name: "Weight" });
const torque = async (page, joint) => {
  const row = weight(page).locator("dl > div", { hasText: joint });
  return read((await row.locator("dd").textContent()).replace(/ N.*/, ""));
};

scenario("torques follow the joints, and the arm falls", async (page) => {
  await openRobot(page, "ur5");
  await weight(page).getByText("its links count as bars of 1 kg a metre").waitFor();
  const field = page.getByRole("textbox", { name: /^q2\b/ });
  await enter(page.getByRole("textbox", { name: /^q3\b/ }), "0");
  await enter(field, "-90");
  await until(async () => Math.abs(await torque(page, "q2")) < 1, "upright it needs almost no torque");
  await enter(field, "0");
  await until(async () => Math.abs(await torque(page, "q2")) > 2, "stretched out it needs one");

  await page.getByRole("button", { name: "Let it fall" }).click();
  await page.getByRole("button", { name: /^(Play|Pause)$/ }).waitFor();
  await page.getByText("The arm falls from rest, nothing holds it.").waitFor();
  await page.getByText("Energies since the start: kinetic, potential").waitFor();
  const moved = await shared(page, (s) => s.panel === "path" && s.q.some((x, k) => k === 1 && Math.abs(x) > 0.05), "it moves");
  assert.ok(moved.q.every(Number.isFinite));
  const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "Save CSV" }).click()]);
  const [head, ...rows] = readFileSync(await download.path(), "utf8").trimEnd().split("\n").map((line) => line.split(","));
  const [kinetic, potential, lost] = ["kinetic", "potential", "lost"].map((name) => rows.map((row) => Number(row[head.indexOf(name)])));
  const most = Math.max(...kinetic);
  assert.ok(rows.length > 100 && most > 1, `${most} J`);
  kinetic.forEach((x, k) => assert.ok(Math.abs(x + potential[k] + lost[k]) < 1e-5 * most, `energy at ${rows[k][0]} s`));
});

scenario("a path of an arm with masses has torques", async (page) => {
  await open(page);
  const text =
    'name = "pendulum"\nconvention = "standard"\n[[joints]]\na = "1 m"\ntheta = "q1"\nmass = "2 kg"\ncom = ["-0.5 m", 0, 0]\ninertia = [0, 0, 0, 0, 0, 0]\nvelocity = "1 rad/s"\n[base]\nrpy = ["90 deg", 0, 0]\n';
  const [chooser] = await Promise.all([page.waitForEvent("filechooser"), page.getByRole("button", { name: "Open", exact: true }).click()]);
  await chooser.setFiles({ name: "pendulum.toml", mimeType: "text/plain", buffer: Buffer.from(text) });
  await tab(page, "Joints").click();
  await weight(page).getByText("By the masses of the robot: 2 kg move.").waitFor();
  const field = page.getByRole("textbox", { name: /^q1\b/ });
  await enter(field, "0");
  await until(async () => Math.abs((await torque(page, "q1")) - 9.81) < 0.006, "half a metre, two kilograms");
  await tab(page, "Path").click();
  await tab(page, "Joints").click();
  await enter(field, "60");
  await tab(page, "Path").click();
  await page.getByRole("button", { name: "Add joints" }).click();
  await page.getByRole("button", { name: /^Plan/ }).click();
  await page.getByText("Joint torques").waitFor();
});
