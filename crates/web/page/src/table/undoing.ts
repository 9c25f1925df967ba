// Undo and redo by keys. Cells are part of the table, so that in them too the table's own undo counts; other text
// fields keep the browser's.

import { redo, undo } from "../state.ts";
import { flush } from "./cells.ts";

/** Ctrl Z, Ctrl Y, Ctrl shift Z; says whether it was one. */
export function undoByKey(event: KeyboardEvent): boolean {
  if (!(event.ctrlKey || event.metaKey) || event.altKey) return false;
  const key = event.key.toLowerCase();
  if (key !== "z" && key !== "y") return false;
  const field = event.target;
  const text = field instanceof HTMLTextAreaElement || (field instanceof HTMLInputElement && field.type !== "range" && field.type !== "radio");
  if (text && !(field as HTMLElement).dataset.cell) return false;
  event.preventDefault();
  flush();
  if (key === "y" || event.shiftKey) redo();
  else undo();
  return true;
}
