// Bundles the page into `dist/`: `node build.mjs` for what is published, `node build.mjs --watch` while working on it,
// `node build.mjs --single` for `single/denavit.html`, all of it in one file, once the rest is there.
// The engine, `dist/denavit.wasm`, is put there by `cargo xtask web`.
import { cpSync, mkdirSync, readdirSync, writeFileSync } from "node:fs";
import { build, context } from "esbuild";
import { kept, single } from "./pack.mjs";

const isWatched = process.argv.includes("--watch");
const shared = {
  outdir: "dist",
  bundle: true,
  format: "esm",
  target: "es2022",
  minify: !isWatched,
  jsx: "automatic",
  jsxImportSource: "preact",
  legalComments: "none",
  logLevel: "info",
};
const options = { ...shared, entryPoints: { main: "src/main.tsx", worker: "src/engine/worker.ts" } };

// What is fetched when it is first needed, with what these parts share.
const later = {
  ...shared,
  entryPoints: Object.fromEntries(readdirSync("src/lazy").map((name) => [`lazy-${name.replace(/\.ts$/, "")}`, `src/lazy/${name}`])),
  splitting: true,
  chunkNames: "lazy-[hash]",
  // The library warns where it is there twice; here it is on purpose: the page begins with its own, smaller part of it.
  define: { "window.__THREE__": "globalThis.threeOfMeshes" },
};

if (process.argv.includes("--single")) {
  mkdirSync("single", { recursive: true });
  writeFileSync("single/denavit.html", await single("dist", shared));
} else {
  mkdirSync("dist", { recursive: true });
  cpSync("static", "dist", { recursive: true });
  for (const part of [options, later]) {
    if (isWatched) await (await context(part)).watch();
    else await build(part);
  }
  writeFileSync("dist/sw.js", kept("dist"));
}
