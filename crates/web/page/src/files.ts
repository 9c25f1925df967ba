// Where the files of the page are: beside it, or, in the page that is a single file (`pack.mjs`), within it.

/** A file within this one: compressed by gzip, in base64, with its type. */
interface Packed {
  type: string;
  data: string;
}

const made = new Map<string, { address: string; contents: Blob }>();

/** Unpacks the files within this page, if there are some. */
export async function unpackFiles(): Promise<void> {
  const place = document.getElementById("packed-files");
  const packed = place?.textContent;
  if (!packed) return;
  place.remove();
  const files = Object.entries(JSON.parse(packed) as Record<string, Packed>);
  const unpacked = files.map(async ([name, { type, data }]) => {
    const bytes = Uint8Array.from(atob(data), (letter) => letter.charCodeAt(0));
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
    const contents = new Blob([await new Response(stream).arrayBuffer()], { type });
    made.set(name, { address: URL.createObjectURL(contents), contents });
  });
  await Promise.all(unpacked);
}

export function addressOf(name: string): string {
  return made.get(name)?.address ?? new URL(name, document.baseURI).href;
}

/** For a worker: where to fetch the file, or, since a worker of a page that is a file may fetch nothing, the file. */
export function sourceOf(name: string): string | Blob {
  return made.get(name)?.contents ?? addressOf(name);
}
