// The table: cells that are right and wrong, undoing, conventions, parameters, tables from documents.
import assert from "node:assert/strict";
import { apart, handAt, robotIn } from "./engine.mjs";
import { differing, pictureOf } from "./pixels.mjs";
import { close, encode, open, openRobot, radians, read, saysInStatus, scenario, shared, tab, until, valueOf } from "./support.mjs";

/** The hand of the RX-90 with q1 = 0, millimetres: t14 = C1 (C2 D3 − S23 RL4), t34 = S2 D3 + C23 RL4 (Khalil and Dombre, 2.5). */
function handOfRx90([, q2, q3], d3, rl4) {
  return [Math.cos(q2) * d3 - Math.sin(q2 + q3) * rl4, 0, Math.sin(q2) * d3 + Math.cos(q2 + q3) * rl4];
}

/** Where the scene says that the hand is, once it says so: millimetres. */
async function handIs(page, wanted, words) {
  let last;
  const isThere = async () => {
    const label = await page.locator("canvas.scene-canvas").getAttribute("aria-label");
    last = ["x", "y", "z"].map((axis) => read(new RegExp(`Hand at.*?\\b${axis} (\\S+) mm`).exec(label)?.[1] ?? "NaN"));
    return last.every((x, k) => Math.abs(x - wanted[k]) < 0.06);
  };
  await until(isThere, () => `${words}: the hand is at ${wanted}, and not at ${last}`);
}

const cell = (page, name) => page.getByRole("textbox", { name, exact: true });

scenario("a cell moves the arm, a wrong one keeps it, and both can be undone", async (page) => {
  const { robot } = await openRobot(page, "staubli-rx90", { panel: "table" });
  const d3 = cell(page, "Row 3, d");
  await d3.focus();
  await handIs(page, handOfRx90(robot.q, 450, 450), "at first");
  const before = await pictureOf(page);

  await d3.fill("300 mm");
  await handIs(page, handOfRx90(robot.q, 300, 450), "after the cell");
  const after = await pictureOf(page);
  assert.ok(differing(before, after) > 0.005, "the picture follows the cell");

  // Wrong: the words stand in the row beneath, the arm stays.
  await d3.fill("300 mm +");
  await until(async () => (await d3.getAttribute("aria-invalid")) === "true", "the cell is marked");
  const words = page.locator(`[id="${await d3.getAttribute("aria-describedby")}"]`);
  assert.match(await words.textContent(), /\w{3}/);
  const [own, beneath] = [await d3.boundingBox(), await words.boundingBox()];
  assert.ok(beneath.y >= own.y + own.height - 1, "the error stands under its cell");
  const note = page.getByText("The table has an error: this is the last arm without one.");
  await note.waitFor();
  await page.getByRole("tab", { name: /Table.*has errors/ }).waitFor();
  assert.ok(differing(after, await pictureOf(page)) < 0.03, "the last good picture stays");
  await handIs(page, handOfRx90(robot.q, 300, 450), "with an error");

  // Right again.
  await d3.fill("300 mm + 100 mm");
  await until(async () => (await d3.getAttribute("aria-invalid")) === null, "the mark is gone");
  await note.waitFor({ state: "detached" });
  assert.equal(await page.locator(".cell-findings").count(), 0);
  await handIs(page, handOfRx90(robot.q, 400, 450), "after the correction");

  // All that was typed in one stay is one step.
  await cell(page, "Row 1, theta").focus();
  await page.getByRole("button", { name: "Undo" }).click();
  assert.equal(await d3.inputValue(), "D3");
  await handIs(page, handOfRx90(robot.q, 450, 450), "after undoing");
  await page.keyboard.press("Control+y");
  assert.equal(await d3.inputValue(), "300 mm + 100 mm");
  await handIs(page, handOfRx90(robot.q, 400, 450), "after redoing");
  await page.keyboard.press("Control+z");
  assert.equal(await d3.inputValue(), "D3");
});

