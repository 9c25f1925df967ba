// A button that copies a text and says so.

import { useEffect, useState } from "preact/hooks";
import { note, said } from "../state.ts";
import { Button } from "./button.tsx";

interface CopyButtonProps {
  label: string;
  text(): string | Promise<string>;
  /** What the status line says after. */
  done?: string;
  bare?: boolean;
  small?: boolean;
  kind?: "plain" | "main";
}

export function CopyButton({ label, text, done = "Copied.", bare, small, kind }: CopyButtonProps) {
  const [copied, setCopied] = useState(false);
  useEffect(() => {
    if (!copied) return;
    const timer = setTimeout(() => setCopied(false), 1500);
    return () => clearTimeout(timer);
  }, [copied]);
  const copy = async () => {
    try {
      await toClipboard(await text());
      setCopied(true);
      note(done);
    } catch (why) {
      said(why);
    }
  };
  return <Button label={label} icon={copied ? "done" : "copy"} bare={bare} small={small} kind={kind} onClick={() => void copy()} />;
}

/** Puts a text into the clipboard, by the old way where the new one is not allowed. */
export async function toClipboard(text: string): Promise<void> {
  try {
    await navigator.clipboard.writeText(text);
    return;
  } catch {
    // An insecure address or a refused permission: a selected text field still works.
  }
  const before = document.activeElement;
  const area = document.createElement("textarea");
  area.value = text;
  area.className = "spoken";
  // Beneath an open dialog nothing can be selected.
  (document.querySelector("dialog[open]") ?? document.body).append(area);
  area.select();
  const copied = document.execCommand("copy");
  area.remove();
  if (before instanceof HTMLElement) before.focus();
  if (!copied) throw new Error("The browser does not let this page use the clipboard.");
}

/** Saves a text as a file. */
export function download(name: string, text: string, type = "text/plain"): void {
  const address = URL.createObjectURL(new Blob([text], { type: `${type};charset=utf-8` }));
  const link = document.createElement("a");
  link.href = address;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}
