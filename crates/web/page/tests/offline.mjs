// Without a network: the page that is kept on a device, and the page that is a single file.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { cpSync, existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { kept } from "../pack.mjs";
import { serve } from "./site.mjs";
import { address, encode, ready, scenario, tab, until } from "./support.mjs";
import { robotOf } from "./engine.mjs";

const dist = new URL("../dist/", import.meta.url);
const page_ = fileURLToPath(new URL("../", import.meta.url));

// A tab asks for its icon past all that is kept.
scenario("a page that is kept opens without a network, with all parts of its engine", { expected: [/^request: /, /icon\.svg/, /ERR_FAILED/] }, async (page, surroundings) => {
  const site = await serve(null);
  try {
    await page.goto(site.url);
    await ready(page);
    await tab(page, "Share").click();
    await page.locator("summary", { hasText: "Without a network" }).click();
    await page.getByRole("button", { name: "Keep it on this device" }).click();
    await page.getByText(/it opens without a network/).waitFor();
    const manifest = await page.evaluate(async () => (await fetch(document.querySelector('link[rel="manifest"]').href)).json());
    assert.equal(manifest.display, "standalone");
    for (const { src } of manifest.icons) assert.ok(existsSync(new URL(src, dist)), src);

    await surroundings.setOffline(true);
    site.end();
    await page.goto(`${site.url}?robot=scara`);
    await ready(page);
    await tab(page, "Formulas").click();
    await page.locator(".document math").first().waitFor();
    await tab(page, "Check").click();
    await page.getByRole("button", { name: "Example" }).click();
    await page.locator(".claim").first().waitFor();
    // Let go again, it is gone.
    await tab(page, "Share").click();
    await page.getByRole("button", { name: "Keep it no longer" }).click();
    await page.getByRole("button", { name: "Keep it on this device" }).waitFor();
    assert.deepEqual(await page.evaluate(() => caches.keys()), []);
  } finally {
    site.end();
  }
});

scenario("under an address that is new each time nothing is kept", async (page) => {
  await page.route("**/0123456789abcdef0123456789abcdef/**", async (route) => {
    const url = new URL(route.request().url());
    await route.continue({ url: url.origin + url.pathname.replace("/0123456789abcdef0123456789abcdef", "") });
  });
  const { origin } = new URL(address());
  await page.goto(`${origin}/0123456789abcdef0123456789abcdef/`);
  await ready(page);
  await tab(page, "Share").click();
  await page.getByText(/while “denavit view” runs/).waitFor();
  assert.equal(await page.locator("summary", { hasText: "Without a network" }).count(), 0);
});

scenario("the files that are kept are called by what they contain", async () => {
  const folder = mkdtempSync(join(tmpdir(), "page-"));
  try {
    cpSync(dist, folder, { recursive: true });
    const name = (text) => /"(denavit-[0-9a-f]{16})"/.exec(text)[1];
    const own = readFileSync(new URL("sw.js", dist), "utf8");
    assert.equal(name(own), name(kept(folder)), "the same files have the same name");
    writeFileSync(join(folder, "style.css"), "body { color: red; }");
    assert.notEqual(name(own), name(kept(folder)), "others have another");
    const files = JSON.parse(/const FILES = (.*);/.exec(own)[1]);
    for (const file of ["index.html", "main.js", "worker.js", "denavit.wasm", "check.wasm"]) assert.ok(files.includes(file), file);
    for (const file of files) assert.ok(existsSync(new URL(file, dist)), file);
  } finally {
    rmSync(folder, { recursive: true });
  }
});

scenario("the page as a single file opens from a disk, solves, derives and writes a report", { expected: [/^request: /] }, async (page) => {
  execFileSync(process.execPath, ["build.mjs", "--single"], { cwd: page_ });
  const file = join(page_, "single/denavit.html");
  // Beside nothing: it has all that it needs.
  const folder = mkdtempSync(join(tmpdir(), "page-"));
  try {
    cpSync(file, join(folder, "denavit.html"));
    const subject = robotOf("puma560");
    const asked = [];
    page.on("request", (request) => /^(data|blob):/.test(request.url()) || asked.push(request.url()));
    await page.goto(pathToFileURL(join(folder, "denavit.html")).href + encode({ file: subject.file, q: subject.robot.q, panel: "hand" }));
    await ready(page);
    await until(async () => (await page.locator(".solution").count()) === 8, "there are eight solutions");
    await tab(page, "Formulas").click();
    await page.locator(".document math").first().waitFor();
    await page.evaluate(() => document.fonts.load('16px "Denavit Maths"'));
    assert.ok(await page.evaluate(() => document.fonts.check('16px "Denavit Maths"')), "with its letters");
    await tab(page, "Share").click();
    await page.getByText(/where the file of the page is/).waitFor();
    const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: "Save the report", exact: true }).click()]);
    assert.match(readFileSync(await download.path(), "utf8"), /data:font\/woff2;base64,d09GMg/, "a report with the font");
    assert.equal(asked.length, 1, `nothing but the file is asked for: ${asked}`);
  } finally {
    rmSync(folder, { recursive: true });
  }
});
