// Bundles the page into `dist/`: `node build.mjs` for what is published, `node build.mjs --watch` while working on it.
// The engine, `dist/denavit.wasm`, is put there by `cargo xtask web`.
import { cpSync, mkdirSync } from "node:fs";
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

mkdirSync("dist", { recursive: true });
cpSync("static", "dist", { recursive: true });
if (process.argv.includes("--watch")) await (await context(options)).watch();
else await build(options);
