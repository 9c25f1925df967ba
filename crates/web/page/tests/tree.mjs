// URDF and xacro: opened as a file, a folder, a zip and a pasted text; chains of them are chosen.
import assert from "node:assert/strict";
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { strToU8, zipSync } from "fflate";
import { Engine } from "./engine.mjs";
import { open, openRobot, saysInStatus, scenario, shared, tab, until } from "./support.mjs";

const named = (page, name) => page.getByRole("heading", { level: 1, name: `Denavit: ${name}`, exact: true });
const chain = (page) => page.getByRole("region", { name: /^Chain of / });

const joint = (name, from, to, xyz) =>
  `<joint name="${name}" type="revolute"><parent link="${from}"/><child link="${to}"/><origin xyz="${xyz}" rpy="1.5708 0 0"/>` +
  `<axis xyz="0 0 1"/><limit lower="-1" upper="2" velocity="3" effort="1"/></joint>\n`;

/** Two arms on one trunk, of two joints each; the right one with a third where `hand` is. */
function pair(hand) {
  const links = ["trunk", "l1", "l2", "r1", "r2", ...(hand ? ["r3"] : [])].map((name) => `<link name="${name}"/>`).join("");
  const left = joint("left_shoulder", "trunk", "l1", "0 0.3 0") + joint("left_elbow", "l1", "l2", "0.4 0 0");
  const right = joint("right_shoulder", "trunk", "r1", "0 -0.3 0") + joint("right_elbow", "r1", "r2", "0.4 0 0");
  return `<?xml version="1.0"?>\n<robot name="pair">${links}\n${left}${right}${hand ? joint("right_hand", "r2", "r3", "0.3 0 0") : ""}</robot>`;
}

const ARM = `<robot xmlns:xacro="http://www.ros.org/wiki/xacro">
<xacro:macro name="arm" params="prefix length">
  <link name="\${prefix}base"/><link name="\${prefix}tip"/>
  <joint name="\${prefix}turn" type="continuous"><parent link="\${prefix}base"/><child link="\${prefix}tip"/>
    <origin xyz="\${length} 0 0" rpy="\${radians(90)} 0 0"/></joint>
</xacro:macro></robot>`;
const MAIN = `<robot name="made" xmlns:xacro="http://www.ros.org/wiki/xacro">
<xacro:arg name="length" default="0.5"/>
<xacro:include filename="$(find my_arm)/urdf/arm.xacro"/><xacro:arm prefix="a_" length="$(arg length)"/></robot>`;
const FILES = {
  "ws/folder/package.xml": "<package><name>my_arm</name></package>",
  "ws/folder/urdf/arm.xacro": ARM,
  "ws/folder/urdf/made.urdf.xacro": MAIN,
};

async function choose(page, button, files) {
  const [chooser] = await Promise.all([page.waitForEvent("filechooser"), button.click()]);
  await chooser.setFiles(files);
}

const file = (name, content) => ({ name, mimeType: "application/octet-stream", buffer: Buffer.from(content) });
const openButton = (page) => page.getByRole("button", { name: "Open", exact: true });

scenario("a URDF is opened: its chain is the robot, another one is chosen, and taken back", async (page) => {
  await openRobot(page, "scara");
  await choose(page, openButton(page), file("pair.urdf", pair(true)));
  await named(page, "pair").waitFor();
  await saysInStatus(page, /Opened pair\.urdf: from trunk to r3, 3 joints; its table is proved/);
  await tab(page, "Joints").click();
  const sliders = page.getByRole("tabpanel", { name: "Joints" }).getByRole("slider");
  assert.deepEqual(await sliders.evaluateAll((all) => all.map((one) => one.getAttribute("aria-label"))), ["q1 (right_shoulder)", "q2 (right_elbow)", "q3 (right_hand)"]);
  // What the engine says of the same text.
  const { file: table } = new Engine().call("tree", { name: "pair.urdf", text: pair(true) });
  const held = await shared(page, (s) => s.file.name === "pair", "the address holds the table");
  assert.deepEqual(held.file, table);

  await chain(page).getByRole("combobox", { name: "To", exact: true }).selectOption("l2");
  await until(async () => (await sliders.count()) === 2, "the left arm has two joints");
  assert.match(await chain(page).textContent(), /From trunk to l2, 2 joints/);
  await chain(page).getByRole("combobox", { name: "From", exact: true }).selectOption("r2");
  await until(async () => (await sliders.count()) === 4, "from hand to hand there are four");
  // A chain without joints is said, and the robot stays.
  await chain(page).getByRole("combobox", { name: "To", exact: true }).selectOption("r2");
  await saysInStatus(page, /No joint moves between/);
  assert.equal(await sliders.count(), 4);
  await page.keyboard.press("Control+z");
  await until(async () => (await sliders.count()) === 2, "the chain before comes back");
  assert.equal(await chain(page).getByRole("combobox", { name: "To", exact: true }).inputValue(), "l2");
  // A table that was changed is no chain of the file any more.
  await tab(page, "Table").click();
  await page.getByRole("textbox", { name: "Row 1, d", exact: true }).fill("0.123");
  await until(async () => (await chain(page).count()) === 0, "the tree is gone");
});

