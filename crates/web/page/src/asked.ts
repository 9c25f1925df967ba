// What the address asks for behind its `?`: a robot of the catalogue, what is shown of the page, and how. It is somebody
// else's text, as the fragment is: what is no value of its key is passed over.

import type { Topic } from "./engine/types.ts";
import type { Panel } from "./state.ts";

/** Parts of the page in another page: without the bars above and below and without tabs. */
export type Embedded = "both" | "scene" | "panel";

export interface Asked {
  embedded: Embedded | null;
  robot: string | null;
  panel: Panel | null;
  topic: Topic | null;
  /** A row of the table (from 0) to be explained. */
  row: number | null;
  theme: "light" | "dark" | null;
}

const PANELS: readonly Panel[] = ["table", "joints", "hand", "formulas", "path", "check", "share"];
const TOPICS: readonly Topic[] = ["table", "links", "forward", "algorithm", "inverse", "jacobian", "singularities"];

export function read(search: string): Asked {
  const given = new URLSearchParams(search);
  const oneOf = <T extends string>(key: string, allowed: readonly T[]): T | null => allowed.find((one) => one === given.get(key)) ?? null;
  const row = Number(given.get("row") ?? NaN);
  const robot = given.get("robot") ?? "";
  return {
    embedded: given.has("embed") ? (oneOf("embed", ["both", "scene", "panel"] as const) ?? "both") : null,
    robot: /^[\w-]{1,80}$/.test(robot) ? robot : null,
    panel: oneOf("panel", PANELS),
    topic: oneOf("topic", TOPICS),
    row: Number.isInteger(row) && row >= 1 && row <= 64 ? row - 1 : null,
    theme: oneOf("theme", ["light", "dark"] as const),
  };
}

export const asked: Asked = read(location.search);
