// What makes the page work without a network: the service worker that keeps its files (`kept`), and the page as a single file
// that opens from a disk (`single`).
import { createHash } from "node:crypto";
import { readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";
import { gzipSync } from "node:zlib";
import { build } from "esbuild";

const ENGINE = /\.wasm$/;
const TYPES = { wasm: "application/wasm", js: "text/javascript", woff2: "font/woff2" };

/** The service worker for the files of a folder: its cache is called by what they contain, so that another page has another one. */
export function kept(folder) {
  const names = readdirSync(folder).filter((name) => name !== "sw.js").sort();
  const hash = createHash("sha256");
  for (const name of names) hash.update(`${name}\0`).update(readFileSync(join(folder, name))).update("\0");
  return `// Keeps the files of the page, and answers with them. A new page waits until the one before is closed everywhere: files of two never meet.
const KEPT = "denavit-${hash.digest("hex").slice(0, 16)}";
const FILES = ${JSON.stringify(names)};
const fresh = (name) => new Request(name, { cache: "reload" });
self.addEventListener("install", (event) => event.waitUntil(caches.open(KEPT).then((cache) => cache.addAll(FILES.map(fresh)))));
self.addEventListener("activate", (event) => event.waitUntil((async () => {
  const others = (await caches.keys()).filter((name) => name.startsWith("denavit-") && name !== KEPT);
  await Promise.all(others.map((name) => caches.delete(name)));
  await self.clients.claim();
})()));
self.addEventListener("fetch", (event) => {
  const { request } = event;
  const url = new URL(request.url);
  const scope = new URL(self.registration.scope);
  if (request.method !== "GET" || url.origin !== scope.origin || !url.pathname.startsWith(scope.pathname)) return;
  const name = url.pathname.slice(scope.pathname.length) || "index.html";
  if (!FILES.includes(name)) return;
  event.respondWith(caches.open(KEPT).then((cache) => cache.match(new URL(name, scope))).then((there) => there ?? fetch(request)));
});
`;
}

/** The page in `folder` as one file of HTML. */
export async function single(folder, options) {
  const read = (name) => readFileSync(join(folder, name));
  const lazy = readdirSync("src/lazy").map((name) => name.replace(/\.ts$/, ""));
  // Each by itself: a part within a file has no neighbours to import.
  const later = await build({
    ...options,
    entryPoints: Object.fromEntries(lazy.map((name) => [`lazy-${name}`, `src/lazy/${name}.ts`])),
    define: { "window.__THREE__": "globalThis.threeOfMeshes" },
    write: false,
    logLevel: "error",
  });
  const engine = readdirSync(folder).filter((name) => ENGINE.test(name));
  const files = [
    ...[...engine, "worker.js", "maths.woff2"].map((name) => [name, read(name)]),
    ...later.outputFiles.map(({ path, contents }) => [path.replace(/.*[\\/]/, ""), contents]),
  ];
  const packed = Object.fromEntries(files.map(([name, bytes]) => [name, { type: TYPES[name.split(".").pop()], data: gzipSync(bytes, { level: 9 }).toString("base64") }]));
  const font = `data:font/woff2;base64,${read("maths.woff2").toString("base64")}`;
  const put = (html, pattern, text) => {
    if (!pattern.test(html)) throw new Error(`index.html has no ${pattern}`);
    return html.replace(pattern, () => text);
  };
  let html = read("index.html").toString();
  for (const [, name] of html.matchAll(/<link rel="stylesheet" href="([\w.]+)">/g)) {
    const css = read(name).toString().replace(/url\("maths\.woff2"\)/, () => `url("${font}")`);
    html = put(html, new RegExp(`<link rel="stylesheet" href="${name.replace(".", "\\.")}">`), `<style>\n${css}</style>`);
  }
  html = put(html, /href="icon\.svg"/, `href="data:image/svg+xml;base64,${read("icon.svg").toString("base64")}"`);
  html = put(html, /\s*<link rel="preload"[^>]*>/, "");
  html = put(html, /\s*<script type="module" src="main\.js"><\/script>/, "");
  const script = read("main.js").toString().replaceAll("</script", "<\\/script");
  return put(html, /<\/body>/, `<script type="application/json" id="packed-files">${JSON.stringify(packed)}</script>\n<script type="module">${script}</script>\n</body>`);
}
