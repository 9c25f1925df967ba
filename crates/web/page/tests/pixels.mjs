// Pictures as numbers: a reader for the PNGs that the browser takes, and what is counted in them.
import assert from "node:assert/strict";
import { inflateSync } from "node:zlib";

/** Width, height and bytes (three or four a pixel) of a PNG of eight bits without interlacing. */
export function decodePng(file) {
  assert.equal(file.subarray(0, 8).toString("latin1"), "\x89PNG\r\n\x1a\n", "a PNG begins with its signature");
  const parts = [];
  let header;
  for (let at = 8; at < file.length; ) {
    const length = file.readUInt32BE(at);
    const kind = file.toString("latin1", at + 4, at + 8);
    const data = file.subarray(at + 8, at + 8 + length);
    if (kind === "IHDR") header = { width: data.readUInt32BE(0), height: data.readUInt32BE(4), depth: data[8], colour: data[9], interlaced: data[12] };
    if (kind === "IDAT") parts.push(data);
    at += 12 + length;
  }
  assert.deepEqual([header.depth, header.interlaced], [8, 0]);
  const channels = { 2: 3, 6: 4 }[header.colour];
  return { ...header, channels, bytes: unfilter(inflateSync(Buffer.concat(parts)), header.height, header.width * channels, channels) };
}

/** The filters of PNG (specification, 9.2), undone line by line. */
function unfilter(raw, height, stride, channels) {
  const out = Buffer.alloc(height * stride);
  for (let y = 0; y < height; y++) {
    const filter = raw[y * (stride + 1)];
    for (let x = 0; x < stride; x++) {
      const left = x >= channels ? out[y * stride + x - channels] : 0;
      const up = y > 0 ? out[(y - 1) * stride + x] : 0;
      const corner = x >= channels && y > 0 ? out[(y - 1) * stride + x - channels] : 0;
      const guess = [0, left, up, (left + up) >> 1, paeth(left, up, corner)][filter];
      out[y * stride + x] = raw[y * (stride + 1) + 1 + x] + guess;
    }
  }
  return out;
}

function paeth(left, up, corner) {
  const p = left + up - corner;
  const [a, b, c] = [Math.abs(p - left), Math.abs(p - up), Math.abs(p - corner)];
  return a <= b && a <= c ? left : b <= c ? up : corner;
}

/** A step of colour that the eye sees, of 255. */
const SEEN = 24;

/** The share of the picture that is not the colour of most of it. */
export function drawn(file) {
  const { bytes, channels } = decodePng(file);
  const counts = new Map();
  for (let at = 0; at < bytes.length; at += channels) {
    const colour = (bytes[at] << 16) | (bytes[at + 1] << 8) | bytes[at + 2];
    counts.set(colour, (counts.get(colour) ?? 0) + 1);
  }
  const [background] = [...counts].reduce((one, other) => (other[1] > one[1] ? other : one));
  const ground = [background >> 16, (background >> 8) & 255, background & 255];
  return share(bytes, channels, (at, k) => ground[k]);
}

/** The share of pixels in which two pictures differ. */
export function differing(one, other) {
  const [first, second] = [decodePng(one), decodePng(other)];
  assert.deepEqual([first.width, first.height], [second.width, second.height]);
  return share(first.bytes, first.channels, (at, k) => second.bytes[at + k]);
}

function share(bytes, channels, expected) {
  let count = 0;
  for (let at = 0; at < bytes.length; at += channels) {
    if ([0, 1, 2].some((k) => Math.abs(bytes[at + k] - expected(at, k)) > SEEN)) count += 1;
  }
  return count / (bytes.length / channels);
}

/** The canvas of the scene once it stands still: drawn finely, nothing new for a while, and what was drawn is seen, twice the same. */
export async function pictureOf(page) {
  const canvas = page.locator("canvas.scene-canvas");
  let [before, seen] = [-1, null];
  for (;;) {
    const { frames, isStill } = await page.evaluate(async () => {
      await new Promise((resolve) => setTimeout(resolve, 260));
      return { frames: window.denavit.frames, isStill: window.denavit.isStill };
    });
    if (isStill && frames === before) {
      const now = await canvas.screenshot();
      if (seen?.equals(now)) return now;
      seen = now;
    }
    before = frames;
  }
}
