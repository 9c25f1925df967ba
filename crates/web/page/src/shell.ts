// What the shell remembers: whether the engine is there, the theme, the width of the side.

import { asked } from "./asked.ts";
import { computed, effect, look, show, signal } from "./state.ts";

export type Phase =
  | { kind: "loading" }
  | { kind: "ready" }
  /** The page cannot work here; a sentence says why. */
  | { kind: "failed"; words: string };
export const phase = signal<Phase>({ kind: "loading" });

const darkSystem = matchMedia("(prefers-color-scheme: dark)");
const isDarkSystem = signal(darkSystem.matches);
darkSystem.addEventListener("change", () => (isDarkSystem.value = darkSystem.matches));

/** The theme that is shown. */
export const theme = computed<"light" | "dark">(() => {
  const wanted = look.value.theme;
  return wanted === "system" ? (isDarkSystem.value ? "dark" : "light") : wanted;
});

/** The share of the width that the side takes, pixels; nothing for the sheet's own. */
export const side = signal<number | null>(null);

const KEPT = "denavit.page";

/** Takes up what this browser kept, and keeps it from now on: theme, units, the width of the side. Not where the page is a `guest`. */
export function keepPreferences(isGuest: boolean): void {
  effect(() => {
    document.documentElement.dataset.theme = theme.value;
  });
  if (isGuest) return;
  try {
    const kept: unknown = JSON.parse(localStorage.getItem(KEPT) ?? "null");
    if (kept && typeof kept === "object") {
      const { theme: wanted, angles, lengths, side: width } = kept as Record<string, unknown>;
      if (!asked.theme && (wanted === "light" || wanted === "dark" || wanted === "system")) show({ theme: wanted });
      if (angles === "deg" || angles === "rad") show({ angles });
      if (lengths === "mm" || lengths === "m") show({ lengths });
      if (typeof width === "number" && width >= 320 && width <= 1200) side.value = width;
    }
  } catch {
    // What cannot be read is as good as nothing.
  }
  effect(() => {
    const { theme: wanted, angles, lengths } = look.value;
    const text = JSON.stringify({ theme: wanted, angles, lengths, side: side.value });
    try {
      localStorage.setItem(KEPT, text);
    } catch {
      // A browser that keeps nothing still shows the page.
    }
  });
}
