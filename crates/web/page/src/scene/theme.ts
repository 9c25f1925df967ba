// The colours of the scene, light and dark. Numbers from 0 to 1 as the shaders take them: no colour space in between.

import { computed, signal } from "@preact/signals";
import { look } from "../state.ts";

export type Colour = [number, number, number];

const DARK = matchMedia("(prefers-color-scheme: dark)");
const systemIsDark = signal(DARK.matches);
DARK.addEventListener("change", () => (systemIsDark.value = DARK.matches));

export const isDark = computed(() => {
  const theme = look.value.theme;
  return theme === "system" ? systemIsDark.value : theme === "dark";
});

/** Whether the person asked for less motion. */
export const stillness = matchMedia("(prefers-reduced-motion: reduce)");

function rgb(hex: string): Colour {
  const value = Number.parseInt(hex.slice(1), 16);
  return [((value >> 16) & 255) / 255, ((value >> 8) & 255) / 255, (value & 255) / 255];
}

export function css([r, g, b]: Colour): string {
  return `rgb(${[r, g, b].map((x) => Math.round(255 * x)).join(" ")})`;
}

export function blend(a: Colour, b: Colour, t: number): Colour {
  return [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])];
}

function palette<T extends Record<string, string>>(hex: T): Record<keyof T, Colour> {
  return Object.fromEntries(Object.entries(hex).map(([name, value]) => [name, rgb(value)])) as Record<keyof T, Colour>;
}

// Axes and the four parameters of a row have the colours of `static/style.css`, as in the table and in the formulas. Red
// and green differ in lightness too, and every axis has its letter, for colour-blind people.
const light = palette({
  background: "#f3f5f7",
  grid: "#d3d8df",
  gridStrong: "#b4bcc7",
  shadow: "#6a7687",
  base: "#7d8795",
  link: "#dfe3e8",
  rod: "#aab3be",
  revolute: "#3f6288",
  prismatic: "#2d857c",
  pin: "#c7d0da",
  hand: "#8b95a3",
  glow: "#f0a202",
  near: "#e08a3a",
  ghost: "#7c90c4",
  ghostStrong: "#3c5fc4",
  beyond: "#98a0aa",
  obstacle: "#b04a5a",
  singular: "#d9731a",
  x: "#c4322b",
  y: "#1d7d3c",
  z: "#1f5fd0",
  theta: "#a14a00",
  d: "#1f5fd0",
  a: "#c4322b",
  alpha: "#7a3fb8",
  normal: "#6b7482",
  text: "#17212b",
  quiet: "#4a5866",
  path: "#6741b5",
  velocity: "#0f7285",
  now: "#1d2530",
});

const dark: typeof light = palette({
  background: "#0f1317",
  grid: "#2c3440",
  gridStrong: "#465263",
  shadow: "#000000",
  base: "#626d7b",
  link: "#b9c1cb",
  rod: "#88929e",
  revolute: "#5b8bc0",
  prismatic: "#3fa598",
  pin: "#dfe5ec",
  hand: "#949eab",
  glow: "#ffc233",
  near: "#d98b45",
  ghost: "#9aaeea",
  ghostStrong: "#9db4ff",
  beyond: "#8b95a3",
  obstacle: "#e07a8a",
  singular: "#f2994a",
  x: "#ff7a70",
  y: "#62cf85",
  z: "#7fabff",
  theta: "#ffb066",
  d: "#7fabff",
  a: "#ff7a70",
  alpha: "#c9a0f5",
  normal: "#8d97a5",
  text: "#e6ebf0",
  quiet: "#a9b5c1",
  path: "#b79bff",
  velocity: "#5cc5d8",
  now: "#eef2f7",
});

export type Palette = typeof light;
export const colours = computed<Palette>(() => (isDark.value ? dark : light));

// Viridis, five of its colours: even in lightness, and read by colour-blind people.
const SCALE = ["#440154", "#3b528b", "#21918c", "#5ec962", "#fde725"].map(rgb);

/** A colour for a value from 0 to 1. */
export function onScale(value: number): Colour {
  const x = Math.min(1, Math.max(0, value)) * (SCALE.length - 1);
  const k = Math.min(SCALE.length - 2, Math.floor(x));
  return blend(SCALE[k], SCALE[k + 1], x - k);
}
