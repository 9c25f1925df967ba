// Moving among the cells of a table as in a spreadsheet: inputs carry `data-row` and `data-column`.

import type { TargetedKeyboardEvent } from "preact";

export function onGridKey(event: TargetedKeyboardEvent<HTMLElement>): void {
  const input = event.target;
  if (!(input instanceof HTMLInputElement) || event.ctrlKey || event.metaKey || event.altKey) return;
  const { row, column } = input.dataset;
  if (row === undefined || column === undefined) return;
  const start = input.selectionStart === 0 && input.selectionEnd === 0;
  const end = input.selectionStart === input.value.length && input.selectionEnd === input.value.length;
  // With the whole text selected, as it is on arrival, the arrows leave the cell.
  const whole = input.value !== "" && input.selectionStart === 0 && input.selectionEnd === input.value.length;
  let by: [number, number] | null = null;
  if (event.key === "ArrowDown" || (event.key === "Enter" && !event.shiftKey)) by = [1, 0];
  else if (event.key === "ArrowUp" || event.key === "Enter") by = [-1, 0];
  else if (event.key === "ArrowLeft" && !event.shiftKey && (start || whole)) by = [0, -1];
  else if (event.key === "ArrowRight" && !event.shiftKey && (end || whole)) by = [0, 1];
  if (!by) return;
  event.preventDefault();
  const next = event.currentTarget.querySelector<HTMLInputElement>(
    `input[data-row="${Number(row) + by[0]}"][data-column="${Number(column) + by[1]}"]`,
  );
  next?.focus();
  next?.select();
}