scenario("where several links may be the tip the page asks", async (page) => {
  await openRobot(page, "scara");
  await choose(page, openButton(page), file("pair.urdf", pair(false)));
  const dialog = page.getByRole("dialog");
  const tip = dialog.getByRole("combobox", { name: "To", exact: true });
  await tip.waitFor();
  assert.match(await dialog.getByRole("alert").first().textContent(), /several tips: l2, r2/);
  const take = dialog.getByRole("button", { name: "Take this chain" });
  assert.equal(await take.getAttribute("aria-disabled"), "true");
  await named(page, "SCARA (generic)").waitFor();
  await tip.selectOption("r2");
  await dialog.getByText(/From trunk to r2, 2 joints/).waitFor();
  await dialog.getByLabel("Convention").selectOption("craig");
  await until(async () => (await take.getAttribute("aria-disabled")) === null, "it can be taken");
  await take.click();
  await dialog.waitFor({ state: "detached" });
  const held = await shared(page, (s) => s.file.name === "pair", "the robot is there");
  assert.equal(held.file.convention, "craig");
});

scenario("a zip and a folder bring what xacro includes", async (page) => {
  await openRobot(page, "scara");
  const zip = zipSync(Object.fromEntries(Object.entries(FILES).map(([path, text]) => [path, strToU8(text)])));
  await choose(page, openButton(page), file("robot.zip", zip));
  await named(page, "made").waitFor();
  await tab(page, "Table").click();
  const length = () => page.getByRole("group", { name: "Base" }).getByRole("textbox").evaluateAll((all) => all.map((one) => one.value));
  const before = await shared(page, (s) => s.file.name === "made", "the robot is there");
  assert.equal(before.file.joints.length, 1, await length());

  // With an argument for xacro it is another robot.
  await chain(page).getByRole("button", { name: "Its file …" }).click();
  const dialog = page.getByRole("dialog");
  await dialog.getByLabel("Arguments of xacro").fill("length:=0.75");
  await dialog.getByRole("button", { name: "Take this chain" }).click();
  await dialog.waitFor({ state: "detached" });
  await shared(page, (s) => JSON.stringify(s.file).includes("0.75"), "the argument counts");

  const top = mkdtempSync(join(tmpdir(), "denavit-page-"));
  try {
    for (const [path, text] of Object.entries(FILES)) {
      mkdirSync(dirname(join(top, path)), { recursive: true });
      writeFileSync(join(top, path), text.replace('name="made"', 'name="from a folder"'));
    }
    await page.getByRole("button", { name: /choose another robot/ }).click();
    await page.getByRole("tab", { name: "URDF, xacro" }).click();
    await choose(page, page.getByRole("button", { name: "Open a folder" }), join(top, "ws"));
    await named(page, "from a folder").waitFor();
    assert.equal(await page.getByRole("dialog").count(), 0);
  } finally {
    rmSync(top, { recursive: true });
  }
});

scenario("what is wrong in a URDF is said with its place, and a pasted one is recognised", async (page) => {
  await openRobot(page, "scara");
  await choose(page, openButton(page), file("wrong.urdf", '<robot name="x">\n <link name="a"/>\n <link name="a"/>\n</robot>'));
  const dialog = page.getByRole("dialog");
  await dialog.getByRole("alert").first().waitFor();
  assert.match(await dialog.getByRole("alert").first().textContent(), /Line 3, column 2: The link a is given twice/);
  await dialog.getByRole("button", { name: "Close" }).click();
  await named(page, "SCARA (generic)").waitFor();

  // One file alone of several.
  await choose(page, openButton(page), file("made.urdf.xacro", MAIN));
  await dialog.getByRole("alert").first().waitFor();
  assert.match(await dialog.textContent(), /my_arm/);
  await dialog.getByRole("button", { name: "Close" }).click();

  for (const [name, content] of [["broken.zip", "PK no zip"], ["empty.zip", zipSync({ "a/readme.md": strToU8("hello") })]]) {
    await choose(page, openButton(page), file(name, content));
    await saysInStatus(page, /zip|description of a robot/i);
    assert.equal(await page.getByRole("dialog").count(), 0);
  }

  await page.getByRole("button", { name: /choose another robot/ }).click();
  await page.getByRole("tab", { name: "Paste or open" }).click();
  await page.getByRole("textbox", { name: /A table, as it stands/ }).fill(`<!-- from afar -->\n${pair(true).replace('<?xml version="1.0"?>\n', "")}`);
  await page.getByRole("button", { name: "Read the table" }).click();
  await named(page, "pair").waitFor();
  await until(async () => (await page.getByRole("dialog").count()) === 0, "the dialog goes");
});
