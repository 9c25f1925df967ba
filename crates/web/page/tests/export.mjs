// What is taken away as a file: report, source code, figures, the picture. The path's numbers are in path.mjs.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { crc32, decodeZip } from "./unzip.mjs";
import { decodePng, drawn } from "./pixels.mjs";
import { openRobot, scenario } from "./support.mjs";

async function saved(page, button, pattern) {
  const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name: button, exact: true }).click()]);
  assert.match(download.suggestedFilename(), pattern);
  return readFileSync(await download.path());
}

const section = (page, name) => page.locator("summary", { hasText: new RegExp(`^${name}$`) });

scenario("the report as HTML holds formulas, figures and the font, and nothing from elsewhere", async (page, context) => {
  await openRobot(page, "staubli-rx90", { panel: "share" });
  const html = (await saved(page, "Save the report", /^staubli-rx-?90-report\.html$/)).toString();
  assert.ok(html.startsWith("<!DOCTYPE html>") || html.startsWith("<!doctype html>"));
  assert.ok((html.match(/<math/g) ?? []).length > 50, "formulas");
  assert.ok((html.match(/<svg/g) ?? []).length >= 2, "figures");
  const font = /url\(["']?data:font\/woff2;base64,([A-Za-z0-9+/=]+)/.exec(html)?.[1];
  assert.equal(Buffer.from(font ?? "", "base64").subarray(0, 4).toString(), "wOF2", "the font itself");
  assert.ok(!/\bFONT\b/.test(html), "no placeholder is left");

  const report = await context.newPage();
  await report.route("**/*", (route) => route.abort());
  await report.setContent(html);
  assert.ok(await report.evaluate(async () => (await document.fonts.load('16px "Denavit Maths"')).length > 0), "the font can be used");
  assert.match(await report.title(), /Stäubli RX-90/);

  await page.getByRole("radio", { name: "Français" }).check();
  await page.getByRole("combobox", { name: "Format of the report" }).selectOption("markdown");
  const markdown = decodeZip(await saved(page, "Save the report", /\.zip$/));
  assert.ok([...markdown].some(([name, text]) => name.endsWith("report.md") && /modèle/i.test(text)), "in French");
  assert.ok([...markdown.keys()].some((name) => name.endsWith(".svg")), "with its figures");
});

scenario("source code is a folder that tests itself, zipped", async (page) => {
  await openRobot(page, "puma560", { panel: "share" });
  await section(page, "Code").click();
  await page.getByRole("combobox", { name: "Language of the code" }).selectOption("python");
  await page.getByRole("button", { name: "Write the code" }).click();
  await page.getByRole("button", { name: "Save as zip" }).waitFor();
  const files = decodeZip(await saved(page, "Save as zip", /-python\.zip$/));
  const names = [...files.keys()];
  assert.ok(names.some((name) => /\/test_\w+\.py$/.test(name)) && names.some((name) => name.endsWith("/pyproject.toml")), names.join());
  const [, code] = [...files].find(([name]) => /\/(?!test_)\w+\.py$/.test(name));
  assert.ok(/^def fk\(/m.test(code) && /^def ik\(/m.test(code), "forward and inverse");
  assert.ok(names.every((name) => !name.startsWith("/") && !name.includes("..")), "in a folder of their own");

  await page.getByRole("combobox", { name: "Language of the code" }).selectOption("c");
  await page.getByRole("button", { name: "Write the code" }).click();
  const other = decodeZip(await saved(page, "Save as zip", /-c\.zip$/));
  for (const [name, text] of [...files, ...other]) assert.ok(text.length > 0 && !text.includes("\0"), `${name} is text`);
  assert.ok([...other.keys()].some((name) => name.endsWith(".h")));
  assert.equal(crc32(Buffer.from("123456789")), 0xcbf43926, "the check value of CRC-32");
});

scenario("figures as SVG and PNG, and the view as it is", async (page) => {
  await openRobot(page, "staubli-rx90", { panel: "share" });
  await section(page, "Figure").click();
  const view = await saved(page, "Save the view (PNG)", /-view\.png$/);
  assert.ok(decodePng(view).width >= 1000, "at twice its size");
  assert.ok(drawn(view) > 0.02, "the picture is not empty");

  const seen = new Set();
  for (const kind of ["Arm", "Line diagram"]) {
    await page.getByRole("radio", { name: kind, exact: true }).check();
    await page.getByRole("button", { name: "Draw" }).click();
    await page.getByRole("button", { name: "Save SVG" }).waitFor();
    const svg = (await saved(page, "Save SVG", /\.svg$/)).toString();
    assert.match(svg, /^(<\?xml[^>]*>\s*)?<svg[^>]*xmlns="http:\/\/www\.w3\.org\/2000\/svg"/);
    const wrong = await page.evaluate((text) => new DOMParser().parseFromString(text, "image/svg+xml").querySelector("parsererror")?.textContent, svg);
    assert.equal(wrong, undefined);
    assert.ok((svg.match(/<(path|line|circle|polyline|polygon|ellipse|rect)\b/g) ?? []).length > 10);
    seen.add(svg);
    assert.ok(drawn(await saved(page, "Save PNG", /\.png$/)) > 0.005, `${kind} as dots`);
  }
  assert.equal(seen.size, 2);
});
