// Pictures from the engine, shown as images: what stands inside of them cannot touch the page.

import { useEffect, useState } from "preact/hooks";

/** An address for a text as a file, as long as the component is shown. */
export function useBlobUrl(text: string, type: string): string | undefined {
  const [url, setUrl] = useState<string>();
  useEffect(() => {
    const made = URL.createObjectURL(new Blob([text], { type }));
    setUrl(made);
    return () => URL.revokeObjectURL(made);
  }, [text, type]);
  return url;
}

export function Picture({ svg, words }: { svg: string; words: string }) {
  const url = useBlobUrl(svg, "image/svg+xml");
  const { width, height } = size(svg);
  return <img class="picture" src={url} width={width} height={height} alt={words} />;
}

/** The size that an SVG says it has, so that its place is kept until it is there. */
export function size(svg: string): { width: number; height: number } {
  const head = svg.slice(0, svg.indexOf(">") + 1);
  const box = /viewBox="([^"]+)"/.exec(head)?.[1]?.trim().split(/[\s,]+/).map(Number);
  const number = (name: string) => parseFloat(new RegExp(`\\s${name}="([\\d.]+)`).exec(head)?.[1] ?? "");
  return { width: Math.round(number("width") || box?.[2] || 640), height: Math.round(number("height") || box?.[3] || 480) };
}

/** The words of a text with tags, for a screen reader. */
export function wordsOf(html: string): string {
  const parsed = new DOMParser().parseFromString(html, "text/html");
  for (const math of parsed.querySelectorAll("math[alttext]")) math.replaceWith(math.getAttribute("alttext") ?? "");
  return (parsed.body.textContent ?? "").replace(/\s+/g, " ").trim();
}