scenario("a parameter's value, a joint's offset, a row more and a row less", async (page) => {
  const { robot } = await openRobot(page, "staubli-rx90", { panel: "table" });
  await cell(page, "Value of RL4").fill("60 cm");
  await handIs(page, handOfRx90(robot.q, 450, 600), "after the parameter");
  await cell(page, "Row 2, theta").fill("q2 - 15 deg");
  const turned = [0, robot.q[1] - radians(15), robot.q[2]];
  await handIs(page, handOfRx90(turned, 450, 600), "after the offset");

  await cell(page, "Row 6, theta").focus();
  await page.getByRole("group", { name: "Rows" }).getByRole("button", { name: "Prismatic" }).click();
  await tab(page, "Joints").click();
  const sliders = page.getByRole("tabpanel", { name: "Joints" }).getByRole("slider");
  await until(async () => (await sliders.count()) === 7, "there are seven joints");
  await tab(page, "Table").click();
  await page.getByRole("button", { name: "Remove row 7" }).click();
  await saysInStatus(page, /Row 7 is gone/);
  await tab(page, "Joints").click();
  await until(async () => (await sliders.count()) === 6, "there are six joints again");
});

scenario("converting keeps the arm, reading the cells so changes it", async (page) => {
  const { engine, robot } = await openRobot(page, "staubli-rx90", { panel: "table" });
  await handIs(page, handOfRx90(robot.q, 450, 450), "before");
  const before = await pictureOf(page);
  const choice = page.getByRole("combobox", { name: "Convention" });
  await choice.selectOption("standard");
  await page.getByRole("button", { name: "Convert the table" }).click();
  await page.getByText("Proved: both tables give the same pose").waitFor();
  const { file, q } = await shared(page, (s) => s.file.convention === "standard", "the table is standard");
  const other = robotIn(file);
  for (const at of [q, [0.3, -0.8, 1.1, 2, -0.7, 0.4], [-2, 0.5, -1.3, 0.2, 1.9, -1]]) {
    assert.ok(apart(handAt(engine, at), handAt(other.engine, at)) < 1e-12, `the same pose at ${at}`);
  }
  await handIs(page, handOfRx90(robot.q, 450, 450), "after");
  // The frames stand elsewhere now, the arm does not.
  assert.ok(differing(before, await pictureOf(page)) < 0.25);

  await choice.selectOption("craig");
  await page.getByRole("button", { name: "Read these cells so" }).click();
  const read = await shared(page, (s) => s.file.convention === "craig", "the cells are read so");
  assert.ok(apart(handAt(engine, q), handAt(robotIn(read.file).engine, q)) > 0.01, "the same cells are another arm");
  await page.getByRole("button", { name: "Undo" }).click();
  await page.getByRole("button", { name: "Undo" }).click();
  assert.equal(await choice.inputValue(), "khalil");
});

scenario("a bare number means what the page shows, and says so", async (page) => {
  const { robot } = await openRobot(page, "staubli-rx90", { panel: "table" });
  const [d3, theta] = [cell(page, "Row 3, d"), cell(page, "Row 2, theta")];
  await d3.fill("300");
  await handIs(page, handOfRx90(robot.q, 300, 450), "while it is typed");
  assert.equal(await d3.inputValue(), "300", "nobody writes into the cell while somebody types");
  await d3.press("Enter");
  assert.equal(await d3.inputValue(), "300 mm");
  await theta.fill("q2 - 15");
  await theta.blur();
  assert.equal(await theta.inputValue(), "q2 - 15 deg");
  await handIs(page, handOfRx90([0, robot.q[1] - radians(15), robot.q[2]], 300, 450), "degrees");
  // The cells keep what they mean when the page shows other units.
  await page.getByRole("button", { name: /Lengths in millimetres/ }).click();
  await page.getByRole("button", { name: /Angles in degrees/ }).click();
  assert.equal(await d3.inputValue(), "300 mm");
  for (const [typed, wanted] of [["0,35", "0.35 m"], ["1/4", "(1/4) m"], ["-0.5 + RL4", "-0.5 m + RL4"], ["2*RL4", "2*RL4"], ["0", "0"]]) {
    await d3.fill(typed);
    await d3.press("Enter");
    assert.equal(await d3.inputValue(), wanted);
  }
  await theta.fill("q2 + pi/4");
  await theta.blur();
  assert.equal(await theta.inputValue(), "q2 + pi/4");
  // One step takes back a number with its unit.
  for (let k = 0; k < 8; k++) await page.getByRole("button", { name: "Undo" }).click();
  assert.equal(await theta.inputValue(), "q2");
  assert.equal(await d3.inputValue(), "D3");
  await page.getByRole("button", { name: "Redo" }).click();
  assert.equal(await d3.inputValue(), "300 mm");
});

