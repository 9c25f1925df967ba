// Bundles the page into `dist/`: `node build.mjs` for what is published, `node build.mjs --watch` while working on it.
// The engine, `dist/denavit.wasm`, is put there by `cargo xtask web`.
import { cpSync, mkdirSync, readdirSync } from "node:fs";
import { build, context } from "esbuild";

const options = {
  entryPoints: { main: "src/main.tsx", worker: "src/engine/worker.ts" },
  outdir: "dist",
  bundle: true,
  format: "esm",
  target: "es2022",
  minify: !process.argv.includes("--watch"),
  jsx: "automatic",
  jsxImportSource: "preact",
  legalComments: "none",
  logLevel: "info",
};

// What is fetched when it is first needed, with what these parts share.
const later = {
  ...options,
  entryPoints: Object.fromEntries(readdirSync("src/lazy").map((name) => [`lazy-${name.replace(/\.ts$/, "")}`, `src/lazy/${name}`])),
  splitting: true,
  chunkNames: "lazy-[hash]",
  // The library warns where it is there twice; here it is on purpose: the page begins with its own, smaller part of it.
  define: { "window.__THREE__": "globalThis.threeOfMeshes" },
};

mkdirSync("dist", { recursive: true });
cpSync("static", "dist", { recursive: true });
for (const part of [options, later]) {
  if (process.argv.includes("--watch")) await (await context(part)).watch();
  else await build(part);
}
