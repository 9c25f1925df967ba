// Small drawings for buttons, in the colour of the text. They never stand for a button's name: that is its label.

import type { ComponentChildren } from "preact";

function Drawing({ children, size = 18 }: { children: ComponentChildren; size?: number }) {
  return (
    <svg
      width={size}
      height={size}
      viewBox="0 0 18 18"
      fill="none"
      stroke="currentColor"
      stroke-width="1.5"
      stroke-linecap="round"
      stroke-linejoin="round"
      aria-hidden="true"
    >
      {children}
    </svg>
  );
}

export function ArmIcon() {
  return (
    <svg width="22" height="22" viewBox="0 0 22 22" fill="none" stroke="currentColor" stroke-width="2" stroke-linecap="round" aria-hidden="true">
      <path d="M3 20h8M7 20v-5M8 12l4-6M14 6l4 4" />
      <circle cx="7" cy="13" r="2" />
      <circle cx="13" cy="5" r="2" />
    </svg>
  );
}

const paths = {
  robots: "M3 3h5v5H3zM10 3h5v5h-5zM3 10h5v5H3zM10 10h5v5h-5z",
  open: "M2.5 14V4.5h4l1.5 2h6.5V8M2.5 14l2-6h11.5l-2 6z",
  save: "M9 2.5v8M5.8 7.5 9 10.7l3.2-3.2M3 12.5v2.5h12v-2.5",
  undo: "M6.5 3.5 3 7l3.5 3.5M3.5 7H11a4 4 0 0 1 0 8H7",
  redo: "M11.5 3.5 15 7l-3.5 3.5M14.5 7H7a4 4 0 0 0 0 8h4",
  close: "M4.5 4.5l9 9M13.5 4.5l-9 9",
  down: "M5 7.5 9 11.5l4-4",
  up: "M5 10.5 9 6.5l4 4",
  plus: "M9 4v10M4 9h10",
  minus: "M4 9h10",
  trash: "M3.5 5h11M7 5V3.2h4V5M5 5l.7 10h6.6L13 5M7.6 8v4.5M10.4 8v4.5",
  copy: "M6.5 6.5h8.5v8.5H6.5zM11.5 6.5V3H3v8.5h3.5",
  done: "M3.5 9.5 7.3 13.2 14.5 5.5",
  link: "M7.5 10.5a3 3 0 0 0 4.2 0l2.6-2.6a3 3 0 0 0-4.2-4.2l-.9.9M10.5 7.5a3 3 0 0 0-4.2 0l-2.6 2.6a3 3 0 0 0 4.2 4.2l.9-.9",
  error: "M9 5.2v4.6M9 12.6v.1M9 2 16.5 15.5h-15z",
  note: "M9 8.2v4.6M9 5.3v.1M9 1.8a7.2 7.2 0 1 0 0 14.4A7.2 7.2 0 1 0 9 1.8",
  sun: "M9 5.5a3.5 3.5 0 1 0 0 7 3.5 3.5 0 0 0 0-7M9 1.5V3M9 15v1.5M1.5 9H3M15 9h1.5M3.7 3.7l1 1M13.3 13.3l1 1M3.7 14.3l1-1M13.3 4.7l1-1",
  moon: "M15 10.5A6.5 6.5 0 1 1 7.5 3a5.2 5.2 0 0 0 7.5 7.5z",
  system: "M2.5 3.5h13v8.5h-13zM6.5 15h5M9 12v3",
  search: "M8 3a5 5 0 1 0 0 10A5 5 0 0 0 8 3M11.8 11.8 15.5 15.5",
  dice: "M3.5 3.5h11v11h-11zM6.5 6.5v.1M11.5 6.5v.1M9 9v.1M6.5 11.5v.1M11.5 11.5v.1",
  reset: "M4 4v4h4M4.3 7.6A5.8 5.8 0 1 1 3.5 11",
  target: "M9 3.5a5.5 5.5 0 1 0 0 11 5.5 5.5 0 0 0 0-11M9 1.5v4M9 12.5v4M1.5 9h4M12.5 9h4",
  file: "M4 2.5h6l4 4v9H4zM10 2.5v4h4",
} as const;

export type IconName = keyof typeof paths;

export function Icon({ name, size }: { name: IconName; size?: number }) {
  return (
    <Drawing size={size}>
      <path d={paths[name]} />
    </Drawing>
  );
}