scenario("numbers of a file without units are shown with them", async (page) => {
  const { file } = await openRobot(page, "staubli-rx90", { panel: "table" });
  const bare = { ...file, joints: file.joints.map((row, k) => (k === 2 ? { ...row, d: "0.3", alpha: "-1.5" } : row)) };
  await open(page, encode({ file: bare, panel: "table" }));
  await until(async () => (await cell(page, "Row 3, d").inputValue()) === "0.3 m", "metres");
  assert.equal(await cell(page, "Row 3, alpha").inputValue(), "-1.5 rad");
});

scenario("a new name in a cell becomes a parameter, and undoing takes both back", async (page) => {
  await openRobot(page, "scara", { panel: "table" });
  const a = cell(page, "Row 1, a");
  await a.fill("L7 + phi");
  await until(async () => (await a.getAttribute("aria-invalid")) === "true", "while it is typed nobody knows it");
  await page.locator(".cell-findings").getByText(/L7 becomes a parameter when the cell is left/).waitFor();
  await a.fill("L7");
  await a.press("Enter");
  await until(async () => (await a.getAttribute("aria-invalid")) === null, "it is known");
  await saysInStatus(page, /L7 is a new parameter/);
  await page.getByText(/No values are known for some parameters\. .*L7 = /).waitFor();
  await cell(page, "Value of L7").fill("250");
  await cell(page, "Value of L7").press("Enter");
  assert.equal(await cell(page, "Value of L7").inputValue(), "250 mm");
  const { file } = await shared(page, (s) => s.file.parameters.some(({ name, value }) => name === "L7" && value === "250 mm"), "it has its value");
  assert.equal(file.joints[0].a, "L7");
  await page.getByRole("button", { name: "Undo" }).click();
  await page.getByRole("button", { name: "Undo" }).click();
  assert.equal(await a.inputValue(), "a1");
  assert.equal(await page.getByRole("textbox", { name: "Value of L7" }).count(), 0);
  // A unit is no name, and the variable of no joint neither.
  for (const text of ["mm", "q9", "theta1"]) {
    await a.fill(text);
    await a.press("Enter");
    await until(async () => (await a.getAttribute("aria-invalid")) === "true", `${text} is refused`);
  }
});

/** Three parallel and perpendicular axes, with whole numbers for the hand. */
const DOCUMENT = `| i | a | α | d | θ |
|---|---|---|---|---|
| 1 | 0 | 90° | 0.3 | θ1 |
| 2 | 0.5 | 0 | 0 | θ2 |
| 3 | 0.4 | 0 | 0 | θ3 |`;

async function paste(page, text) {
  await page.keyboard.press("Control+k");
  await page.getByRole("tab", { name: "Paste or open" }).click();
  await page.getByRole("textbox", { name: /A table, as it stands in a document/ }).fill(text);
  await page.getByRole("button", { name: "Read the table" }).click();
}

/** The pose of the pasted arm where all joints are zero. */
async function straighten(page) {
  await tab(page, "Joints").click();
  for (const name of ["q1", "q2", "q3"]) {
    const field = page.getByRole("textbox", { name: new RegExp(`^${name}\\b`) });
    await field.fill("0");
    await field.press("Enter");
    await until(async () => (await valueOf(field)) === 0, `${name} is 0`);
  }
}

scenario("a table from a document: the convention is asked for where it is not said", async (page) => {
  await open(page);
  await paste(page, DOCUMENT);
  await page.getByRole("alert").getByText(/convention is not said/).waitFor();
  const choice = page.getByRole("dialog").getByRole("combobox", { name: "Convention" });
  await until(async () => (await choice.getAttribute("aria-invalid")) === "true", "the choice is marked");
  await choice.selectOption("standard");
  await page.getByRole("button", { name: "Read the table" }).click();
  await page.getByRole("dialog").waitFor({ state: "detached" });
  assert.equal(await cell(page, "Row 2, a").inputValue(), "0.5 m");
  await straighten(page);
  // Rz·Tz·Tx·Rx: two links of 0.5 and 0.4 m in a vertical plane above a column of 0.3 m.
  await handIs(page, [900, 0, 300], "in the standard convention");

  await paste(page, `convention: craig\n\n${DOCUMENT}`);
  await page.getByRole("dialog").waitFor({ state: "detached" });
  assert.equal(await page.getByRole("combobox", { name: "Convention" }).inputValue(), "craig");
  await straighten(page);
  // Rx·Tx·Rz·Tz: d along the z turned by 90° about x, which is −y.
  await handIs(page, [900, -300, 0], "in Craig's convention");
  await tab(page, "Hand").click();
  close(await valueOf(page.getByRole("textbox", { name: "Position x" })), 900, 0.006);
});
