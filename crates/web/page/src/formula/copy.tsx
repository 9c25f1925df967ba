// Copying of formulas: as LaTeX, Typst, Python, C or plain text.

import { signal } from "@preact/signals";
import { useEffect, useRef } from "preact/hooks";
import type { Formula } from "../engine/types.ts";
import { note, said } from "../state.ts";
import { toClipboard } from "../widgets/copy.tsx";
import { Icon } from "../widgets/icons.tsx";

export type Format = "latex" | "typst" | "python" | "c" | "text";

export const FORMATS: { key: Format; title: string }[] = [
  { key: "latex", title: "LaTeX" },
  { key: "typst", title: "Typst" },
  { key: "python", title: "Python" },
  { key: "c", title: "C" },
  { key: "text", title: "Plain text" },
];

/** What was chosen last; the keys for copying use it, too. */
const preferred = signal<Format>("latex");
/** The formulas whose menu is open, and the button it hangs on. */
const open = signal<{ formulas: Formula[]; anchor: HTMLElement } | null>(null);

/** Formulas below each other, in one text that the format's users can use as it stands. */
export function written(formulas: Formula[], format: Format): string {
  const lines = formulas.map((formula) => formula[format]);
  if (lines.length === 1) return lines[0]!;
  const aligned = lines.map((line) => line.replace(/ *(?<![<>!:&])= */, " &= "));
  switch (format) {
    case "latex":
      return `\\begin{aligned}\n${aligned.join(" \\\\\n")}\n\\end{aligned}`;
    case "typst":
      return aligned.join(" \\\n");
    default:
      return lines.join("\n");
  }
}

export async function copyFormulas(formulas: Formula[], format: Format = preferred.value): Promise<void> {
  preferred.value = format;
  const title = FORMATS.find((f) => f.key === format)!.title;
  const what = formulas.length === 1 ? "Formula" : `${formulas.length} formulas`;
  try {
    await toClipboard(written(formulas, format));
    note(`${what} copied as ${title}.`);
  } catch (why) {
    said(why);
  }
}

export function openCopyMenu(formulas: Formula[], anchor: HTMLElement): void {
  open.value = open.value?.anchor === anchor ? null : { formulas, anchor };
}

/** A button that offers the formats. */
export function CopyButton(props: { formulas: Formula[]; label: string; words?: string }) {
  const isOpen = open.value !== null && open.value.formulas === props.formulas;
  return (
    <button
      type="button"
      class={props.words ? "copy with-words" : "copy"}
      aria-label={props.label}
      aria-haspopup="menu"
      aria-expanded={isOpen}
      title={props.label}
      onClick={(event) => openCopyMenu(props.formulas, event.currentTarget)}
      onKeyDown={(event) => {
        if (event.key !== "ArrowDown") return;
        event.preventDefault();
        openCopyMenu(props.formulas, event.currentTarget);
      }}
    >
      <Icon name="copy" size={16} />
      {props.words && <span>{props.words}</span>}
    </button>
  );
}

/** The menu; there is one for the page, above everything. */
export function CopyMenu() {
  const menu = useRef<HTMLDivElement>(null);
  const shown = open.value;
  useEffect(() => {
    const element = menu.current;
    if (!shown || !element) return;
    element.showPopover();
    place(element, shown.anchor);
    const chosen = element.querySelector<HTMLElement>(`[data-format="${preferred.peek()}"]`);
    (chosen ?? element.querySelector<HTMLElement>("button"))?.focus();
    const close = () => (open.value = null);
    const outside = (event: PointerEvent) => {
      const at = event.target as Node;
      if (!element.contains(at) && !shown.anchor.contains(at)) close();
    };
    document.addEventListener("pointerdown", outside);
    window.addEventListener("resize", close);
    // What scrolls takes the anchor away from under the menu.
    document.addEventListener("scroll", close, { capture: true, passive: true });
    return () => {
      document.removeEventListener("pointerdown", outside);
      window.removeEventListener("resize", close);
      document.removeEventListener("scroll", close, { capture: true });
    };
  }, [shown]);
  if (!shown) return null;

  const leave = () => {
    open.value = null;
    shown.anchor.focus({ preventScroll: true });
  };
  const keys = (event: KeyboardEvent) => {
    const items = [...menu.current!.querySelectorAll<HTMLElement>("button")];
    const at = items.indexOf(document.activeElement as HTMLElement);
    const go = (to: number) => items[(to + items.length) % items.length]!.focus();
    switch (event.key) {
      case "ArrowDown":
        go(at + 1);
        break;
      case "ArrowUp":
        go(at - 1);
        break;
      case "Home":
        go(0);
        break;
      case "End":
        go(-1);
        break;
      case "Escape":
      case "Tab":
        leave();
        break;
      default: {
        const found = items.findIndex((item) => item.textContent?.toLowerCase().startsWith(event.key.toLowerCase()));
        if (event.key.length !== 1 || found < 0) return;
        go(found);
      }
    }
    event.preventDefault();
    event.stopPropagation();
  };
  return (
    <div ref={menu} class="copy-menu" popover="manual" role="menu" aria-label="Copy as" onKeyDown={keys}>
      {FORMATS.map(({ key, title }) => (
        <button
          key={key}
          type="button"
          role="menuitem"
          tabIndex={-1}
          data-format={key}
          onClick={() => {
            leave();
            void copyFormulas(shown.formulas, key);
          }}
        >
          {title}
        </button>
      ))}
    </div>
  );
}

/** Below the anchor, its right edges in line; above it where there is no room. */
function place(menu: HTMLElement, anchor: HTMLElement): void {
  const at = anchor.getBoundingClientRect();
  const { width, height } = menu.getBoundingClientRect();
  const below = at.bottom + 4 + height <= window.innerHeight;
  menu.style.left = `${Math.max(8, Math.min(at.right - width, window.innerWidth - width - 8))}px`;
  menu.style.top = `${below ? at.bottom + 4 : Math.max(8, at.top - 4 - height)}px`;
}
