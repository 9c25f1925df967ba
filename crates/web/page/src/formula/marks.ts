// Symbols in formulas and the joints that they are about: what is under the pointer highlights joints, what is
// highlighted elsewhere is marked in the formulas.

import { effect } from "@preact/signals";
import { highlighted } from "../state.ts";

export interface Symbols {
  /** The symbols inside of an element, in reading order. */
  within(element: Element): Element[];
  name(symbol: Element): string;
  joints(symbol: Element): number[];
  dispose(): void;
}

const GREEK: Record<string, string> = {
  α: "alpha", β: "beta", γ: "gamma", δ: "delta", ε: "epsilon", ζ: "zeta", η: "eta", θ: "theta", ϑ: "theta", ι: "iota", κ: "kappa",
  λ: "lambda", μ: "mu", ν: "nu", ξ: "xi", ρ: "rho", σ: "sigma", τ: "tau", υ: "upsilon", φ: "phi", ϕ: "phi", χ: "chi", ψ: "psi",
  ω: "omega",
};

/** One spelling for `θ2`, `theta2`, `theta_2`, `C_{2-3}` and `C2−3`. */
export function plain(name: string): string {
  return name.replace(/[α-ωϑϕ]/g, (letter) => GREEK[letter] ?? letter).replace(/[\s_{}\u2061\u2062]/g, "").replaceAll("−", "-");
}

/** Finds the symbols below `root` and binds them to `highlighted`, until disposed of. */
export function bind(root: Element, joints: Record<string, number[]>, say: (words: string) => void): Symbols {
  const known = new Map(Object.entries(joints).map(([name, about]) => [plain(name), { name, about }]));
  const found = new Map<Element, { name: string; about: number[] }>();
  const byJoint = new Map<number, Element[]>();
  for (const math of root.querySelectorAll("math")) visit(math);

  function visit(element: Element): void {
    const tag = element.localName;
    if (tag === "msub" || tag === "mi" || tag === "mover") {
      const entry = known.get(plain(element.textContent ?? ""));
      if (entry && entry.about.length > 0) {
        element.classList.add("joint-symbol");
        found.set(element, entry);
        for (const joint of entry.about) byJoint.set(joint, [...(byJoint.get(joint) ?? []), element]);
        return;
      }
    }
    for (const child of element.children) visit(child);
  }

  let lit: Element[] = [];
  const stop = effect(() => {
    for (const element of lit) element.classList.remove("lit");
    lit = [...highlighted.value].flatMap((joint) => byJoint.get(joint) ?? []);
    for (const element of lit) element.classList.add("lit");
  });

  let mine = false;
  const over = (event: Event) => {
    const symbol = (event.target as Element).closest(".joint-symbol");
    const entry = symbol && found.get(symbol);
    if (entry) {
      mine = true;
      highlight(entry.about);
    } else if (mine) {
      mine = false;
      highlight([]);
    }
  };
  const out = () => {
    if (mine) highlight([]);
    mine = false;
  };

  // In a formula that has the focus the arrow keys go from symbol to symbol.
  let chosen: Element | null = null;
  const choose = (symbol: Element | null) => {
    chosen?.classList.remove("chosen");
    chosen = symbol;
    const entry = symbol && found.get(symbol);
    highlight(entry ? entry.about : []);
    if (!symbol || !entry) return;
    symbol.classList.add("chosen");
    symbol.scrollIntoView({ block: "nearest", inline: "nearest" });
    say(`${entry.name}: ${entry.about.length > 1 ? "joints" : "joint"} ${entry.about.map((j) => j + 1).join(", ")}`);
  };
  const keys = (event: Event) => {
    const { key, target } = event as KeyboardEvent;
    if (!(target instanceof Element) || !target.matches("[data-symbols]")) return;
    const all = symbols.within(target);
    const at = chosen ? all.indexOf(chosen) : -1;
    const to = key === "ArrowRight" ? at + 1 : key === "ArrowLeft" ? at - 1 : key === "Home" ? 0 : key === "End" ? all.length - 1 : null;
    if (key === "Escape" && chosen) choose(null);
    // Beyond the last symbol the box scrolls as any other does.
    if (to === null || !all[to]) return;
    event.preventDefault();
    choose(all[to]);
  };
  const blur = () => chosen && choose(null);

  root.addEventListener("pointerover", over);
  root.addEventListener("pointerleave", out);
  root.addEventListener("keydown", keys);
  root.addEventListener("focusout", blur);
  const symbols: Symbols = {
    within: (element) => [...element.querySelectorAll(".joint-symbol")].filter((symbol) => found.has(symbol)),
    name: (symbol) => found.get(symbol)?.name ?? "",
    joints: (symbol) => found.get(symbol)?.about ?? [],
    dispose() {
      stop();
      out();
      root.removeEventListener("pointerover", over);
      root.removeEventListener("pointerleave", out);
      root.removeEventListener("keydown", keys);
      root.removeEventListener("focusout", blur);
    },
  };
  return symbols;
}

/** Sets the joints that are highlighted, if they are others than now. */
export function highlight(joints: number[]): void {
  const now = highlighted.peek();
  if (now.size === joints.length && joints.every((j) => now.has(j))) return;
  highlighted.value = new Set(joints);
}
