// Bad input: files that are no robots, cells full of nonsense, and an engine that stops.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { address, enter, open, openRobot, saysInStatus, scenario, shared, tab, until, valueOf } from "./support.mjs";

const cell = (page, name) => page.getByRole("textbox", { name, exact: true });
const named = (page, name) => page.getByRole("heading", { level: 1, name: `Denavit: ${name}`, exact: true });

async function openFile(page, name, content) {
  const [chooser] = await Promise.all([page.waitForEvent("filechooser"), page.getByRole("button", { name: "Open", exact: true }).click()]);
  await chooser.setFiles({ name, mimeType: "text/plain", buffer: Buffer.from(content) });
}

/** Files, and what is said of them. */
const FILES = [
  ["a diary", "diary.txt", "Dear diary, today I met a robot.", /no Denavit-Hartenberg table/],
  ["an empty file", "empty.toml", "", /\w{4}/],
  ["a broken robot file", "broken.toml", 'name = "x"\njoints = [[[', /Line 2/],
  ["a picture", "photo.csv", readFileSync(new URL("../dist/maths.woff2", import.meta.url)), /\w{4}/],
  ["a table without rows", "table.md", "| i | a | α | d | θ |\n|---|---|---|---|---|\n", /\w{4}/],
  ["1 MB of letters", "long.md", "x".repeat(1_500_000), /1500000 bytes|too (long|large)/],
];

scenario("files that are no robots get words, and the robot stays", async (page) => {
  await openRobot(page, "scara");
  for (const [what, name, content, words] of FILES) {
    await openFile(page, name, content);
    const dialog = page.getByRole("dialog");
    const alert = dialog.getByRole("alert");
    await alert.waitFor();
    assert.match(await alert.textContent(), words, what);
    await dialog.getByRole("button", { name: "Close" }).click();
    await dialog.waitFor({ state: "detached" });
    await named(page, "SCARA (generic)").waitFor();
  }
  await openFile(page, "huge.toml", "#".repeat(2_100_000));
  await saysInStatus(page, /larger than 2 MB/);
  assert.equal(await page.getByRole("dialog").count(), 0);
  await named(page, "SCARA (generic)").waitFor();
  await page.getByRole("slider").first().focus();
  await page.keyboard.press("ArrowRight");
  await shared(page, (s) => s.q[0] > 0.01, "the page works");
});

scenario("a saved robot is opened again, by the button and dropped, with its errors if it has some", async (page) => {
  const { file } = await openRobot(page, "puma560", { panel: "table" });
  await cell(page, "Name of the robot").fill("Kept");
  await named(page, "Kept").waitFor();
  const [download] = await Promise.all([page.waitForEvent("download"), page.keyboard.press("Control+s")]);
  assert.equal(download.suggestedFilename(), "kept.toml");
  const text = readFileSync(await download.path(), "utf8");

  await open(page);
  await openFile(page, "kept.toml", text);
  await named(page, "Kept").waitFor();
  await saysInStatus(page, /Opened kept\.toml/);
  const again = await shared(page, (s) => s.file.name === "Kept", "the file is there");
  assert.deepEqual(again.file, { ...file, name: "Kept" }, "nothing is lost on the way");

  const wrong = text.replace(/alpha = "[^"]*"/, 'alpha = "90 mm"');
  assert.notEqual(wrong, text);
  const drop = await page.evaluateHandle((words) => {
    const data = new DataTransfer();
    data.items.add(new File([words], "wrong.toml"));
    return data;
  }, wrong);
  await page.dispatchEvent("main", "dragover", { dataTransfer: drop });
  await page.getByText("Drop to open").waitFor();
  await page.dispatchEvent("main", "drop", { dataTransfer: drop });
  const mark = page.locator('[aria-invalid="true"], dialog [role=alert]').first();
  await mark.waitFor();
});

scenario("cells take any text without harm", async (page) => {
  const { robot } = await openRobot(page, "staubli-rx90", { panel: "table" });
  const theta = cell(page, "Row 2, theta");
  const findings = page.locator(".cell-findings");
  const nothing = () => until(async () => (await findings.count()) === 0, async () => `nothing is wrong, not even ${await findings.allTextContents()}`);
  for (const text of ["q2 +", "((((((((((", "q1*q2", "1/0", "1e999", "<script>alert(1)</script>", "\u202eq2", "q2 + 90 apples", "(".repeat(20_000), "q9"]) {
    await theta.fill(text);
    await until(async () => (await theta.getAttribute("aria-invalid")) === "true", `${text.slice(0, 30)} is refused`);
    const described = page.locator(`[id="${await theta.getAttribute("aria-describedby")}"]`);
    assert.ok((await described.textContent()).length > 8, `${text.slice(0, 30)} gets words`);
    await theta.fill("q2");
    await nothing();
    assert.equal(await theta.getAttribute("aria-invalid"), null);
  }
  await tab(page, "Hand").click();
  await until(async () => (await page.getByRole("region", { name: "Inverse solutions" }).getByRole("option").count()) === 8, `${robot.robot} is solved`);
});

/** Makes the engine beside the page stop at its next answer, as a trap does. */
function trap() {
  const { Instance } = WebAssembly;
  WebAssembly.Instance = function (module, imports) {
    const { exports } = new Instance(module, imports);
    const answer = () => {
      if (!window.stopEngine) return exports.answer();
      window.stopEngine = false;
      throw new WebAssembly.RuntimeError("unreachable");
    };
    return { exports: exports.answer ? { ...exports, answer } : exports };
  };
}

scenario("an engine that stops is said and replaced", { init: trap }, async (page) => {
  await openRobot(page, "staubli-rx90", { panel: "table" });
  await page.evaluate(() => (window.stopEngine = true));
  await cell(page, "Value of D3").fill("300 mm");
  await saysInStatus(page, /The engine stopped/);
  await cell(page, "Value of D3").fill("350 mm");
  await shared(page, (s) => s.file.parameters[0].value === "350 mm", "the next change is taken");
  await tab(page, "Joints").click();
  await enter(page.getByRole("textbox", { name: /^q1\b/ }), "20");
  await until(async () => (await valueOf(page.getByRole("textbox", { name: /^q1\b/ }))) === 20, "the joints move");
});

scenario("an engine that stops in its worker is said in the panel, and replaced", async (page) => {
  // The worker's script with a trap before it: the first derivation stops.
  await page.route("**/worker.js", async (route) => {
    const response = await route.fetch();
    const prelude = `{
      const { Instance } = WebAssembly;
      let left = 1;
      WebAssembly.Instance = function (module, imports) {
        const { exports } = new Instance(module, imports);
        const answer_more = () => {
          if (left-- > 0) throw new WebAssembly.RuntimeError("unreachable");
          return exports.answer_more();
        };
        return { exports: exports.answer_more ? { ...exports, answer_more } : exports };
      };
    }\n`;
    await route.fulfill({ response, body: prelude + (await response.text()) });
  });
  await openRobot(page, "staubli-rx90", { panel: "formulas" });
  await page.getByRole("alert").getByText(/engine stopped/).waitFor();
  await page.getByRole("tab", { name: "Links" }).click();
  await until(async () => (await page.locator("#topic-panel math").count()) > 3, "the next topic is derived");
  assert.equal(await page.getByRole("alert").count(), 0);
});

scenario("without the engine the page says so", { expected: [/denavit\.wasm/, /404/] }, async (page) => {
  await page.route("**/denavit.wasm", (route) => route.fulfill({ status: 404, body: "" }));
  await page.goto(address());
  await page.getByRole("alert").getByText(/The engine could not be loaded/).waitFor();
});
