// The joints: steps by keys, typed values with units, limits, named poses.
import assert from "node:assert/strict";
import { close, degrees, farthest, openRobot, radians, scenario, shared, until, valueOf } from "./support.mjs";

const slider = (page, name) => page.getByRole("slider", { name: new RegExp(`^${name}\\b`) });
const field = (page, name) => page.getByRole("textbox", { name: new RegExp(`^${name}\\b`) });

async function shows(page, name, wanted) {
  let last;
  await until(async () => Math.abs((last = await valueOf(field(page, name))) - wanted) < 0.006, () => `${name} is ${wanted}, and not ${last}`);
}

scenario("arrow keys step a joint by 1°, with shift by 10°, with alt by 0.1°", async (page) => {
  const { robot } = await openRobot(page, "puma560");
  await slider(page, "q1").focus();
  await page.keyboard.press("ArrowRight");
  await shows(page, "q1", 1);
  await page.keyboard.press("Shift+ArrowUp");
  await shows(page, "q1", 11);
  await page.keyboard.press("Alt+ArrowRight");
  await shows(page, "q1", 11.1);
  await page.keyboard.press("ArrowDown");
  await shows(page, "q1", 10.1);
  await page.keyboard.press("PageDown");
  await shows(page, "q1", 0.1);
  await page.keyboard.press("End");
  await shows(page, "q1", degrees(robot.joints[0].limits[1]));
  assert.match(await slider(page, "q1").getAttribute("aria-valuetext"), /^160\.00°$/);
  await page.keyboard.press("ArrowRight");
  await shows(page, "q1", 160);
  const { q } = await shared(page, (s) => Math.abs(s.q[0] - radians(160)) < 1e-9, "q1 is at its limit");
  assert.ok(farthest(q.slice(1), robot.q.slice(1)) < 1e-9, "the other joints stay");
});

scenario("a prismatic joint steps by 1 mm and is typed in any unit of length", async (page) => {
  const { robot } = await openRobot(page, "scara");
  const at = robot.joints.findIndex((joint) => joint.kind === "P");
  const { name } = robot.joints[at];
  const first = 1000 * robot.q[at];
  await slider(page, name).focus();
  await page.keyboard.press("ArrowLeft");
  await shows(page, name, first - 1);
  await page.keyboard.press("Shift+ArrowRight");
  await shows(page, name, first + 9);
  await field(page, name).fill("0.125 m");
  await field(page, name).press("Enter");
  await shows(page, name, 125);
  await page.getByRole("button", { name: /Lengths in millimetres/ }).click();
  await shows(page, name, 0.125);
});

scenario("a joint is typed with its unit, and nonsense is refused", async (page) => {
  await openRobot(page, "puma560");
  const q2 = field(page, "q2");
  for (const [typed, wanted] of [["45 deg", 45], ["-pi/2", -90], ["0.5 rad", degrees(0.5)], ["12,5", 12.5], ["−30°", -30]]) {
    await q2.fill(typed);
    await q2.press("Enter");
    if (wanted < -45) await page.getByText("outside the limits").waitFor();
    await shows(page, "q2", wanted);
  }
  await q2.fill("forty");
  await q2.press("Enter");
  assert.equal(await q2.getAttribute("aria-invalid"), "true");
  await page.getByRole("alert").getByText(/not a number/).waitFor();
  await q2.fill("100 mm");
  await q2.press("Enter");
  await page.getByRole("alert").getByText(/a length; an angle is wanted/).waitFor();
  await q2.press("Escape");
  await shows(page, "q2", -30);
  assert.equal(await q2.getAttribute("aria-invalid"), null);
  const { q } = await shared(page, (s) => Math.abs(s.q[1] - radians(-30)) < 1e-9, "q2 is −30°");
  close(degrees(q[1]), -30, 1e-9);
  await page.getByRole("button", { name: /Angles in degrees/ }).click();
  await shows(page, "q2", -0.5236);
});

scenario("limits are flagged, poses are taken and saved, reset goes back", async (page) => {
  const { robot } = await openRobot(page, "puma560");
  const q1 = field(page, "q1");
  await q1.fill("200");
  await q1.press("Enter");
  const row = page.getByRole("listitem").filter({ has: slider(page, "q1") });
  await row.getByText("outside the limits").waitFor();
  assert.equal(await q1.getAttribute("aria-invalid"), "true");
  assert.equal(await page.getByText("outside the limits").count(), 1, "only this joint is");

  const ready = robot.poses.find((pose) => pose.name === "ready");
  await page.getByRole("button", { name: "ready", exact: true }).click();
  for (const [k, joint] of robot.joints.entries()) await shows(page, joint.name, degrees(ready.q[k]));
  assert.equal(await page.getByText("outside the limits").count(), 0);

  await page.getByRole("textbox", { name: "Name for this pose" }).fill("above the table");
  await page.getByRole("button", { name: "Save this pose" }).click();
  const saved = await shared(page, (s) => s.file.poses.length === robot.poses.length + 1, "the pose is in the file");
  assert.deepEqual(saved.file.poses.at(-1).name, "above the table");

  await page.getByRole("button", { name: "Random" }).click();
  const { q } = await shared(page, (s) => farthest(s.q, ready.q) > 1e-3, "the arm is anywhere");
  for (const [k, { limits }] of robot.joints.entries()) assert.ok(q[k] >= limits[0] && q[k] <= limits[1], "within its limits");
  await page.getByRole("button", { name: "Reset" }).click();
  for (const [k, joint] of robot.joints.entries()) await shows(page, joint.name, degrees(robot.q[k]));
  await page.getByRole("button", { name: "above the table" }).click();
  await shows(page, "q2", 90);
});

scenario("the gauge is empty where the arm is singular", async (page) => {
  const { robot } = await openRobot(page, "puma560");
  const gauge = page.getByRole("meter", { name: /Evenness/ });
  assert.ok(Number(await gauge.getAttribute("aria-valuenow")) > 0.03, "a regular configuration to begin with");
  assert.equal(await page.getByText(/near a singularity|Nearly singular/).count(), 0);
  // The wrist is singular where its outer axes are one: q5 = 0.
  await field(page, "q5").fill("0");
  await field(page, "q5").press("Enter");
  await until(async () => Number(await gauge.getAttribute("aria-valuenow")) < 1e-9, "the gauge is empty");
  await page.getByText("in a singularity").waitFor();
  await page.getByText("Singular", { exact: true }).waitFor();
  assert.ok(robot.q[4] !== 0);
});

scenario("undoing goes back to the joints that were, and never takes degrees for millimetres", async (page) => {
  const { robot: first } = await openRobot(page, "prrrrp");
  await page.getByRole("button", { name: "Robots", exact: true }).click();
  await page.getByRole("combobox").fill("puma560 craig");
  await page.keyboard.press("Enter");
  await page.locator("dialog").waitFor({ state: "detached" });
  await field(page, "q1").fill("33");
  await field(page, "q1").press("Enter");
  await shows(page, "q1", 33);
  await page.getByRole("button", { name: "Undo" }).click();
  await shows(page, "q1", 0);
  await page.getByRole("button", { name: "Undo" }).click();
  await shared(page, (s) => s.file.joints.length === first.rows && farthest(s.q, first.q) < 1e-9, "the first robot is back, with its own joints");
  await page.getByRole("button", { name: "Redo" }).click();
  await page.getByRole("button", { name: "Redo" }).click();
  await shows(page, "q1", 33);
});
