// Serves `dist/` as `denavit view` does, with its Content-Security-Policy; or names the address in SITE instead.
import { createServer } from "node:http";
import { readFile } from "node:fs/promises";
import { extname } from "node:path";

const dist = new URL("../dist/", import.meta.url);
const POLICY =
  "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; worker-src 'self'; style-src 'self'; img-src 'self' blob: data:; " +
  "font-src 'self'; connect-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";
const TYPES = {
  ".html": "text/html; charset=utf-8",
  ".js": "text/javascript; charset=utf-8",
  ".css": "text/css; charset=utf-8",
  ".json": "application/json",
  ".wasm": "application/wasm",
  ".svg": "image/svg+xml",
  ".woff2": "font/woff2",
};

/** The address of the page, and what ends its server. With `policy` null it serves as any static host does, and so others may frame it. */
export async function serve(policy = POLICY) {
  if (process.env.SITE && policy) return { url: process.env.SITE, end() {} };
  const server = createServer(async (request, response) => {
    const { pathname } = new URL(request.url, "http://page");
    const name = pathname === "/" ? "index.html" : pathname.slice(1);
    const head = { ...(policy && { "content-security-policy": policy }), "x-content-type-options": "nosniff", "cache-control": "no-store" };
    try {
      if (!/^[\w.-]+$/.test(name)) throw new Error("not a file of the page");
      const body = await readFile(new URL(name, dist));
      response.writeHead(200, { ...head, "content-type": TYPES[extname(name)] ?? "application/octet-stream" }).end(body);
    } catch {
      response.writeHead(404, head).end();
    }
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  const end = () => {
    server.closeAllConnections();
    server.close();
  };
  return { url: `http://127.0.0.1:${server.address().port}/`, end };
}
