// Zip files read by their directory (APPNOTE 4.3), with every checksum compared.
import assert from "node:assert/strict";
import { inflateRawSync } from "node:zlib";

const TABLE = Array.from({ length: 256 }, (_, n) => {
  let c = n;
  for (let k = 0; k < 8; k++) c = c & 1 ? 0xedb88320 ^ (c >>> 1) : c >>> 1;
  return c >>> 0;
});

export function crc32(bytes) {
  let c = 0xffffffff;
  for (const byte of bytes) c = TABLE[(c ^ byte) & 255] ^ (c >>> 8);
  return (c ^ 0xffffffff) >>> 0;
}

/** Names and texts. */
export function decodeZip(file) {
  assert.equal(file.readUInt32LE(0), 0x04034b50, "a zip begins with a file");
  const end = file.lastIndexOf(Buffer.from([0x50, 0x4b, 5, 6]));
  assert.ok(end > 0, "a zip ends with its directory");
  const files = new Map();
  let at = file.readUInt32LE(end + 16);
  for (let k = 0; k < file.readUInt16LE(end + 10); k++) {
    assert.equal(file.readUInt32LE(at), 0x02014b50);
    const [method, crc, packed, length] = [file.readUInt16LE(at + 10), file.readUInt32LE(at + 16), file.readUInt32LE(at + 20), file.readUInt32LE(at + 24)];
    const [nameLength, extra, comment, offset] = [file.readUInt16LE(at + 28), file.readUInt16LE(at + 30), file.readUInt16LE(at + 32), file.readUInt32LE(at + 42)];
    const name = file.toString("utf8", at + 46, at + 46 + nameLength);
    const begin = offset + 30 + file.readUInt16LE(offset + 26) + file.readUInt16LE(offset + 28);
    const stored = file.subarray(begin, begin + packed);
    const bytes = method === 8 ? inflateRawSync(stored) : stored;
    assert.deepEqual([bytes.length, crc32(bytes)], [length, crc], name);
    files.set(name, bytes.toString("utf8"));
    at += 46 + nameLength + extra + comment;
  }
  return files;
}
