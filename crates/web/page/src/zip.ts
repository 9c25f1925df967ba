// A zip archive of texts, stored as they are. Format: PKWARE APPNOTE 6.3.10, sections 4.3.7, 4.3.12 and 4.3.16.

export function zip(files: { path: string; text: string }[]): Blob {
  const encoder = new TextEncoder();
  const parts: Uint8Array<ArrayBuffer>[] = [];
  const directory: Uint8Array<ArrayBuffer>[] = [];
  let offset = 0;
  for (const { path, text } of files) {
    const name = encoder.encode(path);
    const data = encoder.encode(text);
    // Version 2.0, names in UTF-8, stored, 1 January 1980.
    const common = [u16(20), u16(0x0800), u16(0), u16(0), u16(0x0021), u32(checksum(data)), u32(data.length), u32(data.length), u16(name.length), u16(0)];
    const local = [u32(0x04034b50), ...common].flat();
    // Made by Unix, so that the permissions 0644 count.
    const central = [u32(0x02014b50), u16(0x0314), ...common, u16(0), u16(0), u16(0), u32((0o100644 << 16) >>> 0), u32(offset)].flat();
    parts.push(new Uint8Array(local), name, data);
    directory.push(new Uint8Array(central), name);
    offset += local.length + name.length + data.length;
  }
  const size = directory.reduce((sum, part) => sum + part.length, 0);
  const end = [u32(0x06054b50), u16(0), u16(0), u16(files.length), u16(files.length), u32(size), u32(offset), u16(0)].flat();
  return new Blob([...parts, ...directory, new Uint8Array(end)], { type: "application/zip" });
}

function u16(n: number): number[] {
  return [n & 0xff, (n >>> 8) & 0xff];
}

function u32(n: number): number[] {
  return [...u16(n & 0xffff), ...u16(n >>> 16)];
}

/** CRC-32 with the polynomial of IEEE 802.3. */
function checksum(data: Uint8Array): number {
  let crc = 0xffffffff;
  for (const byte of data) {
    crc ^= byte;
    for (let bit = 0; bit < 8; bit++) crc = crc & 1 ? (crc >>> 1) ^ 0xedb88320 : crc >>> 1;
  }
  return (crc ^ 0xffffffff) >>> 0;
}
