// Files for whoever uses the page: a link with a blob behind it, followed at once.

import { note, robot, said } from "../state.ts";

export function save(name: string, content: Blob | string, type = "text/plain"): void {
  const blob = typeof content === "string" ? new Blob([content], { type: `${type};charset=utf-8` }) : content;
  const url = URL.createObjectURL(blob);
  const link = document.createElement("a");
  link.href = url;
  link.download = name;
  link.click();
  // Not before the browser has opened it.
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
  note(`${name} saved.`);
}

/** A name for files about the present robot: `staubli-rx-90`. */
export function fileName(): string {
  const words = (robot.peek()?.robot ?? "").normalize("NFD").replace(/\p{M}/gu, "").toLowerCase();
  return words.replace(/[^a-z0-9]+/g, "-").replace(/^-+|-+$/g, "") || "robot";
}

/** Runs something that may fail, and says so if it does. */
export async function attempt(what: () => void | Promise<void>): Promise<void> {
  try {
    await what();
  } catch (why) {
    said(why);
  }
}
