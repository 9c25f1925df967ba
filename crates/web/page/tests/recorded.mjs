// Recorded motion: held against the robot, played, solved; from CSV and from Parquet.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { parquetWriteBuffer } from "hyparquet-writer";
import { apart, handAt } from "./engine.mjs";
import { farthest, openRobot, saysInStatus, scenario, shared, until } from "./support.mjs";

/** Columns of a UR5's motion: time, joints, position and quaternion of the hand. */
function motion({ engine, robot }, rows = 120) {
  const columns = Object.fromEntries(["t", "q1", "q2", "q3", "q4", "q5", "q6", "x", "y", "z", "qx", "qy", "qz", "qw"].map((name) => [name, []]));
  const start = [0.2, -1.4, 1.3, -0.6, 1.1, 0.4];
  let last = null;
  for (let k = 0; k < rows; k++) {
    const t = k / 25;
    const q = start.map((x, i) => x + 0.4 * Math.sin(0.7 * t + i) + 0.2 * Math.sin(1.1 * t + 3 * i + 1));
    const pose = handAt(engine, q);
    let turn = quaternion(pose);
    if (last && turn.reduce((sum, x, i) => sum + x * last[i], 0) < 0) turn = turn.map((x) => -x);
    last = turn;
    const values = [t, ...q, pose[0][3], pose[1][3], pose[2][3], ...turn];
    Object.keys(columns).forEach((name, i) => columns[name].push(values[i]));
  }
  assert.equal(robot.joints.length, 6);
  return columns;
}

/** x, y, z, w of a pose. */
function quaternion([[a, b, c], [d, e, f], [g, h, i]]) {
  const squares = [1 + a - e - i, 1 - a + e - i, 1 - a - e + i, 1 + a + e + i];
  const k = squares.indexOf(Math.max(...squares));
  const s = Math.sqrt(squares[k]) / 2;
  const all = [
    [s, (b + d) / (4 * s), (c + g) / (4 * s), (h - f) / (4 * s)],
    [(b + d) / (4 * s), s, (f + h) / (4 * s), (c - g) / (4 * s)],
    [(c + g) / (4 * s), (f + h) / (4 * s), s, (d - b) / (4 * s)],
    [(h - f) / (4 * s), (c - g) / (4 * s), (d - b) / (4 * s), s],
  ];
  return all[k];
}

function csv(columns) {
  const names = Object.keys(columns);
  return [names.join(","), ...columns.t.map((_, k) => names.map((name) => columns[name][k]).join(","))].join("\n");
}

async function drop(page, name, bytes) {
  const data = await page.evaluateHandle(([called, base64]) => {
    const transfer = new DataTransfer();
    transfer.items.add(new File([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))], called));
    return transfer;
  }, [name, Buffer.from(bytes).toString("base64")]);
  await page.dispatchEvent("main", "dragover", { dataTransfer: data });
  await page.dispatchEvent("main", "drop", { dataTransfer: data });
}

const part = (page) => page.getByRole("region", { name: "Recording" });
const offAt = (page, plot) => page.getByRole("slider", { name: `Time, on the plot of ${plot}` }).getAttribute("aria-valuetext");

scenario("a recording with a slip is named, undone, played, and its hand solved", async (page) => {
  const subject = await openRobot(page, "ur5", { panel: "joints" });
  const columns = motion(subject);
  const slipped = { ...columns, q3: columns.q3.map((x) => -x) };
  await drop(page, "run.csv", Buffer.from(csv(slipped)));
  await part(page).getByText("1 finding.").waitFor();
  await part(page).getByText(/q3: the sign is reversed/i).waitFor();

  // Undone: the arm stands where it was, and the hand is off by nothing.
  const at = (k) => [1, 2, 3, 4, 5, 6].map((i) => columns[`q${i}`][k]);
  await shared(page, (s) => farthest(s.q, at(0)) < 1e-3, "the arm is at the first row");
  await part(page).getByText("But for rounding the hand is where the joints say.").waitFor();
  await page.getByRole("radio", { name: "as the columns stand" }).check({ force: true });
  await shared(page, (s) => Math.abs(s.q[2] + columns.q3[0]) < 1e-3, "the arm is where the column says");
  assert.match(await offAt(page, "position off"), /distance \d{2,}\.\d\d mm/);
  await page.getByRole("radio", { name: "with all of it undone" }).check({ force: true });
  await shared(page, (s) => farthest(s.q, at(0)) < 1e-3, "and back");

  // Played and held.
  await page.getByRole("button", { name: "Play", exact: true }).click();
  const slider = page.getByRole("slider", { name: "Time on the path" });
  await until(async () => Number(await slider.inputValue()) > 0.1, "time goes on");
  await slider.focus();
  await page.keyboard.press("PageUp");
  const seconds = Number(await slider.inputValue());
  const row = Math.floor(seconds * 25 + 1e-6);
  await shared(page, (s) => farthest(s.q, at(row)) < 0.05, "the arm is at that row");

  // What is undone is saved, and clean.
  const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "Save it undone" }).click()]);
  const text = readFileSync(await download.path());
  assert.match(text.toString(), /^t/);

  // All configurations for the hand that was recorded.
  await page.getByRole("button", { name: "Solve the recorded hand" }).click();
  await until(async () => (await page.getByRole("region", { name: "Inverse solutions" }).getByRole("option").count()) === 8, "eight solutions");
  const s = await shared(page, (one) => farthest(one.q, at(row)) < 0.05, "the arm follows the nearest one");
  assert.ok(apart(handAt(subject.engine, s.q), handAt(subject.engine, at(row))) < 0.05);

  await drop(page, "again.csv", text);
  await part(page).getByText("Nothing is wrong with it.").waitFor();
  await page.getByRole("button", { name: "Close" }).click();
  await until(async () => (await part(page).count()) === 0, "it is forgotten");
});

scenario("a recording in Parquet, and files that are none", async (page) => {
  const subject = await openRobot(page, "ur5", { panel: "check" });
  const columns = motion(subject);
  const degrees = Object.entries(columns).map(([name, values]) => ({ name: /^q\d$/.test(name) ? `${name} [deg]` : name, data: /^q\d$/.test(name) ? values.map((x) => (x * 180) / Math.PI) : values }));
  const written = new Uint8Array(parquetWriteBuffer({ columnData: [...degrees, { name: "note", data: columns.t.map(() => "a word") }] }));
  await drop(page, "run.parquet", written);
  await part(page).getByText("Nothing is wrong with it.").waitFor();
  await part(page).getByText(/Left out, for they are no numbers: note/).waitFor();
  // Cut in the middle: refused in words, and the page goes on.
  await drop(page, "cut.parquet", written.subarray(0, written.length >> 1));
  await saysInStatus(page, /./);
  // Joints are missing: told with what would help.
  const { q5, q6, ...few } = columns;
  assert.equal(q5.length, q6.length);
  await drop(page, "few.csv", Buffer.from(csv(few)));
  await part(page).getByRole("alert").waitFor();
  await drop(page, "run.parquet", written);
  await part(page).getByText("Nothing is wrong with it.").waitFor();
});
